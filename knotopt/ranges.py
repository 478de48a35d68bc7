"""Checks of what is asked for, shared by the classes of requirements."""

from __future__ import annotations

import math
from collections.abc import Iterable

from knotopt.errors import RequirementError


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
