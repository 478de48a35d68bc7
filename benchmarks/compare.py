"""This tree against another revision of it, measured in turn on one machine in one call.

Each case is measured by both, one after the other, so that what slows the machine slows both; of
several repeats the fastest counts.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from rich.progress import track

from benchmarks.registry import Benchmark, Case, Result

ROOT = Path(__file__).parents[1]
COSTS = {"seconds", "ms", "mebibytes"}  # words in the names of times and memory
RATIOS = {"times", "ratio"}  # of ratios of these, which differ from run to run
MEASURE = """
import json, sys
import benchmarks.__main__
from benchmarks.registry import BENCHMARKS
answers, sys.stdout = sys.stdout, sys.stderr
for line in sys.stdin:
    name, case = json.loads(line)
    known = name in BENCHMARKS
    print(json.dumps(BENCHMARKS[name].measure(case) if known else None), file=answers, flush=True)
"""


@dataclass(frozen=True)
class Ratio:
    """What this tree costs over what the other one does.

    Attributes
    ----------
    benchmark, cost : str
        Benchmark, and the name of a time [s, ms] or of memory [MiB] in its results.
    cases : int
        That it was measured on.
    mean, least, most : float
        Geometric mean and extremes of the cases' ratios; below 1 where this tree is cheaper.
    """

    benchmark: str
    cost: str
    cases: int
    mean: float
    least: float
    most: float


@dataclass(frozen=True)
class Comparison:
    """Ratios of costs, and cases whose other results differ.

    Attributes
    ----------
    ratios : tuple of Ratio
    changed : tuple of (str, Case)
        Benchmark and case.
    missing : tuple of str
        Benchmarks that the other revision does not have.
    """

    ratios: tuple[Ratio, ...]
    changed: tuple[tuple[str, Case], ...]
    missing: tuple[str, ...]


def compare(
    revision: str, benchmarks: list[Benchmark], *, smoke: bool, repeats: int = 3
) -> Comparison:
    """Measure benchmarks in this tree and in another revision's.

    Raises
    ------
    ValueError
        There is no such revision, or a tree that fails; with what it says.
    """
    costs: dict[tuple[str, str], list[float]] = defaultdict(list)
    changed: list[tuple[str, Case]] = []
    missing: list[str] = []
    with ExitStack() as stack:
        other = stack.enter_context(_measuring(stack.enter_context(_worktree(revision))))
        this = stack.enter_context(_measuring(ROOT))
        for benchmark in benchmarks:
            for case in track(list(benchmark.cases(smoke)), benchmark.name):
                pairs = [
                    (_ask(other, benchmark.name, case), _ask(this, benchmark.name, case))
                    for _ in range(repeats)
                ]
                if pairs[0][0] is None:
                    missing.append(benchmark.name)
                    break
                before, now = (fastest(results) for results in zip(*pairs, strict=True))
                for cost in before[0].keys() & now[0].keys():
                    costs[benchmark.name, cost].append(now[0][cost] / before[0][cost])
                if before[1] != now[1]:
                    changed.append((benchmark.name, case))
    ratios = (
        Ratio(name, cost, len(each), _geometric_mean(each), min(each), max(each))
        for (name, cost), each in sorted(costs.items())
    )
    return Comparison(tuple(ratios), tuple(changed), tuple(missing))


@contextmanager
def _worktree(revision: str) -> Iterator[Path]:
    """The files of a revision, in a folder of their own."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        git = ["git", "-C", str(ROOT), "worktree"]
        added = subprocess.run(
            [*git, "add", "--quiet", "--detach", str(tree), revision],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if added.returncode:
            raise ValueError(f"no revision {revision!r}: {added.stderr.strip()}")
        try:
            yield tree
        finally:
            subprocess.run([*git, "remove", "--force", str(tree)], check=True)


@contextmanager
def _measuring(tree: Path) -> Iterator[subprocess.Popen[str]]:
    """A process that measures what it is asked for with a tree's own code."""
    code = f"import sys; sys.path.insert(0, {str(tree)!r})\n{MEASURE}"
    with subprocess.Popen(
        [sys.executable, "-c", code],
        cwd=tree, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        yield process


def _ask(process: subprocess.Popen[str], name: str, case: Case) -> Result | None:
    questions, answers = _pipes(process)
    questions.write(json.dumps([name, case]) + "\n")
    questions.flush()
    answer = answers.readline()
    if not answer:
        raise ValueError(f"benchmark {name!r} failed on {case}; what it says stands above")
    result: Result | None = json.loads(answer)
    return result


def _pipes(process: subprocess.Popen[str]) -> tuple[IO[str], IO[str]]:
    assert process.stdin is not None
    assert process.stdout is not None
    return process.stdin, process.stdout


def fastest(results: tuple[Result, ...]) -> tuple[dict[str, float], dict[str, Any]]:
    """The least of each cost over repeats, and all else as the first one has it."""
    least: dict[str, float] = {}
    for result in results:
        for name, value in _flat(result, ""):
            if COSTS & _words(name) and isinstance(value, int | float) and value > 0:
                least[name] = min(value, least.get(name, math.inf))
    noisy = COSTS | RATIOS
    return least, {k: value for k, value in _flat(results[0], "") if not noisy & _words(k)}


def _flat(value: object, name: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _flat(item, f"{name}.{key}" if name else str(key))
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _flat(item, f"{name}[{number}]")
    else:
        yield name, value


def _words(name: str) -> set[str]:
    return set(name.rsplit(".", 1)[-1].split("_"))


def _geometric_mean(ratios: list[float]) -> float:
    return math.exp(sum(map(math.log, ratios)) / len(ratios))
