"""Checks of what is asked for, shared by the classes of requirements."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from knotopt.errors import RequirementError

LARGEST_NOISE = 10.0  # of a robot's position [m]
LARGEST_WIND = 100.0  # [m/s]
MOST_FLIGHTS = 10_000  # of one plan or set, disturbed: hours


def check_not_negative(asked: object, names: Iterable[str], kind: str) -> None:
    """Raise unless attributes are finite numbers from 0 up.

    Parameters
    ----------
    asked : object
    names : iterable of str
        Of its attributes.
    kind : str
        What they are to be, for the sentence: "a length in metres".

    Raises
    ------
    RequirementError
        Names the first that is not.
    """
    for name in names:
        value: object = getattr(asked, name)
        if not isinstance(value, int | float) or not math.isfinite(value) or value < 0:
            raise RequirementError(f"{name} is {kind}, not {value!r}")


def check_at_most(asked: object, most: Mapping[str, tuple[float, str]]) -> None:
    """Raise unless attributes are at most so large.

    Parameters
    ----------
    asked : object
    most : mapping of str to (float, str)
        Of an attribute: the largest that makes sense, and its unit, " m" or "".

    Raises
    ------
    RequirementError
        Names the first that is larger.
    """
    for name, (largest, unit) in most.items():
        value: float = getattr(asked, name)
        if value > largest:
            raise RequirementError(f"{name} is at most {largest:g}{unit}, not {value!r}")
