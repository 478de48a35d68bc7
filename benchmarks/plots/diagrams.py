"""The page `diagrams.md`, from the results of the search over grid diagrams."""

from __future__ import annotations

from matplotlib.figure import Figure

from benchmarks.plots.words import machine_words, ruled
from benchmarks.results import Row, load


def speed_table(rows: list[Row]) -> str:
    """One line a knot."""
    lines = ruled("| knot | grid | moves tried a second | grids a second | without numba | ratio |")
    for row in rows:
        lines.append(
            f"| {row['knot']} | {row['size']} | {row['moves_per_second']:,} "
            f"| {row['grids_per_second']:,} "
            f"| {row['grids_per_second_plain']:,} | {row['ratio']:.0f} |"
        )
    return "\n".join(lines)


def front_table(rows: list[Row]) -> str:
    """One line a knot: the front after so many runs."""
    counts = [each["runs"] for each in rows[0]["fronts"]]
    lines = ruled(f"| knot | {' | '.join(f'runs: {count}' for count in counts)} |")
    for row in rows:
        cells = [
            "; ".join(" ".join(map(str, point)) for point in each["front"])
            + f" ({each['seconds']:.2g} s)"
            for each in row["fronts"]
        ]
        lines.append(f"| {row['knot']} | {' | '.join(cells)} |")
    return "\n".join(lines)


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The parts of the page; it has no figures."""
    header, rows = load("diagrams")
    return [
        "# Search over grid diagrams",
        f"One machine, one core: {machine_words(header)}.",
        "A run tries 10,000 moves for each line of the grid; what is no move is no grid looked at. "
        "Seconds are the processor's. Compiled and plain runs found the same.",
        speed_table(rows),
        "Fronts: robots under `loops`, crossings, grid size.",
        front_table(rows),
    ], {}
