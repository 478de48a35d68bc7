"""Flight plans as waypoints: CSV `t,robot,x,y,z,yaw`, one line a robot and instant."""

from __future__ import annotations

from knotopt.flight.plan import FlightPlan

HEADER = "t,robot,x,y,z,yaw"
YAW = 0.0  # the heading of every robot at every time [rad]: a cable hangs from it all the same


def waypoints_csv(plan: FlightPlan) -> str:
    """A plan as CSV: for each time [s] all robots (1-based), x, y, z [m] and yaw [rad]."""
    lines = [HEADER]
    for time, places in zip(plan.times.tolist(), plan.positions.tolist(), strict=True):
        lines += [
            f"{time:.6f},{robot},{x:.5f},{y:.5f},{z:.5f},{YAW:.5f}"
            for robot, (x, y, z) in enumerate(places, 1)
        ]
    return "\n".join([*lines, ""])
