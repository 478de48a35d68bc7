"""Plans to a goal: against forward search, and counted for known knots."""

from __future__ import annotations

from itertools import pairwise

import networkx as nx
import pytest
import spherogram

from knotopt.cable.cable import Cable
from knotopt.cable.notation import gauss_code
from knotopt.diagram.families import torus_knot
from knotopt.topology.actions import R1, R2, Action, C
from knotopt.topology.legal import R2Rule, apply, successors
from knotopt.topology.plan import PlanGraph, plan_graph
from knotopt.topology.state import TRIVIAL, RopeState
from knotopt.topology.undo import predecessors

RULES = tuple(R2Rule)
OVERHAND = RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+")


def long_diagrams(knot: str) -> list[RopeState]:
    """The minimal diagram of a knot that Spherogram has, opened at each edge in turn."""
    visits: list[tuple[int, bool, int]] = []
    number: dict[object, int] = {}
    for entry in spherogram.Link(knot).link_components[0]:
        crossing = entry.crossing
        name = number.setdefault(crossing, len(number) + 1)
        visits.append((name, entry.strand_index % 2 == 1, crossing.sign))
    return [
        RopeState.from_gauss(
            " ".join(
                f"{'UO'[over]}{name}{'-+'[sign > 0]}"
                for name, over, sign in visits[cut:] + visits[:cut]
            )
        )
        for cut in range(len(visits))
    ]


def distinct(knot: str) -> list[RopeState]:
    """The same without mirror images and reverses of others, in the order of their codes."""
    return sorted({s.canonical() for s in long_diagrams(knot)}, key=lambda s: s.code)


def size(graph: PlanGraph) -> tuple[int, int, int]:
    """States, edges, plans."""
    return len(graph.states), graph.action_count, graph.plan_count


def sizes(knot: str, rule: R2Rule = R2Rule.PAPER) -> list[tuple[int, int, int]]:
    return sorted({size(plan_graph(goal, rule=rule)) for goal in distinct(knot)})


def sizes_with_each_end(knot: str) -> list[tuple[int, int, int]]:
    """As `sizes` by the public rule, but a crossing of head and tail counts once for each end."""
    found = set()
    for goal in distinct(knot):
        graph = plan_graph(goal, rule=R2Rule.PUBLIC)
        last = {state: len(state.code) for state in graph.states}
        ways: dict[RopeState, int] = {}
        edges = 0
        for state, steps in reversed(graph.steps.items()):
            ways[state] = not steps
            for action, after in steps:
                twice = isinstance(action, C) and {action.over, action.under} == {0, last[state]}
                edges += 1 + twice
                ways[state] += ways[after] * (1 + twice)
        found.add((len(graph.states), edges, ways[TRIVIAL]))
    return sorted(found)


def test_an_overhand_knot_has_four_plans() -> None:
    """One concrete state."""
    for rule in RULES:
        graph = plan_graph(OVERHAND, rule=rule)
        assert size(graph) == (6, 8, 4)
        assert [str(plan) for plan in graph.plans()] == [
            "R1(0,-1,1) C(1,0,1) C(4,2,1)",
            "R1(0,-1,1) C(2,1,1) C(2,0,1)",
            "R1(0,1,1) C(0,1,1) C(2,0,1)",
            "R1(0,1,1) C(1,2,1) C(4,2,1)",
        ]


def test_a_pair_of_opposite_chirality_has_eight() -> None:
    """The pair that the paper draws, and any state with its mirror image."""
    drawn = OVERHAND.mirror().reverse()
    for pair in ((OVERHAND, drawn), (OVERHAND, OVERHAND.mirror())):
        assert plan_graph(pair).plan_count == 8


def test_all_four_overhand_knots_have_sixteen() -> None:
    """The orbit under mirror and reverse."""
    back = OVERHAND.reverse()
    orbit = {OVERHAND, OVERHAND.mirror(), back, back.mirror()}
    assert len(orbit) == 4
    assert plan_graph(orbit).plan_count == 16


@pytest.mark.parametrize(
    ("knot", "expected"), [("3_1", (6, 8, 4)), ("5_1", (10, 16, 16)), ("7_1", (14, 24, 64))]
)
def test_torus_knots(knot: str, expected: tuple[int, int, int]) -> None:
    for rule in RULES:
        assert sizes(knot, rule) == [expected]


