"""How large a grid each command takes, so that a larger one is refused before any work.

Measured on random grids, which have about N² / 9 crossings: what one slow core does in about a
minute and 4 GiB. Sparse grids of the same size take less.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError

LARGEST: Mapping[str, int] = MappingProxyType(
    {
        "show": 700,  # 37 s, 0.3 GiB: codes, simplification
        "show --plot": 160,
        "show --format": 1000,
        "lcf": 300,  # N = 250: 32 s, 0.3 GiB
        "lcf --cut all": 200,  # N = 160: 23 s, 0.4 GiB
        "lcf --plot": 80,
    }
)
"""Grid size N by what is asked for, with what was measured."""


def check_size(diagram: GridDiagram, job: str) -> None:
    """Refuse a grid that is too large for a command.

    Parameters
    ----------
    diagram : GridDiagram
    job : str
        A key of `LARGEST`.

    Raises
    ------
    GridError
        It is; the message has the size that the command takes.
    """
    most = LARGEST[job]
    if diagram.size > most:
        raise GridError(
            f"a grid of size {diagram.size} is too large for {job}, which takes sizes up to {most}"
            ": about a minute of work; a simpler diagram of the knot may do"
        )
