"""What `knotopt solve --laid` says of the laid cable, as text and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from knotopt.supports.search import CutSearch


def laid_facts(search: CutSearch) -> list[tuple[str, str]]:
    """Facts to print: what is laid, what it loses, and how many sets were cut off."""
    content = laid_json(search)
    if not search.best.found:
        return [("cut off", _cut_off(content["cut_off"]))]
    lost = ", ".join(f"[{column},{row}]" for column, row in content["redundant"])
    words = "every hook of the grid's"
    if lost:
        words = f"without the hooks {lost}, which it does not need"
    elif content["all_flown"]:
        words = "the grid's diagram"
    return [
        ("laid", f"the knot by {content['compared_by']}: {words}"),
        ("cut off", _cut_off(content["cut_off"])),
    ]


def _cut_off(count: int) -> str:
    if count == 0:
        return "no set"
    sets = "1 set that lays" if count == 1 else f"{count} sets that lay"
    return f"{sets} another knot, and others with {'it' if count == 1 else 'each'}"


def laid_json(search: CutSearch) -> dict[str, Any]:
    """What `--json` says of the laid cable of the set that was found."""
    from knotopt.laid.hooks import flown_crossings
    from knotopt.laid.invariants import compared_by
    from knotopt.laid.laid import LaidTest

    best = search.best
    content: dict[str, Any] = {"compared_by": compared_by(), "cut_off": search.cut_off}
    if best.found:
        laid = LaidTest(best.cable).laid(best.supports)
        cells = best.cable.crossings.cell
        content["is_knot"] = laid.is_knot
        content["redundant"] = [cells[each.crossing].tolist() for each in laid.lost]
        content["all_flown"] = len(flown_crossings(best.cable, best.supports)) == len(cells)
    return content
