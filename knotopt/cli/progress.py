"""Progress of what takes long: a bar for who looks on, and a line in the log for afterwards."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

from knotopt.cli.logs import LOGGER, telling

if TYPE_CHECKING:
    from rich.progress import Task
    from rich.text import Text

Item = TypeVar("Item")
logger = logging.getLogger(__name__)


def track(
    items: Iterable[Item],
    what: str,
    total: int,
    name: Callable[[Item], object] = lambda item: getattr(item, "name", ""),
) -> Iterator[Item]:
    """The items, with a bar while they are gone through, and a line in the log after each."""
    with logged_bar(what, total) as show:
        for done, item in enumerate(items, 1):
            yield item
            show(done, name(item))


@contextmanager
def logged_bar(what: str, total: int) -> Iterator[Callable[..., None]]:
    """A bar whose every step is logged; what it yields is told how many are done, and the last."""
    with progress_bar(what, total) as show:
        before = time.monotonic()

        def log(done: int, name: object = "") -> None:
            nonlocal before
            now = time.monotonic()
            words = f" ({name})" if name else ""
            logger.info("%s: %d of %d%s in %.2f s", what, done, total, words, now - before)
            before = now
            show(done)

        yield log


@contextmanager
def status_line(what: str, prefix: str = "", lasting: str | None = None) -> Iterator[None]:
    """Show what is logged on the last line of the error stream, if somebody looks.

    What begins with `lasting` is printed in a line of its own, whoever looks; with `--verbose` it
    stands there already, with all else that is logged.
    """
    from rich.console import Console
    from rich.markup import escape

    console = Console(stderr=True)
    verbose = any(not isinstance(each, logging.FileHandler) for each in LOGGER.handlers)
    with console.status(what) as status:

        def tell(text: str) -> None:
            if lasting is None or not text.startswith(lasting):
                status.update(prefix + escape(text))
            elif not verbose:
                # Into a file a line stays one line.
                wide = not console.is_terminal
                console.print(text, markup=False, highlight=False, soft_wrap=wide)

        with telling(tell):
            yield


@contextmanager
def progress_bar(what: str, total: int) -> Iterator[Callable[[int], None]]:
    """A bar on the error stream, with rate and time left; what it yields is told how many are done.

    What is done already when it is first told is no part of the rate.
    """
    from rich import progress
    from rich.console import Console
    from rich.text import Text

    class Rate(progress.ProgressColumn):
        def render(self, task: Task) -> Text:
            return Text(f"{task.speed or 0:.1f} {what}/s")

    console = Console(stderr=True)
    columns = (
        progress.TextColumn(what),
        progress.BarColumn(),
        progress.MofNCompleteColumn(),
        Rate(),
        progress.TimeElapsedColumn(),
        progress.TextColumn("left"),
        progress.TimeRemainingColumn(),
    )
    with progress.Progress(
        *columns,
        console=console,
        transient=True,
        disable=not console.is_terminal,
        speed_estimate_period=120,
    ) as bar:
        task = bar.add_task(what, total=total)

        def show(done: int) -> None:
            if done > bar.tasks[task].completed + 1:
                bar.reset(task, completed=done)
            else:
                bar.update(task, completed=done)

        yield show
