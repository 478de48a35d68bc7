"""Topological actions C, R1 and R2 on a rope, with the labels of the paper.

Source: Yan, Li, Zhu and Bohg, "Learning topological motion primitives for knot planning", IROS
2020, arXiv:2009.02615, Table I. Segments are those of the state before the action. What the table
leaves open is settled as in the authors' earlier code:

- the new face of R2 is on the left if the finger is pulled out to the left of the top segment;
- C never crosses an end segment with itself: that is an R1.

One bit is added. Colour the regions beside the rope by turns: passing a crossing exchanges the
colours left and right of the rope, so a finger pulled out to the left meets the left of a segment
an even number of crossings away, and the right of one an odd number away - unless the loop closed
by the finger and the rope between the two segments parts one end of the rope from the other. Such
an R2 goes `around` an end. Its four numbers can be those of another R2 with another successor: on a
straight rope a finger of the first half may come down on the second half from the side it was
pulled out to, or go around the tail and come from the other.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from knotopt.errors import KnotoptError
from knotopt.topology.faces import Code


class RopeActionError(KnotoptError):
    """A label that cannot be read, or an action that the state does not allow."""


@dataclass(frozen=True, slots=True)
class R1:
    """A new loop in one segment: Reidemeister I.

    Attributes
    ----------
    idx : int
        The segment.
    left : +1 or -1
        Whether the loop is on the left (+1) or the right of the rope.
    sign : +1 or -1
        Sign of the crossing. The rope passes first under and then over if `sign == left`.
    """

    idx: int
    left: int
    sign: int

    def mirror(self) -> R1:
        """The same action on the state's mirror image."""
        return R1(self.idx, -self.left, -self.sign)

    def reverse(self, crossings: int) -> R1:
        """The same action on the reverse of a state with that many crossings."""
        return R1(2 * crossings - self.idx, -self.left, self.sign)

    def __str__(self) -> str:
        return f"R1({self.idx},{self.left},{self.sign})"


@dataclass(frozen=True, slots=True)
class C:
    """An end of the rope crosses another segment.

    Attributes
    ----------
    over, under : int
        The segment on top and the one below; one of them is an end segment.
    sign : +1 or -1
        Sign of the crossing.
    """

    over: int
    under: int
    sign: int

    def mirror(self) -> C:
        """The same action on the state's mirror image."""
        return C(self.over, self.under, -self.sign)

    def reverse(self, crossings: int) -> C:
        """The same action on the reverse of a state with that many crossings."""
        last = 2 * crossings
        return C(last - self.over, last - self.under, self.sign)

    def __str__(self) -> str:
        return f"C({self.over},{self.under},{self.sign})"


@dataclass(frozen=True, slots=True)
class R2:
    """A finger of one segment is laid over another: two crossings of opposite signs.

    Attributes
    ----------
    over, under : int
        The segment on top and the one below; they may be the same.
    left : +1 or -1
        Whether the finger is pulled out to the left (+1) or the right of the top segment.
    over_first : +1 or -1
        Whether the part on top comes before the one below along the rope; a choice only if they
        are of the same segment.
    around : bool
        Whether the finger goes around an end of the rope: see the head of this module.
    """

    over: int
    under: int
    left: int
    over_first: int
    around: bool = False

    def mirror(self) -> R2:
        """The same action on the state's mirror image."""
        return R2(self.over, self.under, -self.left, self.over_first, self.around)

    def reverse(self, crossings: int) -> R2:
        """The same action on the reverse of a state with that many crossings."""
        last = 2 * crossings
        return R2(last - self.over, last - self.under, -self.left, -self.over_first, self.around)

    def __str__(self) -> str:
        numbers = f"{self.over},{self.under},{self.left},{self.over_first}"
        return f"R2({numbers},around)" if self.around else f"R2({numbers})"


Action = C | R1 | R2


def sort_key(action: Action) -> tuple[int, ...]:
    """Sorts actions by kind - R1, C, R2 - and then by the numbers of their labels."""
    match action:
        case R1(idx, left, sign):
            return 1, idx, left, sign
        case C(over, under, sign):
            return 2, over, under, sign
        case R2(over, under, left, over_first, around):
            return 3, over, under, left, over_first, around


