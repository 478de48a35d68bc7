"""What plans may end in: any knot, the matrix of a rope's state, or a rope's signed Gauss code."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from knotopt.cable.cable import Cable
from knotopt.errors import CutError, FileFormatError
from knotopt.reading.content import Content
from knotopt.reading.knot import check_no_over, read_knot
from knotopt.reading.source import read_source
from knotopt.topology.cable_state import cable_state
from knotopt.topology.state import RopeState, RopeStateError


class GoalSet(StrEnum):
    """Which states are goals beside the one that is named."""

    ONE = "one"
    """None."""
    MIRROR = "mirror"
    """Its mirror image."""
    ORBIT = "orbit"
    """Its mirror image, and the reverses of both."""


@dataclass(frozen=True)
class Goal:
    """States that a plan may end in.

    Attributes
    ----------
    states : tuple of RopeState
        Without repetition; the one that was named is first.
    name : str
        The knot's or file's name, or "Gauss code".
    source : str
        Where the state comes from, in words.
    cable : Cable or None
        The cable that the first state is of, if a knot was named.
    form : str
        What was understood.
    notes : tuple of str
        Readings chosen, as of `NamedDiagram`.
    ambiguous : bool
        As of `NamedDiagram`.
    """

    states: tuple[RopeState, ...]
    name: str
    source: str
    cable: Cable | None = None
    form: str = "rope's state"
    notes: tuple[str, ...] = ()
    ambiguous: bool = False


def read_goal(
    text: str,
    cut: str | None = None,
    which: GoalSet | str = GoalSet.ONE,
    *,
    over: str | None = None,
    mirror: bool = False,
    form: str | None = None,
) -> Goal:
    """The goal that a KNOT argument of `knotopt topology` stands for.

    Parameters
    ----------
    text : str
        Any knot, as `read_knot` reads it. Unless a form is asked for, also the four rows of a
        state's matrix (in JSON also under the key "matrix") and the signed Gauss code of a rope,
        "O1+ U2+ O3+ U1+ O2+ U3+" or "trivial", as argument, in a file or from standard input.
    cut : str, optional
        Where a closed diagram is opened: a cut's name, by default L+.
    which : GoalSet or str
        Whether mirror images and reverses are goals too.
    over, mirror, form
        As for `read_knot`.

    Raises
    ------
    FileFormatError
        A file that cannot be read or holds no goal: the message names the file and the place.
    RopeStateError
        A Gauss code that is not that of a rope in the plane: the message names the visit.
    CutError
        A cut that does not exist, carries crossings, or is asked for where there is no grid.
    KnotoptError
        As of `read_knot`.

    Examples
    --------
    >>> goal = read_goal("3_1", which="mirror")
    >>> print(goal.name, *goal.states, sep=" | ")
    3_1 | O1+ U2+ O3+ U1+ O2+ U3+ | O1- U2- O3- U1- O2- U3-
    >>> read_goal("O1+ U2+ O3+ U1+ O2+ U3+").states == read_goal("3_1").states
    True
    """
    which = GoalSet(which)
    source = read_source(text)
    try:
        state = _state(Content(source.text)) if form is None else None
    except RopeStateError as error:
        if not source.name:
            raise
        raise FileFormatError(f"{source.where}: {error}") from error
    if state is not None:
        name = source.name or "Gauss code"
        check_no_over(over, "rope's state")
        if cut is not None:
            raise CutError(f"{name} is the state of a rope, which has no grid to cut at {cut}")
        return Goal(_with(state.mirror() if mirror else state, which), name, source.words)
    named = read_knot(source, over=over, mirror=mirror, form=form)
    cable = Cable(named.diagram, cut or "L+")
    states = _with(cable_state(cable), which)
    return Goal(states, named.name, named.source, cable, named.form, named.notes, named.ambiguous)


_GAUSS = re.compile(r"\s*([OU]\d|trivial\s*$)", re.IGNORECASE)


def _state(content: Content) -> RopeState | None:
    """The rope's state that is given as such; None for knots."""
    if _GAUSS.match(content.text):
        return RopeState.from_gauss(content.text)
    value = content.value
    has_key = isinstance(value, dict) and "matrix" in value
    rows = content.inside("matrix", value["matrix"]).rows if has_key else content.rows
    return RopeState.from_matrix(rows) if rows and _is_state(rows, has_key) else None


def _with(state: RopeState, which: GoalSet) -> tuple[RopeState, ...]:
    """The state and its images, each once."""
    images = [state]
    if which is not GoalSet.ONE:
        images.append(state.mirror())
    if which is GoalSet.ORBIT:
        images += [image.reverse() for image in images]
    return tuple(dict.fromkeys(images))


def _is_state(rows: Sequence[Sequence[Any]], is_matrix: bool) -> bool:
    """Whether rows are a state's matrix, not a grid's or, without that word, marks or a code."""
    if rows[0][:3] == [1, 2, 3]:
        return True
    if len(rows) != 4 or _is_grid(rows):
        return False
    signs = [entry for row in rows[2:] for entry in row]
    return is_matrix or (len(rows[0]) <= 2 and all(entry in (-1, 1) for entry in signs))


def _is_grid(rows: Sequence[Sequence[Any]]) -> bool:
    return len(rows[0]) == len(rows) and all(entry in (-1, 0, 1) for entry in rows[0])
