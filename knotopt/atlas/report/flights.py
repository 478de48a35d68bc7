"""Section: which sets tie the knot in simulation, where flights were asked for."""

from __future__ import annotations

from statistics import median

from knotopt.atlas.report.results import Results
from knotopt.atlas.report.robots import named_groups
from knotopt.document.cells import percent
from knotopt.document.model import NONE, Block, Section, Table, table
from knotopt.sim.trials import wilson_interval
from knotopt.tables.methods import LCF, TRIED_PROGRAMS

SMALLEST = {method.key: f"`{method.head}`" for method in TRIED_PROGRAMS}
SETS = {LCF.key: LCF.head, **SMALLEST}
MODELS = {f"{key}_open": words for key, words in SMALLEST.items()}
OUTCOMES = ("wrong knot", "stuck", "unsound")
QUADRANTS = {
    "open, tied": (True, True),
    "open, not tied": (True, False),
    "not open, tied": (False, True),
    "not open, not tied": (False, False),
}


def flights_section(results: Results) -> Section | None:
    """How often sets of each kind tie, and whether the models say so; None without flights."""
    if not results.flights:
        return None
    return Section("Flights", tuple(_blocks(results)))


def _blocks(results: Results) -> list[Block]:
    planning = [row["planning_seconds"] for row in results.flights if row["planning_seconds"] > 0]
    flying = [row["simulation_seconds"] for row in results.flights if row["simulation_seconds"] > 0]
    times = f"Planning took {median(planning):.1f} s a set (median)" + (
        f", simulating {median(flying):.1f} s." if flying else "."
    )
    return [
        "LCF's set and the smallest sets were flown in simulation on every cut: once each, "
        "undisturbed, on the route that the model of laid cable gives, without rehearsals. The "
        "knot counts as tied by the Alexander polynomial of the cable where it came to lie. "
        f"Sets of a cut that are equal were flown once and count each. {times}",
        tied_table(results),
        agreement_table(results),
    ]


def tied_table(results: Results) -> Table:
    """Flights that tie the knot by crossing number and set, with Wilson's intervals."""
    rows = []
    for name, knots in named_groups(results):
        numbers = {results.knots[k].number for k in knots.tolist()}
        for kind, words in SETS.items():
            of_kind = (row for row in results.flights if row["supports"] == kind)
            chosen = [row for row in of_kind if row["number"] in numbers]
            if not chosen:
                continue
            flown = [row for row in chosen if row["planned"]]
            tied = sum(row["tied"] for row in flown)
            outcomes = [row["outcome"] for row in flown]
            rows.append(
                [
                    name,
                    words,
                    f"{len(chosen):,}",
                    f"{len(flown):,}",
                    f"{tied:,}",
                    percent([row["tied"] for row in flown]),
                    _interval(tied, len(flown)),
                    *(f"{outcomes.count(outcome):,}" for outcome in OUTCOMES),
                ]
            )
    return table(
        ("crossing number", "set", "sets", "flown", "tied", "share", "95 %", *OUTCOMES),
        rows,
        "Sets on the outer cuts, those that have a flight within the usual limits and were flown, "
        "and those of these that tied the knot, with Wilson's 95 % interval; then what became of "
        "the others. Cuts of one knot are not independent of each other.",
    )


def agreement_table(results: Results) -> Table:
    """Whether a set is open by a model, against whether its flight tied the knot."""
    rows = []
    for kind, words in SETS.items():
        for column, model in MODELS.items():
            flown = [
                (row[column], row["tied"])
                for row in results.flights
                if row["supports"] == kind and row["planned"] and row.get(column) is not None
            ]
            if flown:
                counts = [flown.count((is_open, tied)) for is_open, tied in QUADRANTS.values()]
                agree = percent([is_open == tied for is_open, tied in flown])
                rows.append([words, model, f"{len(flown):,}", *map(str, counts), agree])
    return table(
        ("set", "open by", "flown", *QUADRANTS, "agree"),
        rows,
        "Sets that were flown, by what a model says of them (`opening` with threading by turning "
        "points, `span` over-under) and by whether the flight tied the knot. Agree: open and tied, "
        "or neither.",
    )


def _interval(tied: int, flown: int) -> str:
    if not flown:
        return NONE
    low, high = wilson_interval(tied, flown)
    return f"{100 * low:.0f} to {100 * high:.0f} %"
