"""How long the command line takes to answer, beside a bare Python."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterable
from statistics import median

from benchmarks.registry import Benchmark, Case, Result, register

RUNS = 11


def cases(smoke: bool) -> Iterable[Case]:
    """Help, and the main job."""
    calls = [["--help"]] if smoke else [["--help"], ["table1"]]
    return ({"arguments": arguments} for arguments in calls)


def measure(case: Case) -> Result:
    """Median wall time [s] of the command and of `python -c pass`, run in turns."""
    call = f"import sys; sys.argv = {['knotopt', *case['arguments']]!r}\n"
    call += "from knotopt.cli.app import main; main()"
    command, bare = [], []
    for _ in range(RUNS):
        command.append(_seconds(call))
        bare.append(_seconds("pass"))
    return {
        "seconds": round(median(command), 3),
        "times_a_bare_python": round(median(command) / median(bare), 1),
        "runs": RUNS,
    }


def _seconds(code: str) -> float:
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", code], stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - start


register(Benchmark("startup", "time until the command line answers", cases, measure))
