"""The cable drawn in text, for terminals."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from knotopt.cable.cable import Cable
from knotopt.supports.support_set import SupportSet, format_supports, place

# A corner by where its two strands go: (east rather than west, north rather than south).
_CORNERS = {(True, True): "└", (True, False): "┌", (False, True): "┘", (False, False): "┐"}
SUPPORT, TAIL, LEADER = "●", "◇", "◆"
LEGEND = f"{SUPPORT} support robot  {TAIL} lifting robot p1  {LEADER} lifting robot pn, the leader"


def print_supports(title: str, chosen: SupportSet) -> None:
    """Print a cable with its robots, what they are, and how many."""
    print(draw_text(chosen.cable, chosen.supports))
    print(f"\n{LEGEND}")
    print(
        f"\n{title}, cut {chosen.cable.cut}: {chosen.robots} robots instead of {chosen.baseline} "
        f"({chosen.reduction_percent} % fewer)"
    )
    print(f"supports: {supports_in_words(chosen.cable, chosen.supports)}")


def supports_in_words(cable: Cable, supports: Iterable[int]) -> str:
    """The supports, or that there are none, and why if that is plain."""
    none = "none" if cable.crossings else "none: nothing to hold open"
    return format_supports(place(cable, supports)) or none


def draw_text(cable: Cable, supports: Collection[int] = ()) -> str:
    """The cable as text, row N on top; at a crossing the column is drawn, which passes over.

    Parameters
    ----------
    cable : Cable
    supports : collection of int
        Turning points (1-based) with a support robot, drawn ●. The lifting robots are drawn ◇ at
        p_1 and ◆ at p_n, the leader.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> print(draw_text(Cable(torus_knot(2, 3), "L+"), [3, 5, 6]))
    ◇─────┐
      ●───│─●
    ◆─│─┐ │ │
      └─│─● │
        └───┘
    """
    size = cable.diagram.size
    canvas = [[" "] * (2 * size - 1) for _ in range(size)]

    def put(column: float, row: int, character: str) -> None:
        canvas[size - row][round(2 * (column - 1))] = character

    segments = list(zip(cable.path, cable.path[1:], strict=False))
    for (c0, r0), (c1, r1) in segments:
        if r0 == r1:
            for half in range(2 * min(c0, c1) + 1, 2 * max(c0, c1)):
                put(half / 2, r0, "─")
    for (c0, r0), (c1, r1) in segments:
        if c0 == c1:
            for row in range(min(r0, r1) + 1, max(r0, r1)):
                put(c0, row, "│")
    for before, here, after in zip(cable.path, cable.path[1:], cable.path[2:], strict=False):
        east = max(before[0], after[0]) > here[0]
        north = max(before[1], after[1]) > here[1]
        put(*here, _CORNERS[east, north])
    for support in supports:
        put(*cable.path[support - 1], SUPPORT)
    put(*cable.path[0], TAIL)
    put(*cable.path[-1], LEADER)
    return "\n".join("".join(line).rstrip() for line in canvas)