def test_the_pentagram_is_reached_from_the_overhand_knots() -> None:
    """Twice from each of the two overhand knots on the way."""
    (pentagram,) = distinct("5_1")
    graph = plan_graph(pentagram)
    overhands = [s for s in graph.states if s.canonical() == OVERHAND.canonical()]
    assert len(overhands) == 2
    for state in overhands:
        plans = plan_graph(pentagram, start=state)
        assert plans.counts == {2: 2}
        assert plans.states[0] == plans.start == state


def test_figure_eight() -> None:
    """Two long diagrams: eight plans each, and two with a finger around an end of the rope."""
    assert sizes("4_1", R2Rule.PUBLIC) == [(10, 15, 8), (11, 16, 8)]
    assert sizes("4_1", R2Rule.PAPER) == [(10, 15, 8), (11, 16, 8)]
    assert sizes("4_1", R2Rule.ANY) == [(10, 17, 10), (11, 17, 10)]
    for goal in distinct("4_1"):
        graph = plan_graph(goal, rule="any")
        assert graph.counts == {3: 2, 4: 8}
        assert all(
            any(isinstance(action, R2) and action.around for action in plan.actions)
            for plan in graph.plans()
            if len(plan) == 3
        )
        assert plan_graph(goal, rule="any", fewest=True).counts == {3: 2}


@pytest.mark.parametrize(
    ("knot", "row"),
    [
        ("3_1", [(6, 8, 4)]),
        ("4_1", [(10, 16, 10), (11, 18, 10)]),
        ("5_1", [(10, 16, 16)]),
        ("5_2", [(12, 21, 17), (13, 25, 23), (13, 25, 28)]),
        ("6_1", [(18, 36, 82), (19, 34, 40), (19, 38, 65), (20, 38, 44)]),
        ("7_1", [(14, 24, 64)]),
        ("8_18", [(25, 54, 240)]),
        ("9_40", [(36, 80, 568), (38, 88, 564)]),
        ("10_123", [(39, 86, 1120)]),
    ],
)
def test_a_crossing_of_both_ends_counted_for_each(
    knot: str, row: list[tuple[int, int, int]]
) -> None:
    """How many there are if the crossing of head and tail is made by either as an action each.

    The label of C does not say which end moves, so it is one action here.
    """
    assert sizes_with_each_end(knot) == row


@pytest.mark.parametrize(
    ("knot", "expected"),
    [
        ("5_2", [(12, 20, 16), (13, 22, 16)]),
        ("6_1", [(18, 31, 32), (19, 32, 32), (20, 34, 32)]),
        ("8_18", [(25, 50, 176)]),
        ("9_40", [(45, 98, 456), (47, 103, 432)]),
        ("10_123", [(45, 98, 960)]),
    ],
)
def test_plans_of_other_knots(knot: str, expected: list[tuple[int, int, int]]) -> None:
    assert sizes(knot) == expected


@pytest.mark.parametrize("rule", RULES)
def test_plans_are_those_of_forward_search(rule: R2Rule) -> None:
    """Every state up to three crossings, and how often sequences of actions lead there."""
    ways = {TRIVIAL: 1}
    edges: dict[RopeState, set[tuple[RopeState, Action, RopeState]]] = {TRIVIAL: set()}
    for crossings in range(3):
        for state in [state for state in ways if state.crossings == crossings]:
            for action, after in successors(state, rule):
                if after.crossings <= 3:
                    ways[after] = ways.get(after, 0) + ways[state]
                    edges.setdefault(after, set()).update(edges[state] | {(state, action, after)})
    assert len(ways) == 1 + 4 + 40 + 528
    for goal, count in ways.items():
        graph = plan_graph(goal, rule=rule)
        assert graph.plan_count == count
        found = {(s, a, after) for s, steps in graph.steps.items() for a, after in steps}
        assert found == edges[goal]


@pytest.mark.parametrize("rule", RULES)
def test_plans_are_listed_once_in_order_and_run(rule: R2Rule) -> None:
    for goal in distinct("6_1"):
        graph = plan_graph(goal, rule=rule)
        plans = list(graph.plans())
        assert len(plans) == len({plan.actions for plan in plans}) == graph.plan_count
        assert len({plan.states for plan in plans}) == graph.state_path_count
        assert [plan.actions for plan in graph.plans(3)] == [plan.actions for plan in plans[:3]]
        for plan in plans:
            assert (plan.states[0], plan.states[-1]) == (TRIVIAL, goal)
            for action, (before, after) in zip(plan.actions, pairwise(plan.states), strict=True):
                assert apply(before, action, rule) == after
        lengths = [len(plan) for plan in plans]
        assert graph.counts == {n: lengths.count(n) for n in sorted(set(lengths))}


