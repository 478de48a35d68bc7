"""Small finite groups by their tables: PSL(2, p) and alternating groups, as permutations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

Table = NDArray[np.int16]


@dataclass(frozen=True, eq=False)
class ConjugacyClass:
    """The conjugates of an element x of a group of order n: m in number, x the first.

    Elements are numbered by their places in the class or in the group.

    Attributes
    ----------
    conjugates : Table, shape (m, m)
        ``conjugates[b, a]`` is b^-1 a b, in the class.
    conjugates_back : Table, shape (m, m)
        ``conjugates_back[b, a]`` is b a b^-1.
    products : Table, shape (n, m)
        ``products[g, a]`` is g a, in the group.
    inverse_products : Table, shape (n, m)
        ``inverse_products[g, a]`` is g a^-1.
    identity : int
        The place of 1 in the group.
    reversal : Table, shape (n,)
        Where an element l goes that commutes with x, if the knot is run through backwards: to
        g l^-1 g^-1, where g x g^-1 = x^-1. If no g does that, it stays: in the groups here an
        automorphism then takes x to its inverse, and all that commutes with x are its powers.
    first_of_orbit : Table, shape (n,)
        Of each element the first among its conjugates by elements that commute with x.
    orbits : Table, shape (2, k)
        Of the class's elements likewise: the first of each orbit, in the class, and its length.
    """

    conjugates: Table
    conjugates_back: Table
    products: Table
    inverse_products: Table
    identity: int
    reversal: Table
    first_of_orbit: Table
    orbits: Table


@cache
def psl2(p: int) -> tuple[ConjugacyClass, ...]:
    """Conjugacy classes of PSL(2, p) for a prime p >= 5, of order p (p^2 - 1) / 2.

    It acts on 0 ... p - 1 and infinity by z + 1 and -1 / z.

    Examples
    --------
    >>> [len(each.conjugates) for each in psl2(7)]
    [21, 24, 42, 56]
    """
    inverses = [0, *(pow(z, -1, p) for z in range(1, p))]
    shift = [*((z + 1) % p for z in range(p)), p]
    turn = [p, *(-inverses[z] % p for z in range(1, p)), 0]
    return _classes(_products([shift, turn]))


@cache
def alternating_group(degree: int) -> tuple[ConjugacyClass, ...]:
    """Conjugacy classes of the even permutations of an odd number of things.

    Examples
    --------
    >>> [len(each.conjugates) for each in alternating_group(5)]
    [12, 12, 15, 20]
    """
    three = [1, 2, 0, *range(3, degree)]
    cycle = [*range(1, degree), 0]
    return _classes(_products([three, cycle]))


def _products(generators: Sequence[Sequence[int]]) -> Table:
    """``products[g, h]`` is g h, first g, then h: of all permutations that are generated."""
    places = {tuple(range(len(generators[0]))): 0}
    elements = [*places]
    for element in elements:  # it grows on the way
        for generator in generators:
            product = tuple(generator[point] for point in element)
            if product not in places:
                places[product] = len(elements)
                elements.append(product)
    permutations = np.array(elements)
    weights = len(generators[0]) ** np.arange(len(generators[0]))
    numbers = permutations @ weights
    order = np.argsort(numbers)
    return np.array(
        [
            order[np.searchsorted(numbers[order], permutations[:, element] @ weights)]
            for element in permutations
        ],
        dtype=np.int16,
    )


def _classes(products: Table) -> tuple[ConjugacyClass, ...]:
    """All classes but that of 1, of a class and that of the inverses one; smallest first."""
    everything = np.arange(len(products), dtype=np.int16)
    identity = 0
    inverses = (products == identity).argmax(axis=1)
    left = set(range(1, len(products)))
    found = []
    while left:
        first = min(left)
        of_first = products[products[:, first], inverses]  # g first g^-1
        members = np.unique(of_first)
        left -= {*members.tolist(), *inverses[members].tolist()}
        place = np.full(len(products), -1, dtype=np.int16)
        place[members] = everything[: len(members)]
        back = inverses[members]
        turns = np.flatnonzero(of_first == inverses[first])
        commuting = np.flatnonzero(of_first == first)
        moved = products[products[inverses[commuting]], commuting[:, None]]
        first_of_orbit = moved.min(axis=0)
        found.append(
            ConjugacyClass(
                place[products[products[np.ix_(back, members)], members[:, None]]],
                place[products[products[np.ix_(members, members)], back[:, None]]],
                products[:, members],
                products[:, back],
                identity,
                products[products[turns[0], inverses], inverses[turns[0]]]
                if turns.size
                else everything,
                first_of_orbit,
                _orbits(place[first_of_orbit[members]]),
            )
        )
    return tuple(sorted(found, key=lambda each: len(each.conjugates)))


def _orbits(firsts: Table) -> Table:
    """The different entries, and how often each occurs."""
    return np.array(np.unique(firsts, return_counts=True), dtype=np.int16)
