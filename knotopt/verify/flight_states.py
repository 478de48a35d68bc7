"""The states of the cable after every crossing of a flight: planned and executed, compared.

A word (`flight_word`) says which spans are crossed. It does not say between which of a span's other
crossings, so words that agree may tie different knots; states tell them apart. The cable from p_1
to the leader is a rope whose last end alone moves: every crossing is the action C by its last
segment, or R1 where that crosses itself. C needs a face that both segments border. Where there is
none a crossing is missing, whatever was planned.

Source of states and actions: Yan, Li, Zhu and Bohg, arXiv:2009.02615, sections III and IV.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from knotopt.topology.actions import R1, C, perform
from knotopt.topology.faces import Code, dart_faces
from knotopt.topology.state import RopeState
from knotopt.verify.flight_word import Letter, WordRow

Interval = tuple[float, float]
Order = tuple[int, ...]  # of the visits along the rope, by the crossing's number

AS_PLANNED, NOT_TOLD_APART = "as planned", "not told apart"
MOST = 64  # orders of the crossings along the cable that are followed side by side


@dataclass(frozen=True)
class EndCrossing:
    """A crossing of the rope's last end with an older strand.

    Attributes
    ----------
    over : bool
        Whether the end passes over.
    sense : int
        +1 where the end gets from the right of the older strand to its left, else -1.
    at : float
        Where the older strand is crossed, along the rope from its first end.
    earlier : tuple of (interval, interval)
        Where each earlier crossing's older and newer strand then are along the rope: least, most.
    """

    over: bool
    sense: int
    at: float
    earlier: tuple[tuple[Interval, Interval], ...]

    @property
    def sign(self) -> int:
        """Of the crossing."""
        return -self.sense if self.over else self.sense

    def action(self, segment: int, last: int) -> C | R1:
        """By which the last segment of a rope makes this crossing with another, or with itself."""
        if segment == last:
            return R1(last, self.sign if self.over else -self.sign, self.sign)
        over, under = (last, segment) if self.over else (segment, last)
        return C(over, under, self.sign)


@dataclass(frozen=True)
class StateSequence:
    """What states the crossings of a rope's last end lead through.

    Attributes
    ----------
    steps : tuple of tuple of RopeState
        The states that are possible after each crossing; several where crossings are too near each
        other to tell their order and the plane does not decide it.
    misfit : str
        Why there are no states after the last of these, if there are more crossings.
    letters : tuple of Letter
        The crossings, of a flight or a plan.
    """

    steps: tuple[tuple[RopeState, ...], ...]
    misfit: str = ""
    letters: tuple[Letter, ...] = ()


@dataclass(frozen=True)
class StateComparison:
    """Planned and executed states.

    Attributes
    ----------
    planned, executed : StateSequence
    results : tuple of str
        "as planned" or "not told apart" after each crossing before the first difference.
    difference : str
        The first one, in a sentence; "" if there is none.
    """

    planned: StateSequence
    executed: StateSequence
    results: tuple[str, ...]
    difference: str

    @property
    def sentence(self) -> str:
        """In one line."""
        kept = self.results.count(AS_PLANNED)
        words = f"{AS_PLANNED} ({kept} of {len(self.planned.letters)})"
        if kept < len(self.results):
            words += f", {len(self.results) - kept} {NOT_TOLD_APART}"
        return f"{words}; {self.difference}" if self.difference else words


def state_sequence(crossings: Sequence[EndCrossing], tolerance: float) -> StateSequence:
    """The states that crossings of a rope's last end lead through.

    Parameters
    ----------
    crossings : sequence of EndCrossing
        In order of time; the k-th (from 0) has k earlier ones.
    tolerance : float
        Distance along the rope under which the order of two crossings is left open.

    Notes
    -----
    Every order of the crossings along the rope that the places allow is followed as long as its
    crossings can be made, and those that do not last to the end are left out of all steps.

    Examples
    --------
    The trefoil's three crossings, the first strand crossed at 1, 2 and 3 along the rope:

    >>> first = (1.0, 1.0), (4.0, 4.0)
    >>> second = (2.0, 2.0), (5.0, 5.0)
    >>> found = state_sequence(
    ...     [
    ...         EndCrossing(True, -1, 1.0, ()),
    ...         EndCrossing(False, 1, 2.0, (first,)),
    ...         EndCrossing(True, -1, 3.0, (first, second)),
    ...     ],
    ...     0.1,
    ... )
    >>> for (state,) in found.steps:
    ...     print(state)
    U1+ O1+
    U1+ O2+ O1+ U2+
    U1+ O2+ U3+ O1+ U2+ O3+
    """
    possible: list[dict[Order, Code]] = [{(): ()}]
    misfit = ""
    for number, crossing in enumerate(crossings):
        found: dict[Order, Code] = {}
        for order, code in possible[-1].items():
            for segment in _segments(order, crossing, tolerance):
                if _can_cross(code, segment, crossing.sense):
                    after = (*order[:segment], number, *order[segment:], number)
                    found[after] = perform(code, crossing.action(segment, len(code)))
        if not found:
            misfit = "the leader cannot get there without another one, as of its own tether"
        elif len(found) > MOST:
            misfit = f"crossings lie so near each other that over {MOST} orders are possible"
        if misfit:
            misfit = f"crossing {number + 1}: {misfit}"
            break
        possible.append(found)
    steps = []
    for k, orders in enumerate(possible[1:]):
        lasting = {tuple(number for number in order if number <= k) for order in possible[-1]}
        codes = sorted({orders[order] for order in lasting})
        steps.append(tuple(RopeState(code) for code in codes))
    return StateSequence(tuple(steps), misfit)


def compare_states(
    planned: StateSequence, executed: StateSequence, rows: Sequence[WordRow]
) -> StateComparison:
    """The planned and the executed states up to the first crossing after which they differ.

    Parameters
    ----------
    planned, executed : StateSequence
    rows : sequence of WordRow
        Their words, from `compare_words`, which say what else happened.
    """
    results: list[str] = []
    for wanted, found in zip(planned.steps, executed.steps, strict=False):
        if not {*wanted} & {*found}:
            break
        results.append(AS_PLANNED if len(wanted) == len(found) == 1 else NOT_TOLD_APART)
    difference = _difference(planned, executed, len(results), rows)
    return StateComparison(planned, executed, tuple(results), difference)


def format_states(states: Sequence[RopeState]) -> str:
    """States that are possible, as text."""
    return " or ".join(map(str, states))


def _difference(
    planned: StateSequence, executed: StateSequence, k: int, rows: Sequence[WordRow]
) -> str:
    """What is different about crossing k (from 0), the first after which the states differ."""
    wanted, found = planned.letters[k:], executed.letters[k:]
    if not wanted and not found:
        return ""
    if k == len(planned.steps) and planned.misfit:
        return f"the plan, {planned.misfit}"
    if not (wanted and found and crossing_key(wanted[0]) == crossing_key(found[0])):
        amiss = [row.sentence for row in rows if row.kind != AS_PLANNED]
        return amiss[0] if amiss else f"{len(wanted)} crossings planned, {len(found)} executed"
    if k == len(executed.steps):
        return executed.misfit
    states = f"{format_states(executed.steps[k])}, not {format_states(planned.steps[k])}"
    return f"crossing {k + 1} lies elsewhere among the cable's other crossings: {states}"


def crossing_key(letter: Letter) -> tuple[int, bool, int]:
    """What a crossing is like, whenever it is made: older span, over or under, sense."""
    return letter.older, letter.over, letter.sense


def _can_cross(code: Code, segment: int, sense: int) -> bool:
    """Whether the last end lies in the face on the side of a segment that it comes from.

    With `sense` +1 that is the right one. Its own segment it can always cross.
    """
    face, last = dart_faces(code), len(code)
    return segment == last or face[2 * last] == face[2 * segment + (sense > 0)]


def _segments(order: Order, crossing: EndCrossing, tolerance: float) -> range:
    """Segments that may be crossed, given the crossings in the order of the rope's visits."""
    first, last = 0, len(order)
    met: set[int] = set()
    for visit, number in enumerate(order):
        low, high = crossing.earlier[number][number in met]
        met.add(number)
        if high < crossing.at - tolerance:
            first = visit + 1
        elif low > crossing.at + tolerance:
            last = min(last, visit)
    return range(first, last + 1)
