"""Engines of an atlas: processes of this machine, and a Dask cluster that loses a worker."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from knotopt.atlas.engine import Cluster, EngineError, Local
from knotopt.atlas.knot_list import catalogue_rows
from knotopt.atlas.run import Progress, run_atlas
from knotopt.atlas.schema import MANIFEST, File, Settings
from knotopt.errors import MissingExtraError


def square(number: int) -> int:
    return number * number


def refuse(number: int) -> int:
    raise ValueError(f"not {number}")


def die(_: int) -> int:
    os._exit(3)


def threads(_: int) -> str | None:
    return os.environ.get("OMP_NUM_THREADS")


def process(_: int) -> int:
    return os.getpid()


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_result_comes_once(jobs: int) -> None:
    assert sorted(Local(jobs).map(square, range(50))) == [n * n for n in range(50)]
    assert list(Local(jobs).map(square, [])) == []


@pytest.mark.parametrize("jobs", [1, 2])
def test_errors_of_the_function_are_raised(jobs: int) -> None:
    with pytest.raises(ValueError, match=r"not \d"):
        list(Local(jobs).map(refuse, range(5)))


def test_workers_have_one_thread_and_are_used_again() -> None:
    assert set(Local(2).map(threads, range(6))) == {"1"}
    assert len(set(Local(2).map(process, range(20)))) <= 2


# loky's thread may find that a future was cancelled while it set the result.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_map_can_be_abandoned() -> None:
    results = Local(2).map(square, range(1000))
    next(results)
    results.close()  # type: ignore[attr-defined]
    assert sorted(Local(2).map(square, range(5))) == [0, 1, 4, 9, 16]


def test_a_worker_that_dies() -> None:
    with pytest.raises(EngineError, match="a worker process died"):
        list(Local(2).map(die, range(4)))
    assert sorted(Local(2).map(square, range(3))) == [0, 1, 4]


def test_no_scheduler() -> None:
    with pytest.raises(EngineError, match="no Dask scheduler answers at"):
        list(Cluster("tcp://127.0.0.1:9", timeout=0.5).map(square, [1]))
    with pytest.raises(EngineError, match="no Dask scheduler answers at nonsense://x"):
        list(Cluster("nonsense://x", timeout=0.5).map(square, [1]))


def test_missing_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'knotopt\[cluster\]'"):
        list(Cluster("tcp://127.0.0.1:9").map(square, [1]))


@pytest.fixture
def scheduler(tmp_path: Path) -> Iterator[str]:
    """The address of a scheduler with two workers, a process each, which are started anew."""
    # SnapPy, where it is installed, would be taken for a compression library of the same name.
    (tmp_path / "snappy.py").write_text("raise ImportError")
    root = Path(__file__).parents[2]
    places = map(str, (tmp_path, root))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(places)}
    described = tmp_path / "scheduler.json"
    commands = (
        ["dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"],
        ["dask_worker", "--nworkers", "2", "--nthreads", "1", "--no-dashboard"],
    )
    processes = []
    try:
        for name, *options in commands:
            process = subprocess.Popen(
                [
                    *(sys.executable, "-m", f"distributed.cli.{name}", *options),
                    *("--scheduler-file", str(described)),
                ],
                env=environment,
                cwd=tmp_path,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
            processes.append(process)
            wait_until(described.exists)
        yield json.loads(described.read_text())["address"]
    finally:
        for process in processes:
            os.killpg(process.pid, signal.SIGTERM)
        for process in processes:
            process.wait(30)


def wait_until(condition: Callable[[], bool], seconds: float = 60) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.1)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # the package's own, of time zones and of versions
def test_cluster_of_two_processes_of_which_one_is_killed(scheduler: str, tmp_path: Path) -> None:
    engine = Cluster(scheduler, timeout=60)
    assert sorted(engine.map(square, range(100))) == [n * n for n in range(100)]
    with pytest.raises(ValueError, match=r"not \d"):
        list(engine.map(refuse, range(5)))
    pids = set()
    for pid in engine.map(process_after_a_moment, range(200)):
        pids.add(pid)
        if len(pids) == 2:
            break
    assert len(pids - {os.getpid()}) == 2

    knots, settings = catalogue_rows()[:40], Settings(check=0)
    killed: list[int] = []

    def kill(progress: Progress) -> None:
        if progress.measured == 5:
            killed.append(min(pids))
            os.kill(killed[0], signal.SIGKILL)

    done = run_atlas(tmp_path / "cluster", knots, settings, engine, kill)
    assert (done.measured, len(killed)) == (40, 1)
    with pytest.raises(ProcessLookupError):
        os.kill(killed[0], 0)
    run_atlas(tmp_path / "local", knots, settings, Local(1))
    for name in (File.ATLAS, File.KNOTS, MANIFEST):
        assert (tmp_path / "cluster" / name).read_bytes() == (
            tmp_path / "local" / name
        ).read_bytes()


def process_after_a_moment(_: int) -> int:
    time.sleep(0.02)
    return os.getpid()
