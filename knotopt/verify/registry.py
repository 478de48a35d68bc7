"""The formulations that the checkers know, by name."""

from __future__ import annotations

from knotopt.verify.definition import Definition
from knotopt.verify.loops import LOOPS
from knotopt.verify.opening import OPENING
from knotopt.verify.span import SPAN

DEFINITIONS: dict[str, Definition] = {
    each.name: each
    for each in (
        OPENING,
        SPAN,
        LOOPS,
    )
}
