"""The formulations that a set of supports can be asked to meet, by name."""

from __future__ import annotations

from typing import Any

from knotopt.errors import RequirementError
from knotopt.supports.formulation import Formulation
from knotopt.supports.loops import LOOPS
from knotopt.supports.opening import OPENING
from knotopt.supports.span import SPAN

FORMULATIONS: dict[str, Formulation[Any]] = {
    each.name: each
    for each in (
        OPENING,
        SPAN,
        LOOPS,
    )
}


def find_formulation(name: str) -> Formulation[Any]:
    """The formulation of that name.

    Raises
    ------
    RequirementError
        There is none; the message lists those there are.

    Examples
    --------
    >>> find_formulation("span").words
    'the taut cable itself'
    """
    if name not in FORMULATIONS:
        known = ", ".join(f"{each.name} ({each.words})" for each in FORMULATIONS.values())
        raise RequirementError(f"no formulation is named {name!r}: expected one of {known}")
    return FORMULATIONS[name]
