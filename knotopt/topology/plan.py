"""All plans to a goal, searched backward from it.

Every action adds crossings, so the ways to a goal form a finite directed acyclic graph. An action
taken back leaves few states - those `predecessors` gives, mostly the goal's rope without a piece at
its head or tail - whereas a state with n crossings has successors in the order of n^2. So the graph
is built from the goal down, and plans are counted on it without being listed.

A plan is a sequence of actions. Two actions may lead from one state to the same other one, such as
an R1 before and one behind a loop of the same kind; plans through them are counted as two.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING

from knotopt.errors import KnotoptError
from knotopt.showing import ShownShort, plural
from knotopt.topology.actions import Action, sort_key
from knotopt.topology.legal import R2Rule
from knotopt.topology.state import TRIVIAL, RopeState
from knotopt.topology.undo import predecessors

if TYPE_CHECKING:
    import networkx as nx

Steps = dict[RopeState, list[tuple[Action, RopeState]]]


MOST_STATES = 200_000
"""Of a graph of plans: of 178 crossings each, a minute of work and two gigabytes."""


class PlanError(KnotoptError):
    """A goal whose plans are too many to find."""


@dataclass(frozen=True)
class Plan:
    """Actions that lead from states[0] to states[-1]; actions[k] leads from states[k] to the next.

    Attributes
    ----------
    actions : tuple of Action, length m
    states : tuple of RopeState, length m + 1
    """

    actions: tuple[Action, ...]
    states: tuple[RopeState, ...]

    def __len__(self) -> int:
        return len(self.actions)

    def __str__(self) -> str:
        return " ".join(map(str, self.actions))


@dataclass(frozen=True, eq=False, repr=False)
class PlanGraph(ShownShort):
    """The states and actions of all plans from a start to any of some goals.

    Attributes
    ----------
    start : RopeState
    goals : tuple of RopeState
        The goals that can be reached, in the order asked for.
    steps : dict from RopeState to list of (Action, RopeState)
        The actions out of each state that lead on to a goal, in the order of their labels, with
        their successors. States come in the order of their numbers of crossings and codes, so the
        start is first. Empty if no goal can be reached.

    Examples
    --------
    >>> graph = plan_graph(RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+"))
    >>> graph.plan_count, len(graph.steps), graph.action_count
    (4, 6, 8)
    >>> for plan in graph.plans():
    ...     print(plan)
    R1(0,-1,1) C(1,0,1) C(4,2,1)
    R1(0,-1,1) C(2,1,1) C(2,0,1)
    R1(0,1,1) C(0,1,1) C(2,0,1)
    R1(0,1,1) C(1,2,1) C(4,2,1)
    """

    start: RopeState
    goals: tuple[RopeState, ...]
    steps: Steps

    @property
    def states(self) -> tuple[RopeState, ...]:
        """Every state on a plan, the start first."""
        return tuple(self.steps)

    @property
    def action_count(self) -> int:
        """Number of edges: of pairs of a state and an action there."""
        return sum(map(len, self.steps.values()))

    @property
    def in_words(self) -> str:
        """How many plans and states there are."""
        return f"{plural(self.plan_count, 'plan')}, {plural(len(self.states), 'state')}"

    @cached_property
    def counts(self) -> dict[int, int]:
        """Number of plans by number of actions; by dynamic programming over the edges."""
        ways: dict[RopeState, Counter[int]] = {}
        for state, steps in reversed(self.steps.items()):
            ways[state] = Counter({0: 1} if state in self.goals else {})
            for _, after in steps:
                ways[state].update({length + 1: count for length, count in ways[after].items()})
        return dict(sorted(ways[self.start].items())) if ways else {}

    @property
    def plan_count(self) -> int:
        """Number of plans: of sequences of actions from the start to a goal."""
        return sum(self.counts.values())

    @cached_property
    def state_path_count(self) -> int:
        """Number of sequences of states that the plans go through, at most `plan_count`."""
        count: dict[RopeState, int] = {}
        for state, steps in reversed(self.steps.items()):
            count[state] = (state in self.goals) + sum(count[s] for s in {s for _, s in steps})
        return count.get(self.start, 0)

    @cached_property
    def depth(self) -> dict[RopeState, int]:
        """The fewest actions that lead from the start to each state."""
        return _fewest_actions(self.start, self.steps)

    def plans(self, limit: int | None = None) -> Iterator[Plan]:
        """The plans in the lexicographic order of their actions, made one by one; at most `limit`.

        Actions are ordered by kind - R1, C, R2 - and then by the numbers of their labels.
        """
        return islice(self._walk(), limit) if self.steps else iter(())

    def _walk(self) -> Iterator[Plan]:
        """Depth first, with a stack of its own: plans may be longer than Python's."""
        ways: list[tuple[tuple[Action, ...], tuple[RopeState, ...]]] = [((), (self.start,))]
        while ways:
            actions, states = ways.pop()
            if states[-1] in self.goals:
                yield Plan(actions, states)
            ways += [
                ((*actions, action), (*states, after))
                for action, after in reversed(self.steps[states[-1]])
            ]

    def to_networkx(self) -> nx.MultiDiGraph:
        """States as nodes with attributes `depth` and `goal` (bool), edges with `action`.

        Two actions with the same successor are two edges.
        """
        import networkx as nx

        graph = nx.MultiDiGraph()
        for state in self.steps:
            graph.add_node(state, depth=self.depth[state], goal=state in self.goals)
        for state, steps in self.steps.items():
            graph.add_edges_from((state, after, {"action": action}) for action, after in steps)
        return graph


def plan_graph(
    goals: RopeState | Iterable[RopeState],
    start: RopeState = TRIVIAL,
    rule: R2Rule | str = R2Rule.PAPER,
    *,
    fewest: bool = False,
) -> PlanGraph:
    """All plans from a start to a goal or to any of several goals.

    Parameters
    ----------
    goals : RopeState or iterable of RopeState
    start : RopeState
    rule : R2Rule or str
        Which R2 there are.
    fewest : bool
        Keep only the plans with the fewest actions to their goal. Every plan makes just its goal's
        crossings, but R2 makes two at once, so plans with it are shorter.

    Raises
    ------
    PlanError
        The plans pass through more than `MOST_STATES` states.

    Notes
    -----
    Every state can be reached from the trivial one by R1 and C: take back either end, crossing by
    crossing. O(n) for each edge of the graph. A crossing of the head's segment with the tail's is
    one action, whichever end makes it.
    """
    rule = R2Rule(rule)
    wanted = (goals,) if isinstance(goals, RopeState) else tuple(dict.fromkeys(goals))
    steps = _leading_to(wanted, start, rule)
    reached = _fewest_actions(start, steps)
    if fewest:
        steps = {
            state: [step for step in steps[state] if reached[step[1]] == depth + 1]
            for state, depth in reached.items()
        }
    goals = tuple(goal for goal in wanted if goal in reached)
    return PlanGraph(start, goals, _ordered(start, goals, steps))


def _leading_to(goals: tuple[RopeState, ...], start: RopeState, rule: R2Rule) -> Steps:
    """Actions out of every state from which a goal can be reached, as far back as the start."""
    steps: Steps = {goal: [] for goal in goals}
    open_states = list(goals)
    while open_states:
        state = open_states.pop()
        if state.crossings <= start.crossings:
            continue
        for action, earlier in predecessors(state, rule):
            if earlier not in steps:
                if len(steps) >= MOST_STATES:
                    raise PlanError(
                        f"the ways to this goal of {goals[0].crossings} crossings pass through "
                        f"more than {MOST_STATES} states; a simpler diagram of the knot has fewer"
                    )
                steps[earlier] = []
                open_states.append(earlier)
            steps[earlier].append((action, state))
    return steps


def _fewest_actions(start: RopeState, steps: Steps) -> dict[RopeState, int]:
    """The fewest actions from the start to each state that can be reached from it."""
    depth = {start: 0} if start in steps else {}
    queue = list(depth)
    for state in queue:
        for _, after in steps[state]:
            if after not in depth:
                depth[after] = depth[state] + 1
                queue.append(after)
    return depth


def _ordered(start: RopeState, goals: tuple[RopeState, ...], steps: Steps) -> Steps:
    """The part between the start and the goals, in an order that does not depend on the search."""
    between = set(goals)
    between_start = sorted(_fewest_actions(start, steps), key=lambda s: (s.crossings, s.code))
    for state in reversed(between_start):
        if any(after in between for _, after in steps[state]):
            between.add(state)
    return {
        state: sorted(
            (step for step in steps[state] if step[1] in between),
            key=lambda step: sort_key(step[0]),
        )
        for state in between_start
        if state in between
    }
