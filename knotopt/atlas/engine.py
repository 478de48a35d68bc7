"""What runs the items of an atlas: processes of this machine, or a Dask cluster."""

from __future__ import annotations

import importlib
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any, Protocol, TypeVar

from knotopt.errors import KnotoptError, MissingExtraError

Item = TypeVar("Item")
Result = TypeVar("Result")
IDLE = 20.0  # after which a process ends: its parent may have been killed [s]
ITEMS_A_WORKER = 4  # under way at a time, so that none waits for the network


class EngineError(KnotoptError):
    """Workers that cannot be reached, or that died."""


class Engine(Protocol):
    """Applies a function to many items, on whatever it has."""

    def map(self, function: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """The results, each as soon as it is there, in any order.

        Every item's result comes exactly once. An error in the function is raised here. Closing
        the iterator abandons what is under way.

        Raises
        ------
        EngineError
            The workers are lost.
        """
        ...


@dataclass(frozen=True)
class Local:
    """Processes of this machine, by joblib; with one job this process itself."""

    jobs: int = 1

    def map(self, function: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """As `Engine.map`."""
        from joblib import Parallel, delayed, parallel_config
        from joblib.externals.loky.process_executor import BrokenProcessPool

        if self.jobs == 1:
            yield from map(function, items)
            return
        # Several processes with several threads each would fight for the same cores.
        with parallel_config(
            "loky", n_jobs=self.jobs, inner_max_num_threads=1, idle_worker_timeout=IDLE
        ):
            results = Parallel(return_as="generator_unordered", batch_size=1)(
                delayed(function)(item) for item in items
            )
        try:
            for result in results:  # noqa: UP028 -- that would close them, with a warning
                yield result
        except BrokenProcessPool as error:
            raise EngineError(
                "a worker process died, perhaps for want of memory: try fewer jobs"
            ) from error
        finally:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of work that is abandoned, which is meant
                results.close()


@dataclass(frozen=True)
class Cluster:
    """A Dask cluster at the address of its scheduler; an item of a worker that dies is repeated.

    Scheduler and workers are to have the packages of this process, in the same versions; workers
    one thread each (`dask worker ADDRESS --nworkers 8 --nthreads 1`).
    """

    address: str
    timeout: float = 10.0  # to reach the scheduler [s]

    def map(self, function: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        """As `Engine.map`; some items a worker thread are under way at a time."""
        distributed = _distributed()
        try:
            client = distributed.Client(self.address, timeout=self.timeout, set_as_default=False)
        except (OSError, ValueError) as error:
            raise EngineError(
                f"no Dask scheduler answers at {self.address}: start one with `dask scheduler`"
            ) from error
        with client:
            try:
                client.wait_for_workers(1, timeout=self.timeout)
            except TimeoutError as error:
                raise EngineError(
                    f"the Dask scheduler at {self.address} has no workers: start them with "
                    f"`dask worker {self.address} --nthreads 1`"
                ) from error
            yield from _on_cluster(client, function, items)


def _on_cluster(
    client: Any, function: Callable[[Item], Result], items: Iterable[Item]
) -> Iterator[Result]:
    """A few items a worker under way at a time: a scheduler does not hold a whole atlas."""
    distributed = _distributed()
    left = iter(items)
    done = distributed.as_completed(loop=client.loop, with_results=True)

    def submit() -> None:
        if done.count() <= ITEMS_A_WORKER * (workers := len(client.nthreads())):
            for item in islice(left, ITEMS_A_WORKER * max(1, workers)):
                done.add(client.submit(function, item, pure=False))

    submit()
    try:
        for _, result in done:
            submit()
            yield result
    except distributed.KilledWorker as error:
        raise EngineError(f"workers of the cluster died at the same item: {error}") from error
    except distributed.CancelledError as error:
        raise EngineError("the Dask scheduler is gone") from error
    except (ModuleNotFoundError, RuntimeError) as error:
        lacking = error if isinstance(error, ModuleNotFoundError) else error.__cause__
        if not isinstance(lacking, ModuleNotFoundError | RuntimeError):
            raise
        raise EngineError(
            f"the cluster lacks what is installed here: {str(lacking).splitlines()[0]}"
        ) from error


def _distributed() -> Any:
    """The package; it must not take SnapPy for the compression library of the same name."""
    snappy = {name: sys.modules[name] for name in ("snappy",) if name in sys.modules}
    if "distributed" not in sys.modules:
        sys.modules["snappy"] = None  # type: ignore[assignment]
    try:
        return importlib.import_module("distributed")
    except ImportError as error:
        raise MissingExtraError("distributed", "cluster", "a Dask scheduler") from error
    finally:
        if sys.modules.get("snappy", snappy) is None:
            del sys.modules["snappy"]
        sys.modules.update(snappy)
