"""Jones polynomial of a knot from a diagram of it, in exact integers.

Kauffman's bracket, with the crossings taken one after the other: at each stage the part of the
diagram drawn so far is a sum over the ways in which arcs without crossings can join its loose
ends. Sources: Kauffman, "State models and the Jones polynomial",
doi:10.1016/0040-9383(87)90009-7; Bar-Natan, "Fast Khovanov homology computations",
doi:10.1142/S0218216507005294, for the order of the crossings.

A polynomial is kept as one integer, its value at a power of two so large that the coefficients can
be read off the binary digits (Kronecker substitution).
"""

from __future__ import annotations

from knotopt.cable.alexander import kronecker_digits
from knotopt.planar.planar_diagram import Crossing, PlanarDiagram

Polynomial = dict[int, int]  # exponent to coefficient, without zeros
Joined = tuple[tuple[int, int], ...]  # loose edges, in pairs joined by an arc; sorted


MAX_WIDTH = 16
"""Loose ends of a part of a diagram, at most: they can be joined in 1,430 ways."""


def jones_polynomial(planar: PlanarDiagram) -> Polynomial | None:
    """Jones polynomial in t: the coefficient of each power; t and 1/t change places in the mirror.

    None for a diagram that is wider than `MAX_WIDTH`, in the order in which its crossings are
    taken.

    Examples
    --------
    >>> jones_polynomial(PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1))))
    {1: 1, 3: 1, 4: -1}

    Notes
    -----
    Time grows exponentially with the diagram's width (the most loose ends at any stage), linearly
    with its length; milliseconds for most diagrams of 30 crossings.
    """
    order = _in_order(planar)
    if order is None:
        return None
    bracket = _bracket(order)
    writhe = planar.writhe
    # (-A^3)^-writhe times the bracket, at t = A^-4.
    sign = -1 if writhe % 2 else 1
    polynomial = {
        (3 * writhe + len(planar.crossings) - 2 * power) // 4: sign * coefficient
        for power, coefficient in bracket.items()
    }
    return dict(sorted(polynomial.items()))


def mirrored(polynomial: Polynomial) -> Polynomial:
    """The Jones polynomial of the mirror image."""
    return {-power: coefficient for power, coefficient in reversed(polynomial.items())}


def _bracket(order: list[Crossing]) -> Polynomial:
    """Kauffman's bracket, 1 for a circle, times A^crossings, in powers of A^2."""
    crossings = len(order)
    if not crossings:
        return {0: 1}
    bits = 2 * crossings + 4  # 2 ** crossings states of at most crossings + 1 circles, with a sign
    raised = crossings + 2  # a power that all are raised by, so that none is negative
    sums: dict[Joined, int] = {(): 1 << bits * raised}
    for a, b, c, d in order:
        after: dict[Joined, int] = {}
        for joined, value in sums.items():
            for arcs, power in ((((a, b), (c, d)), 1), (((a, d), (b, c)), 0)):
                partner = {**dict(joined), **{y: x for x, y in joined}}
                term = value << bits * power
                for x, y in arcs:
                    if _join(partner, x, y):
                        term = -((term << bits) + (term >> bits))
                key = tuple(sorted((x, y) for x, y in partner.items() if x < y))
                after[key] = after.get(key, 0) + term
        sums = after
    # Every sum was closed up as one circle more than the bracket of a circle counts.
    (total,) = sums.values()
    powers = {
        power - raised: digit for power, digit in enumerate(kronecker_digits(total, bits)) if digit
    }
    return _without_circle(powers)


def _join(partner: dict[int, int], x: int, y: int) -> bool:
    """Join loose ends x and y by an arc; whether that closes a circle."""
    if x == y or partner.get(x) == y:
        partner.pop(x, None)
        partner.pop(y, None)
        return True
    # An end that is loose already is used up, and what it is joined to becomes the end.
    left, right = partner.pop(x, x), partner.pop(y, y)
    partner[left], partner[right] = right, left
    return False


def _without_circle(powers: Polynomial) -> Polynomial:
    """The quotient by -(A^2 + A^-2), which is exact."""
    left, quotient = dict(powers), {}
    while left:
        power = max(left)
        quotient[power - 1] = -left.pop(power)
        below = left.pop(power - 2, 0) + quotient[power - 1]
        if below:
            left[power - 2] = below
    return quotient


def _in_order(planar: PlanarDiagram) -> list[Crossing] | None:
    """The crossings, each one that leaves fewest loose ends when it is added; None if too many."""
    left = [*planar.crossings]
    loose: set[int] = set()
    order = []
    while left:
        crossing = min(left, key=lambda each: len(loose.symmetric_difference(_once(each))))
        left.remove(crossing)
        loose ^= _once(crossing)
        if len(loose) > MAX_WIDTH:
            return None
        order.append(crossing)
    return order


def _once(crossing: Crossing) -> set[int]:
    """The edges that have one end at the crossing."""
    return {edge for edge in crossing if crossing.count(edge) == 1}
