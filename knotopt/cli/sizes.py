"""How large a grid each command takes: a larger one is refused before any work.

Measured on random grids, which have about N² / 9 crossings: what one slow core does in about a
minute and 4 GiB. `topology` is bounded by states instead (`knotopt.topology.plan.MOST_STATES`):
their number does not follow from N.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from knotopt.errors import GridError

LARGEST: Mapping[str, int] = MappingProxyType(
    {
        "show": 700,  # 37 s, 0.3 GiB
        "show --plot": 200,
        "show --format": 1000,
        "lcf": 300,  # N = 250: 32 s, 0.3 GiB
        "lcf --cut all": 200,  # N = 160: 23 s, 0.4 GiB
        "lcf --plot": 120,  # N = 80: 12 s, 0.6 GiB
        "solve": 60,  # N = 40: 13 s, 0.4 GiB, growing as N^4
        "solve --formulation span": 26,  # N = 20: 17 s, 0.2 GiB, growing as N^5
        "prove": 40,  # a solve and a refutation for each cut
        "prove --formulation span": 20,
        "compare": 22,  # N = 20: 33 s, 0.4 GiB, most of it for span
        "path": 60,  # N = 56: 10 s, 0.9 GiB; N = 80: over 5 GiB
        "path --formulation span": 26,  # its set
        "fly": 60,  # N = 40: 10 s, 0.2 GiB, of a set that is given
        "fly --supports milp": 26,  # whose set is of formulation span
        "identify": 700,  # as show
        "atlas": 60,  # as solve
        "atlas --span": 26,
    }
)
"""Grid size N by what is asked for, with what was measured."""


def check_size(size: int, command: str, **options: object) -> None:
    """Refuse a grid that is too large for a command.

    Parameters
    ----------
    size : int
        Grid size N.
    command : str
    **options
        What else is asked for, as the user writes it ("--plot"), and whether it is.

    Raises
    ------
    GridError
        It is too large; the message has the size that the command takes.
    """
    asked = [command, *(f"{command} {option}" for option, value in options.items() if value)]
    job = min((each for each in asked if each in LARGEST), key=LARGEST.__getitem__)
    if size > LARGEST[job]:
        raise GridError(
            f"a grid of size {size} is too large for `{job}`, which takes sizes up to "
            f"{LARGEST[job]}; `knotopt.simplify` in Python may find a smaller one of the knot"
        )
