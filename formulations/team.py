"""What a team asks beyond openness, as rows over the points of a path.

The decisions are x_1 ... x_n, "point k of the path carries a robot"; a span is a pair of
consecutive robots (u, w). "u and w are not consecutive robots" is the clause
not x_u or not x_w or x_{u+1} or ... or x_{w-1}.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from formulations.instance import Row


@dataclass(frozen=True)
class ReachTarget:
    """Someone must be near: one of the `options` must hold.

    Each option is a conjunction of literals over x_1 ... x_n.
    """

    options: tuple[tuple[int, ...], ...]
    origin: str


class Stretch(NamedTuple):
    """The points `first` ... `last` of a path, of which one at least must carry a robot."""

    first: int
    last: int
    origin: str


@dataclass(frozen=True)
class Team:
    """Optional families; each is off while empty.

    Attributes
    ----------
    stretches : tuple of Stretch
        All of them are to be pierced (`loops`).
    too_close : tuple of (u, w)
        Pairs of points that must not both carry a robot (`separation`).
    too_long : tuple of (u, w), u < w
        Pairs that must not be consecutive robots (`payload`).
    reach : tuple of ReachTarget
    forbidden, forced : tuple of int
        Points without and with a robot.
    excluded : tuple of tuple of int
        Sets of points between the ends that are not the answer: each is ruled out by itself, not
        the sets that contain it.
    clauses : tuple of tuple of int
        Of each, one literal at least holds: +k, point k carries a robot; -k, it does not.
    at_most : int or None
        Robots there are, lifting robots included.
    """

    stretches: tuple[Stretch, ...] = ()
    too_close: tuple[tuple[int, int], ...] = ()
    too_long: tuple[tuple[int, int], ...] = ()
    reach: tuple[ReachTarget, ...] = ()
    forbidden: tuple[int, ...] = ()
    forced: tuple[int, ...] = ()
    excluded: tuple[tuple[int, ...], ...] = ()
    clauses: tuple[tuple[int, ...], ...] = ()
    at_most: int | None = None

    def rows(self, points: int) -> Iterable[Row]:
        """All rows but those of `reach`."""
        # Lifting robots hold the two ends: x_1 = x_n = 1.
        for end in (1, points):
            yield Row((end,), 1, "ends", f"lifting robot p{end}")
        # Loops: a robot on every stretch.
        for stretch in self.stretches:
            yield Row(stretch_literals(stretch), 1, "loops", stretch.origin)
        # Separation: x_u + x_w <= 1 for points too close to each other.
        for u, w in self.too_close:
            yield Row((-u, -w), 1, "separation", f"p{u} and p{w}")
        # Payload: no span longer than one team mate can carry.
        for u, w in self.too_long:
            yield Row(not_consecutive(u, w), 1, "payload", f"span p{u}-p{w}")
        # Points chosen by hand.
        for k in self.forbidden:
            yield Row((-k,), 1, "forbidden", f"p{k}")
        for k in self.forced:
            yield Row((k,), 1, "forced", f"p{k}")
        # No-good: some point differs from the set that is ruled out.
        for points_held in self.excluded:
            literals = tuple(-k if k in points_held else k for k in range(2, points))
            origin = " ".join(f"p{k}" for k in points_held) or "no supports"
            yield Row(literals, 1, "excluded", origin)
        # Cuts: what sets that failed a test say of others.
        for literals in self.clauses:
            yield Row(literals, 1, "cut off", " ".join(map(str, literals)))
        # At most k robots.
        if self.at_most is not None:
            literals = tuple(-k for k in range(1, points + 1))
            family, origin = "at most", f"{self.at_most} robots"
            yield Row(literals, points - self.at_most, family, origin)

    def reach_rows(self, first: int) -> tuple[list[tuple[int, ...]], list[Row]]:
        """Definitions of auxiliary variables from `first` on, and the rows of `reach`."""
        definitions: list[tuple[int, ...]] = []
        rows = []
        for target in self.reach:
            helpers = []
            for option in target.options:
                helper = first + len(definitions)
                definitions.append(option)
                helpers.append(helper)
                # A helper stands for its option: it implies each literal, and they imply it.
                rows += [Row((-helper, x), 1, "reach", target.origin) for x in option]
                rows.append(Row((helper, *(-x for x in option)), 1, "reach", target.origin))
            # Reach: one of the options holds.
            rows.append(Row(tuple(helpers), 1, "reach", target.origin))
        return definitions, rows


def stretch_literals(stretch: Stretch) -> tuple[int, ...]:
    """Literals of the clause: some point of the stretch carries a robot."""
    return tuple(range(stretch.first, stretch.last + 1))


def not_consecutive(u: int, w: int) -> tuple[int, ...]:
    """Literals of the clause: u and w do not both carry robots with none between them."""
    return (-u, -w, *range(u + 1, w))
