"""The figures that a version is judged by, kept version by version.

`record` takes them from the results into one line of `versions.jsonl`.
"""

from __future__ import annotations

import importlib.metadata
import json
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import mean, median
from typing import Any

from benchmarks import results
from benchmarks.physics import KNOT_METHODS, METHODS, OPTIMAL_METHOD, SEEDS
from benchmarks.results import SMALL, SPEED_AT, Row
from knotopt.atlas.report.performance import shifted_geometric_mean
from knotopt.errors import FileFormatError
from knotopt.files import write_atomically

FILE = "versions.jsonl"
Values = Callable[[Row], Iterable[float]]
Facts = dict[str, Any]


@dataclass(frozen=True)
class Headline:
    """One figure.

    Attributes
    ----------
    benchmark : str
        Whose results it is of.
    figure : str
        What it says, with its unit in brackets.
    values : callable
        What a record of the results, case and result in one, contributes.
    summary : callable
        All contributions to the figure.
    """

    benchmark: str
    figure: str
    values: Values
    summary: Callable[[list[float]], float] = median


@dataclass(frozen=True)
class Figures:
    """The figures of one version: a line of `versions.jsonl`.

    Attributes
    ----------
    version : str
    figures : list of (str, str, float, int)
        Benchmark, figure, its value, and how many measurements it rests on.
    machines : dict
        Benchmark to the facts of the machine that it ran on.
    """

    version: str
    figures: list[tuple[str, str, float, int]]
    machines: dict[str, Facts]


def percent(values: list[float]) -> float:
    """Share of what is true [%]."""
    return 100 * mean(values)


def _where(key: str, unit: float = 1, **case: Any) -> Values:
    """A result in some unit, of the cases that are as given."""
    return lambda row: (
        [row[key] / unit] if all(row[name] == value for name, value in case.items()) else []
    )


def _at_arc_index(form: str) -> Values:
    return lambda row: [number >= len(row[form]["larger"]) for number in range(row["knots"])]


def _grid_times(form: str) -> Values:
    return lambda row: row[form]["milliseconds"]


def _of_cuts(key: str) -> Values:
    return lambda row: [cut[key] for cut in row["cuts"].values()]


def _of_paths(supports: str, value: Callable[[Row], float], most: float = float("inf")) -> Values:
    """Of the program's paths on grids up to a size."""
    return lambda row: [
        value(path)
        for path in row["paths"]
        if row["grid_size"] <= most and (path["supports"], path["method"]) == (supports, "nlp")
    ]


def _flights(method: str) -> Values:
    """Whether each disturbed flight tied; without a plan none does."""

    def tied(row: Row) -> list[bool]:
        if row["method"] != method:
            return []
        return [number < row.get("tied_disturbed", 0) for number in range(len(SEEDS))]

    return tied


def _open_by(model: str) -> Values:
    """Whether each subset that a model calls open tied."""
    return lambda row: [row["tied"]] if row["models"][model] else []


def _solved(formulation: str) -> Values:
    return lambda row: [
        run["seconds"]
        for run in row["runs"]
        if (row["formulation"], run["solver"]) == (formulation, "cp-sat")
    ]


