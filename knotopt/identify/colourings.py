"""Colouring polynomials: representations of the knot's group in a finite group, by longitudes.

The strands of a diagram are coloured by the elements of one conjugacy class such that at each
crossing the strand below changes by conjugation with that above (Wirtinger's presentation). Each
colouring with a given colour at the starting point sends the longitude to an element that commutes
with it; how often which one occurs is an invariant, and one that can tell mirror images apart.
Source: Riley, "Homomorphisms of knot groups on finite groups",
doi:10.1090/S0025-5718-1971-0295332-4; Eisermann, "Knot colouring polynomials",
doi:10.2140/pjm.2007.231.305.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from knotopt.identify.finite_groups import ConjugacyClass
from knotopt.planar.planar_diagram import PlanarDiagram

Colours = NDArray[np.int16]

MOST_COLOURINGS = 3_000_000
"""Colours of the strands that determine all others: more choices are not tried."""
WEIGHT = -1  # no strand's number: in its place, how many colourings each one stands for
DRAWN = 2000  # fours of strands, until one determines all others


def colouring_polynomial(
    planar: PlanarDiagram, colours: ConjugacyClass, *, most: int = MOST_COLOURINGS
) -> tuple[int, ...] | None:
    """How often the longitude is which element of the group, over all colourings.

    Elements are counted up to conjugation by what commutes with the colour at the starting point,
    which takes colourings to colourings; so the second colour need only be one of each orbit. The
    result is the same for both orientations of the knot.

    Parameters
    ----------
    planar : PlanarDiagram
    colours : ConjugacyClass
        The strand at the starting point has the class's first element.
    most : int
        Choices of colours that may be tried.

    Returns
    -------
    tuple of int, length of the group's order
        By the place in the group of an orbit's first element. None if more would be tried.
    """
    strands = Wirtinger.of(planar)
    size, count = len(colours.conjugates), len(strands.over)
    seeds = strands.seeds()
    firsts, lengths = colours.orbits
    if len(firsts) * size ** max(len(seeds) - 2, 0) > most:
        return None
    known = {seed: np.zeros(1, dtype=np.int16) for seed in seeds[:1]}
    known[WEIGHT] = np.ones(1, dtype=np.int16)
    for number, seed in enumerate(seeds[1:]):
        chosen = firsts if number == 0 else np.arange(size, dtype=np.int16)
        width = len(known[WEIGHT])
        known = {strand: np.repeat(colour, len(chosen)) for strand, colour in known.items()}
        known[seed] = np.tile(chosen, width)
        if number == 0:
            known[WEIGHT] = lengths
    checked: set[int] = set()
    while len(checked) < count:
        for k in set(range(count)) - checked:
            after, above = (k + 1) % count, strands.over[k]
            if above not in known or (k not in known and after not in known):
                continue
            ways = (colours.conjugates, colours.conjugates_back)[:: strands.signs[k]]
            checked.add(k)
            if k not in known:
                known[k] = ways[1][known[above], known[after]]
                continue
            found = ways[0][known[above], known[k]]
            if after not in known:
                known[after] = found
                continue
            agree = found == known[after]
            if not agree.all():
                known = {strand: colour[agree] for strand, colour in known.items()}
    return _longitudes(strands, colours, known, seeds[0] if seeds else 0)


@dataclass(frozen=True)
class Wirtinger:
    """The strands of a diagram between passes below, from 0 in order, and where they end.

    Attributes
    ----------
    over : tuple of int
        The strand above, where strand k goes below and strand k + 1 (modulo their number) begins.
    signs : tuple of +1 or -1
        Of that crossing.
    """

    over: tuple[int, ...]
    signs: tuple[int, ...]

    @classmethod
    def of(cls, planar: PlanarDiagram) -> Wirtinger:
        """The strands of a diagram."""
        strand = 0
        over = {}
        below = []
        count = len(planar.crossings)
        for crossing, is_over in planar.visits:
            if is_over:
                over[crossing] = strand
            else:
                below.append(crossing)
                strand = (strand + 1) % count
        return cls(
            tuple(over[crossing] for crossing in below),
            tuple(planar.signs[crossing] for crossing in below),
        )

    def seeds(self) -> tuple[int, ...]:
        """Few strands whose colours determine all others: as few as can be up to three, then four
        if some are met by chance.
        """
        strands = range(len(self.over))
        for size in range(4):
            for chosen in combinations(strands, size):
                if len(self._order(chosen)) == len(strands):
                    return chosen
        generator = random.Random(0)
        for _ in range(DRAWN):
            drawn = tuple(sorted(generator.sample(strands, 4)))
            if len(self._order(drawn)) == len(strands):
                return drawn
        seeds: tuple[int, ...] = (0,)
        while len(known := self._order(seeds)) < len(strands):
            more = [(*seeds, strand) for strand in strands if strand not in known]
            seeds = max(more, key=lambda each: len(self._order(each)))
        return seeds

    def _order(self, seeds: tuple[int, ...]) -> list[int]:
        """The strands whose colours follow, in an order in which they do."""
        known = list(seeds)
        held = set(known)
        while True:
            more = [
                new
                for k, above in enumerate(self.over)
                if above in held
                for new, old in (((k + 1) % len(self.over), k), (k, (k + 1) % len(self.over)))
                if old in held and new not in held
            ]
            if not more:
                return known
            known += dict.fromkeys(more)
            held.update(more)


def _longitudes(
    strands: Wirtinger, colours: ConjugacyClass, known: dict[int, Colours], start: int
) -> tuple[int, ...]:
    """How often the longitude from the start of a strand is which element."""
    count, weights = len(strands.over), known[WEIGHT]
    element = np.full(len(weights), colours.identity, dtype=np.int16)
    for k in (*range(start, count), *range(start)):
        ways = (colours.products, colours.inverse_products)[:: strands.signs[k]]
        element = ways[0][element, known[strands.over[k]]]
    writhe = sum(strands.signs)
    for _ in range(abs(writhe)):  # a longitude winds no times round the knot
        element = (colours.inverse_products if writhe > 0 else colours.products)[element, 0]
    order = len(colours.products)
    return min(
        tuple(np.bincount(colours.first_of_orbit[each], weights, order).astype(int).tolist())
        for each in (element, colours.reversal[element])
    )
