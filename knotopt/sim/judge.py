"""Which knot a flight tied: the Alexander polynomial of its final centreline.

The centreline is open; it is closed far outside in three ways: upwards, outwards and downwards from
its ends. Where the three give one knot, the ends are free of the tangle.

The Alexander polynomial does not tell a knot from its mirror image, nor 5_1 from 10_132, nor 8_20
from the sum of two trefoils. Up to ten crossings only the unknot has the unknot's. Names are those
of prime knots up to ten crossings.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.cable.alexander import alexander_from_gauss, alexander_polynomial, format_polynomial
from knotopt.cable.cable import Cable
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.flight.record import FlightRecord
from knotopt.sim.material import Material
from knotopt.verify.crossings import curve_crossings

SOUND = 0.4  # share of two radii under which strands may have passed through each other
FAR = 20.0  # sizes of the cable at which it is closed
TILTS = ((0.31, 0.17), (-0.23, 0.29), (0.11, -0.37), (0.47, -0.05))  # directions to look along

Polynomial = tuple[int, ...]


class Outcome(StrEnum):
    """What came of a flight."""

    TIED = "tied"
    WRONG_KNOT = "wrong knot"
    STUCK = "stuck"
    UNSOUND = "unsound"


@dataclass(frozen=True)
class Verdict:
    """What a flight tied.

    Attributes
    ----------
    outcome : Outcome
        "unsound" where strands may have passed through each other or the closures disagree; else
        "stuck" where the robots did not get to the end of the plan; else by the polynomial.
    knot : str or None
        What is tied: "unknot", "3_1", "5_1 or 10_132"; None where no prime knot up to ten crossings
        has the polynomial, or the closures disagree.
    is_wanted : bool
        Whether what is tied has the polynomial of the knot wanted, whatever the outcome.
    closures_agree : bool
    polynomial : str
        The Alexander polynomial, "1 - t + t^2"; of several closures that disagree, with " | ".
    """

    outcome: Outcome
    knot: str | None
    is_wanted: bool
    closures_agree: bool
    polynomial: str

    def __str__(self) -> str:
        tied = self.knot or f"a knot with polynomial {self.polynomial}"
        return f"{self.outcome}: {tied}"


def judge(record: FlightRecord, wanted: Cable | GridDiagram) -> Verdict:
    """Which knot a flight tied, and whether that can be trusted.

    Parameters
    ----------
    record : FlightRecord
    wanted : Cable or GridDiagram
        The knot to tie.
    """
    cable = wanted if isinstance(wanted, Cable) else Cable(wanted, "L+")
    final = record.cable[-1]
    if not np.isfinite(final).all():
        return Verdict(Outcome.UNSOUND, None, False, False, "")
    found = closed_polynomials(final)
    agree = len(set(found)) == 1
    is_wanted = agree and found[0] == alexander_polynomial(cable)
    if not agree or record.smallest_distance < SOUND * 2 * Material.radius:
        outcome = Outcome.UNSOUND
    elif not record.finished:
        outcome = Outcome.STUCK
    else:
        outcome = Outcome.TIED if is_wanted else Outcome.WRONG_KNOT
    knot = knot_name(found[0]) if agree else None
    text = " | ".join(dict.fromkeys(format_polynomial(polynomial) for polynomial in found))
    return Verdict(outcome, knot, is_wanted, agree, text)


def knot_name(polynomial: Polynomial) -> str | None:
    """The prime knots up to ten crossings that have an Alexander polynomial.

    Examples
    --------
    >>> knot_name((1, -1, 1, -1, 1))
    '5_1 or 10_132'
    >>> knot_name((1,))
    'unknot'
    """
    if polynomial == (1,):
        return "unknot"
    names = [knot.name for knot in shipped_knots().values() if knot.alexander == polynomial]
    return " or ".join(names) or None


def closed_polynomials(centreline: FloatArray) -> tuple[Polynomial, Polynomial, Polynomial]:
    """Alexander polynomials of an open curve closed upwards, outwards and downwards.

    Parameters
    ----------
    centreline : float array, shape (M, 3)
        z is up.

    Raises
    ------
    RequirementError
        The curve touches itself from wherever it is seen.

    Examples
    --------
    A straight cable:

    >>> closed_polynomials(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]))
    ((1,), (1,), (1,))
    """
    middle = (centreline.min(axis=0) + centreline.max(axis=0)) / 2
    curve = centreline - middle
    far = FAR * float(np.abs(curve).max())
    up = np.array([0.0, 0.0, far])
    above, below = (np.array([curve[-1] + way, curve[0] + way]) for way in (up, -up))
    return (
        _polynomial(curve, above),
        _polynomial(curve, _outside(curve, far)),
        _polynomial(curve, below),
    )


def _outside(curve: FloatArray, far: float) -> FloatArray:
    """Points from beyond the last point round the curve to beyond the first, level with them."""
    last, first = (float(np.arctan2(curve[k, 1], curve[k, 0])) for k in (-1, 0))
    turn = (first - last + np.pi) % (2 * np.pi) - np.pi
    angles = last + turn * np.linspace(0, 1, 9)
    heights = np.linspace(curve[-1, 2], curve[0, 2], 9)
    return np.column_stack((far * np.cos(angles), far * np.sin(angles), heights))


def _polynomial(curve: FloatArray, way: FloatArray) -> Polynomial:
    """Of the curve closed by a way from its last point to its first."""
    middle = (way[0] + way[1]) / 2
    # The two ends of the closed curve stay a hair apart: a common point would count as touching.
    ends = middle + 1e-7 * (way[1] - way[0]), middle
    closed = np.vstack((ends[0], way[1:], curve, way[:1], ends[1]))
    for a, b in TILTS:
        seen = closed @ _rotation(a, b)
        try:
            crossings = curve_crossings(seen)
        except ValueError:
            continue
        visits, signs = crossings.code
        return alexander_from_gauss([v for v, _ in visits], [over for _, over in visits], signs)
    raise RequirementError("the cable touches itself from wherever it is seen")


def _rotation(a: float, b: float) -> FloatArray:
    """By two angles about the axes x and y."""
    about_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    rotation: FloatArray = about_x @ about_y
    return rotation
