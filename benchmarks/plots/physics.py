"""The page `physics.md`, from the results of the benchmarks of flights."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from matplotlib.figure import Figure

from benchmarks import results
from benchmarks.physics_subsets import LOST_AT
from benchmarks.plots.words import machine_words, ruled
from benchmarks.results import grouped
from knotopt.sim.trials import wilson_interval

Rows = list[dict[str, Any]]
SEEDS = 3  # disturbed flights, of the five, that a set is asked to tie in


def flown_table(rows: Rows) -> str:
    """One line a set: robots, what the flights tied, what went wrong first."""
    lines = ruled(
        "| row | method | cut | cuts tried | robots | undisturbed | disturbed, tied | rehearsals "
        "| flight [s] | robots apart | first crossing amiss |"
    )
    numbered = {row["method"] for row in rows if row["number"]}
    for row in rows:
        method = row["method"] + (f", set {row['number'] + 1}" if row["method"] in numbered else "")
        start = f"| {row['row']} | {method} | {row['cut']} | {row['cuts_tried']} | {row['robots']} "
        if not row["planned"]:
            lines.append(f"{start}| no plan: {row['why']} | | | | | |")
            continue
        lines.append(
            f"{start}| {row['undisturbed'].replace('|', '/')} "
            f"| {row['tied_disturbed']} of {len(row['disturbed'])} "
            f"| {row['rehearsals'] or 'none'} | {row['flight_seconds']:.0f} "
            f"| {row['separation']:.2f} "
            f"| {row['first_amiss'].replace('|', '/')} |"
        )
    return "\n".join(lines)


def rates_table(rows: Rows) -> str:
    """Success rates by method with Wilson's intervals; a set without a plan counts as failed."""
    lines = ruled("| method | sets | tied undisturbed | disturbed flights | tied | 95 % interval |")
    for method, some in grouped(rows, "method").items():
        flights = sum(len(each["disturbed"]) if each["planned"] else 5 for each in some)
        tied = sum(each.get("tied_disturbed", 0) for each in some)
        low, high = wilson_interval(tied, flights)
        lines.append(
            f"| {method} | {len(some)} | {sum(each.get('tied', False) for each in some)} "
            f"| {flights} | {tied} | {low:.2f} to {high:.2f} |"
        )
    return "\n".join(lines)


def confusion_table(rows: Rows) -> str:
    """What each model says of a subset beside what physics does with it."""
    lines = ruled(
        "| knot | model, r | open and tied | open, not tied | not open, tied | neither "
        "| tied, of the open | smallest open | smallest tied |"
    )
    for knot, of_knot in grouped(rows, "knot").items():
        tied_sizes = [len(r["supports"]) for r in of_knot if r["tied"]]
        for model in of_knot[0]["models"]:
            counts: dict[tuple[bool, bool], int] = defaultdict(int)
            for row in of_knot:
                counts[row["models"][model], row["tied"]] += 1
            open_sizes = [len(r["supports"]) for r in of_knot if r["models"][model]]
            lines.append(
                f"| {knot} | {model} | {counts[True, True]} | {counts[True, False]} "
                f"| {counts[False, True]} | {counts[False, False]} "
                f"| {_share(counts[True, True], len(open_sizes))} "
                f"| {_least(open_sizes)} | {_least(tied_sizes)} |"
            )
    return "\n".join(lines)


def lost_table(rows: Rows) -> str:
    """How often sets tie by the number of regions that `span` loses, and pairs of sets."""
    lines = ruled("| knot | regions lost | sets | tied | 95 % interval |")
    pairs = []
    for knot, of_knot in grouped(rows, "knot").items():
        tied = {frozenset(row["supports"]): row["tied"] for row in of_knot}
        for lost, group in sorted(grouped(of_knot, "regions_lost").items()):
            found = [row["tied"] for row in group]
            low, high = wilson_interval(sum(found), len(found))
            lines.append(
                f"| {knot} | {lost} | {len(found)} | {sum(found)} | {low:.2f} to {high:.2f} |"
            )
        more = [(tied[few], tied[few | {one}]) for few in tied for one in max(tied, key=len) - few]
        pairs.append(
            f"{knot}: of {len(more)} ways to add a support {more.count((False, True))} tie a set "
            f"that did not tie, {more.count((True, False))} untie one that did."
        )
    return "\n".join([*lines, "", *pairs])


