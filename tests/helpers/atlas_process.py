"""`knotopt atlas` as a process of its own, which can be killed or interrupted."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from knotopt.atlas.schema import MANIFEST, File

WITH_PAUSES = """
import time
from knotopt.atlas import run, store
from knotopt.cli.app import main

def add(self, results, write=store.Run.add):
    write(self, results)
    time.sleep(0.15)

run.SHORTEST = run.SHARE = 0.0
store.Run.add = add
main()
"""  # the command, with a part after every knot, and a moment in which to be killed


def start(
    folder: Path, knots: Sequence[str], *options: object, pauses: bool = False
) -> subprocess.Popen[str]:
    command = ["-c", WITH_PAUSES] if pauses else ["-m", "knotopt"]
    # Into files: processes that outlive a killed one would keep its pipes open.
    with folder.with_suffix(".out").open("w") as out, folder.with_suffix(".err").open("w") as err:
        return subprocess.Popen(
            [sys.executable, *command, "atlas", str(folder), *knots, *map(str, options)],
            stdout=out,
            stderr=err,
            text=True,
            cwd=Path(__file__).parents[2],
            start_new_session=True,
        )


def ended(folder: Path, process: subprocess.Popen[str]) -> tuple[int, str, str]:
    """Exit status, output, errors."""
    status = process.wait(120)
    texts = (folder.with_suffix(end).read_text() for end in (".out", ".err"))
    return (status, *texts)


def parts(folder: Path) -> int:
    return len(list((folder / "parts").glob("part-*.parquet")))


def wait_for_parts(folder: Path, count: int, process: subprocess.Popen[str]) -> None:
    while parts(folder) < count:
        assert process.poll() is None, ended(folder, process)
        time.sleep(0.01)


def same_results(one: Path, other: Path) -> bool:
    return all(
        (one / n).read_bytes() == (other / n).read_bytes()
        for n in (File.ATLAS, File.KNOTS, MANIFEST)
    )
