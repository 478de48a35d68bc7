"""An atlas with flights in simulation: what came of them, files, a resumed run, the report."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from knotopt.atlas import flights
from knotopt.atlas.columns import FILES
from knotopt.atlas.engine import Local
from knotopt.atlas.flights import fly_set, fly_sets
from knotopt.atlas.measure import KnotResult, measure_knot
from knotopt.atlas.report.flights import OUTCOMES, agreement_table, tied_table
from knotopt.atlas.report.report import report_document
from knotopt.atlas.report.results import Results, read_results
from knotopt.atlas.run import run_atlas
from knotopt.atlas.schema import File, Settings
from knotopt.atlas.store import read_manifest, read_rows
from knotopt.cable.cable import Cable
from knotopt.document.columns import Row
from knotopt.document.markdown import markdown
from knotopt.errors import MissingExtraError, RequirementError
from knotopt.reading.knot import read_knot
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.trials import Flight, wilson_interval
from knotopt.supports.lcf import lcf
from knotopt.tables.methods import OPENING
from tests.helpers.command_line import Cli
from tests.helpers.small_atlas import LIST, Replay, contents
from tests.helpers.small_flight import small_plan, small_record

Supports = tuple[int, ...]
SETTINGS = Settings(span=True, check=0, physics=True)
PLAN = small_plan()
FLOWN = Flight(PLAN, small_record(PLAN), Verdict(Outcome.TIED, "3_1", True, True, "1 - t + t^2"))
LOST = replace(FLOWN, verdict=Verdict(Outcome.WRONG_KNOT, "unknot", False, True, "1"))


def stub(_: str, cable: Cable, supports: Supports) -> tuple[Flight | str, tuple[float, float]]:
    """Small sets do not tie; one cut has no plan for them."""
    if len(supports) > 4:
        return FLOWN, (1.0, 2.0)
    return ("no way", (1.0, 0.0)) if str(cable.cut) == "L-" else (LOST, (1.0, 2.0))


def only_row(monkeypatch: pytest.MonkeyPatch, flown: Flight | str) -> Row:
    """The row of LCF's set for the trefoil, flown like that."""
    knot = LIST[0]
    monkeypatch.setattr(flights, "fly_set", lambda *_: (flown, (1.0, 2.0)))
    programs = {OPENING: SimpleNamespace(supports=None, allows=lambda _: True)}
    (row,), _ = fly_sets(knot, lcf(Cable(knot.diagram, "L+")), programs)
    return row


