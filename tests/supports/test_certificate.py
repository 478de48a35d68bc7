"""Certificates: accepted as written, rejected when anything in them is changed."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings

from formulations.solution import Limits
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import CertificateError, MissingExtraError, RequirementError
from knotopt.reading.knot import read_knot
from knotopt.supports.certificate import prove
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from knotopt.verify import cable as verify_cable
from knotopt.verify.certificate import check_certificate
from tests.helpers.strategies import diagrams

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def certificate() -> str:
    return prove("5_1", read_knot("5").diagram)


@settings(max_examples=200)
@given(diagrams(max_size=12))
def test_the_checkers_cables_are_the_cables(diagram: GridDiagram) -> None:
    marks = list(diagram.marks)
    cuts = crossing_free_cuts(diagram)
    assert verify_cable.crossing_free_cuts(marks) == {str(cut) for cut in cuts}
    for cut in cuts:
        assert verify_cable.cable_path(marks, str(cut)) == list(Cable(diagram, cut).path)


def test_a_certificate_is_accepted(certificate: str) -> None:
    verdict = check_certificate(certificate)
    assert (verdict.knot, verdict.robots, verdict.cuts) == ("5_1", 6, 8) and verdict.every_cut
    assert verdict.robots == best_supports(read_knot("5").diagram).best.robots


@pytest.mark.parametrize("name", ["3_1", "7_4", "8_19", "10_124", "10_161"])
def test_certificates_of_knots(name: str) -> None:
    diagram = shipped_knots()[name].diagram
    for asked in (
        Requirements(),
        Requirements(openness=0.25, threading="over-under"),
        Requirements("span"),
        Requirements("span", with_loops=False),
        Requirements("loops"),
    ):
        verdict = check_certificate(prove(name, diagram, asked))
        assert verdict.robots == best_supports(diagram, asked).best.robots and verdict.every_cut


def test_certificates_of_one_cut_and_by_counting(monkeypatch: pytest.MonkeyPatch) -> None:
    diagram = read_knot("3").diagram
    verdict = check_certificate(prove("3_1", diagram, cuts=[Cut.parse("T-", 5)]))
    assert (verdict.cut, verdict.cuts, verdict.every_cut) == ("T-", 1, False)
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)  # no PySAT
    for formulation in ("opening", "span"):
        counted = prove("3_1", diagram, Requirements(formulation), method="count")
        assert check_certificate(counted).formulation == formulation
    with pytest.raises(MissingExtraError, match=r"a refutation needs python-sat.*\[sat\]"):
        prove("3_1", diagram)


def test_what_cannot_be_certified() -> None:
    diagram = read_knot("7 Var1").diagram
    with pytest.raises(RequirementError, match="leave out the other options"):
        prove("7_2", diagram, Requirements(payload=5))
    with pytest.raises(CertificateError, match="smaller sets are too many to count"):
        prove("7_2", diagram, method="count")


def _set(key: str, value: Any) -> Callable[[dict[str, Any]], None]:
    return lambda content: content.__setitem__(key, value)


def _without(key: str) -> Callable[[dict[str, Any]], None]:
    return lambda content: content.pop(key)


def _fewer(content: dict[str, Any]) -> None:
    content["robots"] -= 1
    content["supports"].pop()


def _more(content: dict[str, Any]) -> None:
    """A set that is open but not smallest: the refutations are of one robot fewer than claimed."""
    content["robots"] += 1
    content["supports"] = sorted({*content["supports"], 3})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_fewer, "the set is not open"),
        (_more, "does not follow"),
        (_set("robots", 5), "are not 5"),
        (_set("supports", [5, 6, 7, 7]), "not distinct"),
        (_set("supports", [1, 6, 7, 8]), "between the cable's ends"),
        (_set("supports", [5, 6, 7, "8"]), "'8' is no integer"),
        (_set("supports", [3, 4, 9, 10]), "the set is not open"),
        (_set("openness", "1"), "the set is not open"),
        (_set("openness", "2/1"), "does not lie in"),
        (_set("openness", "x"), "is no fraction"),
        (_set("openness", "1e-2000000"), "is no fraction"),
        (_set("openness", 0.5), "not of type str"),
        (_set("threading", "never"), "no formulation"),
        (_set("formulation", "span"), "the set is not open"),
        (_set("cut", "R+"), "the set is not open"),
        (_set("cut", "col3+"), "'col3.' is no crossing-free cut"),
        (_set("cut", "X"), "'X' is no crossing-free cut"),
        (lambda c: c["bounds"].append({**c["bounds"][0], "cut": "col1+"}), "is no crossing-free"),
        (_set("format", "x"), "not a certificate"),
        (_set("bounds", []), "own cut is missing"),
        (_set("every_cut", 1), "not of type bool"),
        (_set("grid", [[1, 1], [1, 2], [2, 1], [2, 3]]), "grid: not two marks"),
        (_set("grid", [[1, 1, 1]]), "is not .column, row."),
        (_without("grid"), "key 'grid' is missing"),
        (_without("every_cut"), "key 'every_cut' is missing"),
        (lambda c: c["bounds"].pop(), "none is given for T-"),
        (lambda c: c["bounds"].append(c["bounds"][0]), "a cut comes twice"),
        (lambda c: c["bounds"][3].update(cut="L+"), "a cut comes twice"),
        (lambda c: c["bounds"][3].update(steps=c["bounds"][4]["steps"]), "step"),
        (lambda c: c["bounds"][3].update(clauses=c["bounds"][4]["clauses"]), "does not follow"),
        (lambda c: c["bounds"][2].update(method="trust"), "no method 'trust'"),
        (lambda c: c["bounds"][2].update(clauses=3), "not of type list"),
        (lambda c: c["bounds"][2]["steps"].insert(0, [1]), "not .clause, hints."),
        (lambda c: c["bounds"][2]["steps"].pop(), "not the empty clause"),
        (lambda c: c["bounds"][2]["clauses"].append([2]), "does not follow from the diagram"),
    ],
)
def test_changed_certificates_are_rejected(
    certificate: str, change: Callable[[dict[str, Any]], Any], message: str
) -> None:
    content = json.loads(certificate)
    change(content)
    with pytest.raises(CertificateError, match=message):
        check_certificate(json.dumps(content))


def test_every_changed_number_of_a_refutation_is_noticed(certificate: str) -> None:
    """Each literal flipped, each clause or step dropped; what is still a proof may pass."""
    content = json.loads(certificate)
    bound = content["bounds"][0]
    content["bounds"], content["every_cut"] = [bound], False
    check_certificate(json.dumps(content))
    for number, clause in enumerate(bound["clauses"]):
        for position in range(len(clause)):
            clause[position] *= -1
            with pytest.raises(CertificateError):
                check_certificate(json.dumps(content))
            clause[position] *= -1
        dropped = bound["clauses"].pop(number)
        with pytest.raises(CertificateError):
            check_certificate(json.dumps(content))
        bound["clauses"].insert(number, dropped)
    for number in range(len(bound["steps"])):
        dropped = bound["steps"].pop(number)
        with pytest.raises(CertificateError):
            check_certificate(json.dumps(content))
        bound["steps"].insert(number, dropped)


def test_torn_files_are_rejected(certificate: str) -> None:
    for length in (0, 1, 100, len(certificate) // 2, len(certificate) - 2):
        with pytest.raises(CertificateError, match="not JSON, or cut off"):
            check_certificate(certificate[:length])
    for text in ("[" * 200_000, f'{{"robots": {"9" * 5001}}}'):
        with pytest.raises(CertificateError, match="not JSON, or cut off"):
            check_certificate(text)
    with pytest.raises(CertificateError, match="not a certificate"):
        check_certificate("[1]")


def test_an_unfinished_search_is_not_certified() -> None:
    diagram = shipped_knots()["10_123"].diagram
    with pytest.raises(CertificateError, match="was not proven within the limits"):
        prove("10_123", diagram, Requirements("span"), limits=Limits(seconds=1e-3))


def test_changed_certificates_of_span_are_rejected() -> None:
    """A clause without the spans that excuse it, or with others, is not believed."""
    content = json.loads(prove("4_1", read_knot("4").diagram, Requirements("span")))
    assert check_certificate(json.dumps(content)).robots == 5
    bound = next(bound for bound in content["bounds"] if bound["cut"] == content["cut"])
    content["bounds"], content["every_cut"] = [bound], False
    check_certificate(json.dumps(content))
    for number, spans in enumerate(list(bound["spans"])):
        if spans:
            for other in ([], [[1, 2]], [*spans[:-1], [1, 2]], spans[:-1]):
                bound["spans"][number] = other
                with pytest.raises(CertificateError, match="does not follow from the diagram"):
                    check_certificate(json.dumps(content))
            bound["spans"][number] = spans
    for other in (3, [[2, 1]], [[0, 3]], [["1", 2]], [[1, 99]]):
        with pytest.raises(CertificateError):
            changed = {**bound, "spans": [other, *bound["spans"][1:]]}
            check_certificate(json.dumps({**content, "bounds": [changed]}))
    with pytest.raises(CertificateError, match="key 'spans' is missing"):
        del bound["spans"]
        check_certificate(json.dumps(content))


@pytest.mark.slow
def test_the_kept_certificates() -> None:
    """All 249 knots' minima (`opening`), one in eight of them checked here."""
    lines = (ROOT / "paper_results" / "certificates.jsonl").read_text().splitlines()
    assert [json.loads(line)["knot"] for line in lines] == list(shipped_knots())
    for line in lines[::8]:
        verdict = check_certificate(line)
        assert verdict.every_cut
        marks = json.loads(line)["grid"]
        assert GridDiagram.from_marks(marks) == shipped_knots()[verdict.knot].diagram


