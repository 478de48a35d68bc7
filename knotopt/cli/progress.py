"""Progress of what takes long: a bar for who looks on, and a line in the log for afterwards."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TypeVar

Item = TypeVar("Item")
logger = logging.getLogger(__name__)


def track(
    items: Iterable[Item],
    what: str,
    total: int,
    name: Callable[[Item], object] = lambda item: getattr(item, "name", ""),
) -> Iterator[Item]:
    """The items, with a bar while they are gone through, and a line in the log after each."""
    with progress_bar(what, total) as show:
        for done, item in enumerate(items, 1):
            yield item
            show(done, name(item))


@contextmanager
def progress_bar(what: str, total: int) -> Iterator[Callable[..., None]]:
    """A bar on the error stream; what it yields is told how many are done, and the last's name."""
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(what, total=total)
        before = time.monotonic()

        def show(done: int, name: object = "") -> None:
            nonlocal before
            now = time.monotonic()
            words = f" ({name})" if name else ""
            logger.info("%s: %d of %d%s in %.2f s", what, done, total, words, now - before)
            before = now
            bar.update(task, completed=done)

        yield show
