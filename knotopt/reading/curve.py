"""Points of a curve in space: rows x, y, z as files of polymers, KnotPlot and motion capture have.

In lines, an index or an element's letters may stand before them; a header names x, y and z, in any
order and among other columns; no cell is empty, unless its column is; the XYZ files of chemistry
have their number and a remark in front. Each point is joined to the next. If the ends are about as
far apart as neighbours are, the curve is closed; else its ends are joined where they lie in one
face of what is seen.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import dropwhile
from typing import Any

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.planar.loosened import loosened
from knotopt.planar.views import CurveError, closed_view, open_view
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading
from knotopt.reading.source import REMARK

MOST_POINTS = 100_000  # about ten seconds
FARTHEST = 1e150  # of coordinates; their squares are still numbers
CLOSE = 1.5  # times the longest of the other steps: a last step that closes the curve

_SPLIT = re.compile(r"[\s,;|]+")
_CELLS = re.compile(r" *[\t,;|] *| +")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(nan|inf(inity)?)", re.IGNORECASE)
_UNIT = re.compile(r"[\[(].*[\])]")
_LETTERS = re.compile(r"[A-Za-z]{1,4}\d*")


def read(content: Content, asked: Asked) -> Reading | None:  # noqa: ARG001
    """The planar diagram of the curve through those points.

    Raises
    ------
    CurveError
        A row that is no point, a curve that meets itself or is more than one, or an open one whose
        ends cannot be joined.
    """
    rows = _rows_of_lists(content.value) or _rows(content.text)
    if rows is None:
        return None
    points, is_closed = _curve(rows)
    view = (closed_view if is_closed else open_view)(points)
    kind = "closed" if is_closed else "open"
    x, y, z = view.direction
    seen = "from above" if (x, y) == (0, 0) else f"from the direction ({x:g}, {y:g}, {z:g})"
    joined = "" if is_closed else ", ends joined in the face that has both"
    note = f"{kind} curve of {len(points)} points, seen {seen}{joined}"
    return Reading(loosened(view.diagram), (note,))


def _curve(rows: Sequence[tuple[int, Sequence[float]]]) -> tuple[FloatArray, bool]:
    """The points without those that repeat the one before, and whether they are closed."""
    if len(rows) > MOST_POINTS:
        raise CurveError(
            f"a curve of {len(rows)} points: at most {MOST_POINTS} are read; leave out some"
        )
    for number, row in rows:
        if not all(math.isfinite(value) for value in row):
            raise CurveError(f"line {number} has a coordinate that is no finite number")
        if max(map(abs, row)) > FARTHEST:
            raise CurveError(f"line {number} has a coordinate beyond {FARTHEST:g}")
    points = np.array([row for _, row in rows], dtype=np.float64)
    differs = np.append(True, (points[1:] != points[:-1]).any(axis=1))
    points = points[differs]
    repeats = len(points) > 1 and bool((points[0] == points[-1]).all())
    if repeats:
        points = points[:-1]
    if len(points) < 3:
        raise CurveError(f"a curve takes at least three different points, not {len(points)}")
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    last = np.linalg.norm(points[0] - points[-1])
    return points, repeats or bool(last <= CLOSE * steps.max())


Rows = list[tuple[int, list[float]]]
"""Number of a line, and the point in it."""


def _rows_of_lists(value: Any) -> Rows | None:
    """The points of a list of lists of three numbers; None if it is none."""
    if not isinstance(value, list) or len(value) < 3:
        return None
    if not all(isinstance(row, list) for row in value):
        return None
    if sum(len(row) == 3 for row in value) * 10 < 9 * len(value):
        return None
    if len(value) == 3 and all(entry in (-1, 0, 1) for row in value for entry in row):
        return None  # the matrix of a grid
    rows = []
    for number, row in enumerate(value, 1):
        if not all(isinstance(entry, int | float) and not isinstance(entry, bool) for entry in row):
            raise CurveError(f"point {number} is {row}, expected three numbers x, y, z")
        if len(row) != 3:
            raise CurveError(f"point {number} has {len(row)} coordinates, expected three")
        rows.append((number, [_float(entry) for entry in row]))
    return rows


def _float(entry: float | str) -> float:
    try:
        return float(entry)
    except OverflowError:
        return math.inf


def _rows(text: str) -> Rows | None:
    """The points in a text's lines; None if most of its lines hold no point."""
    lines = [
        (number, _words(line))
        for number, line in enumerate(text.splitlines(), 1)
        if not REMARK.match(line)
    ]
    lines = [*dropwhile(lambda line: not line[1], lines)]
    lines = _without_count(_of_obj(lines))
    blocks = _blocks(lines)
    lines = [line for block in blocks for line in block]
    if len(lines) < 4:
        return None
    columns: tuple[int, ...] | None = None
    header = [word.lower() for word in lines[0][1] if not _UNIT.fullmatch(word)]
    is_headed = not any(map(_NUMBER.fullmatch, header))
    if is_headed:
        columns = _named(header)
        lines = lines[1:]
        blocks[0] = blocks[0][1:]
    width = _usual([len(words) for _, words in lines])
    if columns is None:
        columns = _columns(lines, width)
        if columns is not None and is_headed:
            raise CurveError(
                f"the header is {' '.join(header)[:60]!r}, and a curve's names x, y and z once each"
            )
    elif len(header) == width - 1 and _is_counted([words[0] for _, words in lines]):
        columns = tuple(k + 1 for k in columns)  # nothing stands above an index
    elif len(header) != width:
        raise CurveError(f"the header names {len(header)} columns, the lines have {width}")
    if columns is None:
        return None
    _check_filled(text, [number for number, _ in lines])
    rows = []
    for number, words in lines:
        picked = [words[k] for k in columns] if len(words) == width > max(columns) else []
        if len(picked) != 3 or not all(map(_NUMBER.fullmatch, picked)):
            raise CurveError(f"line {number} is {' '.join(words)[:60]!r}, expected a point x, y, z")
        rows.append((number, [float(word) for word in picked]))
    if len([block for block in blocks if block]) > 1:
        raise CurveError(
            f"a blank line before line {blocks[1][0][0]} parts the points into "
            f"{len(blocks)} curves: a link, a knot is one"
        )
    return rows


