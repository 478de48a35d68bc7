"""The word of a flight: what the leader crosses, in order; planned, executed, and compared.

A letter is the older span that is crossed, over or under, and from which side. Two neighbours that
cross the same span, both over or both under, there and back, undo each other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from knotopt.arrays import FloatArray
from knotopt.verify.flight import LeaderEvent

Kind = Literal["as planned", "wrong height", "wrong way", "missing", "extra"]

OTHER_SPAN = 0.01  # what a crossing in another span of the flight costs beside one that is missing


class Letter(Protocol):
    """A crossing as it is planned: span flown, older span, over or under, sense (`LeaderEvent`)."""

    @property
    def span(self) -> int: ...
    @property
    def older(self) -> int: ...
    @property
    def over(self) -> bool: ...
    @property
    def sense(self) -> int: ...


class Found(Letter, Protocol):
    """A crossing found in a flight or on a route: gap above the cable [m], and when in words."""

    @property
    def gap(self) -> float: ...
    @property
    def when(self) -> str: ...


AnyLetter = TypeVar("AnyLetter", bound=Letter)


@dataclass(frozen=True)
class RouteCrossing:
    """A crossing of the leader's route, at arc length `route` [m], with cable that is laid already.

    The other attributes are those of `LeaderEvent`.
    """

    span: int
    older: int
    over: bool
    sense: int
    place: tuple[float, float]
    height: float
    cable_height: float
    route: float

    @property
    def gap(self) -> float:
        """Height of the route above the strand [m]."""
        return self.height - self.cable_height

    @property
    def when(self) -> str:
        """The place in words."""
        return f"{self.route:.2f} m along the route"


@dataclass(frozen=True)
class WordRow:
    """One letter of the planned word beside one of the executed, None where there is none."""

    kind: Kind
    planned: Letter | None
    executed: Found | None
    sentence: str


def reduced_word(letters: Sequence[AnyLetter]) -> tuple[AnyLetter, ...]:
    """The letters that are left when neighbours that undo each other are taken out, repeatedly.

    Crossings of the leader's own tether count as one span, and curls in it are taken out too.
    """
    kept, _ = _reduce(letters)
    return tuple(letters[index] for index in kept)


def compare_words(
    planned: Sequence[Letter],
    executed: Sequence[Found],
    approaches: Sequence[tuple[float, float]] | None = None,
) -> list[WordRow]:
    """The planned and the executed word, both reduced, aligned letter by letter.

    Parameters
    ----------
    planned : sequence of letters
    executed : sequence of LeaderEvent or RouteCrossing
        All of them: those that undid each other explain what is missing.
    approaches : sequence of (distance, time), optional
        For each planned letter how near the leader came, from `nearest_approaches`.

    Returns
    -------
    list of WordRow
        In order, by the fewest letters wrong, missing or extra (Levenshtein); the words agree if
        every row is "as planned".
    """
    wanted, planned_pairs = _reduce(planned)
    kept, undone_by = _reduce(executed)
    word = [executed[k] for k in kept]
    for i, j in _aligned([planned[k] for k in wanted], word):
        if i is None and j is not None:
            # What was planned there and back, and happened once, is no longer taken out.
            for pair in planned_pairs.items():
                if not {*pair} & {*wanted} and any(_change(planned[k], word[j]) <= 1 for k in pair):
                    wanted = sorted([*wanted, *pair])
                    break
    undone = [(executed[k], executed[back]) for k, back in undone_by.items()]
    rows = []
    for i, j in _aligned([planned[k] for k in wanted], word):
        found = None if j is None else word[j]
        if i is None and found:
            rows.append(WordRow("extra", None, found, _extra(found)))
        elif i is not None and found:
            rows.append(_row(planned[wanted[i]], found))
        elif i is not None:
            near = approaches[wanted[i]] if approaches else None
            rows.append(_missing(planned[wanted[i]], undone, near))
    return rows


def plan_word(
    route: ArrayLike,
    passes: ArrayLike,
    anchors: ArrayLike,
    lengths: ArrayLike,
    *,
    near: float = 0.2,
) -> tuple[RouteCrossing, ...]:
    """Crossings of the leader's route with the cable that is laid already, in order.

    Laid cable is straight in plan between its anchors and a catenary in height.

    Parameters
    ----------
    route : float array, shape (m, 3)
        The leader's way [m].
    passes : float array, shape (R - 1,)
        Arc length of the route at which it passes anchors 1 to R - 1 [m].
    anchors : float array, shape (R, 3)
        Where the robots hover in the end [m].
    lengths : float array, shape (R - 1,)
        Of cable between consecutive robots [m].
    near : float
        Way from an anchor within which the route does not cross the last span, but ends it [m].

    Raises
    ------
    ValueError
        Shapes that do not fit, a number that is not finite, passes out of order.
    """
    route, passes = np.asarray(route, dtype=float), np.asarray(passes, dtype=float)
    anchors, lengths = np.asarray(anchors, dtype=float), np.asarray(lengths, dtype=float)
    for name, array in {"route": route, "anchors": anchors}.items():
        if array.ndim != 2 or array.shape[1] != 3 or len(array) < 2:
            raise ValueError(f"{name}: at least two points [x, y, z], not {array.shape}")
    if not passes.shape == lengths.shape == (len(anchors) - 1,):
        given = f"{passes.shape} and {lengths.shape}"
        raise ValueError(f"{len(anchors)} robots need one pass and one length less, not {given}")
    if not all(np.isfinite(array).all() for array in (route, passes, anchors, lengths)):
        raise ValueError("a number of the plan is not finite")
    if not (np.diff(passes) >= 0).all():
        raise ValueError(f"the leader passes its anchors out of order: {passes.tolist()}")
    along = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))))
    ends = [*passes.tolist()[1:], float(along[-1])]
    found = []
    for span, (start, end) in enumerate(zip(passes.tolist(), ends, strict=True), 1):
        for older in range(1, span):
            begin = start + near if older == span - 1 else start
            piece = along[(along > begin) & (along < end)]
            at = np.concatenate(([begin], piece, [max(begin, end)]))
            way = np.column_stack([np.interp(at, along, axis) for axis in route.T])
            strand = anchors[older - 1 : older + 1]
            found += _met(span, older, at, way, strand, float(lengths[older - 1]))
    return tuple(sorted(found, key=lambda crossing: crossing.route))


def catenary_height(start: ArrayLike, end: ArrayLike, length: float, share: float) -> float:
    """Height of a cable that hangs between two points, at a share of the way between them in plan.

    A length [m] that is too short counts as straight.

    Examples
    --------
    >>> round(catenary_height([0, 0, 1], [2, 0, 1], 2 * math.sinh(1), 0.5), 9)
    0.456919365
    """
    (x, y, z), (x_end, y_end, z_end) = np.asarray([start, end], dtype=float).tolist()
    across, rise = math.hypot(x_end - x, y_end - y), z_end - z
    if length <= math.hypot(across, rise) * (1 + 1e-12) or across == 0:
        return float(z + share * rise)
    stretch = math.log(math.sqrt(length**2 - rise**2) / across)

    def excess(half: float) -> float:  # log(sinh(half) / half) - stretch, without overflow
        return half + math.log(-math.expm1(-2 * half) / (2 * half)) - stretch

    half = float(brentq(excess, 1e-6, 7 + 2 * stretch)) if excess(1e-6) < 0 else 1e-6
    scale = across / (2 * half)
    lowest = half - math.atanh(rise / length)  # in units of the scale, from the start
    here = 2 * half * share - lowest
    return float(z + scale * (math.cosh(here) - math.cosh(lowest)))


def _met(
    span: int, older: int, at: FloatArray, way: FloatArray, strand: FloatArray, length: float
) -> list[RouteCrossing]:
    """Crossings of a piece of the route with one laid span."""
    start, direction = strand[0, :2], strand[1, :2] - strand[0, :2]
    off = way[:, :2] - start
    side = direction[0] * off[:, 1] - direction[1] * off[:, 0]
    found = []
    for k in np.flatnonzero((side[:-1] > 0) != (side[1:] > 0)):
        u = side[k] / (side[k] - side[k + 1])
        x, y, height = (way[k] + u * (way[k + 1] - way[k])).tolist()
        share = float(((x, y) - start) @ direction / (direction @ direction))
        if not 0 <= share <= 1:
            continue
        cable = catenary_height(strand[0], strand[1], length, share)
        route = float(at[k] + u * (at[k + 1] - at[k]))
        sense = 1 if side[k + 1] > side[k] else -1
        found.append(
            RouteCrossing(span, older, height > cable, sense, (x, y), height, cable, route)
        )
    return found


def _reduce(letters: Sequence[Letter]) -> tuple[list[int], dict[int, int]]:
    """Indices of the letters that are left, and which letter undid which."""
    undone_by: dict[int, int] = {}

    def cancelled(indices: Sequence[int]) -> list[int]:
        left: list[int] = []
        for index in indices:
            if left and _undoes(letters[left[-1]], letters[index]):
                undone_by[left.pop()] = index
            else:
                left.append(index)
        return left

    # A curl may be what undoes a crossing that was none, so curls are taken out only afterwards.
    left = cancelled(range(len(letters)))
    curls = {k for k, each in enumerate(letters) if isinstance(each, LeaderEvent) and each.curl}
    return cancelled([index for index in left if index not in curls]), undone_by


def _undoes(first: Letter, second: Letter) -> bool:
    tether = first.older >= first.span and second.older >= second.span
    same = tether or first.older == second.older
    return same and first.over == second.over and first.sense == -second.sense


def _name(letter: Letter) -> str:
    return f"span {letter.span} {_side(letter)} span {letter.older}"


def _side(letter: Letter) -> str:
    return "over" if letter.over else "under"


def _row(letter: Letter, found: Found) -> WordRow:
    apart = f"{abs(found.gap):.2f} m {'above' if found.gap > 0 else 'below'} the strand"
    kind: Kind = "as planned"
    sentence = f"{found.when}, {apart}"
    if letter.over != found.over:
        kind = "wrong height"
        sentence = f"executed as {_side(found)} {found.when}: the leader was {apart}"
    elif letter.sense != found.sense:
        kind = "wrong way"
        way = "right to left" if found.sense > 0 else "left to right"
        sentence = f"crossed the other way, from {way}, {found.when}"
    return WordRow(kind, letter, found, f"{_name(letter)}: {sentence}")


def _extra(found: Found) -> str:
    if found.older < found.span:
        return f"extra: {_name(found)} {found.when}"
    flown = f"span {found.span}" if found.span else "the way in"
    return f"extra: on {flown} the leader crossed {_side(found)} its own tether {found.when}"


def _missing(
    letter: Letter, undone: Sequence[tuple[Found, Found]], near: tuple[float, float] | None
) -> WordRow:
    why = "never crossed"
    for found, back in undone:
        if _change(letter, found) < 1:
            why = f"crossed {found.when} and undone {back.when}"
            break
        if back.older == letter.older and back.sense == letter.sense and back.over != letter.over:
            return _row(letter, back)
    else:
        if near and math.isinf(near[0]):
            why = "the flight did not get that far"
        elif near:
            why += f"; nearest approach {near[0]:.2f} m at {near[1]:.2f} s of the plan"
    return WordRow("missing", letter, None, f"{_name(letter)}: missing: {why}")


def _aligned(
    planned: Sequence[Letter], executed: Sequence[Letter]
) -> list[tuple[int | None, int | None]]:
    """Pairs of indices, None for nothing, with the least cost in all."""
    n, m = len(planned), len(executed)
    cost = np.zeros((n + 1, m + 1))
    cost[:, 0], cost[0, :] = np.arange(n + 1), np.arange(m + 1)
    for i in range(n):
        for j in range(m):
            change = _change(planned[i], executed[j])
            cost[i + 1, j + 1] = min(cost[i, j] + change, cost[i, j + 1] + 1, cost[i + 1, j] + 1)
    pairs: list[tuple[int | None, int | None]] = []
    i, j = n, m
    while i or j:
        if i and j and cost[i, j] == cost[i - 1, j - 1] + _change(planned[i - 1], executed[j - 1]):
            i, j = i - 1, j - 1
            pairs.append((i, j))
        elif i and cost[i, j] == cost[i - 1, j] + 1:
            i -= 1
            pairs.append((i, None))
        else:
            j -= 1
            pairs.append((None, j))
    return pairs[::-1]


def _change(letter: Letter, found: Letter) -> float:
    if letter.older != found.older:
        return math.inf
    wrong = (letter.over != found.over) + (letter.sense != found.sense)
    return wrong + OTHER_SPAN * (letter.span != found.span) if wrong < 2 else math.inf
