"""`knotopt atlas`: every method on every outer cut of many knots, as Parquet."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from formulations.backends import BACKENDS
from knotopt.atlas.schema import Settings
from knotopt.cli.completion import knot_names, list_of
from knotopt.cli.options import CatalogueOption, OpennessOption, given, refuse, unless_given
from knotopt.cli.printing import print_facts, print_written
from knotopt.cli.progress import progress_bar
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.atlas.engine import Engine
    from knotopt.atlas.run import Progress
    from knotopt.atlas.schema import KnotRow


def atlas(
    run_dir: Annotated[Path, typer.Argument(metavar="RUN_DIR", help="Folder of the results.")],
    knots: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="KNOT",
            autocompletion=knot_names,
            help="Knots; by default those of --catalogue.",
        ),
    ] = None,
    catalogue: CatalogueOption = False,
    knotinfo: Annotated[
        bool, typer.Option("--knotinfo", help="All 12,965 up to 13 crossings (the knotinfo extra).")
    ] = False,
    grids: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="The grids in a folder's .json and .csv files."),
    ] = None,
    span: Annotated[
        bool, typer.Option("--span", help="The smallest set of formulation span, too.")
    ] = False,
    paths: Annotated[
        bool,
        typer.Option("--paths", help="Cable paths of LCF's set and the smallest open one, too."),
    ] = False,
    solvers: Annotated[
        str | None,
        typer.Option(
            metavar="NAME,NAME...",
            autocompletion=list_of(BACKENDS),
            help=f"Solve the programs by each of these as well: {', '.join(BACKENDS)}.",
        ),
    ] = None,
    solver_limit: Annotated[
        float | None,
        unless_given(
            Settings.solver_limit, "With --solvers: time limit of each solve.", metavar="S"
        ),
    ] = None,
    physics: Annotated[
        bool,
        typer.Option(
            "--physics",
            help="Fly the sets in simulation, too (the sim extra): seconds to a minute a flight, "
            "up to 24 flights a knot.",
        ),
    ] = False,
    r: OpennessOption = None,
    seed: Annotated[
        int, typer.Option(min=0, max=2**31 - 1, metavar="N", help="Seed of the solver.")
    ] = Settings.seed,
    check: Annotated[
        int,
        typer.Option(
            min=0,
            metavar="N",
            help="Examine the sets of one knot in N by the definitions; 1: of all, 0: of none.",
        ),
    ] = Settings.check,
    jobs: Annotated[
        int | None,
        typer.Option(min=1, max=1024, metavar="N", help="Processes; by default one a core."),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="Of a Dask scheduler, whose workers then do the work."
        ),
    ] = None,
) -> None:
    """Measure baseline, LCF, LCF layered and the smallest open sets on every outer cut.

    A run that is interrupted, in whatever way, goes on when the same command is given again.
    Example: knotopt atlas atlas249 --span
    """
    from knotopt.atlas.run import run_atlas

    if solver_limit is not None and solvers is None:
        refuse("--solver-limit", "goes with --solvers")
    settings = Settings(
        str(Requirements(openness=r).openness),
        seed,
        span,
        paths,
        check,
        physics=physics,
        solvers=() if solvers is None else _solvers(solvers),
        **given(solver_limit=solver_limit),
    )
    engine = _engine(jobs, scheduler)
    listed = _list(knots, grids, catalogue=catalogue, knotinfo=knotinfo)
    for row in listed:
        check_size(row.grid_size, "atlas", **{"--span": span})
    done = 0
    try:
        with progress_bar("knots", len(listed)) as show:

            def progress(state: Progress) -> None:
                nonlocal done
                done = state.before + state.measured
                show(done)

            run_atlas(run_dir, listed, settings, engine, progress)
    except KeyboardInterrupt:
        typer.echo(
            f"knotopt: interrupted with {done} of {len(listed)} knots measured; "
            "the same command goes on from there",
            err=True,
        )
        raise typer.Exit(130) from None
    _summarise(run_dir)


def _list(
    knots: list[str] | None, grids: Path | None, *, catalogue: bool, knotinfo: bool
) -> tuple[KnotRow, ...]:
    from knotopt.atlas.knot_list import catalogue_rows, folder_rows, knot_rows

    if sum(map(bool, (knots, grids, catalogue, knotinfo))) > 1:
        refuse("KNOT...", "give one of: knots, --catalogue, --knotinfo, --grids")
    if knots:
        return knot_rows(map(read, knots))
    return folder_rows(grids, read) if grids else catalogue_rows(knotinfo=knotinfo)


def _solvers(text: str) -> tuple[str, ...]:
    """The solvers named, in one order whatever order they are named in."""
    from knotopt.supports.minimal import find_backend

    names = {name.strip() for name in text.split(",")}
    for name in sorted(names - set(BACKENDS)):
        find_backend(name)  # raises the error that lists them
    return tuple(name for name in BACKENDS if name in names)


def _engine(jobs: int | None, scheduler: str | None) -> Engine:
    from knotopt.atlas.engine import Cluster, Local

    if scheduler is not None:
        if not re.fullmatch(r"[\w.:/@\[\]-]+", scheduler):
            refuse("--scheduler", f"is an address such as tcp://host:8786, not {scheduler!r}")
        if jobs is not None:
            refuse("--jobs", "a cluster has the workers it has: give --jobs or --scheduler")
        return Cluster(scheduler)
    if jobs is None:
        from joblib import cpu_count

        jobs = cpu_count()
    return Local(jobs)


def _requested_facts(run_dir: Path) -> list[tuple[str, object]]:
    """How many programs each solver proved, and how many flights of each set tied the knot."""
    from knotopt.atlas.schema import File
    from knotopt.atlas.store import read_manifest, read_rows

    facts: list[tuple[str, object]] = []
    for name, group, held, words in (
        (File.SOLVERS, "solver", "proven", "programs proven"),
        (File.FLIGHTS, "supports", "tied", "flights that tie"),
    ):
        if name not in read_manifest(run_dir).settings.requested:
            continue
        counts: dict[str, list[bool]] = {}
        for row in read_rows(run_dir, name).select([group, held]).to_pylist():
            counts.setdefault(row[group], []).append(row[held])
        parts = [f"{each} {sum(found)} of {len(found)}" for each, found in counts.items()]
        facts.append((words, ", ".join(parts)))
    return facts


def _summarise(run_dir: Path) -> None:
    """What the atlas says on average; an error if a checker contradicts it."""
    import pyarrow.compute as pc

    from knotopt.atlas.schema import File
    from knotopt.atlas.store import read_rows
    from knotopt.errors import SolverError

    table = read_rows(run_dir, File.ATLAS)
    rows = table.num_rows

    def mean(column: str) -> str:
        value = pc.mean(table[column]).as_py()
        return "none" if value is None else f"{value:.2f}"

    def share(column: str) -> str:
        return f"{100 * pc.sum(table[column]).as_py() / rows:.1f} %"

    proven = pc.sum(pc.equal(table["opening_status"], "optimal")).as_py()
    checked = table["checked"].drop_null()
    wrong = pc.sum(pc.invert(checked)).as_py() or 0
    print_facts(
        [
            ("knots", len(pc.unique(table["number"]))),
            ("rows, one a knot and cut", rows),
            ("robots: baseline", mean("baseline")),
            ("LCF", mean("lcf_robots")),
            ("LCF layered", mean("layered_robots")),
            ("smallest open", f"{mean('opening_robots')}, proven {proven} of {rows}"),
            ("smallest open, over-under", mean("over_under_robots")),
            ("smallest span", mean("span_robots")),
            ("LCF open", share("lcf_open")),
            ("LCF below every open set", share("lcf_below")),
            ("checked by definition", f"{len(checked)} rows, {wrong} wrong"),
            *_requested_facts(run_dir),
        ]
    )
    print_written(run_dir / File.ATLAS)
    if wrong:
        raise SolverError(
            f"{wrong} rows of {run_dir / File.ATLAS} contradict the definitions: column checked"
        )
