"""Grid diagrams from JSON and CSV files.

JSON: a matrix, a list of [column, row] marks, or an object with one of them under the key "matrix"
or "grid" (such as the output of `knotopt show --json`). CSV: a matrix, or lines `column,row` with
or without that header. A matrix has row N in its first line.
"""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import FileFormatError, GridError


def read_grid(path: Path | str) -> GridDiagram:
    """Grid diagram from a `.json` or `.csv` file.

    Raises
    ------
    FileFormatError
        The file cannot be read, or holds something else; the message names file and place.
    """
    path = Path(path)
    readers = {".json": _read_json, ".csv": _read_csv}
    if path.suffix.lower() not in readers:
        raise FileFormatError(f"{path}: expected a .json or .csv file")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise FileFormatError(f"cannot read {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is not UTF-8 text (byte {error.start})") from error
    try:
        return readers[path.suffix.lower()](text)
    except (GridError, FileFormatError) as error:
        raise FileFormatError(f"{path}: {error}") from error


def _read_json(text: str) -> GridDiagram:
    try:
        content: Any = json.loads(text)
    except json.JSONDecodeError as error:
        raise FileFormatError(f"line {error.lineno} is not JSON: {error.msg}") from error
    except (ValueError, RecursionError) as error:  # a number of 5,000 digits, lists 1,000 deep
        raise FileFormatError(f"not the JSON of a grid diagram: {error}") from error
    if isinstance(content, dict):
        keys = [key for key in ("grid", "matrix") if key in content]
        if len(keys) != 1:
            found = ", ".join(map(repr, content)) or "none"
            raise FileFormatError(f'expected either the key "grid" or "matrix", found {found}')
        content, kind = content[keys[0]], keys[0]
    else:
        kind = ""
    if not isinstance(content, list) or not all(isinstance(line, list) for line in content):
        raise FileFormatError(
            "expected a list of lists: the matrix, or marks [column, row]"
            + (f' (key "{kind}")' if kind else "")
        )
    return _from_lists(content, kind)


def _read_csv(text: str) -> GridDiagram:
    lines: list[list[int]] = []
    kind = ""
    try:
        rows = list(csv.reader(text.splitlines()))
    except csv.Error as error:
        raise FileFormatError(f"not the CSV of a grid diagram: {error}") from error
    for number, fields in enumerate(rows, 1):
        if not any(field.strip() for field in fields):
            continue
        if not lines and [field.strip().lower() for field in fields] == ["column", "row"]:
            kind = "grid"
            continue
        try:
            lines.append([int(field) for field in fields])
        except ValueError as error:
            line = ",".join(fields)
            raise FileFormatError(f"line {number} is {line!r}, expected integers") from error
    return _from_lists(lines, kind)


def _from_lists(lines: list[list[int]], kind: str) -> GridDiagram:
    # Without a key: two entries a line make marks, unless there are two lines (a 2 x 2 matrix).
    looks_like_marks = len(lines) != 2 and all(len(line) == 2 for line in lines)
    if kind == "grid" or (not kind and looks_like_marks):
        return GridDiagram.from_marks(lines)
    return GridDiagram.from_matrix(lines)