def parse_action(text: str) -> Action:
    """The action with this label; R2 of two different segments may leave out its fourth number.

    Raises
    ------
    RopeActionError
        The label cannot be read.

    Examples
    --------
    >>> parse_action("R1(0,1,-1)")
    R1(idx=0, left=1, sign=-1)
    >>> print(parse_action("R2(4, 1, -1)"), parse_action("R2(0,0,1,1,around)"))
    R2(4,1,-1,-1) R2(0,0,1,1,around)
    >>> parse_action("C(0,1)")
    Traceback (most recent call last):
    ...
    knotopt.topology.actions.RopeActionError: 'C(0,1)': expected C(over,under,sign)
    """
    match = re.fullmatch(r"\s*(C|R1|R2)\s*\(([-+\d\s,]*?)(,\s*around\s*)?\)\s*", text)
    if not match:
        raise RopeActionError(
            f"{text!r} is no action: expected C(over,under,sign), R1(idx,left,sign) or "
            f"R2(over,under,left,over_first)"
        )
    kind, inside, around = match.groups()
    form, counts, make = _FORMS[kind]
    try:
        numbers = [int(word) for word in inside.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or (around and kind != "R2"):
        raise RopeActionError(f"{text!r}: expected {form}")
    if kind == "R2" and len(numbers) == 3:
        if numbers[0] == numbers[1]:
            raise RopeActionError(
                f"{text!r}: over_first is missing; it says which half of segment {numbers[0]} is "
                f"on top"
            )
        numbers.append(1 if numbers[0] < numbers[1] else -1)
    return make(*numbers, around=True) if around else make(*numbers)


_FORMS: dict[str, tuple[str, set[int], Callable[..., Action]]] = {
    "C": ("C(over,under,sign)", {3}, C),
    "R1": ("R1(idx,left,sign)", {3}, R1),
    "R2": ("R2(over,under,left,over_first), with ',around' after it or not", {3, 4}, R2),
}


def perform(code: Code, action: Action) -> Code:
    """The code after an action that is legal in a state with this code."""
    match action:
        case R1(idx, left, sign):
            return _with_crossing(code, idx, idx, sign != left, sign > 0)
        case C(over, under, sign):
            if over < under:
                return _with_crossing(code, over, under, True, sign > 0)
            return _with_crossing(code, under, over, False, sign > 0)
        case R2(over, under, left, over_first, around):
            below_left = (left > 0) ^ (over ^ under) & 1 ^ around  # from which side it comes
            crossed = below_left == (left > 0)  # the finger's first visit meets the last below
            low, high = (over, under) if over_first > 0 else (under, over)
            near, far = (high + 3, high + 2) if crossed else (high + 2, high + 3)
            back, forth = (low + 1, low) if crossed else (low, low + 1)
            top = 2 * (over_first > 0)
            # The top strand's first crossing is positive if it comes from the lower one's left;
            # `one` is the sign at the first low visit.
            one = below_left ^ (crossed and over_first < 0)
            above = 4 * near + top + one, 4 * far + top + (not one)
            other = one ^ crossed
            beneath = 4 * back + 2 - top + other, 4 * forth + 2 - top + (not other)
            return _inserted(code, low, above, high, beneath)


def _with_crossing(code: Code, low: int, high: int, low_over: bool, positive: bool) -> Code:
    """One more crossing, of segments low <= high."""
    before = 4 * high + 4 + 2 * low_over + positive
    after = 4 * low + 2 * (not low_over) + positive
    return _inserted(code, low, (before,), high, (after,))


def _inserted(
    code: Code, low: int, before: tuple[int, ...], high: int, after: tuple[int, ...]
) -> Code:
    """New visits `before` in segment low and `after`, as many, in segment high >= low."""
    step = 4 * len(before)
    low4, high4 = 4 * low, 4 * high
    moved = tuple([e if e < low4 else e + step if e < high4 else e + step + step for e in code])
    return moved[:low] + before + moved[low:high] + after + moved[high:]
