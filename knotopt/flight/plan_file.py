"""Flight plans as JSON files: written, read, and refused where they make no sense."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import FileFormatError, KnotoptError, RequirementError
from knotopt.flight.limits import FlightLimits
from knotopt.flight.plan import FlightPlan, PlannedCrossing
from knotopt.path.world import World

FORMAT = "knotopt flight plan"
VERSION = 2
DIGITS = 5  # of positions, after the point [m]
UNEVEN = 1e-6  # by which two intervals between samples may differ [s]

Numbers = TypeVar("Numbers", World, FlightLimits)


def plan_to_json(plan: FlightPlan) -> str:
    """A flight plan as JSON, one key a line.

    Positions and the route are rounded to 1e-5 m; everything else is kept to the last digit.

    Raises
    ------
    RequirementError
        Such as `check_plan` raises.
    """
    check_plan(plan)
    content = {
        "format": FORMAT,
        "version": VERSION,
        "name": plan.name,
        "grid": [list(mark) for mark in plan.cable.diagram.marks],
        "cut": str(plan.cable.cut),
        "supports": list(plan.supports),
        "chosen_by": plan.chosen_by,
        "schedule": plan.schedule,
        "notes": list(plan.notes),
        "world": asdict(plan.world),
        "limits": asdict(plan.limits),
        "lengths": plan.lengths.tolist(),
        "passes": plan.passes.tolist(),
        "tightening": plan.tightening,
        "crossings": [asdict(crossing) for crossing in plan.crossings],
        "route": plan.route.round(DIGITS).tolist(),
        "times": plan.times.tolist(),
        "positions": plan.positions.round(DIGITS).tolist(),
    }
    lines = [
        f"{json.dumps(key)}: {json.dumps(value, allow_nan=False)}" for key, value in content.items()
    ]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def read_plan(path: Path | str) -> FlightPlan:
    """A flight plan from a file that `plan_to_json` wrote.

    Raises
    ------
    FileFormatError
        The file cannot be read, is of another version, lacks a key, or holds what makes no sense;
        the message names file, key, robot and time.
    """
    path = Path(path)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FileFormatError(f"cannot read {path}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} is not JSON: {error}") from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise FileFormatError(f'{path} is no flight plan: its "format" is not "{FORMAT}"')
    if content.get("version") != VERSION:
        raise FileFormatError(
            f"{path} is a flight plan of version {content.get('version')!r}; "
            f"this program reads version {VERSION}"
        )
    try:
        plan = _plan(content)
        check_plan(plan)
    except KnotoptError as error:
        raise FileFormatError(f"{path}: {error}") from error
    return plan


def check_plan(plan: FlightPlan) -> None:
    """Refuse a plan that no robots could fly.

    Raises
    ------
    RequirementError
        Arrays whose shapes do not fit, numbers that are none, uneven times, or robots that start
        within each other's ellipsoid (see `FlightLimits`).
    """
    samples, robots = len(plan.times), len(plan.supports) + 2
    shapes = {
        "times": (plan.times, (samples,)),
        "positions": (plan.positions, (samples, robots, 3)),
        "lengths": (plan.lengths, (robots - 1,)),
        "passes": (plan.passes, (robots - 1,)),
        "route": (plan.route, (len(plan.route), 3)),
    }
    for name, (array, shape) in shapes.items():
        if array.shape != shape:
            raise RequirementError(f"{name} has the shape {array.shape}, expected {shape}")
    if samples < 2:
        raise RequirementError(f"times has {samples} samples; a flight has at least 2")
    for name in ("times", "lengths", "passes", "route"):
        for index in np.argwhere(~np.isfinite(shapes[name][0]))[:1]:
            raise RequirementError(f"{name}: entry {int(index[0]) + 1} is not a finite number")
    steps = np.diff(plan.times)
    if plan.times[0] != 0 or steps.min() <= 0 or np.ptp(steps) > UNEVEN:
        raise RequirementError("times are not evenly spaced from 0")
    for sample, robot, axis in np.argwhere(~np.isfinite(plan.positions))[:1].tolist():
        raise RequirementError(
            f"positions: {'xyz'[axis]} of robot {robot + 1} at {plan.times[sample]:.3f} s "
            "is not a finite number"
        )
    if not 0 <= plan.tightening < plan.duration:
        raise RequirementError(
            f"tightening: {plan.tightening!r} s are no part of a flight of {plan.duration:g} s"
        )
    if not (plan.lengths > 0).all():
        raise RequirementError(f"lengths: {plan.lengths.min():g} m is no length of cable")
    _check_start(plan.positions[0], plan.limits)


def _check_start(start: FloatArray, limits: FlightLimits) -> None:
    semi_axes = np.array([limits.separation, limits.separation, limits.downwash])
    for i, j in zip(*np.triu_indices(len(start), 1), strict=True):
        apart = start[j] - start[i]
        if np.linalg.norm(apart / semi_axes) < 1 - 10**-DIGITS / limits.separation:
            raise RequirementError(
                f"positions: robots {i + 1} and {j + 1} start too close, "
                f"{math.hypot(*apart[:2]):.3f} m apart in plan, {abs(apart[2]):.3f} m in height; "
                f"the separation is {limits.separation:g} m beside and {limits.downwash:g} m below"
            )


def _plan(content: dict[str, Any]) -> FlightPlan:
    diagram = GridDiagram.from_marks(_list(content, "grid"))
    cable = Cable(diagram, Cut.parse(_text(content, "cut"), diagram.size))
    return FlightPlan(
        name=_text(content, "name"),
        cable=cable,
        supports=_supports(_list(content, "supports"), cable),
        chosen_by=_text(content, "chosen_by"),
        schedule=_text(content, "schedule"),
        world=_numbers(content, "world", World),
        limits=_numbers(content, "limits", FlightLimits),
        times=_array(content, "times"),
        positions=_array(content, "positions"),
        lengths=_array(content, "lengths"),
        route=_array(content, "route"),
        crossings=tuple(
            _crossing(entry, number) for number, entry in enumerate(_list(content, "crossings"), 1)
        ),
        passes=_array(content, "passes"),
        notes=tuple(str(note) for note in _list(content, "notes")),
        tightening=float(_get(content, "tightening", (float, int), "seconds")),
    )


def _get(content: dict[str, Any], key: str, kind: type | tuple[type, ...], words: str) -> Any:
    if key not in content:
        raise FileFormatError(f'the key "{key}" is missing')
    if not isinstance(content[key], kind):
        raise FileFormatError(f'"{key}" is {json.dumps(content[key])[:40]}, expected {words}')
    return content[key]


def _text(content: dict[str, Any], key: str) -> str:
    text: str = _get(content, key, str, "text")
    return text


def _list(content: dict[str, Any], key: str) -> list[Any]:
    entries: list[Any] = _get(content, key, list, "a list")
    return entries


def _numbers(content: dict[str, Any], key: str, kind: type[Numbers]) -> Numbers:
    """A value that consists of named numbers."""
    values: dict[str, Any] = _get(content, key, dict, "an object")
    _check_keys(values, [field.name for field in fields(kind)], f'"{key}"')
    return kind(**values)


def _check_keys(values: dict[str, Any], names: Iterable[str], where: str) -> None:
    for name in set(names) ^ set(values):
        problem = "unknown" if name in values else "missing"
        raise FileFormatError(f'the key "{name}" in {where} is {problem}')


def _array(content: dict[str, Any], key: str) -> FloatArray:
    entries = _list(content, key)
    try:
        array = np.array(entries)
    except ValueError as error:
        raise FileFormatError(f'"{key}": the lists in it differ in length') from error
    if array.dtype.kind not in "if":
        raise FileFormatError(f'"{key}" holds something that is not a number')
    return array.astype(np.float64)


def _supports(entries: list[Any], cable: Cable) -> tuple[int, ...]:
    last = len(cable.path) - 1
    for entry in entries:
        if type(entry) is not int or not 1 < entry <= last:
            raise FileFormatError(
                f'"supports": {entry!r} is none of the turning points 2 to {last}'
            )
    if entries != sorted(set(entries)):
        raise FileFormatError(f'"supports": {entries} are not in order')
    return tuple(entries)


def _crossing(entry: Any, number: int) -> PlannedCrossing:
    if not isinstance(entry, dict):
        raise FileFormatError(f'"crossings": entry {number} is not an object')
    values = dict(entry)
    kinds: dict[str, tuple[type, ...]] = dict.fromkeys(
        ("height", "cable_height", "route", "time"), (float, int)
    )
    kinds |= {"span": (int,), "older": (int,), "over": (bool,), "sense": (int,), "place": (list,)}
    where = f'entry {number} of "crossings"'
    _check_keys(values, kinds, where)
    for name, kind in kinds.items():
        if type(values[name]) not in kind or (float in kind and not math.isfinite(values[name])):
            raise FileFormatError(
                f'"{name}" in {where} is {values[name]!r}, '
                f"expected {' or '.join(each.__name__ for each in kind)}"
            )
    place = values.pop("place")
    if len(place) != 2 or not all(type(x) in (int, float) and math.isfinite(x) for x in place):
        raise FileFormatError(f'"place" in {where} is not [x, y]')
    return PlannedCrossing(place=(place[0], place[1]), **values)