Line = tuple[int, list[str]]


def _words(line: str) -> list[str]:
    """The cells of a line; between semicolons a comma is a decimal point."""
    if ";" in line:
        line = line.replace(",", ".")
    # An empty cell in front, as before an index, is no cell.
    return [word.strip("\"'") for word in _SPLIT.split(line.strip(" \t,;|")) if word]


def _check_filled(text: str, numbers: Sequence[int]) -> None:
    """Refuse lines with empty cells, unless the same cells are empty in every line.

    Raises
    ------
    CurveError
    """
    lines = text.splitlines()
    usual = None
    for number in numbers:
        cells = _CELLS.split(lines[number - 1].strip(" ").rstrip(" \t,;|"))
        empty = [k for k, cell in enumerate(cells) if not cell]
        usual = empty if usual is None else usual
        if empty != usual:
            raise CurveError(f"line {number} has other empty cells than line {numbers[0]}")


def _of_obj(lines: list[Line]) -> list[Line]:
    """The vertices of a Wavefront OBJ file, around its line; any other lines as they are."""
    vertices = [line for line in lines if line[1][:1] == ["v"]]
    around = next((words[1:] for _, words in lines if words[:1] == ["l"]), None)
    if not vertices or around is None:
        return lines
    if not all(word.isdecimal() and 0 < int(word[:18]) <= len(vertices) for word in around):
        raise CurveError("a line of the OBJ file names a vertex that it does not have")
    return [vertices[int(word) - 1] for word in around]


def _without_count(lines: list[Line]) -> list[Line]:
    """The lines without the number of points and the remark in front of a chemist's file."""
    if len(lines) > 3 and len(lines[0][1]) == 1 and lines[0][1][0].isdecimal():
        count = int(lines[0][1][0][:18])
        rest = [line for line in lines[2:] if line[1]]
        if count == len(rest):
            return rest
    return lines


def _blocks(lines: list[Line]) -> list[list[Line]]:
    """The lines between blank ones."""
    blocks: list[list[Line]] = [[]]
    for line in lines:
        if line[1]:
            blocks[-1].append(line)
        elif blocks[-1]:
            blocks.append([])
    return blocks if blocks[-1] or len(blocks) == 1 else blocks[:-1]


def _usual(widths: Sequence[int]) -> int:
    return max(set(widths), key=widths.count)


def _named(header: Sequence[str]) -> tuple[int, ...] | None:
    """Where a header has x, y and z, alone or within names that are otherwise alike: pos_x."""
    names = [re.sub(r"[^a-z]", "", re.sub(r"[\[(].*", "", word)) for word in header]
    for name in sorted(names, key=len):
        for at in re.finditer("x", name):
            axes = [f"{name[: at.start()]}{axis}{name[at.end() :]}" for axis in "xyz"]
            if all(names.count(axis) == 1 for axis in axes):
                return tuple(names.index(axis) for axis in axes)
    return None


def _columns(lines: Sequence[Line], width: int) -> tuple[int, ...] | None:
    """Which words of a line of that many are x, y, z; None if the lines are no points."""
    alike = [words for _, words in lines if len(words) == width]
    if width not in (3, 4) or 10 * len(alike) < 9 * len(lines):
        return None
    last = [words[-3:] for words in alike]
    numbers = sum(all(map(_NUMBER.fullmatch, words)) for words in last)
    if 10 * numbers < 9 * len(lines):
        return None
    if width == 4:
        firsts = [words[0] for words in alike]
        if not _is_counted(firsts) and not all(map(_LETTERS.fullmatch, firsts)):
            return None
    return tuple(range(width - 3, width))


def _is_counted(words: Sequence[str]) -> bool:
    """Whether they count the lines from 0 or 1."""
    return any(list(words) == [str(k + start) for k in range(len(words))] for start in (0, 1))
