"""Whether a cable, laid in straight spans between its robots, is still the knot.

From the path's turning points alone. A crossing counts where the later visit passes under the older
one, unless both are on one span, which is straight, or the strand's next crossing undoes it, there
and back under one older span. Everywhere else the later strand is held by nothing, and passes over.
Where the crossings that are left make a diagram by themselves, that has to be the knot, too.

The knot is examined by its diagram's faces. Its Alexander polynomial is the determinant of
Alexander's own matrix, a row for each crossing and a column for each face but two neighbours:
t, -t, 1, -1 around the crossing, the first two to the left of the strand below (doi:10.1090/S0002-
9947-1928-1501429-1). It is known up to units +-t^k, so Delta(t) Delta(1/t) is compared, modulo a
prime, in three places; `knotopt.verify.alexander` says how sure that is. The signature is
half of that of Kashaev's matrix over all faces, less the writhe (Kashaev, "On symmetric matrices
associated with oriented link diagrams"; proven by Liu, arXiv:2311.01923, and Cimasoni and Ferretti,
arXiv:2310.04560), at the place that belongs to omega = -1, in rational numbers.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from knotopt.verify.alexander import POINTS, PRIME
from knotopt.verify.regions import Cell, lay


@dataclass(frozen=True)
class Crossing:
    """A crossing of the cable on its grid.

    Attributes
    ----------
    place : (column, row)
    first, second : int
        Times of the two visits [grid steps from the cable's first end].
    first_over : bool
        Whether the first visit passes over: it runs along a column.
    turn : +1 or -1
        Whether the second visit runs from the right of the first to its left.
    """

    place: Cell
    first: int
    second: int
    first_over: bool
    turn: int


@dataclass(frozen=True)
class LaidReport:
    """What became of the cable.

    Attributes
    ----------
    lost : tuple of (column, row)
        Crossings that the later strand no longer passes under.
    same_polynomial, same_signature : bool
        Whether the laid cable has the grid's Alexander polynomial, and its signature.
    """

    lost: tuple[Cell, ...]
    same_polynomial: bool
    same_signature: bool

    @property
    def is_knot(self) -> bool:
        """Whether polynomial and signature are those of the knot."""
        return self.same_polynomial and self.same_signature


def check_laid(path: Sequence[Cell], supports: Collection[int]) -> LaidReport:
    """What a set of supports makes of the cable along a path.

    Parameters
    ----------
    path : sequence of (column, row)
        Turning points p_1 ... p_n.
    supports : collection of int
        Those with a support robot (1-based), without the ends.

    Examples
    --------
    >>> path = [(1, 5), (4, 5), (4, 2), (2, 2), (2, 4), (5, 4), (5, 1), (3, 1), (3, 3), (1, 3)]
    >>> [check_laid(path, held).is_knot for held in ([5], [3])]
    [True, False]
    """
    crossings = tuple(crossings_of(path))
    kept = kept_crossings(path, crossings, supports)
    lost = [c for c in crossings if c.first_over and c not in kept]
    before = _invariants(crossings, tuple(c.first_over for c in crossings))
    after = [_invariants(crossings, tuple(c.first_over and c not in lost for c in crossings))]
    flown = tuple(c for c in crossings if c in kept)
    if _is_planar(flown):
        after.append(_invariants(flown, tuple(c.first_over for c in flown)))
    same = [all(each[k] == before[k] for each in after) for k in (0, 1)]
    return LaidReport(tuple(c.place for c in lost), *same)


def crossings_of(path: Sequence[Cell]) -> list[Crossing]:
    """The crossings of a cable in the order of their first visits."""
    cells = lay(path)
    met: dict[Cell, list[int]] = {}
    for time, cell in enumerate(cells):
        met.setdefault(cell, []).append(time)
    found = []
    for place, times in met.items():
        if len(times) == 2:
            (a, b), (c, d) = (
                (cells[t][0] - cells[t - 1][0], cells[t][1] - cells[t - 1][1]) for t in times
            )
            found.append(Crossing(place, times[0], times[1], a == 0, a * d - b * c))
    return found


def kept_crossings(
    path: Sequence[Cell], crossings: Sequence[Crossing], supports: Collection[int]
) -> list[Crossing]:
    """The crossings of different spans that no other one undoes."""
    cells = lay(path)
    robots = [cells.index(path[k - 1]) for k in sorted(supports)]
    kept = []
    for span in range(len(robots) + 1):
        word = [
            (sum(time < c.first for time in robots), c.first_over, c.turn, c)
            for c in sorted(crossings, key=lambda each: each.second)
            if sum(time < c.second for time in robots) == span
        ]
        word = [letter for letter in word if letter[0] != span]
        while (place := _first_undone(word)) is not None:
            del word[place : place + 2]
        kept += [letter[3] for letter in word]
    return kept


def _first_undone(word: Sequence[tuple[int, bool, int, Crossing]]) -> int | None:
    for place in range(len(word) - 1):
        (older, under, turn, _), (other, also, back, _) = word[place : place + 2]
        if (older, under, turn) == (other, also, -back):
            return place
    return None


@lru_cache(maxsize=4096)
def _invariants(
    crossings: tuple[Crossing, ...], first_over: tuple[bool, ...]
) -> tuple[tuple[int, ...], Fraction]:
    """Delta(t) Delta(1/t) modulo a prime at `POINTS`, and the signature, of the closed cable."""
    if not crossings:
        return (1,) * len(POINTS), Fraction(0)
    corners = _corners(crossings)
    values = []
    for t in POINTS:
        both = 1
        for u in (t, pow(t, -1, PRIME)):
            both *= _determinant(_alexander_rows(crossings, corners, first_over, u))
        values.append(both % PRIME)
    return tuple(values), _signature(crossings, corners, first_over)


def _corners(crossings: Sequence[Crossing]) -> list[tuple[int, int, int, int]]:
    """The faces at each crossing, counterclockwise, the first one left of the first visit's way
    out.

    A face is what corners have in common that lie on one side of an edge: edge k runs from the
    k-th visit to the next.
    """
    visits = sorted((time, c) for c, x in enumerate(crossings) for time in (x.first, x.second))
    number = {time: k for k, (time, _) in enumerate(visits)}
    root = list(range(4 * len(visits)))

    def find(side: int) -> int:
        while root[side] != side:
            side = root[side]
        return side

    found = []
    for x in crossings:
        ways = [(number[x.first], True), (number[x.second], True)]
        ways += [(edge - 1, False) for edge, _ in ways]
        out, across, into, back = ways if x.turn > 0 else (ways[0], ways[3], ways[2], ways[1])
        corner: list[int] = []
        for (edge, leaves), (following, also) in (
            (out, across),
            (across, into),
            (into, back),
            (back, out),
        ):
            # To the left of a strand seen from the crossing, to the right of the next one.
            left = 2 * (edge % len(visits)) + (not leaves)
            right = 2 * (following % len(visits)) + also
            root[find(left)] = find(right)
            corner.append(left)
        found.append(corner)
    names = {find(side): 0 for corner in found for side in corner}
    names = {side: face for face, side in enumerate(names)}
    return [
        (names[find(a)], names[find(b)], names[find(c)], names[find(d)]) for a, b, c, d in found
    ]


def _is_planar(crossings: Sequence[Crossing]) -> bool:
    """Whether crossings, visited in the order of their times, are those of a curve in the plane."""
    faces = {face for corner in _corners(crossings) for face in corner}
    return not crossings or len(faces) == len(crossings) + 2


def _alexander_rows(
    crossings: Sequence[Crossing],
    corners: Sequence[tuple[int, int, int, int]],
    first_over: Sequence[bool],
    t: int,
) -> list[list[int]]:
    """Alexander's matrix modulo the prime, without two faces that are neighbours."""
    rows = []
    for x, faces, over in zip(crossings, corners, first_over, strict=True):
        # Around the strand below, from the corner left of its way out on.
        start = 0 if not over else 1 if x.turn > 0 else 3
        row = [0] * (len(crossings) + 2)
        for face, value in zip(faces[start:] + faces[:start], (-t, t, -1, 1), strict=True):
            row[face] += value
        rows.append(row)
    gone = corners[0][:2]
    return [[v % PRIME for k, v in enumerate(row) if k not in gone] for row in rows]


def _determinant(rows: list[list[int]]) -> int:
    """Determinant modulo the prime, up to sign."""
    value = 1
    while rows:
        pivot = next((row for row in rows if row[0]), None)
        if pivot is None:
            return 0
        rows.remove(pivot)
        value = value * pivot[0] % PRIME
        inverse = pow(pivot[0], -1, PRIME)
        rows = [
            [(a - row[0] * inverse * b) % PRIME for a, b in zip(row[1:], pivot[1:], strict=True)]
            for row in rows
        ]
    return value


def _signature(
    crossings: Sequence[Crossing],
    corners: Sequence[tuple[int, int, int, int]],
    first_over: Sequence[bool],
) -> Fraction:
    """Signature from Kashaev's matrix at x = 0."""
    size = len(crossings) + 2
    form = [[Fraction(0)] * size for _ in range(size)]
    writhe = 0
    for x, faces, over in zip(crossings, corners, first_over, strict=True):
        sign = x.turn if over else -x.turn
        writhe += sign
        # The corners between two ways out and between two ways in; then those at the sides.
        ends, sides = faces[::2], faces[1::2]
        for pair, own in ((ends, -1), (sides, 1)) if x.turn > 0 else ((sides, -1), (ends, 1)):
            for k, other in (pair, pair[::-1]):
                form[k][k] += sign * own
                form[k][other] += sign
    return Fraction(_squares(form) - writhe, 2)


def _squares(form: list[list[Fraction]]) -> int:
    """Positive less negative squares of a symmetric matrix, which may be singular."""
    total = 0
    while form:
        size = len(form)
        k = next((k for k in range(size) if form[k][k]), None)
        if k is None:
            pair = next(((a, b) for a in range(size) for b in range(a) if form[a][b]), None)
            if pair is None:
                return total
            a, b = pair  # 2 x y: with x = u + v and y = v there is a square of v
            for m in range(size):
                form[a][m] += form[b][m]
            for m in range(size):
                form[m][a] += form[m][b]
            k = a
        pivot = form[k]
        total += 1 if pivot[k] > 0 else -1
        left = [m for m in range(size) if m != k]
        form = [[form[a][b] - pivot[a] * pivot[b] / pivot[k] for b in left] for a in left]
    return total
