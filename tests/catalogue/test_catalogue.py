"""Looking knots up, and KnotInfo's whole table by the extra."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from knotopt.cable.alexander import alexander_polynomial, determinant
from knotopt.cable.cable import Cable
from knotopt.catalogue import knotinfo
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.errors import (
    FileFormatError,
    GridError,
    MissingExtraError,
    OutputError,
    UnknownKnotError,
)
from knotopt.reading.knot import read_knot


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty cache folder, and nothing kept in memory."""
    monkeypatch.setattr(knotinfo.platformdirs, "user_cache_path", lambda _: tmp_path)
    knotinfo.knotinfo_knots.cache_clear()
    yield tmp_path
    knotinfo.knotinfo_knots.cache_clear()


@pytest.fixture
def no_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "database_knotinfo", None)


def test_knotinfo_is_parsed_once_and_then_cached(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    knots = knotinfo.knotinfo_knots()
    assert len(knots) == 12_965
    shipped = {name: knot for name, knot in knots.items() if knot.crossing_number <= 10}
    assert shipped == shipped_knots(), "the shipped catalogue is what the extra would write"
    (stored,) = cache.iterdir()
    knotinfo.knotinfo_knots.cache_clear()
    with monkeypatch.context() as context:
        context.setattr(knotinfo, "_parse", lambda: pytest.fail("parsed again"))
        assert knotinfo.knotinfo_knots() == knots
    knotinfo.knotinfo_knots.cache_clear()
    stored.write_text(stored.read_text()[:1000])  # a damaged cache is written anew
    assert knotinfo.knotinfo_knots() == knots
    assert stored.stat().st_size > 1_000_000


def test_a_cache_that_cannot_be_written_is_done_without(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: Path, _content: str) -> None:
        raise OutputError(f"cannot write {path}: Read-only file system")

    monkeypatch.setattr(knotinfo, "write_atomically", refuse)
    monkeypatch.setattr(knotinfo, "_parse", lambda: list(shipped_knots().values()))
    with pytest.warns(UserWarning, match="not cached: cannot write"):
        assert len(knotinfo.knotinfo_knots()) == 249
    assert not list(cache.iterdir())


@pytest.mark.slow
def test_every_knot_of_knotinfo_has_its_alexander_polynomial() -> None:
    for knot in knotinfo.knotinfo_knots().values():
        polynomial = alexander_polynomial(Cable(knot.diagram, "L+"))
        assert polynomial == knot.alexander, knot.name
        assert determinant(polynomial) == knot.determinant, knot.name
        assert knot.diagram.size == knot.arc_index


@pytest.mark.parametrize(
    ("text", "coefficients"),
    [
        ("1-t+ t^2", (1, -1, 1)),
        ("-7+ 34*t-53*t^2+ 34*t^3-7*t^4", (7, -34, 53, -34, 7)),
        ("1", (1,)),
        ("1-t+ t^3-t^5+ t^6", (1, -1, 0, 1, 0, -1, 1)),
        ("2*t^10+ t^11", (2, 1)),
    ],
)
def test_polynomials_of_knotinfo(text: str, coefficients: tuple[int, ...]) -> None:
    assert knotinfo._coefficients(text) == coefficients


def test_what_a_knot_argument_may_be(tmp_path: Path) -> None:
    assert read_knot("8_19").prime_knot == shipped_knots()["8_19"]
    assert read_knot(" 8_19 ").name == "8_19"
    assert read_knot("T( 2 , 7 )").diagram.size == read_knot("t(2,-7)").diagram.size == 9
    assert read_knot("T(2,7)").name == "T(2,7)"
    for row in ("3", "4", "5", "7 Var1", "7var2", "9"):
        assert read_knot(row).source.startswith("Table I, row")
    assert read_knot("7 Var2").diagram == next(
        grid.diagram for grid in table1_grids() if grid.row == "7 Var2" and grid.preferred
    )
    path = tmp_path / "mine.csv"
    path.write_text("1,-1\n-1,1\n")
    assert read_knot(str(path)).name == "mine.csv"


@pytest.mark.parametrize("name", ["11a_1", "K12n242", "13a_4878", "13n_5110"])
def test_knots_of_the_extra(name: str) -> None:
    found = read_knot(name)
    assert found.prime_knot is not None and found.name == found.prime_knot.name
    assert found.prime_knot.crossing_number == int(found.name[:2])


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("8_22", UnknownKnotError, "no knot is named '8_22'; KnotInfo has 8_1 to 8_21"),
        ("7 Var3", UnknownKnotError, "nearest: 7 Var"),
        ("7", UnknownKnotError, "nearest: 7 Var1, 7 Var2"),
        ("11a_999", UnknownKnotError, "KnotInfo has 11a_1 to 11a_367"),
        ("zzzzzz", UnknownKnotError, "`knotopt knots` lists the names"),
        ("9" * 5000, FileFormatError, "no knot in '9999"),
        ("", FileFormatError, "there is nothing in it"),
        ("T(2,4)", GridError, "a link of 2 components"),
        ("none.json", FileFormatError, "No such file"),
    ],
)
def test_unknown_knots(text: str, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        read_knot(text)


@pytest.mark.usefixtures("no_extra", "cache")
def test_without_the_extra() -> None:
    install = r"pip install 'knotopt\[knotinfo\]'"
    with pytest.raises(MissingExtraError, match=f"knot '11a_1' needs .*{install}"):
        read_knot("11a1")
    with pytest.raises(MissingExtraError, match=install):
        knotinfo.knotinfo_knots()
    assert read_knot("10_165").diagram.size == shipped_knots()["10_165"].arc_index
    with pytest.raises(UnknownKnotError, match="KnotInfo has 10_1 to 10_165"):
        read_knot("10_166")
