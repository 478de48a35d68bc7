"""How numbers are written in cells; a dash stands for nothing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import FloatArray
from knotopt.document.model import NONE

Numbers = ArrayLike | Sequence[float | None]
"""What is not known is None or nan."""


def mean(values: Numbers, digits: int = 2) -> str:
    """The mean of what is known.

    Examples
    --------
    >>> mean([1, 2, None]), mean([])
    ('1.50', '–')
    """
    known = _known(values)
    return f"{known.mean():.{digits}f}" if known.size else NONE


def median(values: Numbers, digits: int = 1) -> str:
    """The median of what is known."""
    known = _known(values)
    return f"{np.median(known):.{digits}f}" if known.size else NONE


def whole(value: float) -> str:
    """A whole number with commas.

    Examples
    --------
    >>> whole(12965.0), whole(float("nan"))
    ('12,965', '–')
    """
    return NONE if np.isnan(value) else f"{int(value):,}"


def largest(values: Numbers) -> str:
    """The largest whole number."""
    known = _known(values)
    return whole(known.max()) if known.size else NONE


def percent(held: ArrayLike, digits: int = 1) -> str:
    """How many in a hundred hold.

    Examples
    --------
    >>> percent([True, False, False])
    '33.3 %'
    """
    values = np.asarray(held, dtype=bool)
    return f"{100 * values.mean():.{digits}f} %" if values.size else NONE


def signed(value: float) -> str:
    """A coefficient to two decimals with its sign.

    Examples
    --------
    >>> signed(-0.123), signed(0.5), signed(float("nan"))
    ('−0.12', '+0.50', '–')
    """
    return NONE if np.isnan(value) else f"{value:+.2f}".replace("-", "\N{MINUS SIGN}")


def yes(held: bool) -> str:
    """Whether something holds, in a word."""
    return "yes" if held else "no"


def _known(values: Numbers) -> FloatArray:
    array: FloatArray = np.asarray(values, dtype=float).ravel()
    return array[~np.isnan(array)]
