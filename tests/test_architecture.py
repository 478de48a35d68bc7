"""Who imports whom: one table of allowed imports, read off the source, inside functions too."""

from __future__ import annotations

import ast
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCES = ("formulations", "knotopt", "benchmarks")

ALLOWED: Mapping[str, str] = {
    # Numbers alone.
    "formulations": "",
    # The version, and what all share.
    "knotopt": "",
    "errors": "",
    "arrays": "",
    "files": "errors",
    "frames": "errors",
    # What results show of themselves; pictures are found by the name of their module.
    "showing": "errors",
    "ranges": "errors",
    # Documents of whatever there is to say.
    "document": "errors arrays frames",
    # Knots, cables, ropes.
    "diagram": "showing errors arrays",
    "planar": "errors arrays diagram",
    "cable": "showing errors arrays diagram planar",
    "search": "errors diagram",
    "catalogue": "errors files diagram frames",
    "identify": "errors diagram planar cable catalogue",
    "topology": "showing errors arrays planar cable",
    "reading": "showing errors arrays diagram planar cable catalogue identify topology",
    # The judges.
    "verify": "errors arrays topology",
    # The makers, each with what its results are judged by.
    "supports": "showing formulations errors arrays diagram search cable verify",
    "path": "showing formulations errors arrays ranges cable topology verify supports",
    "flight": "showing formulations errors arrays ranges diagram cable topology verify supports "
    "path",
    "laid": "formulations errors arrays diagram planar cable supports path flight",
    "sandwich": "formulations errors diagram catalogue identify reading search supports laid",
    "sim": "errors arrays ranges diagram cable catalogue verify flight",
    "rehearsal": "formulations errors arrays ranges diagram cable supports path flight sim",
    # What is made of the results.
    "export": "errors arrays flight",
    "viewer": "errors arrays document supports flight",
    "plot": "errors arrays files diagram cable topology reading supports path flight viewer",
    "mission": "errors ranges verify supports flight sim rehearsal export viewer plot",
    "tables": "formulations files document diagram cable catalogue identify supports path plot "
    "sandwich",
    "atlas": "formulations knotopt errors arrays files frames document diagram cable catalogue "
    "reading verify supports flight sim plot tables",
    "api": "formulations errors diagram search cable reading supports path flight sandwich mission",
    "cli": "formulations knotopt errors files document diagram planar search cable catalogue "
    "identify topology reading verify supports path flight laid sandwich sim rehearsal plot "
    "mission tables atlas",
    "__main__": "cli",
    "benchmarks": "formulations errors arrays files document diagram planar search cable catalogue "
    "identify topology reading verify supports path flight laid sim rehearsal plot mission tables "
    "atlas cli",
}
"""What each package, or module right in `knotopt`, may import of the others; lower ones first."""

BY_NAME = {
    "knotopt": "the public names, when they are first used (lazy_loader)",
    "knotopt.atlas.engine": "distributed, of the extra, where a cluster is asked for",
    "knotopt.cli.app": "a command's module, when the command is asked for",
    "knotopt.laid.invariants": "knot Floer homology, of the extra, where it is installed",
    "knotopt.showing": "knotopt.plot.pictures, when a result is asked for its picture",
    "formulations.backends": "a solver's module, when the solver is asked for",
}
"""Modules that import others by name, which the table does not see; what, and when."""

STATES = {"actions", "extract", "faces", "state"}
"""The modules of `topology` that `verify` may import: states of ropes, nothing that plans."""

JUDGED = {
    "supports.certificate": "certificate",
    "supports.formulation": "definition registry",
    "supports.minimal": "definition",
    "supports.proofs": "proofs",
    "path.optimise": "path",
    "path.result": "path",
    "flight.examine": "flight flight_limits flight_places flight_states flight_word span",
    "sim.judge": "crossings",
    "mission.content": "flight_limits flight_states",
    "mission.mission": "flight_limits",
    "atlas.report.gallery": "opening regions",
    "cli.prove": "certificate",
}
"""Where results meet the judges: modules that may import of `verify`, and which modules of it.

No other module of `knotopt` does, so that nothing is made or chosen by the code that judges it.
"""

MEASURING = {"alexander", "crossings", "flight", "flight_limits", "flight_places", "flight_word"}
MEASURING |= {"path"}
"""The modules of `verify` that measure curves, in floating point; all others are exact."""

INEXACT = {"numpy", "scipy", "shapely"}


@dataclass(frozen=True)
class Arrow:
    """One import: module and imported module, by their full names, and the line."""

    source: str
    target: str
    line: int

    def __str__(self) -> str:
        return f"{self.source} line {self.line} imports {self.target}"


def modules(root: Path) -> dict[str, Path]:
    """Every module by its full name.

    The list of public names, `knotopt/__init__.pyi`, is none: nothing is imported by it before it
    is used.
    """
    files = [file for source in SOURCES for file in sorted((root / source).rglob("*.py"))]
    return {_name(file.relative_to(root)): file for file in files}


def arrows(root: Path) -> list[Arrow]:
    """Every import of a module by another, anywhere in the source."""
    known = modules(root)
    return [
        Arrow(name, target, line)
        for name, file in known.items()
        for target, line in imports(name, file, set(known))
        if target in known and target != name
    ]


