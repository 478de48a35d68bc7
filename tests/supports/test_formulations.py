"""What the package and the checkers each know of the formulations."""

from __future__ import annotations

import pickle

import pytest

from knotopt.errors import RequirementError
from knotopt.supports.registry import FORMULATIONS, find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.verify.registry import DEFINITIONS


def test_both_lists_have_the_same() -> None:
    assert list(FORMULATIONS) == list(DEFINITIONS)
    for name, formulation in FORMULATIONS.items():
        definition = DEFINITIONS[name]
        assert formulation.name == definition.name == name
        assert sorted(formulation.threading) == sorted(definition.modes)
        assert list(formulation.proofs) == list(definition.proofs)
        assert formulation.checker(with_loops=False) is definition.check


def test_defaults_of_the_class_are_those_of_a_value() -> None:
    """The command line shows the former."""
    asked = Requirements()
    for name in ("formulation", "openness", "threading"):
        assert getattr(asked, name) == getattr(Requirements, name)


@pytest.mark.parametrize("name", list(FORMULATIONS))
def test_defaults_are_the_formulations(name: str) -> None:
    asked, formulation = Requirements(name), FORMULATIONS[name]
    assert (asked.formulation, asked.openness) == (name, formulation.openness)
    assert asked.threading == formulation.threading[0]
    assert pickle.loads(pickle.dumps(formulation)) == formulation  # as workers are sent it


def test_an_unknown_name_gets_no_other_formulations_rules() -> None:
    with pytest.raises(RequirementError, match=r"no formulation is named 'Span'.*span \(the taut"):
        find_formulation("Span")
    with pytest.raises(RequirementError, match="no formulation is named ''"):
        Requirements("")
