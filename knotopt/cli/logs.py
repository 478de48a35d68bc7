"""What a command logs while it runs: to the error stream, to a file, or to a line of its own.

Modules log by `logging.getLogger(__name__)`, below the logger "knotopt": INFO says what is being
done and how long it took, DEBUG also why. Only the handlers here make that visible.
"""

from __future__ import annotations

import inspect
import logging
import shlex
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import wraps
from pathlib import Path
from typing import Annotated, Any

import typer

from knotopt import __version__
from knotopt.errors import OutputError

LOGGER = logging.getLogger("knotopt")
FORMAT = "%(asctime)s %(levelname)s %(name)s: %(message)s"

VerboseOption = Annotated[
    int,
    typer.Option(
        "--verbose",
        "-v",
        count=True,
        show_default=False,
        metavar="",
        help="Say on the error stream what is being done; twice: in detail.",
    ),
]
LogOption = Annotated[
    Path | None,
    typer.Option(
        "--log",
        metavar="FILE",
        help="Append the same to a file, with times: where a run of hours spent them.",
    ),
]


class _Lines(logging.Handler):
    """Gives each record, as a line, to a function."""

    def __init__(self, print_line: Callable[[str], None], level: int) -> None:
        super().__init__(level)
        self._print = print_line

    def emit(self, record: logging.LogRecord) -> None:
        try:
            self._print(self.format(record))
        except Exception:
            self.handleError(record)


@contextmanager
def telling(print_line: Callable[[str], None]) -> Iterator[None]:
    """Give what is logged as INFO, as plain text, to a function while a block runs."""
    handler = _Lines(print_line, logging.INFO)
    handler.addFilter(lambda record: record.levelno == logging.INFO)
    with _handled(handler):
        yield


@contextmanager
def logging_to(verbose: int, file: Path | None) -> Iterator[None]:
    """Log what a block does: INFO to the error stream (verbose 1) and to a file; DEBUG (2) as well.

    Raises
    ------
    OutputError
        The file, to which lines are appended, cannot be written.
    """
    level = logging.DEBUG if verbose > 1 else logging.INFO
    with ExitStack() as stack:
        if verbose:
            stack.enter_context(_handled(_Lines(_print_error, level)))
        if file is not None:
            if not file.parent.is_dir():
                raise OutputError(f"cannot write {file}: there is no folder {file.parent}")
            try:
                lines = logging.FileHandler(file, encoding="utf-8")
            except OSError as error:
                raise OutputError(f"cannot write {file}: {error.strerror}") from error
            lines.setLevel(level)
            lines.setFormatter(logging.Formatter(FORMAT))
            stack.enter_context(_handled(lines))
        yield


def logged(command: Callable[..., None]) -> Callable[..., None]:
    """The command with the options --verbose and --log; begin, end and time go to the log."""

    @wraps(command)
    def run(*arguments: Any, verbose: int, log: Path | None, **options: Any) -> None:
        with logging_to(verbose, log):
            began = time.monotonic()
            LOGGER.info("knotopt %s: %s", __version__, shlex.join(sys.argv[1:]))
            ending = "done"
            try:
                command(*arguments, **options)
            except typer.Exit as end:
                ending = f"exit status {end.exit_code}"
                raise
            except BaseException as error:
                ending = f"ended by {type(error).__name__}: {error}".rstrip(": ")
                raise
            finally:
                LOGGER.info("%s after %.1f s", ending, time.monotonic() - began)

    signature = inspect.signature(command, eval_str=True)
    more = [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind)
        for name, default, kind in (("verbose", 0, VerboseOption), ("log", None, LogOption))
    ]
    parameters = [*signature.parameters.values(), *more]
    run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in parameters}
    return run


@contextmanager
def _handled(handler: logging.Handler) -> Iterator[None]:
    """A handler of the logger while a block runs; the logger passes on what some handler takes."""
    before = LOGGER.level
    LOGGER.addHandler(handler)
    LOGGER.setLevel(min(before or logging.WARNING, handler.level))
    try:
        yield
    finally:
        LOGGER.removeHandler(handler)
        LOGGER.setLevel(before)
        handler.close()


def _print_error(line: str) -> None:
    print(line, file=sys.stderr)
