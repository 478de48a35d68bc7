"""The smallest set over diagrams: the same knot, the same every time, never worse."""

from __future__ import annotations

import json

import pytest

from knotopt.cable.alexander import alexander_polynomial
from knotopt.cable.cable import Cable
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.reading.knot import read_knot
from knotopt.search import run as single
from knotopt.search.budget import Budget
from knotopt.search.search import GridSearch
from knotopt.supports import diagram_search
from knotopt.supports.diagram_search import LOOKED_PER_SOLVED, DiagramSearch, Walk, find_diagram
from knotopt.supports.diagram_search_file import from_json, to_json
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from tests.helpers.snappy_invariants import invariants


@pytest.fixture(autouse=True)
def short_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(single, "STEPS", 500)
    monkeypatch.setattr(single, "can_compile", lambda: False)
    monkeypatch.setattr(diagram_search, "STARTS", 4)


def solved(count: int) -> Budget:
    """A budget in which so many grids are solved."""
    return Budget(grids=count * LOOKED_PER_SOLVED)


@pytest.fixture(scope="module")
def five_two() -> GridDiagram:
    return shipped_knots()["5_2"].diagram


def search(diagram: GridDiagram, count: int, **options: object) -> DiagramSearch:
    """A walk of so many grids from few that were looked at."""
    grids = GridSearch(diagram, 2, tuple(single.run(diagram, number, 2) for number in range(3)))
    many = GridSearch(diagram, 2, (*grids.runs, single.Run(3, 10**9, ())))  # enough looked at
    known = (many, options.pop("walk", None))
    return find_diagram(diagram, budget=solved(count), known=known, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "asked",
    [
        Requirements(),
        Requirements("span", 0.5),
        Requirements("loops", separation=1.5),
        Requirements("opening", max_robots=6),
    ],
    ids=str,
)
def test_never_worse_than_the_given_grid(five_two: GridDiagram, asked: Requirements) -> None:
    told: list[Walk] = []
    found = search(five_two, 7, requirements=asked, progress=told.append)
    best, given = found.best.best, best_supports(five_two, asked).best
    assert found.best.is_proven and best.report.is_open
    if asked.max_robots is None:
        assert best.robots <= given.robots
    else:
        assert (best.smallest_opening or 0) >= (given.smallest_opening or 0)
    assert [walk.solved for walk in told] == list(range(2, 8)) and told[-1] == found.walk
    assert invariants(best.cable.diagram) == invariants(five_two)


def test_the_same_every_time_and_in_parts(five_two: GridDiagram) -> None:
    asked = Requirements("span", 0.5)
    whole = search(five_two, 9, requirements=asked)
    assert search(five_two, 9, requirements=asked).walk == whole.walk
    part = search(five_two, 4, requirements=asked)
    grids, walk = from_json(json.loads(json.dumps(to_json(part.grids, part.walk))))
    assert (grids, walk) == (part.grids, part.walk) and part.walk.solved == 4
    again = search(five_two, 9, requirements=asked, walk=walk)
    assert again.walk == whole.walk
    assert again.best.best.supports == whole.best.best.supports


def test_loops_are_what_grids_are_searched_for() -> None:
    found = find_diagram(torus_knot(3, 4), Requirements("loops"), Budget(grids=20_000))
    assert found.walk.solved == 1 and found.best.is_proven
    assert found.best.best.robots == found.grids.front[0].robots == 3


def test_a_better_grid_at_hand_is_solved_first() -> None:
    """Table I's grid of 7_2 needs 12 robots, another one (up to mirror image) 5."""
    other = GridDiagram((1, 5, 4, 7, 6, 9, 8, 3, 2), (4, 3, 6, 5, 8, 7, 2, 1, 9))
    asked = Requirements("span", 0.5)
    found = search(read_knot("7 Var1").diagram, 1, requirements=asked, starts=[other])
    assert found.walk.best == other and found.best.best.robots == found.walk.best_cost == 5


def test_ctrl_c_keeps_the_best(five_two: GridDiagram) -> None:
    def stop(walk: Walk) -> None:
        if walk.solved == 5:
            raise KeyboardInterrupt

    found = search(five_two, 100, requirements=Requirements("span"), progress=stop)
    assert found.best.is_proven and found.walk.solved == 5


def test_a_knot_that_cannot_be_met_by_any_grid() -> None:
    asked = Requirements("loops", payload=0.5)
    found = search(torus_knot(2, 3), 5, requirements=asked)
    assert not found.best.best.found and found.walk.cost is None and found.walk.solved == 5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("row", "most"), [("3", 6), ("4", 5), ("5", 6), ("7 Var1", 6), ("7 Var2", 6), ("9", 5)]
)
def test_safe_sets_of_table_1(row: str, most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """A few dozen grids solved give what is stored for the knot, or nearly."""
    monkeypatch.undo()
    diagram = read_knot(row).diagram
    found = find_diagram(diagram, Requirements("span", 0.5), solved(40))
    best = found.best.best
    assert best.is_proven and best.robots <= most
    polynomials = {alexander_polynomial(Cable(d, "L+")) for d in (diagram, best.cable.diagram)}
    assert len(polynomials) == 1


@pytest.mark.parametrize(
    ("minus", "plus", "cut", "supports", "openness", "knot"),
    [
        ((1, 5, 4, 7, 6, 9, 8, 3, 2), (4, 3, 6, 5, 8, 7, 2, 1, 9), "L+", (8, 10, 15), 0.5, "7_2"),
        ((1, 5, 6, 2, 4, 3, 8, 7, 9), (8, 9, 4, 5, 7, 1, 6, 2, 3), "T-", (4, 5, 6, 9), 0.25, "7_6"),
    ],
)
def test_two_grids_with_small_safe_sets(
    minus: tuple[int, ...],
    plus: tuple[int, ...],
    cut: str,
    supports: tuple[int, ...],
    openness: float,
    knot: str,
) -> None:
    """Known from another search; the knots are as named up to mirror image."""
    from knotopt.cable.cut import Cut
    from knotopt.verify.span import check_span

    diagram = GridDiagram(minus, plus)
    cable = Cable(diagram, cut)
    assert alexander_polynomial(cable) == shipped_knots()[knot].alexander
    report = check_span(cable.path, diagram.size, supports, openness, "over-under")
    assert report.is_open
    best = best_supports(diagram, Requirements("span", openness), cuts=[Cut.parse(cut, 9)]).best
    assert best.is_proven and best.robots <= len(supports) + 2
