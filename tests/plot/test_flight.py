"""What the pictures of flights show, read off the artists they are drawn with."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex

from knotopt.plot.figures import save_figure
from knotopt.plot.flight import flight_figure, strip_figure
from knotopt.viewer.colours import ramp
from tests.helpers.small_flight import crossed, small_plan, small_record

PLAN = small_plan()
RECORD = small_record(PLAN)


def test_route_heights_and_speeds() -> None:
    route, heights, speeds = flight_figure(PLAN).axes
    drawn = {line.get_label(): line.get_xydata() for line in route.lines}
    assert drawn["laid cable"] == pytest.approx(PLAN.anchors[:, :2])
    assert drawn["leader's route"] == pytest.approx(PLAN.route[:, :2])
    assert drawn["leader"] == pytest.approx(PLAN.anchors[-1:, :2])
    assert drawn["passes over, and which span"].tolist() == [[0.8, 1.6]]
    assert drawn["passes under, and which span"].tolist() == [[0.8, 1.6]]
    assert [text.get_text() for text in route.texts] == ["1", "2", "1", "2", "3", "4", "5"]
    marks = {
        (line.get_marker(), *line.get_ydata())
        for line in heights.lines
        if len(line.get_xdata()) == 1
    }
    assert marks == {("^", 2.3), ("_", 1.9), ("v", 1.4)}
    fastest = np.linalg.norm(np.diff(PLAN.positions, axis=0), axis=2).max() / PLAN.interval
    *robots, limit = speeds.lines
    assert len(robots) == PLAN.robots
    assert max(line.get_ydata().max() for line in robots) == pytest.approx(fastest)
    assert set(limit.get_ydata()) == {PLAN.limits.speed}


def test_the_strip_ends_with_the_flight() -> None:
    figure = strip_figure(RECORD, PLAN, count=5)
    shown = [axes for axes in figure.axes if axes.collections]
    assert len(shown) == 5
    assert shown[0].get_title() == "2.2 s"
    assert shown[-1].get_title() == "12.1 s, span 4 under span 2"
    edges = RECORD.cable.shape[1] - 1
    for axes in shown:
        (cable,) = [a for a in axes.collections if isinstance(a, LineCollection)]
        strokes = [to_hex(colour) for colour in cable.get_colors()]
        assert strokes[::2] == ["#ffffff"] * edges
        assert sorted(strokes[1::2]) == sorted(np.repeat(ramp(PLAN.robots)[:-1], 12).tolist())


def test_the_strip_says_what_is_pulled_tight_and_nothing_else() -> None:
    late = replace(RECORD, clock=RECORD.clock * (1 + 1e-12))  # sums of times round either way
    titles = [axes.get_title() for axes in strip_figure(late, PLAN, count=3).axes]
    assert titles[-1] == "12.1 s, span 4 under span 2"
    tight = replace(PLAN, tightening=2.0)  # from 9 s on
    titles = [axes.get_title() for axes in strip_figure(RECORD, tight, count=3).axes]
    assert "pulled tight" not in "".join(titles[:-1]) and titles[-1] == "12.1 s, pulled tight"


@pytest.mark.parametrize("lift", [5.0, -5.0])
def test_what_is_higher_is_drawn_later(lift: float) -> None:
    record = crossed(RECORD, lift)
    drawn = strip_figure(record, PLAN, count=1).axes[0].collections[0].get_colors()[1::2]
    first, last = (0, 2) if lift > 0 else (2, 0)
    order = [ramp(4).index(to_hex(colour)) for colour in drawn]
    assert [span for span in order if span != 1] == [first] * 10 + [last] * 10


def test_odd_names_and_counts(tmp_path: Path) -> None:
    plan = replace(PLAN, name="$\\odd_{name", crossings=())
    save_figure(flight_figure(plan), tmp_path / "flight.png")
    save_figure(strip_figure(RECORD, plan, count=1), tmp_path / "strip.svg")
    assert (tmp_path / "flight.png").stat().st_size > 10_000
    still = replace(PLAN, positions=np.repeat(PLAN.positions[-1:], len(PLAN.times), axis=0))
    assert len(strip_figure(RECORD, still, count=2).axes) == 2
