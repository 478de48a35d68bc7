"""A run of an atlas: measure what is not measured yet, keep it by parts, merge at the end."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from knotopt.atlas.engine import Engine, EngineError
from knotopt.atlas.measure import KnotResult, check_installed, measure_knot, versions
from knotopt.atlas.schema import KnotRow, Manifest, Settings, list_hash
from knotopt.atlas.store import opened

logger = logging.getLogger(__name__)
SHORTEST = 1.0  # between two parts [s]
SHARE = 0.01  # of the time so far: at most so much is lost if the process is killed


@dataclass(frozen=True)
class Progress:
    """How far a run is: knots of the list, those that earlier runs measured, and those of now."""

    knots: int
    before: int
    measured: int


def run_atlas(
    folder: Path,
    knots: tuple[KnotRow, ...],
    settings: Settings,
    engine: Engine,
    progress: Callable[[Progress], None] = lambda _: None,
) -> Progress:
    """Measure every knot of a list; what a folder has of the same run is not measured again.

    Parameters
    ----------
    folder : Path
        Made if it is not there.
    knots : tuple of KnotRow
    settings : Settings
    engine : Engine
    progress : callable, optional
        Told at the beginning and after each knot.

    Returns
    -------
    Progress
        At the end; the results are in the folder.

    Raises
    ------
    OutputError
        The folder is not of this run, or nothing can be written; parts written so far stay.
    EngineError
        Workers died, or have other versions.
    SolverError, MissingExtraError
        A solver that does not exist, or something that is not installed; nothing is written then.
    KeyboardInterrupt
        After what is measured was written.
    """
    check_installed(settings)
    manifest = Manifest(settings, versions(settings), len(knots), list_hash(knots))
    with opened(folder, manifest, knots) as run:
        left = [] if run.is_complete else [knot for knot in knots if knot.number not in run.done]
        before = len(knots) - len(left)
        state = Progress(len(knots), before, 0)
        fresh: list[KnotResult] = []

        def keep() -> None:
            kept = fresh.copy()
            fresh.clear()  # what cannot be written now is not tried once more on the way out
            run.add(kept)

        began = written = time.monotonic()
        logger.info("%d of %d knots are measured already", before, len(knots))
        progress(state)
        try:
            for result in engine.map(partial(measure_knot, settings=settings), left):
                _check_versions(result, manifest)
                fresh.append(result)
                state = Progress(len(knots), before, state.measured + 1)
                logger.info(
                    "knot %s measured in %.2f s: %d of %d",
                    result.rows[0]["knot"],
                    result.seconds,
                    before + state.measured,
                    len(knots),
                )
                progress(state)
                now = time.monotonic()
                if now - written > max(SHORTEST, SHARE * (now - began)):
                    keep()
                    written = now
        finally:
            keep()
        run.finish()
        logger.info("parts merged in %s", folder)
    return state


def _check_versions(result: KnotResult, manifest: Manifest) -> None:
    for package, version in manifest.versions.items():
        there = result.versions.get(package, "none")
        if there != version:
            raise EngineError(
                f"a worker has {package} {there}, this process {version}: "
                "results of different versions are not mixed"
            )
