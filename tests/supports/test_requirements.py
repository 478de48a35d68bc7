"""Requests that make no sense, or that no solver here can take: one clear sentence each."""

from __future__ import annotations

from typing import Any

import pytest

from formulations.solution import Limits
from knotopt.cable.cable import Cable
from knotopt.diagram.families import torus_knot
from knotopt.errors import KnotoptError, MissingExtraError, RequirementError, SolverError
from knotopt.supports.minimal import all_minimal, minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"openness": 0}, r"must lie in \(0, 1\]"),
        ({"openness": 1.01}, r"must lie in \(0, 1\]"),
        ({"openness": -0.5}, r"must lie in \(0, 1\]"),
        ({"openness": float("nan")}, "is a number, not nan"),
        ({"openness": 0.12345}, "in thousandths"),
        ({"openness": "half"}, "is a number, not 'half'"),
        ({"formulation": "springs"}, "no formulation is named 'springs'"),
        ({"threading": "never"}, "no threading mode is named 'never'"),
        ({"separation": 0}, "the separation must be a positive number"),
        ({"payload": -1}, "the longest span must be a positive number"),
        ({"reach": float("inf")}, "the reach must be a positive number"),
        ({"forced": (3,), "forbidden": (3,)}, "p3 is both forced and forbidden"),
        ({"max_robots": 1}, "two robots hold the cable's ends"),
        ({"max_robots": 5, "openness": 0.5}, "exclude each other"),
        ({"max_robots": 5.5}, "are counted, not 5.5"),
        ({"forced": (2.5,)}, "are counted, not 2.5"),
    ],
)
def test_bad_requirements(options: dict[str, Any], message: str) -> None:
    with pytest.raises(RequirementError, match=message):
        Requirements(**options)


def test_bad_requests(monkeypatch: pytest.MonkeyPatch) -> None:
    cable = Cable(torus_knot(2, 3), "L+")
    with pytest.raises(RequirementError, match="p11: the cable's turning points are p1 to p10"):
        minimal_supports(cable, Requirements(forced=(11,)))
    with pytest.raises(RequirementError, match="no cut is given"):
        best_supports(cable.diagram, cuts=())
    with pytest.raises(RequirementError, match="p10 is an end of the cable"):
        minimal_supports(cable, Requirements(forbidden=(10,)))
    with pytest.raises(SolverError, match="no solver is named 'gurobi'"):
        minimal_supports(cable, solver="gurobi")
    with pytest.raises(SolverError, match="exhaustive search goes through"):
        minimal_supports(Cable(torus_knot(2, 11), "L+"), solver="exhaustive")
    for limits, message in (
        (Limits(gap=0.1), "a gap"),
        (Limits(threads=2), "more than one thread"),
    ):
        with pytest.raises(SolverError, match=f"solver maxsat cannot be given {message}"):
            minimal_supports(cable, solver="maxsat", limits=limits)
    result = minimal_supports(cable)
    with pytest.raises(SolverError, match="cannot list all sets; cp-sat and exhaustive can"):
        all_minimal(result, solver="highs")
    with pytest.raises(RequirementError, match="only once the smallest is proven"):
        all_minimal(minimal_supports(cable, Requirements(max_robots=6)))
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    with pytest.raises(MissingExtraError, match=r"solver maxsat needs python-sat.*\[sat\]"):
        minimal_supports(cable, solver="maxsat")
    assert issubclass(MissingExtraError, KnotoptError)
