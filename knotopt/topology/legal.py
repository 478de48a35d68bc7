"""Which actions a state allows, and the states they lead to.

C and R2 need a face that both segments border. Faces are open discs, so within one the way from one
segment's side to another's is unique up to deformation, and a state with its action's label fixes
the successor.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum
from itertools import product

from knotopt.topology.actions import R1, R2, Action, C, RopeActionError, perform
from knotopt.topology.faces import Code, dart_faces
from knotopt.topology.state import RopeState


class R2Rule(StrEnum):
    """When a finger of one segment may be laid over another.

    Every R2 of a rule is one of the next rule, with the same label and successor.
    """

    PUBLIC = "public"
    """As in the authors' earlier code: both ends of the rope lie in one face, an imagined edge in
    it joins them, and the two segments share a face of the closed curve so made."""
    PAPER = "paper"
    """The two segments share a face, and the finger does not go around an end of the rope: the R2
    that the parameters of the paper's Table I tell apart."""
    ANY = "any"
    """The two segments share a face: every finger there is."""


def successors(
    state: RopeState, rule: R2Rule | str = R2Rule.PAPER
) -> Iterator[tuple[Action, RopeState]]:
    """Every legal action, with the state it leads to.

    Each action is given once, in an order fixed by the state: R1, C, then R2. Different actions may
    lead to the same state.

    Examples
    --------
    >>> from knotopt.topology.state import TRIVIAL
    >>> print(*[action for action, _ in successors(TRIVIAL)])  # doctest: +NORMALIZE_WHITESPACE
    R1(0,-1,-1) R1(0,-1,1) R1(0,1,-1) R1(0,1,1)
    R2(0,0,1,1) R2(0,0,1,-1) R2(0,0,-1,1) R2(0,0,-1,-1)
    """
    for action in legal_actions(state, rule):
        yield action, RopeState(perform(state.code, action))


def legal_actions(state: RopeState, rule: R2Rule | str = R2Rule.PAPER) -> Iterator[Action]:
    """Every legal action, as `successors` orders them."""
    rule = R2Rule(rule)
    last = len(state.code)
    yield from (R1(*label) for label in product(range(last + 1), (-1, 1), (-1, 1)))
    face = dart_faces(state.code)
    borders: list[list[int]] = [[] for _ in range(last // 2 + 1)]
    for dart, number in enumerate(face):
        borders[number].append(dart)
    for end in sorted({0, last}):
        for dart in borders[face[2 * end]]:
            segment = dart >> 1
            if segment not in {0, end}:  # the crossing of both ends is met from the head
                sign = _sign_with_end_over(dart, end)
                yield C(end, segment, sign)
                yield C(segment, end, -sign)
    if rule is not R2Rule.PUBLIC or face[0] == face[-1]:
        for border in borders:
            for top, below in product(border, repeat=2):
                yield from _fingers(top, below, rule)


def _fingers(top: int, below: int, rule: R2Rule) -> Iterator[R2]:
    """R2 from one dart over another of the same face."""
    over, under = top >> 1, below >> 1
    left = 1 - 2 * (top & 1)
    around = bool((top ^ below ^ over ^ under) & 1)
    if around and rule is not R2Rule.ANY:
        return
    if over <= under:
        yield R2(over, under, left, 1, around)
    if over >= under:
        yield R2(over, under, left, -1, around)


def apply(state: RopeState, action: Action, rule: R2Rule | str = R2Rule.PAPER) -> RopeState:
    """The state after an action.

    Raises
    ------
    RopeActionError
        The state does not allow the action; the message says why.

    Examples
    --------
    >>> from knotopt.topology.actions import parse_action
    >>> from knotopt.topology.state import TRIVIAL
    >>> state = TRIVIAL
    >>> for label in ("R1(0,1,1)", "C(0,1,1)", "C(2,0,1)"):
    ...     state = apply(state, parse_action(label))
    >>> print(state)
    U1+ O2+ U3+ O1+ U2+ O3+
    """
    reason = refusal(state, action, rule)
    if reason:
        raise RopeActionError(f"{action} is not legal here: {reason}")
    return RopeState(perform(state.code, action))


def refusal(state: RopeState, action: Action, rule: R2Rule | str = R2Rule.PAPER) -> str | None:
    """Why the state does not allow the action; None if it does."""
    rule = R2Rule(rule)
    last = len(state.code)
    for name in ("left", "over_first", "sign"):
        bit = getattr(action, name, 1)  # R1, C and R2 have two or one of them
        if bit not in {1, -1}:
            return f"{name} is {bit}, not +1 or -1"
    for segment in (action.idx,) if isinstance(action, R1) else (action.over, action.under):
        if not 0 <= segment <= last:
            return f"there is no segment {segment}, only 0 to {last}"
    match action:
        case C():
            return _refuse_c(state.code, action)
        case R2():
            return _refuse_r2(state.code, action, rule)
    return None


def _refuse_c(code: Code, action: C) -> str | None:
    last = len(code)
    over, under = action.over, action.under
    if over == under:
        return f"segment {over} crosses itself by R1"
    ends = {over, under} & {0, last}
    if not ends:
        return f"neither segment {over} nor {under} is an end of the rope (0 or {last})"
    end = min(ends)
    other = under if end == over else over
    face = dart_faces(code)
    inside = face[2 * end]
    darts = [dart for dart in (2 * other, 2 * other + 1) if face[dart] == inside]
    if not darts:
        return f"the end segment {end} does not lie in a face beside segment {other}"
    flip = 1 if end == over else -1
    signs = {flip * _sign_with_end_over(dart, end) for dart in darts}
    if action.sign not in signs:
        return (
            f"segment {end} comes from the side of segment {other} that gives sign {-action.sign}"
        )
    return None


def _refuse_r2(code: Code, action: R2, rule: R2Rule) -> str | None:
    over, under = action.over, action.under
    if over != under and (action.over_first > 0) != (over < under):
        return f"over_first is {action.over_first}, but segment {min(over, under)} comes first"
    if action.around and rule is not R2Rule.ANY:
        return f"the finger goes around an end of the rope, which rule {rule.value!r} does not have"
    face = dart_faces(code)
    if rule is R2Rule.PUBLIC and face[0] != face[-1]:
        return f"rule {rule.value!r} needs both ends of the rope in one face"
    right = action.left < 0
    below_right = right ^ (over ^ under) & 1 ^ action.around
    if face[2 * over + right] != face[2 * under + below_right]:
        sides = ["left", "right"]
        return (
            f"the {sides[right]} of segment {over} and the {sides[below_right]} of segment {under} "
            f"do not lie in one face"
        )
    return None


def _sign_with_end_over(dart: int, end: int) -> int:
    """Sign of the crossing when an end in the face on a dart's left passes over that dart.

    The tail crosses the dart from its left to its right, which is positive along the rope.
    """
    return (1 if end else -1) * (1 - 2 * (dart & 1))
