"""How results show themselves: a short line, a picture, text where there is no matplotlib."""

from __future__ import annotations

import base64
import re
import sys
from collections.abc import Callable

import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

import knotopt
from knotopt.errors import MissingExtraError
from knotopt.showing import Shown


def trefoil() -> knotopt.GridDiagram:
    return knotopt.read("3").diagram


def cable() -> knotopt.Cable:
    return knotopt.Cable(trefoil(), "L+")


RESULTS: dict[str, tuple[Callable[[], Shown], str]] = {
    "grid": (trefoil, r"GridDiagram\(minus="),
    "knot": (lambda: knotopt.read("8_19"), r"<NamedDiagram: 8_19 \(KnotInfo\), grid of size 7>"),
    "cable": (cable, r"<Cable: grid of size 5, cut L\+, 3 crossings>"),
    "lcf": (lambda: knotopt.lcf(cable()), r"<LcfResult: cut L\+, 5 robots instead of 10>"),
    "smallest": (
        lambda: knotopt.minimal_supports(cable()),
        r"<MinimalSupports: opening, cut L\+, 5 robots instead of 10, optimal>",
    ),
    "none": (
        lambda: knotopt.minimal_supports(cable(), knotopt.Requirements(payload=0.1)),
        r"<MinimalSupports: opening, cut L\+, no set found: infeasible>",
    ),
    "search": (lambda: knotopt.best_supports(trefoil()), r"<CutSearch: best of 8 cuts: opening"),
    "path": (
        lambda: knotopt.optimise_path(cable(), (3, 4, 5)),
        r"<PathResult: nlp solved, cut L\+, \d+\.\d\d grid steps, 5 robots>",
    ),
    "flight": (
        lambda: knotopt.plan("3", "lcf", schedule="fixed"),
        r"<FlightPlan: 3_1, cut L\+, 5 robots, fixed schedule, \d+\.\d s>",
    ),
    "plans": (
        lambda: knotopt.plan_graph(knotopt.cable_state(cable())),
        r"<PlanGraph: 4 plans, 6 states>",
    ),
}


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_has_a_line_and_a_picture(name: str) -> None:
    make, line = RESULTS[name]
    result = make()
    assert re.match(line, repr(result)) and "\n" not in repr(result)
    figure = result.plot("a title of one's own")
    assert isinstance(figure, Figure) and figure.axes
    assert "a title of one's own" in [text.get_text() for text in figure.findobj(Text)]
    shown = result._repr_html_()
    (code,) = re.findall(r'src="data:image/svg\+xml;base64,([^"]+)"', shown)
    assert base64.b64decode(code).startswith(b"<?xml")
    assert "&lt;" in shown or name == "grid"


def test_without_matplotlib_there_is_text(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in [each for each in sys.modules if each.startswith("knotopt.plot")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    assert trefoil()._repr_html_() == f"<pre>{trefoil()}</pre>"
    assert cable()._repr_html_() == "<pre>&lt;Cable: grid of size 5, cut L+, 3 crossings&gt;</pre>"
    with pytest.raises(MissingExtraError, match=r"pip install '\.\[viz\]'"):
        trefoil().plot()


def test_what_has_no_picture() -> None:
    from knotopt.plot.pictures import picture

    with pytest.raises(TypeError, match="no picture of a int"):
        picture(1)