MS = 1e-3  # [s]
HEADLINES = (
    Headline("startup", "`knotopt --help` [s]", _where("seconds", arguments=["--help"])),
    Headline("startup", "`knotopt table1` [s]", _where("seconds", arguments=["table1"])),
    *(
        headline
        for form, made_from in (("planar", "PD codes"), ("braid", "braid words"))
        for headline in (
            Headline(
                "grids_catalogue",
                f"grids from {made_from} at the arc index [%]",
                _at_arc_index(form),
                percent,
            ),
            Headline(
                "grids_catalogue",
                f"a grid from {made_from} [ms, median]",
                _grid_times(form),
            ),
        )
    ),
    Headline(
        "identified", "knots named right, of diagrams moved about [%]", _where("named"), percent
    ),
    Headline("identified", "to name a knot [ms, median]", _where("seconds", MS)),
    Headline(
        "lcf_catalogue",
        f"LCF at N = {SPEED_AT}, a cut [ms, median]",
        _where("ms_per_cut", grid_size=SPEED_AT),
    ),
    Headline("lcf_growth", "LCF at N = 100 [s, worst]", _where("seconds", size=100), max),
    Headline("lcf_growth", "LCF at N = 100 [MiB, worst]", _where("mebibytes", size=100), max),
    Headline("formulations", "LCF, a cut [robots, mean]", _of_cuts("lcf"), mean),
    Headline("formulations", "LCF's set open [% of cuts]", _of_cuts("lcf_open"), percent),
    *(
        Headline("formulations", f"`{name}`, {figure}", _of_cuts(name + key), summary)
        for name in ("opening", "span")
        for figure, key, summary in (
            ("a cut [robots, mean]", "", mean),
            ("proven [% of cuts]", "_proven", percent),
            ("a cut [ms, median]", "_ms", median),
            ("a cut [ms, worst]", "_ms", max),
        )
    ),
    Headline("loops", "`loops`, a cut [robots, mean]", _of_cuts("loops"), mean),
    Headline("loops", "sweep, a cut [ms, worst]", _of_cuts("sweep_ms"), max),
    Headline(
        "loops",
        "CP-SAT's time over the sweep's with its rows [median]",
        lambda row: [c["cp_sat_ms"] / c["rows_and_sweep_ms"] for c in row["cuts"].values()],
    ),
    *(
        Headline(
            "formulations_growth",
            f"`{name}` to compile at N = {size} [s, worst]",
            _where("compile_seconds", formulation=name, family="random", size=size),
            max,
        )
        for name, size in (("opening", 60), ("span", 24))
    ),
    Headline(
        "solvers", "disagreements on the optimum", lambda row: [len(row["disagreements"])], sum
    ),
    *(
        Headline(
            "solvers",
            f"CP-SAT on `{name}` [ms, shifted geometric mean]",
            _solved(name),
            lambda times: shifted_geometric_mean(times) / MS,
        )
        for name in ("opening", "span")
    ),
    Headline("certificates", "to prove all [s]", _where("prove_seconds"), sum),
    Headline("certificates", "to check all [s]", _where("check_seconds"), sum),
    *(
        Headline("paths", f"program on {whose}: {figure}", _of_paths(supports, *which), summary)
        for whose, supports in (("LCF's sets", "lcf"), ("the smallest sets", "opening"))
        for figure, which, summary in (
            ("solved [%]", [lambda path: path["status"] == "solved"], percent),
            ("length over the taut string's [median]", [lambda path: path["stretch"]], median),
            (f"time at N <= {SMALL} [ms, median]", [lambda p: p["milliseconds"], SMALL], median),
        )
    ),
    *(
        Headline("physics", f"disturbed flights tied, {method} [%]", _flights(method), percent)
        for method in METHODS
    ),
    *(
        Headline(name, f"disturbed flights tied, {method} [%]", _flights(method), percent)
        for name, methods in (
            ("physics_knots", KNOT_METHODS),
            ("physics_optimal", [OPTIMAL_METHOD]),
        )
        for method in methods
    ),
    *(
        Headline(
            "physics_subsets",
            f"tied, of the subsets open by `{name}` [%]",
            _open_by(name),
            percent,
        )
        for name in ("opening 0.25", "span 0.25")
    ),
    Headline(
        "physics_tight",
        "disturbed flights tied when pulled tight, of sets that tie [%]",
        lambda row: (
            [verdict.startswith("tied") for verdict in row["disturbed"]]
            if row["planned"] and row["tightening"]
            else []
        ),
        percent,
    ),
    Headline(
        "topology_growth",
        "all states of 5 crossings, up to symmetry [s]",
        _where("seconds", crossings=5, canonical=True),
    ),
    *(
        Headline("topology_planning", f"all plans to {goal} [ms]", _where("seconds", MS, goal=goal))
        for goal in ("3_1", "10_123")
    ),
    Headline(
        "topology_extraction",
        "the state of 64 points on a smooth curve [ms, median]",
        _where("seconds", MS, curve="smooth", points=64),
    ),
)


def record() -> tuple[Figures, dict[str, str]]:
    """Keep the figures of the installed version, in place of those it had before.

    Returns
    -------
    figures : Figures
    left_out : dict of str to str
        Benchmarks whose results are missing or are not of this version, and why.

    Raises
    ------
    FileFormatError
        A file of results, or the one of versions, is damaged; or there is nothing to record.
    OutputError
        The file cannot be written.
    """
    version = importlib.metadata.version("knotopt")
    path = results.RESULTS / FILE
    kept = {line.version: line for line in read_versions(path)}
    figures: list[tuple[str, str, float, int]] = []
    machines: dict[str, Facts] = {}
    left_out: dict[str, str] = {}
    for benchmark in dict.fromkeys(headline.benchmark for headline in HEADLINES):
        chosen = [headline for headline in HEADLINES if headline.benchmark == benchmark]
        try:
            header, rows = results.load(benchmark)
            measured = header["machine"]["knotopt"]
            if header["smoke"] or measured != version:
                left_out[benchmark] = "a smoke run" if header["smoke"] else f"of {measured}"
                continue
            figures += [_figure(headline, rows) for headline in chosen]
            machines[benchmark] = header["machine"]
        except FileNotFoundError:
            left_out[benchmark] = "no results"
        except (ValueError, TypeError, KeyError) as error:
            raise FileFormatError(f"{benchmark}.jsonl is damaged or outdated: {error!r}") from error
    if not figures:
        raise FileFormatError(f"no results of version {version} in {results.RESULTS}")
    kept[version] = Figures(version, figures, machines)
    write_atomically(path, "".join(f"{json.dumps(asdict(line))}\n" for line in kept.values()))
    return kept[version], left_out


def _figure(headline: Headline, rows: list[Row]) -> tuple[str, str, float, int]:
    values = [value for row in rows for value in headline.values(row)]
    if not values:
        raise ValueError(f"nothing to make {headline.figure!r} of")
    value = float(f"{headline.summary(values):.6g}")
    return headline.benchmark, headline.figure, value, len(values)


def read_versions(path: Path) -> list[Figures]:
    """The versions recorded so far, oldest first; none where there is no file.

    Raises
    ------
    FileFormatError
        A line is damaged.
    """
    lines = path.read_bytes().splitlines() if path.exists() else []
    found = []
    for number, line in enumerate(lines, 1):
        try:
            content = json.loads(line)
            content["figures"] = [
                (str(benchmark), str(figure), float(value), int(count))
                for benchmark, figure, value, count in content["figures"]
            ]
            found.append(Figures(**content))
        except (ValueError, TypeError, KeyError) as error:
            raise FileFormatError(f"{path}, line {number} is damaged: {error}") from error
    return found
