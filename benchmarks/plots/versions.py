"""The page `versions.md`: the headline figures of every version side by side."""

from __future__ import annotations

from collections import defaultdict

from matplotlib.figure import Figure

from benchmarks import results
from benchmarks.headlines import FILE, Figures, read_versions


def versions_table(versions: list[Figures]) -> str:
    """One line a figure, one column a version."""
    cells: dict[tuple[str, str], dict[str, str]] = defaultdict(dict)
    for line in reversed(versions):  # figures in the order of the newest version that has them
        for benchmark, figure, value, count in line.figures:
            cells[benchmark, figure][line.version] = f"{value:.4g} ({count:,})"
    names = [line.version for line in versions]
    lines = [
        f"| benchmark | figure | {' | '.join(names)} |",
        f"|---|---|{'---:|' * len(names)}",
    ]
    for (benchmark, figure), by_version in cells.items():
        row = " | ".join(by_version.get(name, "-") for name in names)
        lines.append(f"| {benchmark} | {figure} | {row} |")
    return "\n".join(lines)


def machines_list(versions: list[Figures]) -> str:
    """What each version's results were measured on, with which packages."""
    lines = []
    for line in versions:
        groups: dict[str, list[str]] = defaultdict(list)
        for benchmark, facts in line.machines.items():
            told = ", ".join(f"{key} {value}" for key, value in facts.items() if key != "knotopt")
            groups[told].append(f"`{benchmark}`")
        lines += [f"- {line.version}, {', '.join(names)}: {told}" for told, names in groups.items()]
    return "\n".join(lines)


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The parts of the page."""
    versions = read_versions(results.RESULTS / FILE)
    parts = [
        "# Benchmarks by version",
        "In brackets: how many cuts, knots, flights or other cases a figure rests on. Times depend "
        "on the machine; `python -m benchmarks compare REVISION NAME` measures two revisions in "
        "turn on one.",
        versions_table(versions),
        "## Machines and packages",
        machines_list(versions),
    ]
    return parts, {}
