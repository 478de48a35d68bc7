"""Knots of the tables, their mirror images and connected sums, and which have an Alexander
polynomial.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product

from knotopt.cable.alexander import determinant
from knotopt.catalogue.knotinfo import (
    LARGEST_CROSSINGS,
    SHIPPED_CROSSINGS,
    is_installed,
    knotinfo_knots,
)
from knotopt.catalogue.knots import PrimeKnot, shipped_knots, unknot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.sums import connected_sum
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.loosened import loosened
from knotopt.planar.planar_diagram import PlanarDiagram

Coefficients = tuple[int, ...]

MOST_SUMS = 100  # of candidates for the summands


@dataclass(frozen=True)
class Summand:
    """A prime knot of the tables, or its mirror image."""

    knot: PrimeKnot
    mirrored: bool = False

    @property
    def name(self) -> str:
        """8_19, or m8_19 for the mirror image."""
        return f"m{self.knot.name}" if self.mirrored else self.knot.name

    @property
    def signature(self) -> int:
        """The signature, in KnotInfo's sign."""
        return -self.knot.signature if self.mirrored else self.knot.signature

    @property
    def mirror(self) -> Summand:
        """The mirror image."""
        return self if self.knot.is_amphicheiral else Summand(self.knot, not self.mirrored)

    @property
    def diagram(self) -> GridDiagram:
        """A grid diagram."""
        return self.knot.diagram.mirrored if self.mirrored else self.knot.diagram


@dataclass(frozen=True)
class KnotSum:
    """A connected sum of prime knots; of none, the unknot."""

    summands: tuple[Summand, ...]

    @property
    def name(self) -> str:
        """3_1#m3_1#4_1: in the tables' order."""
        return "#".join(each.name for each in self.summands) or unknot().name

    @property
    def signature(self) -> int:
        """The signature, in KnotInfo's sign."""
        return sum(each.signature for each in self.summands)

    @property
    def crossing_number(self) -> int:
        """The summands' crossing numbers, added up."""
        return sum(each.knot.crossing_number for each in self.summands)

    @property
    def is_amphicheiral(self) -> bool:
        """Whether it is its own mirror image, orientations aside."""
        hands = Counter[str]()  # of each knot, as it is less mirrored
        for each in self.summands:
            if not each.knot.is_amphicheiral:
                hands[each.knot.name] += -1 if each.mirrored else 1
        return not any(hands.values())

    @property
    def mirror(self) -> KnotSum:
        """The mirror image."""
        return KnotSum(tuple(sorted((each.mirror for each in self.summands), key=_place)))

    @cached_property
    def planar(self) -> PlanarDiagram:
        """A planar diagram."""
        grids = [each.diagram for each in self.summands] or [unknot().diagram]
        return loosened(planar_diagram(connected_sum(grids)))

    def __add__(self, other: KnotSum) -> KnotSum:
        return KnotSum(tuple(sorted((*self.summands, *other.summands), key=_place)))


def knots_with(alexander: Coefficients, signature: int) -> list[KnotSum]:
    """The knots of the tables with these invariants: prime ones, their mirror images, and sums.

    Tables go to 13 crossings with the `knotinfo` extra, to 10 without; sums whose crossing numbers
    add up to no more are among them, and the unknot.

    Examples
    --------
    >>> [knot.name for knot in knots_with((1, -2, 3, -2, 1), 0) if knot.crossing_number < 9]
    ['8_20', 'm8_20', '3_1#m3_1']
    """
    found = [KnotSum(())] if alexander == (1,) else []
    found += [
        KnotSum((each,)) for knot in _table().get(alexander, ()) for each in _both_hands(knot)
    ]
    for factors in _factorisations(alexander, crossings_in_table(), 0):
        if len(factors) > 1:
            found += _sums(factors)
    return [knot for knot in dict.fromkeys(found) if knot.signature == signature]


def sums(parts: Sequence[Sequence[KnotSum]]) -> tuple[KnotSum, ...]:
    """The sums of one candidate of each part, each once, and no more than `MOST_SUMS`."""
    found: tuple[KnotSum, ...] = (KnotSum(()),)
    for part in parts:
        more = dict.fromkeys(knot + other for knot in found for other in part)
        found = tuple(more)[:MOST_SUMS]
    return found


def crossings_in_table() -> int:
    """The crossing number up to which prime knots are known here."""
    return LARGEST_CROSSINGS if is_installed() else SHIPPED_CROSSINGS


def _both_hands(knot: PrimeKnot) -> list[Summand]:
    return [Summand(knot)] if knot.is_amphicheiral else [Summand(knot), Summand(knot, True)]


def _place(summand: Summand) -> tuple[int, int, str, bool]:
    knot = summand.knot
    return knot.crossing_number, len(knot.name), knot.name, summand.mirrored


@cache
def _table() -> dict[Coefficients, list[PrimeKnot]]:
    """The prime knots by Alexander polynomial."""
    table = defaultdict[Coefficients, list[PrimeKnot]](list)
    for knot in (knotinfo_knots() if is_installed() else shipped_knots()).values():
        table[knot.alexander].append(knot)
    return table


@cache
def _small_factors() -> list[tuple[Coefficients, int, int]]:
    """Alexander polynomials of summands, other than 1, with the fewest crossings that have them and
    the determinant. With a trefoil beside it, none has more than 10 crossings.
    """
    fewest: dict[Coefficients, int] = {}
    for knot in shipped_knots().values():
        if knot.alexander != (1,):
            fewest.setdefault(knot.alexander, knot.crossing_number)
    return [(poly, crossings, determinant(poly)) for poly, crossings in fewest.items()]


def _factorisations(
    alexander: Coefficients, crossings: int, first: int
) -> Iterator[tuple[Coefficients, ...]]:
    """The ways to write it as a product of summands' polynomials, from the numbered one on."""
    if alexander == (1,):
        yield ()
    for number, (factor, fewest, own) in enumerate(_small_factors()[first:], first):
        if fewest > crossings or len(factor) > len(alexander) or determinant(alexander) % own:
            continue
        quotient = _quotient(alexander, factor)
        if quotient is not None:
            for others in _factorisations(quotient, crossings - fewest, number):
                yield (factor, *others)


def _quotient(dividend: Coefficients, divisor: Coefficients) -> Coefficients | None:
    """The quotient of two polynomials, constant term first; None if it is not one in integers."""
    left = list(dividend)
    quotient = []
    while len(left) >= len(divisor):
        factor, rest = divmod(left[-1], divisor[-1])
        if rest:
            return None
        quotient.append(factor)
        start = len(left) - len(divisor)
        for k, coefficient in enumerate(divisor):
            left[start + k] -= factor * coefficient
        left.pop()
    return None if any(left) else tuple(reversed(quotient))


def _sums(factors: tuple[Coefficients, ...]) -> list[KnotSum]:
    """The connected sums of knots with these polynomials, with few enough crossings."""
    hands = [
        [
            each
            for knot in shipped_knots().values()
            if knot.alexander == factor
            for each in _both_hands(knot)
        ]
        for factor in factors
    ]
    sums = [KnotSum(tuple(sorted(summands, key=_place))) for summands in product(*hands)]
    return [each for each in dict.fromkeys(sums) if each.crossing_number <= crossings_in_table()]
