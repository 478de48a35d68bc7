"""Actions on ropes: against codes tried one by one, drawn curves, mirror images and reverses."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import product, takewhile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.topology.actions import R1, R2, Action, C, RopeActionError, parse_action, perform
from knotopt.topology.faces import Code, lies_in_the_plane, next_darts
from knotopt.topology.legal import R2Rule, apply, legal_actions, refusal, successors
from knotopt.topology.state import TRIVIAL, RopeState
from knotopt.topology.undo import predecessors
from knotopt.verify.crossings import curve_crossings

RULES = tuple(R2Rule)
RAW = (1, 4, 40, 528, 7968, 133_056)


@cache
def states(crossings: int) -> tuple[RopeState, ...]:
    """Every state with that many crossings, grown by R1 and C."""
    if crossings == 0:
        return (TRIVIAL,)
    grown = {
        after
        for state in states(crossings - 1)
        for action, after in successors(state)
        if not isinstance(action, R2)
    }
    return tuple(sorted(grown, key=lambda state: state.code))


Edges = dict[RopeState, set[tuple[Action, RopeState]]]


@cache
def edges(rule: R2Rule) -> Edges:
    """Actions and successors of every state up to three crossings."""
    return {state: set(successors(state, rule)) for state in small_states()}


def small_states() -> list[RopeState]:
    return [state for crossings in range(4) for state in states(crossings)]


def state_of_curve(points: Sequence[Sequence[float]]) -> RopeState:
    visits, signs = curve_crossings(np.array(points, dtype=float)).code
    return RopeState.from_gauss([k + 1 if over else -k - 1 for k, over in visits], signs)


def joined_lies_in_the_plane(code: Code) -> bool:
    """Whether head and tail can be joined without crossing the rope: n + 2 faces then."""
    after = next_darts(code)
    last = len(after) - 2
    after[last], after[1] = 0, last + 1
    cycles, met = 0, set()
    for start in range(len(after)):
        cycles += start not in met
        dart = start
        while dart not in met:
            met.add(dart)
            dart = after[dart]
    return cycles == len(code) // 2 + 2


def with_crossings(code: Code, places: list[tuple[int, int, int]]) -> Code:
    """The code with new visits (segment, crossing's name, bits), each after those before it."""
    visits: list[tuple[int, int]] = []
    names = [min(k, entry >> 2) for k, entry in enumerate(code)]
    for segment in range(len(code) + 1):
        visits += [(-1 - name, bits) for place, name, bits in places if place == segment]
        if segment < len(code):
            visits.append((names[segment], code[segment] & 3))
    return tuple(
        4 * next(j for j, (other, _) in enumerate(visits) if other == name and j != k) + bits
        for k, (name, bits) in enumerate(visits)
    )


def one_crossing_more(code: Code) -> set[Code]:
    """Codes with a crossing more of an end segment with another one, in any way."""
    last = len(code)
    found = set()
    for low, high in product(range(last + 1), repeat=2):
        if low < high and (low == 0 or high == last):
            for bits in range(4):
                found.add(with_crossings(code, [(low, 0, bits), (high, 0, bits ^ 2)]))
    return found


def one_loop_more(code: Code) -> set[Code]:
    return {
        with_crossings(code, [(segment, 0, bits), (segment, 0, bits ^ 2)])
        for segment, bits in product(range(len(code) + 1), range(4))
    }


def one_finger_more(code: Code) -> set[Code]:
    """Two crossings of opposite signs more, one strand over both, in any way."""
    found = set()
    for low, high in product(range(len(code) + 1), repeat=2):
        for over, sign, turned in product((0, 2), (0, 1), (False, True)):
            if low <= high:
                near = [(low, 0, over + sign), (low, 1, over + 1 - sign)]
                far = [(high, 0, 2 - over + sign), (high, 1, 3 - over - sign)]
                found.add(with_crossings(code, near + (far[::-1] if turned else far)))
    return found


@pytest.mark.parametrize("crossings", range(3))
def test_successors_are_all_planar_codes_of_their_kind(crossings: int) -> None:
    for state in states(crossings):
        code = state.code
        fingers = {new for new in one_finger_more(code) if lies_in_the_plane(new)}
        joined = {new for new in fingers if joined_lies_in_the_plane(new)}
        reached: dict[R2Rule, dict[type[Action], set[Code]]] = {
            rule: {C: set(), R1: set(), R2: set()} for rule in RULES
        }
        for rule in RULES:
            for action, after in successors(state, rule):
                reached[rule][type(action)].add(after.code)
            assert reached[rule][R1] == one_loop_more(code)
            assert reached[rule][C] == set(filter(lies_in_the_plane, one_crossing_more(code)))
        assert reached[R2Rule.ANY][R2] == fingers
        assert reached[R2Rule.PUBLIC][R2] == (joined if joined_lies_in_the_plane(code) else set())
        assert reached[R2Rule.PUBLIC][R2] <= reached[R2Rule.PAPER][R2] <= fingers


@pytest.mark.parametrize("rule", RULES)
def test_legal_actions_are_those_not_refused(rule: R2Rule) -> None:
    for state in (*states(0), *states(1), *states(2)):
        segments = range(-1, len(state.code) + 2)
        tried: list[Action] = [R1(s, a, b) for s in segments for a in (-1, 1) for b in (-1, 1)]
        for s, t, a in product(segments, segments, (-1, 0, 1)):
            tried.append(C(s, t, a))
            tried += [R2(s, t, a, b, c) for b in (-1, 1) for c in (False, True)]
        allowed = [action for action in tried if refusal(state, action, rule) is None]
        legal = list(legal_actions(state, rule))
        assert len(legal) == len(set(legal))
        assert set(legal) == set(allowed)


def test_rules_are_nested_with_the_same_successors() -> None:
    public, paper, every = (edges(rule) for rule in RULES)
    for state in small_states():
        assert public[state] <= paper[state] <= every[state]
        assert len(every[state]) == len({action for action, _ in every[state]})


def test_growth_of_the_state_space() -> None:
    """Every state is reached by R1 and C, so R2 adds no other."""
    assert [len(states(n)) for n in range(5)] == list(RAW[:5])
    assert [len({s.canonical() for s in states(n)}) for n in range(5)] == [1, 1, 13, 132, 2032]
    known = {state for n in range(5) for state in states(n)}
    for n in range(3):
        for state in states(n):
            assert known.issuperset(after for _, after in successors(state, R2Rule.ANY))


def test_growth_to_five_crossings() -> None:
    """One state of each class under mirror and reverse is enough to reach every class."""
    classes = {TRIVIAL}
    for count in (1, 13, 132, 2032, 32576):
        classes = {
            RopeState(perform(state.code, action)).canonical()
            for state in classes
            for action in takewhile(lambda action: not isinstance(action, R2), legal_actions(state))
        }
        assert len(classes) == count


@pytest.mark.parametrize(
    ("rule", "numbers"),
    [("public", (8, 160, 2800)), ("paper", (8, 160, 3024)), ("any", (12, 224, 4144))],
)
def test_number_of_actions(rule: R2Rule, numbers: tuple[int, ...]) -> None:
    """2,968 up to two crossings by the public rule."""
    found = edges(R2Rule(rule))
    assert tuple(sum(len(found[s]) for s in states(n)) for n in range(3)) == numbers


def test_actions_with_the_successor_of_another() -> None:
    found = edges(R2Rule.PUBLIC)
    for n, surplus in enumerate((0, 16, 216)):
        assert surplus == sum(
            len(found[state]) - len({after for _, after in found[state]}) for state in states(n)
        )


@pytest.mark.parametrize("rule", RULES)
def test_mirror_and_reverse(rule: R2Rule) -> None:
    found = edges(rule)
    for state, forward in found.items():
        n = state.crossings
        assert found[state.mirror()] == {(a.mirror(), after.mirror()) for a, after in forward}
        assert found[state.reverse()] == {(a.reverse(n), after.reverse()) for a, after in forward}


@pytest.mark.parametrize("rule", RULES)
def test_predecessors_invert_successors(rule: R2Rule) -> None:
    """Forward from every state up to three crossings, and back from them and all they lead to."""
    known: Edges = {}
    for state, forward in edges(rule).items():
        for action, after in forward:
            if after not in known:
                back = list(predecessors(after, rule))
                known[after] = set(back)
                assert len(back) == len(known[after])
            assert (action, state) in known[after]
    for state in small_states()[1:]:
        for action, earlier in known[state]:
            assert refusal(earlier, action, rule) is None
            assert (action, state) in edges(rule)[earlier]


@given(st.integers(0, 2**32))
def test_a_curve_that_grows(seed: int) -> None:
    """Drawing a curve on at its tail is C, or R1 where it meets what was drawn last."""
    points = np.random.default_rng(seed).normal(size=(8, 3))
    events = np.sort(curve_crossings(points).second)
    state = TRIVIAL
    for stop in [*((events[:-1] + events[1:]) / 2).tolist(), 7.0][: len(events)]:
        whole = min(int(stop), 6)
        tip = points[whole] + (stop - whole) * (points[whole + 1] - points[whole])
        grown = state_of_curve([*points[: whole + 1], tip])
        last = len(state.code)
        actions = [action for action, after in successors(state) if after == grown]
        made = [a for a in actions if isinstance(a, C) and last in {a.over, a.under}]
        made += [a for a in actions if a in {R1(last, x, y) for x in (-1, 1) for y in (-1, 1)}]
        assert len(made) == 1
        state = grown
    assert state == state_of_curve(list(points))


# Curves from west to east; what is on top has height 1.
LOOP_LEFT = [(0, 0, 0), (6, 0, 0), (6, 4, 0), (3, 4, 0), (3, -3, 1), (9, -3, 0)]
FINGER_LEFT = [  # the first half goes up, right, and down over the second half, and back
    (0, 0, 0), (2, 0, 0), (2, 4, 1), (7, 4, 1), (7, -3, 1), (6, -3, 1), (6, 3, 1), (3, 3, 0),
    (3, 0, 0), (9, 0, 0),
]  # fmt: skip
FINGER_AROUND = [  # up, around the tail's end, and over the second half from below
    (0, 0, 0), (2, 0, 0), (2, 4, 1), (12, 4, 1), (12, -3, 1), (6, -3, 1), (6, 3, 1), (7, 3, 1),
    (7, -2, 1), (11, -2, 1), (11, 3.5, 1), (3, 3.5, 0), (3, 0, 0), (9, 0, 0),
]  # fmt: skip


def mirrored(curve: list[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    return [(x, -y, z) for x, y, z in curve]


@pytest.mark.parametrize(
    ("label", "curve"),
    [
        ("R1(0,1,1)", LOOP_LEFT),
        ("R1(0,-1,-1)", mirrored(LOOP_LEFT)),
        ("R1(0,-1,1)", LOOP_LEFT[::-1]),
        ("R1(0,1,-1)", mirrored(LOOP_LEFT)[::-1]),
        ("R2(0,0,1,1)", FINGER_LEFT),
        ("R2(0,0,-1,1)", mirrored(FINGER_LEFT)),
        ("R2(0,0,-1,-1)", FINGER_LEFT[::-1]),
        ("R2(0,0,1,-1)", mirrored(FINGER_LEFT)[::-1]),
        ("R2(0,0,1,1,around)", FINGER_AROUND),
        ("R2(0,0,-1,-1,around)", FINGER_AROUND[::-1]),
    ],
)
def test_drawn_actions_on_a_straight_rope(
    label: str, curve: list[tuple[float, float, float]]
) -> None:
    assert apply(TRIVIAL, parse_action(label), R2Rule.ANY) == state_of_curve(curve)


def run(*labels: str) -> RopeState:
    state = TRIVIAL
    for label in labels:
        state = apply(state, parse_action(label))
    return state


def test_the_overhand_knots_of_the_paper() -> None:
    """Its plan is mirrored and reversed into one of the other chirality."""
    labels = ("R1(0,1,1)", "C(0,1,1)", "C(2,0,1)")
    other = tuple(str(parse_action(a).mirror().reverse(n)) for n, a in enumerate(labels))
    assert other == ("R1(0,1,-1)", "C(2,1,-1)", "C(2,4,-1)")
    assert str(run(*labels)) == "U1+ O2+ U3+ O1+ U2+ O3+"
    assert run(*other) == run(*labels).mirror().reverse()


def test_where_the_papers_eighth_action_is_legal() -> None:
    for sign in (1, -1):
        assert run(f"R1(0,1,{sign})", "C(2,1,-1)", "C(2,4,-1)").crossings == 3
    after = run("R1(0,1,1)", "C(0,1,1)")
    with pytest.raises(RopeActionError, match="from the side of segment 2 that gives sign 1"):
        apply(after, parse_action("C(2,4,-1)"))
    assert refusal(after, parse_action("C(2,4,1)")) is None


def test_both_signs_across_a_bridge() -> None:
    """Both sides of the rope between two loops lie in the face of the ends."""
    state = run("R1(0,1,1)", "R1(2,1,1)")
    for over, under, sign in product((0, 4), (2,), (1, -1)):
        assert refusal(state, C(over, under, sign)) is None
        assert refusal(state, C(under, over, sign)) is None
    second = [
        action
        for state in states(2)
        for action in legal_actions(state)
        if isinstance(action, C) and action.sign > 0 and {action.over, action.under} != {0, 4}
        if refusal(state, C(action.over, action.under, -1)) is None
    ]
    assert len(second) == 64


@pytest.mark.parametrize(
    ("label", "message"),
    [
        ("R1(7,1,1)", "there is no segment 7, only 0 to 6"),
        ("R1(0,2,1)", "left is 2, not"),
        ("C(0,1,0)", "sign is 0, not"),
        ("C(6,6,1)", "segment 6 crosses itself by R1"),
        ("C(2,4,1)", r"neither segment 2 nor 4 is an end of the rope \(0 or 6\)"),
        ("C(0,5,1)", "the end segment 0 does not lie in a face beside segment 5"),
        ("R2(0,3,1,-1)", "over_first is -1, but segment 0 comes first"),
        ("R2(0,0,1,1,around)", "goes around an end of the rope, which rule 'paper' does not"),
        ("R2(1,2,1,1)", "the left of segment 1 and the right of segment 2 do not lie in one face"),
    ],
)
def test_illegal_actions_say_why(label: str, message: str) -> None:
    """On the overhand knot that goes under first, with positive crossings."""
    state = RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+")
    with pytest.raises(RopeActionError, match=message) as caught:
        apply(state, parse_action(label))
    assert label in str(caught.value)


def test_the_public_rule_needs_both_ends_in_one_face() -> None:
    inside = run("R1(0,1,1)", "C(0,1,1)")
    action = next(a for a in legal_actions(inside) if isinstance(a, R2))
    assert refusal(inside, action) is None
    with pytest.raises(RopeActionError, match="rule 'public' needs both ends of the rope in one"):
        apply(inside, action, "public")


def test_labels_are_read_as_written() -> None:
    for state in (*states(0), *states(1), *states(2)):
        for action in legal_actions(state, R2Rule.ANY):
            assert parse_action(str(action)) == action
    assert parse_action(" R2( 2,0, -1 )") == R2(2, 0, -1, -1)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("R3(0,1,1)", "is no action"),
        ("C(0,1", "is no action"),
        ("C(0,,1)", r"expected C\(over,under,sign\)"),
        ("R1(0,1)", r"expected R1\(idx,left,sign\)"),
        ("R1(0,1,1,around)", "expected R1"),
        ("R2(0,0,1)", "over_first is missing; it says which half of segment 0 is on top"),
        ("R2(0,0)", "expected R2"),
    ],
)
def test_labels_that_cannot_be_read(text: str, message: str) -> None:
    with pytest.raises(RopeActionError, match=message):
        parse_action(text)
