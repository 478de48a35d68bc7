"""The fewest robots that can tie a knot, on whatever diagram: 2, 3 or 4, under stated assumptions.

Proofs: docs/one-support.md. That no knot but the unknot is tied by two robots, and none but
connected sums of torus knots T(2, n) by three, is proven for a model of the laid cable; that so
many robots are enough is not said.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from knotopt.errors import RequirementError

STRAIGHT = (
    "only the leader moves; cable between two hovering robots, and beyond the first, is straight "
    "in plan"
)
NO_SELF_CROSSING = "the leader never crosses its own tether"
WINDINGS = "the tether slides along laid cable: successive crossings of one winding are neighbours"
TIGHT = "a winding is drawn tight against the robot behind it before the next one begins"

TORUS = {"3_1", "5_1", "7_1", "9_1", "11a_367", "13a_4878"}
"""T(2, n) in the tables."""


class Standing(StrEnum):
    """How sure a lower bound is."""

    TRIVIAL = "trivial"
    PROVEN = "proven under the assumptions"


@dataclass(frozen=True)
class FewestRobots:
    """A lower bound for the robots that tie a knot.

    Attributes
    ----------
    robots : int
    why : str
        In words.
    standing : Standing
    assumptions : tuple of str
        Under which it is proven.
    against : str
        A simulated flight that left the assumptions and tied a knot with fewer robots, "" if none
        is known.
    """

    robots: int
    why: str
    standing: Standing
    assumptions: tuple[str, ...]
    against: str = ""


UNKNOT = FewestRobots(2, "two robots hold the cable's ends", Standing.TRIVIAL, ())
UNKNOWN = FewestRobots(2, "which knot it is could not be told", Standing.TRIVIAL, ())
TORUS_SUM = FewestRobots(
    3,
    "two robots lay one straight span, which has no crossing",
    Standing.PROVEN,
    (STRAIGHT, NO_SELF_CROSSING),
)
UNTOLD = replace(
    TORUS_SUM,
    why="no unknot; its Alexander polynomial does not tell it from a sum of T(2, n)",
)
OTHER = FewestRobots(
    4,
    "with one support only T(2, n) and their connected sums are tied",
    Standing.PROVEN,
    (STRAIGHT, NO_SELF_CROSSING, WINDINGS, TIGHT),
    "a leader that crossed its own tether, unplanned, tied 5_2 with three robots",
)


def fewest_by_claim(candidates: Collection[str], alexander: Sequence[int]) -> FewestRobots:
    """The least number of robots for a knot.

    Parameters
    ----------
    candidates : collection of str
        The knots that it can be, as tables or `T(p,q)` name them: m3_1 is the mirror image of 3_1,
        3_1#m3_1 a connected sum. None if it was compared with the tables, the unknot among them,
        and is in none.
    alexander : sequence of int
        Its Alexander polynomial, constant term first, which decides where there is no name; empty
        if it is not known.

    Returns
    -------
    FewestRobots
        Of several candidates, the one that needs fewest.

    Raises
    ------
    RequirementError
        A candidate that is no such name.

    Examples
    --------
    >>> names = ("0_1", "m3_1", "4_1", "3_1#5_1", "T(2,15)")
    >>> [fewest_by_claim([name], ()).robots for name in names]
    [2, 3, 4, 3, 3]
    >>> unnamed = ((1, -3, 1), (1, -2, 3, -2, 1), (1,), ())
    >>> [fewest_by_claim([], polynomial).robots for polynomial in unnamed]
    [4, 3, 4, 2]
    """
    if candidates:
        return min((_of_name(name) for name in candidates), key=lambda each: each.robots)
    if not alexander:
        return UNKNOWN
    # A knot with polynomial 1 that is no unknot is no such sum: theirs have other polynomials.
    return UNTOLD if len(alexander) > 1 and _is_product(alexander) else OTHER


def _of_name(name: str) -> FewestRobots:
    parts = [part.strip() for part in name.split("#")]
    knotted = [part for part in parts if not _is_unknot(part)]
    if not knotted:
        return UNKNOT
    return TORUS_SUM if all(map(_is_torus, knotted)) else OTHER


def _is_unknot(part: str) -> bool:
    pair = _pair(part)
    if pair is None and not re.fullmatch(r"m?[0-9]+[an]?_[0-9]+", part):
        raise RequirementError(f"{part!r} is no name of a knot such as 3_1, m8_19 or T(2,5)")
    return part.removeprefix("m") == "0_1" or (pair is not None and min(map(abs, pair)) == 1)


def _is_torus(part: str) -> bool:
    pair = _pair(part)
    if pair is not None:
        return min(map(abs, pair)) == 2
    return part.removeprefix("m") in TORUS


def _pair(part: str) -> tuple[int, int] | None:
    match = re.fullmatch(r"m?T\(\s*(-?[0-9]+)\s*,\s*(-?[0-9]+)\s*\)", part)
    return (int(match[1]), int(match[2])) if match else None


def _is_product(alexander: Sequence[int]) -> bool:
    """Whether a polynomial is a product of 1 - t + ... + t^(n - 1), the T(2, n)'s, n odd.

    The largest n of a product is the largest one whose polynomial divides it, since a root of
    unity of order 2 n is a root of no other one with n or less.
    """
    left = list(alexander)
    while len(left) > 1:
        for degree in range(len(left) - 1 - (len(left) - 1) % 2, 0, -2):
            quotient = _quotient(left, [(-1) ** k for k in range(degree + 1)])
            if quotient is not None:
                left = quotient
                break
        else:
            return False
    return abs(left[0]) == 1


def _quotient(dividend: Sequence[int], divisor: Sequence[int]) -> list[int] | None:
    """Of polynomials, the divisor's last coefficient being 1; None if it does not divide."""
    left, quotient = list(dividend), list[int]()
    while len(left) >= len(divisor):
        factor = left[-1]
        quotient.append(factor)
        start = len(left) - len(divisor)
        left = [v - factor * divisor[k - start] if k >= start else v for k, v in enumerate(left)]
        left.pop()
    return None if any(left) else quotient[::-1]
