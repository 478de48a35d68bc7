"""What GOAL means on the command line: a knot, the matrix of a state, or a Gauss code."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from knotopt.cable.cable import Cable
from knotopt.catalogue.lookup import find_knot
from knotopt.errors import CutError, FileFormatError
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
        The cable that the first state is of, if a knot or a grid was named.
    """

    states: tuple[RopeState, ...]
    name: str
    source: str
    cable: Cable | None = None


def read_goal(text: str, cut: str | None = None, which: GoalSet | str = GoalSet.ONE) -> Goal:
    """The goal that a GOAL argument stands for.

    Parameters
    ----------
    text : str
        A knot or a file with a grid, as in `knotopt.catalogue.lookup.find_knot`; a `.json`, `.csv`
        or `.txt` file with the four rows of a state's matrix (in JSON also under the key "matrix");
        a Gauss code such as "O1+ U2+ O3+ U1+ O2+ U3+"; or a `.txt` file with one.
    cut : str, optional
        Where a knot's or grid's closed diagram is opened: a cut's name, by default L+.
    which : GoalSet or str
        Whether mirror images and reverses are goals too.

    Raises
    ------
    FileFormatError
        A file that cannot be read or holds no goal: the message names the file and the place.
    RopeStateError
        A Gauss code that is not that of a rope in the plane: the message names the visit.
    CutError
        A cut that does not exist, carries crossings, or is asked for where there is no grid.
    UnknownKnotError
        No knot has that name.

    Examples
    --------
    >>> goal = read_goal("3_1", which="mirror")
    >>> print(goal.name, *goal.states, sep=" | ")
    3_1 | O1+ U2+ O3+ U1+ O2+ U3+ | O1- U2- O3- U1- O2- U3-
    >>> read_goal("O1+ U2+ O3+ U1+ O2+ U3+").states == read_goal("3_1").states
    True
    """
    which = GoalSet(which)
    path = Path(text)
    suffix = path.suffix.lower()
    state = None
    if suffix in {".json", ".csv", ".txt"}:
        try:
            state = _read_text(path) if suffix == ".txt" else _matrix_in(path)
        except (RopeStateError, FileFormatError) as error:
            raise FileFormatError(f"{path}: {error}") from error
        name, source = path.name, f"file {text}"
    elif _GAUSS.match(text):
        state = RopeState.from_gauss(text)
        name, source = "Gauss code", "as given"
    if state is not None:
        if cut is not None:
            raise CutError(f"{name} is the state of a rope, which has no grid to cut at {cut}")
        return Goal(_with(state, which), name, source)
    named = find_knot(text)
    cable = Cable(named.diagram, cut or "L+")
    return Goal(_with(cable_state(cable), which), named.name, named.source, cable)


_GAUSS = re.compile(r"\s*([OU]\d|[+-]?\d+[\s,]+[+-]?\d|trivial\s*$)", re.IGNORECASE)


def _with(state: RopeState, which: GoalSet) -> tuple[RopeState, ...]:
    """The state and its images, each once."""
    images = [state]
    if which is not GoalSet.ONE:
        images.append(state.mirror())
    if which is GoalSet.ORBIT:
        images += [image.reverse() for image in images]
    return tuple(dict.fromkeys(images))


def _read_text(path: Path) -> RopeState:
    """The state in a file of four rows of numbers, or of a Gauss code."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise FileFormatError(f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"not UTF-8 text (byte {error.start})") from error
    if re.search("[OUou]|trivial", text):
        return RopeState.from_gauss(text)
    rows = []
    for number, line in enumerate(text.splitlines(), 1):
        words = re.findall(r"[^\s,;\[\]]+", line)
        try:
            row = [int(word) for word in words]
        except ValueError as error:
            raise FileFormatError(
                f"line {number} is {line!r}: expected a row of whole numbers, or a Gauss code such "
                f"as O1+ U1+"
            ) from error
        if row:
            rows.append(row)
    if not rows:
        raise FileFormatError("holds neither a state's matrix nor a Gauss code")
    return RopeState.from_matrix(rows)


def _matrix_in(path: Path) -> RopeState | None:
    """The state whose matrix a JSON or CSV file holds; None if it holds anything else."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        if path.suffix.lower() == ".csv":
            lines = csv.reader(text.splitlines())
            rows: Any = [[int(field) for field in line] for line in lines if any(line)]
        else:
            rows = json.loads(text)
    except (OSError, ValueError, RecursionError, csv.Error):
        return None  # what is wrong with it is found again where it is read as a grid
    if has_key := isinstance(rows, dict):
        rows = rows.get("matrix")
    return RopeState.from_matrix(rows) if _looks_like_state(rows, has_key) else None


def _looks_like_state(rows: Any, is_matrix: bool) -> bool:
    """Whether rows are meant as a state's matrix, not as a grid's or, without that word, marks."""
    if not isinstance(rows, list) or not all(isinstance(row, list) for row in rows):
        return False
    if rows and rows[0][:3] == [1, 2, 3]:
        return True
    return len(rows) == 4 and not (_is_grid(rows) or (not is_matrix and _are_marks(rows)))


def _is_grid(rows: Sequence[Sequence[Any]]) -> bool:
    return len(rows[0]) == len(rows) and all(entry in (-1, 0, 1) for entry in rows[0])


def _are_marks(rows: Sequence[Sequence[Any]]) -> bool:
    return all(
        len(row) == 2 and all(isinstance(entry, int) and entry > 0 for entry in row) for row in rows
    )
