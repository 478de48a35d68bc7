"""What `knotopt solve --verify-physics` says, as text and as JSON."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from knotopt.cli.printing import print_facts, print_json, print_note, print_table, print_written
from knotopt.cli.solve_printing import search_json, show_search

if TYPE_CHECKING:
    from knotopt.reading.record import NamedDiagram
    from knotopt.rehearsal.cut_off import CutOff, FlownResult


def flown_json(named: NamedDiagram, flown: FlownResult) -> dict[str, Any]:
    """What `--json` says."""
    tied = flown.tied.flights if flown.tied else ()
    content = search_json(named.name, flown.search)
    for key in ("proven", "proven_over_cuts"):  # smaller sets that were cut off are open as well
        content[key] = content[key] and not flown.smaller_cut_off
    return content | {
        "physics": {
            "status": str(flown.status),
            "noise": flown.tests.noise,
            "trials": flown.tests.trials,
            "tied": [str(flight.verdict) for flight in tied],
            "proven_but_for_cut_off": flown.is_proven,
            "cut_off_by_robots": {str(k): count for k, count in flown.cut_off_by_robots.items()},
            "cut_off": [
                each.to_json() | {"robots": each.robots, "tied_instead": each.tied_instead}
                for each in flown.cut_off
            ],
            "claim": claim(flown),
        }
    }


def show_flown(
    named: NamedDiagram, flown: FlownResult, written: list[Path], *, as_json: bool
) -> None:
    """The set that ties, what was cut off, what is proven, and the files `written`."""
    if as_json:
        print_json(flown_json(named, flown))
        return
    title = f"{named.name} ({named.source})"
    best = flown.result
    if flown.status == "tied":
        show_search(title, flown.search, None, flown.smaller_cut_off)
    elif not flown.cut_off and not best.found:
        show_search(title, flown.search, None)
        return
    counts = ", ".join(f"{n} of {robots} robots" for robots, n in flown.cut_off_by_robots.items())
    facts = [("cut off in flight", counts or "none")]
    if flown.status == "tied":
        facts.insert(0, ("tied in simulation", _flights(flown)))
    elif best.found:
        points = " ".join(f"p{k}" for k in best.supports) or "no supports"
        words = f"{best.robots} robots, cut {best.cable.cut}, {points}: not flown"
        facts.append(("next set", words))
    print(f"{title}: {_ENDED[flown.status]}" if flown.status != "tied" else "")
    print_facts(facts)
    if flown.cut_off:
        print_table(
            ("robots", "cut", "supports", "tied instead", "trials", "first crossing that failed"),
            [
                (
                    each.robots,
                    each.cut,
                    " ".join(f"p{k}" for k in each.supports) or "none",
                    each.tied_instead,
                    _tied_trials(each),
                    each.failed,
                )
                for each in flown.cut_off
            ],
        )
    print()
    print_note(claim(flown))
    print_written(*written)


_ENDED = {
    "budget": "no set tied the knot before the budget ended",
    "no set": "none of the sets that meet the requirements tied the knot",
    "unknown": "no set tied the knot, and the solver stopped before it had another",
}


def claim(flown: FlownResult) -> str:
    """What is proven, what was seen in flights, and what is not known."""
    best, count, smaller = flown.result, len(flown.cut_off), flown.smaller_cut_off
    rows = f"the rows of `{best.requirements.words}`"
    laid = flown.search.cut_off is not None
    meets = f"meets {rows} and lays the knot" if laid else f"meets {rows}"
    many = len(flown.search.outcomes)
    where = f"over the {many} cuts searched" if many > 1 else "on this cut"
    sentences = []
    if flown.is_proven:
        but = f", but for {smaller} cut off" if smaller else ""
        sentences.append(f"Proven: no set of fewer than {best.robots} robots {meets} {where}{but}.")
    elif flown.status == "no set":
        sentences.append(f"Proven: no set but the {count} cut off {meets} {where}.")
    else:
        sentences.append(f"The solver stopped early: smaller sets may meet {rows}.")
    if flown.status == "tied":
        sentences.append(f"Seen in simulation: it tied the knot {_flights(flown)}.")
    if count:
        sentences.append(
            "The sets cut off failed in the flights tried; that is no proof that they, flown "
            "otherwise, cannot tie the knot."
        )
    sentences.append(
        f"Sets that do not meet {rows}{', or lay another knot,' if laid else ''} were not flown. "
        "A knot counts as tied by its Alexander polynomial, which does not tell mirror images "
        "apart."
    )
    return " ".join(sentences)


def _flights(flown: FlownResult) -> str:
    trials, noise = flown.tests.trials, flown.tests.noise
    return (
        f"undisturbed and in {trials} of {trials} flights with noise of {noise:g} m "
        f"(seeds 1 to {trials})"
    )


def _tied_trials(each: CutOff) -> str:
    if not each.trials:
        return "-"
    return f"{sum(trial.outcome == 'tied' for trial in each.trials)} of {len(each.trials)}"
