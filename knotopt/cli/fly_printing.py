"""What `knotopt fly` says of a flight, as text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from knotopt.cli.printing import print_facts, print_table

if TYPE_CHECKING:
    from knotopt.flight.examine import Examination
    from knotopt.mission.mission import Mission

HEADS = ("planned", "result", "what happened")


def show_mission(mission: Mission, title: str) -> None:
    """Print a plan's measures, its crossings, and what came of it in physics."""
    from knotopt.cli.drawing import supports_in_words

    plan = mission.plan
    print(f"{title}, cut {plan.cable.cut}: {plan.robots} robots ({plan.chosen_by})")
    print(f"supports: {supports_in_words(plan.cable, plan.supports)}\n")
    print_facts(mission.measures())
    if not mission.flights:
        print("\nthe leader's route over cable laid straight in plan:")
        _show_crossings(mission.examination)
    for index, (name, flight) in enumerate(mission.flights):
        print(f"\n{name} flight: {flight.came_of}")
        if flight.examination is not None:
            _show_crossings(flight.examination)
        if index == 0 and mission.disturbed:
            print_table(
                ("flight", "outcome", "knot", "crossings", "strands apart", "tension", "computed"),
                [_flight_row(each) for each in mission.disturbed],
            )
    for note in plan.notes:
        print(f"note: {note}")
    for reason in mission.reasons:
        print(f"not good: {reason}")


def _show_crossings(examination: Examination) -> None:
    rows = examination.crossings
    print_table(HEADS, ((row.planned or "nothing", row.result, row.happened) for row in rows))
    print(f"states after each crossing: {examination.states.sentence}")


def _flight_row(flight: Mapping[str, Any]) -> tuple[Any, ...]:
    rows = flight["crossings"]
    kept = sum(row["result"] == "as planned" for row in rows)
    return (
        flight["flight"],
        flight["outcome"],
        flight["knot"] or "unnamed",
        f"{kept} of {len(rows)}",
        f"{flight['smallest_distance']:.3f} m",
        f"{flight['largest_tension']:.2f} N",
        f"{flight['seconds']:.1f} s",
    )
