"""What a set of supports must do: the formulation, the openness, and what the team asks."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from typing import TYPE_CHECKING, Any

from knotopt.errors import RequirementError
from knotopt.supports.threading import Threading

if TYPE_CHECKING:
    from knotopt.supports.formulation import Formulation

MOST_ROBOTS = 1_000_000


@dataclass(frozen=True)
class Requirements:
    """What is asked of a set of supports; everything after `threading` is off by default.

    Parameters
    ----------
    formulation : str
        `opening`: polygons through the grid's crossings stay open. `span`: the taut cable itself,
        whose crossings move, keeps them. `loops`: a support on every loop. Or another one of
        `knotopt.supports.registry`.
    openness : Fraction, float or str, optional
        r in (0, 1] [grid steps], in thousandths; 0.5 by default. Not with `max_robots`.
    threading : Threading, optional
        By default the formulation's: `over-under` for `span`, else `turning-point`.
    with_loops : bool, optional
        Whether every loop of the cable must hold a support, too, as in `loops`, so that no crossing
        vanishes when the cable is straight between robots. By default only for `span`: the safe
        set.
    separation : float, optional
        Smallest distance between any two robots [grid steps].
    payload : float, optional
        Longest span between two consecutive robots, straight [grid steps].
    reach : float, optional
        When a region is threaded, some robot other than the leader, on the threaded span or on
        the span being flown, is within this distance of the threading point [grid steps].
    forbidden, forced : tuple of int
        Turning points (1-based) that must not, or must, carry a robot.
    excluded : tuple of tuple of int
        Sets of supports, without p_1 and p_n, that are not the answer; sets that contain one, or
        are part of one, still may be.
    clauses : tuple of tuple of int
        Of each, one literal at least holds: +k, turning point k carries a robot; -k, it does not.
    max_robots : int, optional
        At most so many robots, the two lifting ones included; the smallest opening is then
        maximised instead of the number of robots minimised.

    Raises
    ------
    RequirementError
        A value out of range, or two options that contradict each other.

    Examples
    --------
    >>> Requirements(openness=0.25).openness
    Fraction(1, 4)
    >>> Requirements(openness=1.5)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: the openness r must lie in (0, 1] grid steps, not 1.5
    """

    formulation: str = "opening"
    openness: Fraction = Fraction(1, 2)
    threading: Threading = Threading.TURNING_POINT
    with_loops: bool = False
    separation: float | None = None
    payload: float | None = None
    reach: float | None = None
    forbidden: tuple[int, ...] = ()
    forced: tuple[int, ...] = ()
    excluded: tuple[tuple[int, ...], ...] = ()
    clauses: tuple[tuple[int, ...], ...] = ()
    max_robots: int | None = None

    def __init__(
        self,
        formulation: str = "opening",
        openness: Fraction | float | str | None = None,
        threading: Threading | str | None = None,
        *,
        with_loops: bool | None = None,
        separation: float | None = None,
        payload: float | None = None,
        reach: float | None = None,
        forbidden: tuple[int, ...] = (),
        forced: tuple[int, ...] = (),
        excluded: tuple[tuple[int, ...], ...] = (),
        clauses: tuple[tuple[int, ...], ...] = (),
        max_robots: int | None = None,
    ) -> None:
        if openness is not None and max_robots is not None:
            raise RequirementError(
                "an openness and a largest number of robots exclude each other: with the latter "
                "the smallest opening is maximised"
            )
        from knotopt.supports.registry import find_formulation  # whose programs import much

        rules = find_formulation(formulation)
        fields = {
            "formulation": rules.name,
            "openness": _openness(rules.openness if openness is None else openness),
            "threading": _threading(rules, threading),
            "with_loops": _with_loops(rules, with_loops),
            "separation": _positive(separation, "the separation"),
            "payload": _positive(payload, "the longest span"),
            "reach": _positive(reach, "the reach"),
            "forbidden": tuple(sorted(set(forbidden))),
            "forced": tuple(sorted(set(forced))),
            "excluded": tuple(sorted({tuple(sorted(set(each))) for each in excluded})),
            "clauses": tuple(dict.fromkeys(tuple(each) for each in clauses)),
            "max_robots": max_robots,
        }
        for name, value in fields.items():
            object.__setattr__(self, name, value)
        points = (*self.forced, *self.forbidden, *chain(*self.excluded, *self.clauses))
        for number in (*points, *([max_robots] if max_robots else [])):
            if not isinstance(number, int) or isinstance(number, bool):
                raise RequirementError(f"turning points and robots are counted, not {number!r}")
        for point in self.forced:
            if point in self.forbidden:
                raise RequirementError(f"p{point} is both forced and forbidden")
        if max_robots is not None and max_robots > MOST_ROBOTS:
            raise RequirementError(f"at most {MOST_ROBOTS} robots are counted, not {max_robots}")
        if max_robots is not None and max_robots < 2:
            raise RequirementError(f"two robots hold the cable's ends; at most {max_robots} cannot")

    @property
    def words(self) -> str:
        """The formulation, and whether it is with loops."""
        return f"{self.formulation} with loops" if self.with_loops else self.formulation

    def check_points(self, count: int) -> None:
        """Whether the points named exist on a path of `count` turning points.

        Raises
        ------
        RequirementError
            One does not, or an end of the cable is to have no robot.
        """
        literals = chain(*self.clauses)
        for point in (*self.forced, *self.forbidden, *chain(*self.excluded), *map(abs, literals)):
            if not 1 <= point <= count:
                raise RequirementError(f"p{point}: the cable's turning points are p1 to p{count}")
        for end in (1, count):
            if end in self.forbidden:
                raise RequirementError(f"p{end} is an end of the cable: a lifting robot is there")
            if any(end in each for each in self.excluded):
                raise RequirementError(f"p{end} is an end of the cable and part of no excluded set")


def _threading(rules: Formulation[Any], mode: str | None) -> Threading:
    """The mode of that name, or the formulation's default."""
    if mode is None:
        return rules.threading[0]
    if mode not in rules.threading:
        names = ", ".join(rules.threading)
        raise RequirementError(
            f"no threading mode is named {mode!r} in {rules.name}: expected one of {names}"
        )
    return Threading(mode)


def _with_loops(rules: Formulation[Any], wanted: bool | None) -> bool:
    """Whether the loops' rows are added: never to a formulation that consists of them."""
    return (rules.with_loops if wanted is None else wanted) and rules.name != "loops"


def _openness(value: Fraction | float | str) -> Fraction:
    try:
        openness = Fraction(str(value))
    except (ValueError, ZeroDivisionError):
        raise RequirementError(f"the openness r is a number, not {value!r}") from None
    if not 0 < openness <= 1:
        raise RequirementError(f"the openness r must lie in (0, 1] grid steps, not {value}")
    if (openness * 1000).denominator != 1:
        raise RequirementError(f"the openness r is given in thousandths, not as {value}")
    return openness


def _positive(value: float | None, what: str) -> float | None:
    if value is not None and not 0 < value < float("inf"):
        raise RequirementError(f"{what} must be a positive number of grid steps, not {value}")
    return value
