"""`python -m benchmarks run [NAME ...]`: measure, and write one JSON line per case.

A run that is interrupted leaves NAME.jsonl.partial and continues from it when started again; the
results land under their final name when the benchmark is complete.
"""

from __future__ import annotations

import importlib.metadata
import json
import os
import platform
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

import typer
from joblib import Parallel, delayed
from rich.progress import track

from benchmarks import (  # noqa: F401 -- they register themselves
    certificates,
    diagrams,
    formulations_catalogue,
    formulations_growth,
    grids_catalogue,
    heuristics_flown,
    identified,
    lcf_catalogue,
    lcf_growth,
    loops,
    paths_catalogue,
    paths_growth,
    paths_stiffness,
    paths_tradeoff,
    physics,
    physics_fewest,
    physics_safe,
    physics_subsets,
    physics_tight,
    solvers,
    startup,
    topology,
    topology_extraction,
)
from benchmarks.compare import compare
from benchmarks.registry import BENCHMARKS, Benchmark, Case
from benchmarks.results import RESULTS
from knotopt.cli.options import FormatOption, PictureFormat
from knotopt.errors import KnotoptError
from knotopt.files import resumable_lines

CPUINFO = Path("/proc/cpuinfo")  # of Linux, where Python does not know the processor's model
app = typer.Typer(help=__doc__, no_args_is_help=True, pretty_exceptions_enable=False)


@app.command("list")
def list_benchmarks() -> None:
    """Name every benchmark and what it measures."""
    for benchmark in BENCHMARKS.values():
        print(f"{benchmark.name:20} {benchmark.about}")


@app.command()
def run(
    names: Annotated[list[str] | None, typer.Argument(help="By default all of them.")] = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = RESULTS,
    smoke: Annotated[bool, typer.Option("--smoke", help="A few small cases each.")] = False,
    jobs: Annotated[
        int, typer.Option(min=1, help="Cases at a time; times are to be measured one at a time.")
    ] = 1,
) -> None:
    """Run benchmarks and write their results as JSON lines."""
    chosen = _named(names)
    out.mkdir(parents=True, exist_ok=True)
    for benchmark in chosen:
        print(f"written: {run_benchmark(benchmark, out, smoke=smoke, jobs=jobs)}")


@app.command("compare")
def compare_revisions(
    revision: Annotated[str, typer.Argument(help="To compare with, as git names it.")],
    names: Annotated[list[str], typer.Argument(help="Benchmarks.")],
    smoke: Annotated[bool, typer.Option("--smoke", help="A few small cases each.")] = False,
    repeats: Annotated[int, typer.Option(min=1, help="Of each case; the fastest counts.")] = 3,
) -> None:
    """Measure this tree and another revision in turn: ratios of their costs, and what changed."""
    chosen = _named(names)
    try:
        found = compare(revision, chosen, smoke=smoke, repeats=repeats)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error
    print(f"| benchmark | cost | cases | this over {revision} | least | most |")
    print("|---|---|---|---|---|---|")
    for each in found.ratios:
        print(
            f"| {each.benchmark} | {each.cost} | {each.cases} "
            f"| {each.mean:.3f} | {each.least:.3f} | {each.most:.3f} |"
        )
    for name in found.missing:
        print(f"{name} is not among the benchmarks of {revision}")
    for name, case in found.changed:
        print(f"other results than at {revision}: {name}, {json.dumps(case)}")


@app.command()
def plot(picture_format: FormatOption = PictureFormat.PNG) -> None:
    """Write pages, figures and the table of versions from the results, beside them."""
    from benchmarks.plots.pages import write_pages

    write_pages(f".{picture_format}")


@app.command()
def record() -> None:
    """Keep this version's headline figures; its earlier ones are replaced."""
    from benchmarks import headlines

    try:
        kept, left_out = headlines.record()
    except KnotoptError as error:
        raise typer.BadParameter(str(error)) from error
    for benchmark, why in left_out.items():
        print(f"left out: {benchmark}, {why}")
    print(f"kept: {len(kept.figures)} figures of version {kept.version}")


@app.command()
def flown() -> None:
    """Write the catalogue of the smallest teams that fly, from the stored flights."""
    from benchmarks.flown import write_catalogue

    print(f"written: {write_catalogue()}")


def _named(names: list[str] | None) -> list[Benchmark]:
    """The benchmarks of these names, or all."""
    chosen = names or list(BENCHMARKS)
    unknown = [name for name in chosen if name not in BENCHMARKS]
    if unknown:
        raise typer.BadParameter(f"no benchmark is named {unknown[0]!r}: {', '.join(BENCHMARKS)}")
    return [BENCHMARKS[name] for name in chosen]


def run_benchmark(benchmark: Benchmark, out: Path, *, smoke: bool = False, jobs: int = 1) -> Path:
    """Measure every case not yet in the partial file; return the path of the complete one."""
    final = out / f"{benchmark.name}.jsonl"
    header = {"benchmark": benchmark.name, "smoke": smoke, "machine": machine_facts()}

    cases = list(benchmark.cases(smoke))
    order = {json.dumps(case): number for number, case in enumerate(cases)}

    def finish(lines: list[str]) -> str:
        rows = sorted(lines, key=lambda line: order[_case(line)])
        return "".join(f"{line}\n" for line in (json.dumps(header), *rows))

    with resumable_lines(final, json.dumps(header), finish) as lines:
        done = {_case(line) for line in lines.done}
        left = [case for case in cases if json.dumps(case) not in done]
        measured = Parallel(jobs, return_as="generator_unordered")(
            delayed(_measured)(benchmark, case) for case in left
        )
        for line in track(measured, benchmark.name, len(left)):
            lines.write(line)
    return final


def _measured(benchmark: Benchmark, case: Case) -> str:
    return json.dumps({"case": case, "result": benchmark.measure(case)})


def _case(line: str) -> str:
    return json.dumps(json.loads(line)["case"])


def machine_facts() -> dict[str, Any]:
    """What the times depend on."""
    packages = (
        "knotopt",
        "numpy",
        "scipy",
        "ortools",
        "cvxpy",
        "highspy",
        "pyscipopt",
        "python-sat",
        "casadi",
        "pythoncdt",
        "shapely",
        "mujoco",
        "numba",
    )
    processor = _processor()
    return {
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        **({"processor": processor} if processor else {}),
        "cores": os.cpu_count(),
        **{package: importlib.metadata.version(package) for package in packages},
    }


def _processor() -> str:
    """Model of the processor; "" where the system does not say."""
    with suppress(OSError):
        for line in CPUINFO.read_text(encoding="utf-8").splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                return value.strip()
    return platform.processor()


if __name__ == "__main__":
    app()
