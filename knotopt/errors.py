"""Errors for wrong input. A method that stops early returns a value; it does not raise."""

from __future__ import annotations

import importlib.util


class KnotoptError(ValueError):
    """Base of every error that knotopt raises for wrong input."""


class GridError(KnotoptError):
    """A grid diagram that is not one: the message names the row, column or entry."""


class DiagramError(KnotoptError):
    """A code that is no planar diagram of one knot: the message names the crossing or entry."""


class MoveError(KnotoptError):
    """A Cromwell move that does not apply to this grid diagram."""


class CutError(KnotoptError):
    """A cut that does not exist in this grid diagram or that carries crossings."""


class UnknownKnotError(KnotoptError):
    """A knot name that is in no table at hand: the message gives the nearest names."""


class FileFormatError(KnotoptError):
    """A file that cannot be read as a grid diagram: the message names file, line and key."""


class OutputError(KnotoptError):
    """A result that cannot be written where, or in the format, that was asked for."""


class RequirementError(KnotoptError):
    """Something asked of a set of supports that no set can do, or that contradicts itself."""


class SolverError(KnotoptError):
    """A solver that does not exist, or is asked for what it cannot do."""


class CertificateError(KnotoptError):
    """A certificate that cannot be read or does not prove what it claims."""


class MissingExtraError(KnotoptError):
    """An optional dependency is not installed: the message is the line that installs it."""

    def __init__(self, package: str, extra: str, purpose: str) -> None:
        super().__init__(
            f"{purpose} needs {package}, which is not installed; "
            f"install it with: {install_line(extra)}"
        )


def require_extra(package: str, extra: str, purpose: str) -> None:
    """Whether an optional dependency can be imported.

    Parameters
    ----------
    package, extra : str
        What is imported, and the extra of this project that brings it.
    purpose : str
        What needs it, for the sentence: "drawing pictures".

    Raises
    ------
    MissingExtraError
        It cannot.
    """
    if importlib.util.find_spec(package) is None:
        raise MissingExtraError(package, extra, purpose)


def install_line(extra: str) -> str:
    """The line that installs an optional extra."""
    return f"pip install '.[{extra}]' in a clone, elsewhere pip install 'knotopt[{extra}]'"