def test_the_order_of_plans() -> None:
    """R1 before C before R2, then by numbers."""
    two_loops = plan_graph(RopeState.from_gauss("O1+ U1+ O2+ U2+"))
    assert [str(plan) for plan in two_loops.plans()] == [
        "R1(0,-1,1) R1(0,-1,1)",
        "R1(0,-1,1) R1(2,-1,1)",
    ]
    finger = plan_graph(apply(TRIVIAL, R2(0, 0, 1, 1)))
    assert [str(plan) for plan in finger.plans()] == [
        "R1(0,-1,1) R1(1,1,-1)",
        "R1(0,1,-1) C(0,2,1)",
        "R2(0,0,1,1)",
    ]


def test_two_actions_with_one_successor_are_two_plans() -> None:
    graph = plan_graph(RopeState.from_gauss("O1+ U1+ O2+ U2+"))
    assert (graph.plan_count, graph.state_path_count) == (2, 1)


def test_a_goal_on_the_way_to_another() -> None:
    """A plan may end at it or go on."""
    loop = RopeState.from_gauss("U1+ O1+")
    graph = plan_graph((OVERHAND, loop))
    assert graph.counts == {1: 1, 3: 4}
    assert [len(plan) for plan in graph.plans()].count(1) == 1


def test_the_start_may_be_a_goal_or_out_of_reach() -> None:
    here = plan_graph(OVERHAND, start=OVERHAND)
    assert here.counts == {0: 1}
    assert [plan.actions for plan in here.plans()] == [()]
    away = plan_graph(OVERHAND, start=OVERHAND.mirror())
    assert (away.goals, away.states, away.plan_count, away.state_path_count) == ((), (), 0, 0)
    assert list(away.plans()) == []
    assert away.to_networkx().number_of_nodes() == 0
    some = plan_graph((OVERHAND, RopeState.from_gauss("U1- O1-")), start=OVERHAND)
    assert some.goals == (OVERHAND,)


def test_fewest_actions() -> None:
    goal = apply(TRIVIAL, R2(0, 0, 1, 1))
    assert plan_graph(goal).counts == {1: 1, 2: 2}
    assert [str(plan) for plan in plan_graph(goal, fewest=True).plans()] == ["R2(0,0,1,1)"]


def test_networkx() -> None:
    graph = plan_graph(OVERHAND)
    drawn = graph.to_networkx()
    assert nx.is_directed_acyclic_graph(drawn)
    assert (drawn.number_of_nodes(), drawn.number_of_edges()) == (6, 8)
    assert drawn.nodes[TRIVIAL] == {"depth": 0, "goal": False}
    assert drawn.nodes[OVERHAND] == {"depth": 3, "goal": True}
    for before, after, action in drawn.edges(data="action"):
        assert apply(before, action) == after
    twice = plan_graph(RopeState.from_gauss("O1+ U1+ O2+ U2+")).to_networkx()
    assert sorted(str(a) for _, _, a in twice.edges(data="action")) == [
        "R1(0,-1,1)",
        "R1(0,-1,1)",
        "R1(2,-1,1)",
    ]


def test_mirror_image_and_reverse_have_as_many_plans() -> None:
    for goal in distinct("7_7"):
        for other in (goal.mirror(), goal.reverse()):
            assert size(plan_graph(other)) == size(plan_graph(goal))


def test_fourteen_crossings() -> None:
    """A cable of T(3,7), and every way to open a diagram of K14n100: the graphs stay small."""
    cable = Cable(torus_knot(3, 7), "L+")
    knot = RopeState.from_gauss(gauss_code(cable), cable.crossings.sign.tolist())
    goals = [knot, *distinct("K14n100")]
    assert len(goals) == 29
    for goal in goals:
        assert goal.crossings == 14
        graph = plan_graph(goal)
        assert graph.plan_count > 1000
    assert max(len(plan_graph(goal).states) for goal in goals) < 150


def test_predecessors_of_the_trivial_state() -> None:
    assert list(predecessors(TRIVIAL)) == []
    assert [str(a) for a, _ in predecessors(RopeState.from_gauss("U1+ O1+"))] == [str(R1(0, 1, 1))]


@pytest.mark.slow
def test_a_plan_longer_than_python_recurses() -> None:
    cable = Cable(torus_knot(2, 1001), "L+")
    knot = RopeState.from_gauss(gauss_code(cable), cable.crossings.sign.tolist())
    (plan,) = plan_graph(knot).plans(1)
    assert len(plan.actions) == 1001 and plan.states[-1] == knot