def _name(file: Path) -> str:
    parts = file.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports(name: str, file: Path, known: Collection[str]) -> Iterator[tuple[str, int]]:
    """What a file imports, of `known` down to the module, and in which line."""
    package = name.split(".") if file.stem == "__init__" else name.split(".")[:-1]
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) + 1 - node.level] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            for alias in node.names:
                inner = f"{base}.{alias.name}"
                yield (inner if inner in known else base), node.lineno


def package_of(module: str) -> str:
    """`formulations`, `benchmarks`, `knotopt` (itself), or what lies right below `knotopt`."""
    first, *rest = module.split(".")
    return rest[0] if first == "knotopt" and rest else first


def not_in_the_table(found: Iterable[Arrow]) -> list[str]:
    """The arrows between packages that the table does not have, in words."""
    return [str(arrow) for arrow in found if not _is_allowed(arrow)]


def _is_allowed(arrow: Arrow) -> bool:
    source, target = package_of(arrow.source), package_of(arrow.target)
    if source == target:
        return True
    module = arrow.target.rpartition(".")[2]
    if source == "verify" and target == "topology" and module not in STATES:
        return False
    if target == "verify" and source != "benchmarks":
        judged = JUDGED.get(arrow.source.removeprefix("knotopt."), "")
        if module not in judged.split():
            return False
    return target in ALLOWED.get(source, "").split()


def circle(edges: Iterable[tuple[str, str]]) -> list[str]:
    """Names along a circle; none if there is no circle."""
    sorter: TopologicalSorter[str] = TopologicalSorter()
    for source, target in edges:
        sorter.add(source, target)
    try:
        sorter.prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


@pytest.fixture(scope="module")
def tree() -> list[Arrow]:
    return arrows(ROOT)


def test_every_import_is_in_the_table(tree: list[Arrow]) -> None:
    assert not not_in_the_table(tree)


def test_every_entry_of_the_table_is_used(tree: list[Arrow]) -> None:
    used = {(package_of(arrow.source), package_of(arrow.target)) for arrow in tree}
    entries = [(source, target) for source, row in ALLOWED.items() for target in row.split()]
    assert [entry for entry in entries if entry not in used] == []
    assert {
        arrow.target.removeprefix("knotopt.topology.")
        for arrow in tree
        if (package_of(arrow.source), package_of(arrow.target)) == ("verify", "topology")
    } == STATES
    judged = {(arrow.source, arrow.target) for arrow in tree}
    for module, row in JUDGED.items():
        for judge in row.split():
            assert (f"knotopt.{module}", f"knotopt.verify.{judge}") in judged, (module, judge)


def test_the_table_has_no_circle_and_lower_packages_come_first() -> None:
    assert not circle((source, to) for source, row in ALLOWED.items() for to in row.split())
    place = {package: number for number, package in enumerate(ALLOWED)}
    for source, row in ALLOWED.items():
        assert all(place[target] < place[source] for target in row.split()), source


def test_no_modules_import_each_other_in_a_circle(tree: list[Arrow]) -> None:
    assert not circle((arrow.source, arrow.target) for arrow in tree)


def test_what_is_imported_by_name_is_listed() -> None:
    found = set()
    for name, file in modules(ROOT).items():
        text = file.read_text(encoding="utf-8")
        if package_of(name) != "benchmarks" and ("import_module(" in text or "attach_stub" in text):
            found.add(name)
    assert found == {*BY_NAME}


def test_the_judges_use_no_solver_and_exact_ones_nothing_inexact() -> None:
    for name, file in modules(ROOT).items():
        if package_of(name) == "verify":
            others = {target.split(".")[0] for target, _ in imports(name, file, ())}
            others -= {*sys.stdlib_module_names, "knotopt"}
            measuring = name.rpartition(".")[2] in MEASURING
            assert others <= (INEXACT if measuring else set()), (name, others)


@pytest.mark.parametrize(
    ("file", "line", "complaint"),
    [
        ("formulations/cnf.py", "import knotopt.errors", "formulations.cnf line"),
        ("knotopt/verify/span.py", "from formulations import cnf", "verify.span line"),
        ("knotopt/verify/lrat.py", "from knotopt.supports.lcf import lcf", "verify.lrat line"),
        ("knotopt/verify/lrat.py", "from knotopt.topology.plan import Plan", "topology.plan"),
        (
            "knotopt/verify/lrat.py",
            "from ..topology import legal",
            "imports knotopt.topology.legal",
        ),
        ("knotopt/path/arcs.py", "from knotopt.verify import crossings", "verify.crossings"),
        ("knotopt/path/result.py", "from knotopt.verify.regions import lay", "verify.regions"),
        ("knotopt/cable/cut.py", "def f():\n    from knotopt.cli import app", "line 2 imports"),
        ("knotopt/sim/model.py", "if TYPE_CHECKING:\n    import knotopt.rehearsal", "rehearsal"),
        ("knotopt/new/room.py", "import knotopt.errors", "knotopt.new.room line 1 imports"),
    ],
)
def test_one_more_arrow_is_named(tmp_path: Path, file: str, line: str, complaint: str) -> None:
    """In a tree with the same files, all of them empty but the one that imports."""
    for module in modules(ROOT).values():
        copy = tmp_path / module.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.touch()
    (tmp_path / file).parent.mkdir(exist_ok=True)
    (tmp_path / file).write_text(line)
    (found,) = not_in_the_table(arrows(tmp_path))
    assert complaint in found


def test_a_circle_is_named() -> None:
    assert not circle([("a", "b"), ("a", "c"), ("b", "c")])
    assert {*circle([("a", "b"), ("b", "c"), ("c", "b")])} == {"b", "c"}
