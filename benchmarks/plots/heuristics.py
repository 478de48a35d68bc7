"""The page `heuristics.md`, from the results of `heuristics_flown`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from matplotlib.figure import Figure

from benchmarks import results
from benchmarks.plots.words import machine_words, ruled
from benchmarks.results import grouped

Rows = list[dict[str, Any]]

PREDICTORS: dict[str, Callable[[dict[str, Any]], bool]] = {
    "any set": lambda _: True,
    "a support on every loop": lambda row: row["loops"],
    "laid": lambda row: row["laid"],
    "test A": lambda row: row["A"],
    "test C": lambda row: bool(row["C"]),
    "every loop, and C": lambda row: row["loops"] and bool(row["C"]),
    "laid, and C": lambda row: row["laid"] and bool(row["C"]),
}
"""What is said to tie."""


def prediction_table(rows: Rows) -> str:
    """Of each source, what is said to tie and what ties."""
    lines = ruled(
        "| flights | said to tie | sets | of these tied | precision | recall | others, tied |"
    )
    for source, some in grouped(rows, "source").items():
        tied = [row for row in some if row["tied"]]
        for name, says in PREDICTORS.items():
            said = [row for row in some if says(row)]
            right = sum(row["tied"] for row in said)
            lines.append(
                f"| {source} | {name} | {len(said)} | {right} | {_share(right, len(said))} "
                f"| {_share(right, len(tied))} | {len(tied) - right} of {len(some) - len(said)} |"
            )
    return "\n".join(lines)


def split_table(rows: Rows) -> str:
    """Sets by what each test says of them."""
    lines = ruled("| every loop | laid | A | C | sets | tied |")
    groups = grouped(rows, "loops", "laid", "A", "C")
    for says in sorted(groups, key=str, reverse=True):
        some = groups[says]
        words = " | ".join({True: "yes", False: "no", None: "not drawn"}[each] for each in says)
        lines.append(f"| {words} | {len(some)} | {sum(row['tied'] for row in some)} |")
    return "\n".join(lines)


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The page's parts; it has no figures."""
    header, rows = results.load("heuristics_flown")
    parts = [
        "# What the diagram says of sets, and what flights make of them",
        f"Machine: {machine_words(header)}.",
        "A set ties if its undisturbed flight does; one without a plan does not. The tests are "
        "explained in `docs/laid.md`. Sets are all those of the flights' own benchmarks.",
        prediction_table(rows),
        "All of them, by what the tests say together:",
        split_table(rows),
    ]
    return parts, {}


def _share(part: int, whole: int) -> str:
    return f"{part / whole:.2f}" if whole else "-"
