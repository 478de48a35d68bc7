"""What `knotopt fly` says of a flight, as text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from knotopt.cli.printing import print_facts, print_table

if TYPE_CHECKING:
    from knotopt.flight.examine import Examination
    from knotopt.mission.result import FlightResult, Flown

HEADS = ("planned", "result", "what happened")


def show_flight(result: FlightResult, title: str) -> None:
    """Print a plan's measures, its crossings, and what came of it in physics."""
    from knotopt.supports.support_set import format_supports, place

    plan = result.plan
    supports = format_supports(place(plan.cable, plan.supports))
    print(f"{title}, cut {plan.cable.cut}: {plan.robots} robots ({plan.chosen_by})")
    print(f"supports: {supports or 'none'}\n")
    print_facts(result.measures())
    if result.flown is None:
        print("\nthe leader's route over cable laid straight in plan:")
        _show_crossings(result.examination)
    else:
        _show_flight(result.flown)
        if result.disturbed:
            print_table(
                ("flight", "outcome", "knot", "crossings", "strands apart", "tension", "computed"),
                [_flight_row(each) for each in result.disturbed],
            )
        if result.failed is not None:
            _show_flight(result.failed)
    for note in plan.notes:
        print(f"note: {note}")
    for reason in result.reasons:
        print(f"not good: {reason}")


def _show_flight(flown: Flown) -> None:
    print(f"\n{flown.name} flight: {flown.came_of}")
    if flown.examination is not None:
        _show_crossings(flown.examination)


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