def test_the_kept_certificates_of_loops() -> None:
    """All 249 knots' fewest robots that lay their diagrams."""
    lines = (ROOT / "paper_results" / "certificates_loops.jsonl").read_text().splitlines()
    for line, (name, knot) in zip(lines, shipped_knots().items(), strict=True):
        verdict = check_certificate(line)
        assert (verdict.knot, verdict.formulation, verdict.every_cut) == (name, "loops", True)
        assert GridDiagram.from_marks(verdict.grid) == knot.diagram


@pytest.mark.slow
@pytest.mark.parametrize("formulation", ["opening", "span", "loops"])
def test_the_kept_certificates_of_table1(formulation: str) -> None:
    """They prove what the table says, on its grids."""
    with (ROOT / "paper_results" / "table1.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    file = ROOT / "paper_results" / f"table1_{formulation}.jsonl"
    for row, line in zip(rows, file.read_text().splitlines(), strict=True):
        verdict = check_certificate(line)
        assert verdict.every_cut and verdict.formulation == formulation
        assert (verdict.robots, verdict.cut) == (
            int(row[f"{formulation}_robots"]),
            row[f"{formulation}_cut"],
        )
        assert sorted(verdict.grid) == sorted(map(tuple, json.loads(row["grid"])))


def test_a_key_that_stands_twice_is_refused() -> None:
    text = prove("3_1", read_knot("3").diagram, Requirements("loops"))
    twice = text.replace('"robots":', '"robots": 9, "robots":', 1)
    assert twice != text
    with pytest.raises(CertificateError, match="the key 'robots' stands twice"):
        check_certificate(twice)
