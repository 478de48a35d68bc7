"""Actions that may have come last, and the states before them."""

from __future__ import annotations

from collections.abc import Iterator

from knotopt.topology.actions import R1, R2, Action, C
from knotopt.topology.faces import Code, dart_faces
from knotopt.topology.legal import R2Rule
from knotopt.topology.state import RopeState


def predecessors(
    state: RopeState, rule: R2Rule | str = R2Rule.PAPER
) -> Iterator[tuple[Action, RopeState]]:
    """Every (action, earlier state) such that the action is legal there and leads to this state.

    Each pair is given once, in an order fixed by the state.

    Notes
    -----
    An end's last crossing can always be taken back: C, or R1 if it is with the rope right before
    it. Two consecutive visits of one crossing bound a loop: R1. Two consecutive visits over, whose
    partners are consecutive and which have opposite signs, bound a face together with the strand
    below, for the rope is connected and meets the closed curve of the two strands between the
    crossings only at these, from outside: R2. O(n) for each pair.

    Examples
    --------
    >>> for action, earlier in predecessors(RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+")):
    ...     print(action, "after", earlier)
    C(4,2,1) after U1+ O2+ O1+ U2+
    C(2,0,1) after O1+ U2+ U1+ O2+
    """
    rule = R2Rule(rule)
    code = state.code
    last = len(code) - 1
    if last < 0:
        return
    for visit in (last, 0):
        entry = code[visit]
        partner = entry >> 2
        if abs(partner - visit) == 1 or (visit == 0 and partner == last):
            continue  # a loop, or taken back at the tail already
        end, other = (last - 1, partner) if visit else (0, partner - 1)
        sign = 2 * (entry & 1) - 1
        crossed = C(end, other, sign) if entry & 2 else C(other, end, sign)
        yield crossed, RopeState(_removed(code, min(visit, partner), max(visit, partner), 1))
    for visit in range(last):
        entry, following = code[visit], code[visit + 1]
        partner = entry >> 2
        if partner == visit + 1:
            sign = 2 * (entry & 1) - 1
            looped = R1(visit, -sign if entry & 2 else sign, sign)
            yield looped, RopeState(_removed(code, visit, visit + 1, 1))
        elif entry & following & 2 and (entry ^ following) & 1:
            gap = (following >> 2) - partner
            if abs(gap) == 1:
                yield from _finger(code, visit, min(partner, following >> 2), gap < 0, rule)


def _finger(
    code: Code, top: int, below: int, crossed: bool, rule: R2Rule
) -> Iterator[tuple[Action, RopeState]]:
    """Takes back the R2 whose visits are top, top + 1 over below, below + 1, if the rule has it."""
    if top < below:
        over, under, over_first = top, below - 2, 1
    else:
        over, under, over_first = top - 2, below, -1
    below_left = bool(code[top] & 1)
    left = below_left == crossed
    around = bool((left ^ below_left ^ over ^ under) & 1)
    if around and rule is not R2Rule.ANY:
        return
    earlier = _removed(code, min(top, below), max(top, below), 2)
    if rule is R2Rule.PUBLIC:
        face = dart_faces(earlier)
        if face[0] != face[-1]:
            return
    yield R2(over, under, 1 if left else -1, over_first, around), RopeState(earlier)


def _removed(code: Code, low: int, high: int, width: int) -> Code:
    """The code without `width` visits from low and from high > low on, which are partners."""
    low4, high4, step = 4 * low, 4 * high, 4 * width
    kept = code[:low] + code[low + width : high] + code[high + width :]
    return tuple([e if e < low4 else e - step if e < high4 else e - step - step for e in kept])