def tight_table(rows: Rows) -> str:
    """One line a set that was pulled tight."""
    lines = ruled(
        "| row | method | cut | robots | ends apart, laid and pulled [m] "
        "| supports within, laid and pulled [m] | pulled for [s] | undisturbed "
        "| disturbed, tied | without the pull | tension [N] | robots apart | why it ends |"
    )
    for row in rows:
        start = f"| {row['row']} | {row['method']} | {row['cut']} | {row['robots']} "
        if not row["planned"]:
            lines.append(f"{start}| no plan: {row['why']} | | | | | | | | |")
            continue
        ends, within = (
            " to ".join(f"{each:.2f}" for each in row[key])
            for key in ("ends_apart", "supports_within")
        )
        lines.append(
            f"{start}| {ends} | {within} | {row['tightening']:.0f} | {row['undisturbed']} "
            f"| {row['tied_disturbed']} of {len(row['disturbed'])} "
            f"| {row['tied_laid']} of {len(row['disturbed'])} "
            f"| {row['largest_tension']:.2f} | {row['separation']:.2f} "
            f"| {row['why'].rpartition(': ')[2]} |"
        )
    return "\n".join(lines)


def safe_table(rows: Rows) -> str:
    """By row of Table I: smallest sets of `span` flown, and those that tie whatever the seed."""
    sets: dict[str, dict[str, list[bool]]] = defaultdict(lambda: defaultdict(list))
    for row in rows:
        if row["method"].startswith("span"):
            tied = row["planned"] and all(
                each.startswith("tied") for each in row["disturbed"][:SEEDS]
            )
            sets[row["row"]][row["method"]].append(tied)
    methods = sorted({method for by_method in sets.values() for method in by_method})
    lines = [f"| row | {' | '.join(methods)} |", "|---" * (len(methods) + 1) + "|"]
    for name, by_method in sets.items():
        cells = [f"{sum(by_method[m])} of {len(by_method[m])}" for m in methods]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    some = sum(any(any(each) for each in by_method.values()) for by_method in sets.values())
    note = f"Some smallest set ties in all of them on {some} of {len(sets)} rows."
    return "\n".join([*lines, "", note])


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The parts of the page."""
    header, rows = results.load("physics")
    parts = [
        "# Flights in physics",
        f"One machine, one core: {machine_words(header)}.",
        "Grid step 0.5 m. Sets are flown on routes that up to three rehearsals made and that were "
        "chosen by flights with other disturbances; `all` on modelled routes, in a wider file "
        "first, where one of them ties in all of those, `none` on the modelled route. Each set is "
        "on the first cut that ties with the robots apart, of the cuts whose sets are as small as "
        "the best cut's, or on the best of them; random ones are on the best cut. Disturbed "
        "flights have position errors of 1 cm (seeds 1 to 5). A flight counts as tied by its "
        "Alexander polynomial, which does not tell mirror images apart, nor 5_1 from 10_132, nor "
        "7_4 from 9_2. Robots apart: 1 is the separation asked for.",
        "## By method, Table I",
        rates_table(rows),
        "## Set by set",
        flown_table(rows),
    ]
    if (results.RESULTS / "physics_optimal.jsonl").exists():
        _, optimal = results.load("physics_optimal")
        parts += [
            "## All smallest sets of `span`, Table I",
            f"How many of the smallest sets flown tie in all of seeds 1 to {SEEDS}: at r = 0.25 "
            "all on every crossing-free cut, at r = 0.5 the one above.",
            safe_table(optimal + [row for row in rows if row["method"] == "span 0.5"]),
            "Set 1 is the canonical one.",
            flown_table(optimal),
        ]
    if (results.RESULTS / "physics_knots.jsonl").exists():
        _, knots = results.load("physics_knots")
        parts += [
            "## Knots to 7 crossings, KnotInfo's grids",
            rates_table(knots),
            flown_table(knots),
        ]
    if (results.RESULTS / "physics_subsets.jsonl").exists():
        _, subsets = results.load("physics_subsets")
        parts += [
            "## Subsets of supports on modelled routes, against the models",
            confusion_table(subsets),
            "All subsets of the turning points, 256 of 3_1 and 1,024 of 4_1; one undisturbed "
            "flight each, a set without a plan counts as not tied "
            f"({sum(row['verdict'].startswith('no plan') for row in subsets)} of them); r = any: "
            "regions are there at all; in brackets Wilson's 95 % intervals.",
            f"By the regions that `span` loses at r = {LOST_AT}:",
            lost_table(subsets),
        ]
    if (results.RESULTS / "physics_tight.jsonl").exists():
        _, tight = results.load("physics_tight")
        parts += [
            "## Pulled tight after the flight",
            "The ends fly apart along the outside, 30 m at most, which is more than any of these "
            "cables is long; the supports give way. Five disturbed flights of each plan, the "
            "laying of the knot included.",
            tight_table(tight),
        ]
    return parts, {}


def _share(tied: int, sets: int) -> str:
    if not sets:
        return "none is open"
    low, high = wilson_interval(tied, sets)
    return f"{tied / sets:.0%} ({low:.0%} to {high:.0%})"


def _least(sizes: list[int]) -> str:
    return f"{min(sizes)} supports" if sizes else "none"
