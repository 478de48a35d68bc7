"""What a shell completes: names of knots, and what options can be.

Where nothing here fits what is typed, the shell completes names of files.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

Completed = Callable[[str], list[str]]

CUTS = ("L+", "L-", "R+", "R-", "B+", "B-", "T+", "T-")
"""The outer cuts, which every diagram has."""


def among(names: Collection[str]) -> Completed:
    """Completes to one of some names."""

    def complete(incomplete: str) -> list[str]:
        return [str(name) for name in names if name.startswith(incomplete)]

    return complete


def list_of(names: Collection[str]) -> Completed:
    """Completes the last of names with commas between, to one that is not there yet."""

    def complete(incomplete: str) -> list[str]:
        *before, last = incomplete.split(",")
        start = "".join(f"{name}," for name in before)
        left = [name for name in names if name not in before]
        return [start + name for name in left if name.startswith(last)]

    return complete


def knot_names(incomplete: str) -> list[str]:
    """Completes to a knot's name: of the catalogue, in words, or of Table I."""
    from knotopt.catalogue.everyday_names import everyday_names
    from knotopt.catalogue.knots import shipped_knots
    from knotopt.catalogue.table1_grids import table1_grids

    in_words = [name for entry in everyday_names().values() for name in entry.names]
    rows = [grid.row for grid in table1_grids()]
    names = dict.fromkeys([*shipped_knots(), *in_words, *rows])
    return [name for name in names if name.lower().startswith(incomplete.lower())]


def form_names(incomplete: str) -> list[str]:
    """Completes to a form that knots are read in."""
    from knotopt.reading.forms import FORMS

    return [form.name for form in FORMS if form.name.startswith(incomplete)]
