"""`knotopt solve --verify-physics`: sets are flown until one ties the knot."""

from __future__ import annotations

import importlib.metadata
import json
import sys
from dataclasses import dataclass, fields
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from knotopt.cli.options import check_suffix, given, refuse, run_header, unless_given
from knotopt.cli.progress import status_line
from knotopt.cli.solve_flown_printing import flown_json
from knotopt.rehearsal.flight_tests import FlightTests

if TYPE_CHECKING:
    from collections.abc import Callable

    from formulations.solution import Limits
    from knotopt.reading.record import NamedDiagram
    from knotopt.rehearsal.cut_off import CutOff, FlownResult
    from knotopt.supports.requirements import Requirements

NoiseOption = Annotated[
    float | None,
    unless_given(
        FlightTests.noise, "Of the robots' positions in disturbed flights [m].", metavar="M"
    ),
]
TrialsOption = Annotated[
    int | None,
    unless_given(
        FlightTests.trials,
        "Disturbed flights that a set must tie in, beside the undisturbed one.",
    ),
]
PhysicsBudgetOption = Annotated[
    float | None,
    typer.Option(help="Fly no further set after so many seconds.", metavar="S"),
]
MaxCutOption = Annotated[
    int | None,
    unless_given(
        f"{FlightTests.MAX_CUT} unless a budget is given",
        "Fly no further set once so many are cut off.",
    ),
]


@dataclass(frozen=True)
class FlightOptions:
    """The options of the flights; None for what is not given."""

    noise: float | None
    trials: int | None
    seconds: float | None
    max_cut: int | None
    out: Path | None

    def check_unused(self) -> None:
        """Without flights none of them makes sense."""
        names = {"seconds": "--physics-budget", "max_cut": "--max-cut"}
        for name in given(**vars(self)):
            refuse(names.get(name, f"--{name}"), "goes with --verify-physics")

    def tests(self) -> FlightTests:
        """What sets are put to."""
        return FlightTests(
            **given(**{each.name: getattr(self, each.name) for each in fields(FlightTests)})
        )


class _UnfinishedError(Exception):
    """The search ended at a limit: a later run may go on."""


def fly_sets(
    named: NamedDiagram,
    asked: Requirements,
    cut: str,
    options: FlightOptions,
    *,
    laid: bool,
    solver: str,
    limits: Limits,
) -> FlownResult:
    """Fly sets until one ties the knot; write the answer to the file asked for."""
    from knotopt.cable.cut import Cut
    from knotopt.laid.smallest import LaidCuts
    from knotopt.rehearsal.cut_off import solve_flown
    from knotopt.sim.simulators import MUJOCO

    check_suffix(options.out, "the answer is", (".json",))
    MUJOCO.require()
    tests = options.tests()

    cuts = None if cut == "best" else [Cut.parse(cut, named.diagram.size)]
    knot = named.name, named.diagram
    search = partial(
        solve_flown,
        *knot,
        asked,
        tests,
        cuts=cuts,
        lacks=LaidCuts() if laid else None,
        solver=solver,
        limits=limits,
    )
    with status_line("solving", lasting="set "):
        if options.out is None:
            return search()
        versions = [importlib.metadata.version(each) for each in ("knotopt", MUJOCO.package)]
        settings = [
            "verify-physics" + laid * " laid",
            repr(asked),
            cut,
            tests.noise,
            tests.trials,
            versions,
        ]
        header = run_header("solve", settings, [named])
        return _search_into(options.out, header, named, search)


def _search_into(
    out: Path, header: str, named: NamedDiagram, search: Callable[..., FlownResult]
) -> FlownResult:
    """Search from where a former run stopped, keep what is cut off, and write the answer."""
    from knotopt.files import resumable_lines, write_atomically
    from knotopt.rehearsal.cut_off import CutOff, FlownStatus

    found: list[FlownResult] = []

    def text(_: list[str]) -> str:
        return json.dumps(flown_json(named, found[0]), indent=1) + "\n"

    done = 0
    try:
        with resumable_lines(out, header, text) as lines:
            known = tuple(CutOff.from_json(json.loads(line)) for line in lines.done)
            done = len(known)
            if known:
                _note(f"cut off before, from {out}.partial: {_sets(done)}")

            def keep(each: CutOff) -> None:
                nonlocal done
                lines.write(json.dumps(each.to_json()))
                done += 1

            found.append(search(known=known, on_cut_off=keep))
            if found[0].status in (FlownStatus.BUDGET, FlownStatus.UNKNOWN):
                raise _UnfinishedError
    except _UnfinishedError:
        write_atomically(out, text([]))
        _note(f"{_sets(done)} cut off: {out}.partial; with a larger budget it goes on from there")
    except KeyboardInterrupt:
        if done:
            _note(
                f"stopped, {_sets(done)} cut off: {out}.partial; "
                "the same command goes on from there"
            )
        raise
    return found[0]


def _sets(count: int) -> str:
    return "1 set" if count == 1 else f"{count} sets"


def _note(text: str) -> None:
    print(text, file=sys.stderr)
