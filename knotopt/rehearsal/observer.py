"""The cable of a simulated flight as a planner sees it, in grid steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import attrgetter

import numpy as np
import shapely

from knotopt.arrays import FloatArray
from knotopt.flight.gates import Gate
from knotopt.flight.laid_cable import LaidCable
from knotopt.flight.planner import FlightPlanner
from knotopt.flight.route import SpanRoute
from knotopt.sim.simulation import Simulation

LOOSE = 0.5  # end of the tether at the leader that it may fly past [grid steps]
ARRIVED = 0.2  # from its place, at most: a robot that hovers there [grid steps]


@dataclass(frozen=True)
class Observer:
    """Looks at the cable of a simulation.

    Parameters
    ----------
    planner : FlightPlanner
        Its routes are those flown so far.
    simulation : Simulation
    """

    planner: FlightPlanner
    simulation: Simulation

    def laid(self, spans: int) -> LaidCable:
        """The first spans as they lie; where a robot is not in its place yet, as modelled."""
        planner, simulation = self.planner, self.simulation
        found = list(planner.modelled_cable(spans).spans)
        robots = self._in_plan(simulation.robots)
        arrived = np.linalg.norm(robots - planner.layout.places, axis=1) < ARRIVED
        for i in np.flatnonzero(arrived[:spans] & arrived[1 : spans + 1]).tolist():
            found[i] = self._in_grid(i)
        return LaidCable(found)

    def tether(self, span: int) -> FloatArray | None:
        """The cable from robot `span` to the leader in plan, but for its end; None if short."""
        points = self._own_cable(span)
        far = np.flatnonzero(np.linalg.norm(points - points[-1], axis=1) > LOOSE)
        if len(far) < 1 or far[-1] < 1:
            return None
        return points[: far[-1] + 1]

    def crossed(
        self, span: int, laid: LaidCable, done: int, apart: float
    ) -> dict[int, list[tuple[float | None, float]]]:
        """Crossings on the laid spans where they are now: rank, arc length.

        Parameters
        ----------
        span : int
            That is being flown.
        laid : LaidCable
        done : int
            Letters of its word that are behind the leader.
        apart : float
            That the next crossing keeps from where the tether hangs over the same span.
        """
        planner = self.planner
        found: dict[int, list[tuple[float | None, float]]] = {}
        lines = [shapely.LineString(points) for points in laid.in_plan]
        for later, route in enumerate(planner.spans[: span - 1], 1):
            for older, gates in _by_older(route).items():
                places = _places(lines[older - 1], lines[later - 1])
                if len(places) != len(gates):
                    places = [gate.along for gate in gates]
                ranks = (gate.letter.rank for gate in gates)
                found.setdefault(older, []).extend(zip(ranks, places, strict=True))
        word = planner.layout.words[span - 1]
        if 0 < done < len(word) and word[done - 1].older == word[done].older:
            last, wanted = word[done - 1].rank, word[done].rank
            if last is not None and wanted is not None:
                older = word[done].older
                tether = shapely.LineString(self._own_cable(span))
                gate = planner.spans[span - 1].passages[done - 1].gate
                hooks = [gate.along, *_places(lines[older - 1], tether)]
                place = max(hooks) + apart if wanted > last else min(hooks) - apart
                found.setdefault(older, []).append((last, place))
        return found

    def _own_cable(self, span: int) -> FloatArray:
        return self._in_plan(self.simulation.cable[self.simulation.held[span - 1] :])

    def _in_plan(self, points: FloatArray) -> FloatArray:
        return np.asarray(points[:, :2] / self.planner.world.step)

    def _in_grid(self, span: int) -> FloatArray:
        """Span `span` (from 0), heights above the robots'."""
        simulation, world = self.simulation, self.planner.world
        points = simulation.cable[simulation.held[span] : simulation.held[span + 1] + 1]
        return np.asarray((points - [0, 0, world.altitude]) / world.step)


def _by_older(route: SpanRoute) -> dict[int, list[Gate]]:
    """A route's gates for each span crossed, in order along it."""
    found: dict[int, list[Gate]] = {}
    for gate in sorted((passage.gate for passage in route.passages), key=attrgetter("along")):
        found.setdefault(gate.letter.older, []).append(gate)
    return found


def _places(line: shapely.LineString, other: shapely.LineString) -> Sequence[float]:
    """Arc lengths along a line at which another crosses it, in order."""
    met = shapely.intersection(line, other)
    points = [part for part in shapely.get_parts(met) if part.geom_type == "Point"]
    return sorted(float(line.project(point)) for point in points)
