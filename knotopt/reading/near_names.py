"""What is said of a name that no knot has: what was understood, and the names of that form."""

from __future__ import annotations

import difflib
import re

from knotopt.catalogue.everyday_names import everyday_names, plain
from knotopt.catalogue.knotinfo import LARGEST_CROSSINGS, SHIPPED_CROSSINGS
from knotopt.catalogue.prime_names import numbered, range_of
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.errors import UnknownKnotError

_SHOWN = 60  # letters of a name


def unknown(text: str) -> UnknownKnotError:
    """The error to raise.

    Examples
    --------
    >>> print(unknown("11a_400"))
    no knot is named '11a_400'; KnotInfo has 11a_1 to 11a_367
    >>> print(unknown("trefol"))
    no knot is named 'trefol'; nearest: trefoil, threefoil, left trefoil
    """
    shown = text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."
    name = numbered(re.sub(r"^\s*(?:m|-|mirror)\s*(?=k?\d)", "", text[:_SHOWN].casefold()))
    if name is not None:
        return UnknownKnotError(f"no knot is named {shown!r}; {_numbers(name)}")
    near = _near(text[:_SHOWN])
    hint = f"nearest: {', '.join(near)}" if near else "`knotopt knots` lists the names"
    return UnknownKnotError(f"no knot is named {shown!r}; {hint}")


def _numbers(name: str) -> str:
    """Which names there are of the form of one that a knot could have."""
    head = name.partition("_")[0]
    last = range_of(name)
    if last:
        has = f"KnotInfo has {head}_1" + (f" to {head}_{last}" if last > 1 else "")
        if head == "10":
            has += " (Rolfsen's 10_163 to 10_166 are its 10_162 to 10_165)"
        return has if head != "11" else f"Conway's list has {head}_1 to {head}_{last}"
    crossings = int(head.rstrip("an"))
    if crossings > LARGEST_CROSSINGS:
        return (
            f"names are known up to {LARGEST_CROSSINGS} crossings: give a PD or DT code, a braid "
            "word or a grid"
        )
    if crossings > SHIPPED_CROSSINGS:
        kinds = " and ".join(
            f"{crossings}{kind}_1 to {crossings}{kind}_{range_of(f'{crossings}{kind}_1')}"
            for kind in "an"
        )
        return f"KnotInfo has {kinds}"
    if crossings < 3:
        return f"no knot has a crossing number of {crossings}" if crossings else "0_1 is the unknot"
    return f"all knots of {crossings} crossings alternate, such as {crossings}a_1"


def _near(text: str) -> list[str]:
    """Rows of Table I that begin so, and the nearest of them and of names in words."""
    squeezed = re.sub(r"\s", "", text).casefold()
    rows = dict.fromkeys(grid.row for grid in table1_grids())
    words = {plain(name): name for each in everyday_names().values() for name in each.names}
    near = [row for row in rows if squeezed and row.casefold().startswith(squeezed)]
    if squeezed.isdigit():
        crossings = int(squeezed) if len(squeezed) < 3 else 0
        if SHIPPED_CROSSINGS < crossings <= LARGEST_CROSSINGS:
            return [f"{crossings}a_1", f"{crossings}n_1"]
        last = range_of(f"{crossings}_1") or 0
        return near + [f"{crossings}_{n}" for n in range(1, min(last, 3) + 1)]
    near += difflib.get_close_matches(text, [*rows], n=2, cutoff=0.6)
    close = difflib.get_close_matches(plain(text), [*words], n=3, cutoff=0.6)
    return [*dict.fromkeys([*near, *(words[each] for each in close)])]
