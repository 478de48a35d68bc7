"""What the leader's way over a span keeps away from, in plan: laid cable and hovering robots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from knotopt.arrays import FloatArray

NEAR = 0.4  # laid cable: closer than this costs more, and is not flown for a short cut [grid steps]


@dataclass(frozen=True, eq=False)
class Obstacles:
    """Cable and robots in plan [grid steps].

    Attributes
    ----------
    laid : tuple of shapely.LineString
        Spans 1, 2, ... as they lie.
    cable : shapely geometry
        These and all other cable that is not to be crossed but at a gate.
    robots : float array, shape (k, 2)
        Hovering robots but for those at the way's ends.
    posts : float array, shape (l, 2)
        Those at the ends too: gates keep away from them.
    clear : float
        Distance to keep from robots.
    """

    laid: tuple[shapely.LineString, ...]
    cable: shapely.Geometry
    robots: FloatArray
    posts: FloatArray
    clear: float

    def blocks(self, sight: shapely.LineString, end: FloatArray) -> bool:
        """Whether cable crosses a line, other than where the line starts at its robot."""
        if not sight.intersects(self.cable):
            return False
        met = sight.intersection(self.cable)
        return bool(shapely.hausdorff_distance(met, shapely.Point(end)) > 1e-6)

    def allows_short_cut(self, piece: FloatArray) -> bool:
        """Whether a piece of a way may be replaced by the straight line between its ends."""
        line = shapely.LineString(piece[[0, -1]])
        apart = shapely.distance(line, shapely.points(self.robots))
        if apart.min(initial=np.inf) < self.clear:
            return False
        if self.cable.is_empty:
            return True
        ends = [shapely.distance(shapely.Point(end), self.cable) for end in (piece[0], piece[-1])]
        inner = shapely.distance(shapely.points(piece[1:-1]), self.cable).min()
        if self.blocks(line, piece[0]) and self.blocks(line, piece[-1]):
            return False
        room = min(NEAR, float(inner), *map(float, ends)) - 0.05
        middle = shapely.LineString([piece[0] + s * (piece[-1] - piece[0]) for s in (0.02, 0.98)])
        return not middle.intersects(self.cable) and bool(
            room <= 0 or line.distance(self.cable) >= room
        )

    def pulled_straight(self, points: FloatArray) -> FloatArray:
        """A piece of a way with its detours cut short, from each point to the last one allowed."""
        corners = [0]
        while corners[-1] < len(points) - 1:
            i = corners[-1]
            best = i + 1
            for j in range(i + 2, len(points)):
                if self.allows_short_cut(points[i : j + 1]):
                    best = j
            corners.append(best)
        return points[corners]


def nearest(points: FloatArray, robots: FloatArray) -> FloatArray:
    """Distance of each point from the nearest robot, infinite if there is none."""
    apart = np.linalg.norm(points[:, None] - robots[None], axis=2)
    return np.asarray(apart.min(axis=1, initial=np.inf))