@pytest.fixture(scope="module")
def found() -> dict[int, KnotResult]:
    """Results of 3_1 and 4_1, with flights that nobody simulated."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(flights, "fly_set", stub)
        return {knot.number: measure_knot(knot, SETTINGS) for knot in LIST[:2]}


@pytest.fixture
def folder(tmp_path: Path, found: dict[int, KnotResult]) -> Path:
    run_atlas(tmp_path / "run", LIST[:2], SETTINGS, Replay(found))
    return tmp_path / "run"


@pytest.fixture
def results(folder: Path) -> Results:
    return read_results(folder)


def test_a_set_that_ties(monkeypatch: pytest.MonkeyPatch) -> None:
    flown, seconds = fly_set("3_1", Cable(read_knot("3_1").diagram, "L-"), (3, 4, 5))
    assert isinstance(flown, Flight) and min(seconds) > 0
    row = only_row(monkeypatch, flown)
    assert (row["planned"], row["tied"], row["outcome"]) == (True, True, "tied")
    assert (row["verdict"], row["why"]) == ("tied: 3_1", "")
    measures = (
        row["flight_seconds"],
        row["separation"],
        row["strand_distance"],
        row["cable_length"],
    )
    assert all(value is not None and value > 0 for value in measures)


def test_a_set_without_a_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise RequirementError("no way for span 4")

    monkeypatch.setattr(flights, "plan_flight", refuse)
    flown, seconds = fly_set("3_1", Cable(read_knot("3_1").diagram, "L-"), (3,))
    assert flown == "no way for span 4" and seconds[0] > seconds[1] == 0
    row = only_row(monkeypatch, flown)
    assert (row["planned"], row["tied"], row["why"]) == (False, False, "no way for span 4")
    assert row["outcome"] is row["flight_seconds"] is row["tension"] is row["separation"] is None


def test_a_flight_that_cannot_be_examined(monkeypatch: pytest.MonkeyPatch) -> None:
    broken = replace(LOST.record, cable=np.full_like(LOST.record.cable, np.nan))
    row = only_row(monkeypatch, replace(LOST, record=broken))
    assert (row["planned"], row["separation"], row["why"]) == (
        True,
        None,
        "the simulation broke down",
    )


def test_rows(folder: Path, found: dict[int, KnotResult]) -> None:
    rows, times = (
        read_rows(folder, name).to_pylist() for name in (File.FLIGHTS, File.FLIGHT_TIMES)
    )
    kinds = ["lcf", "opening", "span"] * 16
    assert [row["supports"] for row in rows] == [row["supports"] for row in times] == kinds
    atlas = [row for number in (1, 2) for row in found[number].rows]
    for row, measured in zip(rows, [each for each in atlas for _ in range(3)], strict=True):
        assert (row["knot"], row["cut"]) == (measured["knot"], measured["cut"])
        assert row["robots"] == measured[f"{row['supports']}_robots"]
        if row["supports"] == "lcf":
            assert row["opening_open"] == measured["lcf_open"]
        assert row["opening_open"] or row["supports"] != "opening"
        assert row["span_open"] or row["supports"] != "span"
        assert row["planned"] or row["cut"] == "L-"
    assert {row["span_open"] for row in rows} == {True, False}
    for name in (File.FLIGHTS, File.FLIGHT_TIMES):
        schema = read_rows(folder, name).schema
        for column in FILES[name]:
            assert schema.field(column.name).metadata[b"meaning"].decode() == column.meaning
    assert {"mujoco", "scipy"} < set(read_manifest(folder).versions)


def test_equal_sets_fly_once(monkeypatch: pytest.MonkeyPatch) -> None:
    flown: list[tuple[str, Supports]] = []

    def count(_: str, cable: Cable, supports: Supports) -> tuple[Flight, tuple[float, float]]:
        flown.append((str(cable.cut), supports))
        return FLOWN, (1.0, 2.0)

    monkeypatch.setattr(flights, "fly_set", count)
    result = measure_knot(LIST[0], SETTINGS)
    assert len(flown) == len(set(flown)) < 24
    times = result.requested[File.FLIGHT_TIMES]
    assert sum(row["simulation_seconds"] > 0 for row in times) == len(flown)
    assert len(times) == len(result.requested[File.FLIGHTS]) == 24


def test_resumed(tmp_path: Path, folder: Path, found: dict[int, KnotResult]) -> None:
    half = tmp_path / "half"
    with pytest.raises(KeyboardInterrupt):
        run_atlas(half, LIST[:2], SETTINGS, Replay(found, 1, KeyboardInterrupt()))
    engine = Replay(found)
    run_atlas(half, LIST[:2], SETTINGS, engine)
    assert engine.asked == [1]
    assert contents(half) == contents(folder)


def test_tied_table(results: Results) -> None:
    table = tied_table(results)
    for words, kind in (("LCF", "lcf"), ("`opening`", "opening"), ("`span`", "span")):
        for name, knots in (("3", {"3_1"}), ("4", {"4_1"}), ("all", {"3_1", "4_1"})):
            (row,) = [r for r in table.rows if r[:2] == (name, words)]
            sets = [
                each
                for each in results.flights
                if each["supports"] == kind and each["knot"] in knots
            ]
            flown = [each for each in sets if each["planned"]]
            tied = sum(each["tied"] for each in flown)
            assert row[2:5] == (str(len(sets)), str(len(flown)), str(tied))
            low, high = wilson_interval(tied, len(flown))
            assert row[6] == f"{100 * low:.0f} to {100 * high:.0f} %"
            assert sum(map(int, row[-len(OUTCOMES) :])) + tied == len(flown)


def test_agreement_table(results: Results) -> None:
    rows = agreement_table(results).rows
    assert [row[:2] for row in rows] == [
        (kind, model)
        for kind in ("LCF", "`opening`", "`span`")
        for model in ("`opening`", "`span`")
    ]
    for row in rows:
        counts = [*map(int, row[3:7])]
        assert sum(counts) == int(row[2])
        assert row[7] == f"{100 * (counts[0] + counts[3]) / sum(counts):.1f} %"
    assert rows[2][5:7] == ("0", "0")  # what is smallest by `opening` is open by it
    without = replace(results)
    without.__dict__["flights"] = [{**row, "span_open": None} for row in results.flights]
    assert {row[1] for row in agreement_table(without).rows} == {"`opening`"}


def test_section(results: Results) -> None:
    text = markdown(report_document(results, {}))
    assert "## Flights" in text
    assert "Planning took 1.0 s a set (median), simulating 2.0 s." in text
    unplanned = replace(results)
    unplanned.__dict__["flights"] = [
        {**row, "planned": False, "tied": False, "simulation_seconds": 0.0}
        for row in results.flights
    ]
    text = markdown(report_document(unplanned, {}))
    assert "Planning took 1.0 s a set (median)." in text
    assert tied_table(unplanned).rows[0][3:7] == ("0", "0", "–", "–")
    assert agreement_table(unplanned).rows == ()


def test_missing_extra(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    status, output, errors = cli("atlas", tmp_path / "run", "3_1", "--physics")
    assert (status, output) == (1, "")
    assert "needs mujoco, which is not installed" in errors
    assert "pip install 'knotopt[sim]'" in errors
    with pytest.raises(MissingExtraError):
        run_atlas(tmp_path / "run", LIST[:1], SETTINGS, Local())
    assert not (tmp_path / "run").exists()


def test_summary(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flights, "fly_set", stub)
    status, output, _ = cli("atlas", tmp_path / "run", "3_1", "--jobs", 1, "--physics")
    assert status == 0
    assert "flights that tie" in output
    assert "lcf 0 of 8, opening 0 of 8" in output


@pytest.mark.slow
def test_the_same_bytes_every_time(tmp_path: Path) -> None:
    settings = Settings(check=0, physics=True)
    for name in ("one", "other"):
        run_atlas(tmp_path / name, LIST[:1], settings, Local(1 if name == "one" else 2))
    one, other = ((tmp_path / name / File.FLIGHTS).read_bytes() for name in ("one", "other"))
    assert one == other
    rows = read_rows(tmp_path / "one", File.FLIGHTS).to_pylist()
    assert {row["outcome"] for row in rows} == {"tied", "wrong knot"}
    assert all(row["why"] for row in rows if not row["tied"])
