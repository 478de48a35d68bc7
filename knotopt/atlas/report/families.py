"""Section: families of knots: torus, twist, pretzel, two-bridge, alternating or not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from knotopt.atlas.report.invariants import TORUS, TWIST, Invariants
from knotopt.atlas.report.results import Results
from knotopt.atlas.schema import KnotRow
from knotopt.document.cells import largest, mean, percent, whole
from knotopt.document.model import NONE, Block, Section, Table, table_of

Members = Sequence[bool | None]


def families_section(results: Results, known: Mapping[str, Invariants]) -> Section:
    """Means by family, alternating against not at the same size, and torus and twist knots."""
    blocks: list[Block] = [families_table(results, known)]
    if not known:
        blocks.append(
            "Pretzel knots and bridge indices are missing: the `knotinfo` extra was not installed "
            "when this report was written, or it has none of these knots."
        )
    same_size = alternating_table(results)
    if same_size.rows:
        blocks += [
            "Families differ in size, and size alone decides much: the arc index of an alternating "
            "knot is its crossing number + 2 (Bae and Park 2000), that of any other at most its "
            "crossing number (Jin and Park, arXiv:1010.3005), and "
            f"{_smallest_grids(results)} So compare within a row of the next table.",
            same_size,
        ]
    named = [k for k, knot in enumerate(results.knots) if _name(knot) in TORUS + TWIST]
    if named:
        blocks.append(_named_table(results, named))
    return Section("Families", tuple(blocks))


def families_table(results: Results, known: Mapping[str, Invariants]) -> Table:
    """Sizes and mean robots by family."""
    families = {"all": [True] * len(results.knots), **_families(results, known)}
    return table_of(
        [
            [("family", name), *_cells(results, members)]
            for name, members in families.items()
            if True in members
        ],
        "Families: knots in them, of how many where it is known, mean crossing number and arc "
        "index, share of outer cuts where LCF's set is open, mean robots on each method's best "
        "outer cut, and the fewest and most robots of a knot's smallest open set (best cut). "
        "Pretzel notations are KnotInfo's, which stop at 9 crossings and may have entries of 1.",
    )


def alternating_table(results: Results) -> Table:
    """Alternating knots and others at the same crossing number, and at the same arc index."""
    alternating = np.array([knot.alternating for knot in results.knots], dtype=float)
    fewest, is_open = results.best("opening_robots"), results.holds("lcf_open")
    rows = []
    for what, values in (
        ("crossing number", [knot.crossing_number for knot in results.knots]),
        ("arc index", [knot.arc_index for knot in results.knots]),
    ):
        column = np.array(values, dtype=float)
        for value in np.unique(column[~np.isnan(column)]):
            yes, no = ((column == value) & (alternating == which) for which in (1, 0))
            if yes.any() and no.any():
                rows.append(
                    [
                        ("knots with", f"{what} {value:.0f}"),
                        ("alternating", f"{yes.sum():,}"),
                        ("not", f"{no.sum():,}"),
                        ("robots, alternating", mean(fewest[yes])),
                        ("robots, not", mean(fewest[no])),
                        ("LCF open, alternating", percent(is_open[yes])),
                        ("LCF open, not", percent(is_open[no])),
                    ]
                )
    return table_of(
        rows,
        "Alternating knots against others of the same size: how many, mean robots of the smallest "
        "open set on the best outer cut (`opening`), share of outer cuts where LCF's set is open.",
    )


def _smallest_grids(results: Results) -> str:
    known = [knot for knot in results.knots if knot.arc_index is not None]
    smallest = sum(knot.grid_size == knot.arc_index for knot in known)
    return f"{smallest:,} of {len(known):,} grids here have the size of the arc index."


def _named_table(results: Results, named: Sequence[int]) -> Table:
    rows = []
    for k in named:
        knot = results.knots[k]
        kinds = [w for w, family in (("torus", TORUS), ("twist", TWIST)) if knot.knot in family]
        rows.append(
            [
                ("knot", knot.knot),
                ("family", ", ".join(kinds)),
                ("arc index", NONE if knot.arc_index is None else str(knot.arc_index)),
                ("LCF open, cuts", f"{int(results.holds('lcf_open')[k].sum())} of 8"),
                *(
                    (f"{words}, best cut", whole(results.best(column)[k]))
                    for column, words in results.methods.items()
                ),
            ]
        )
    return table_of(
        rows,
        f"Torus and twist knots: robots on each method's best outer cut ({len(named)} knots).",
    )


def _families(results: Results, known: Mapping[str, Invariants]) -> dict[str, Members]:
    """Which knots are in a family; None where it is not known."""
    names = list(map(_name, results.knots))
    more = list(map(known.get, names))
    bridges = [each.bridge_index if each else None for each in more]
    pretzel = [each.is_pretzel if each else None for each in more]
    alternating = [knot.alternating for knot in results.knots]
    return {
        "alternating": alternating,
        "not alternating": _none_or_not(alternating),
        "torus": [name in TORUS if name else None for name in names],
        "twist": [name in TWIST if name else None for name in names],
        "two-bridge": [None if b is None else b == 2 for b in bridges],
        "three-bridge": [None if b is None else b == 3 for b in bridges],
        "four-bridge": [None if b is None else b == 4 for b in bridges],
        "pretzel": pretzel,
        "not pretzel": _none_or_not(pretzel),
    }


def _cells(results: Results, members: Members) -> list[tuple[str, str]]:
    inside = np.array([member is True for member in members])
    knots = [knot for knot, member in zip(results.knots, inside, strict=True) if member]
    fewest = results.best("opening_robots")[inside]
    return [
        ("knots", f"{int(inside.sum()):,}"),
        ("of", f"{sum(member is not None for member in members):,}"),
        ("crossing number", mean([knot.crossing_number for knot in knots], 1)),
        ("arc index", mean([knot.arc_index for knot in knots], 1)),
        ("LCF open", percent(results.holds("lcf_open")[inside])),
        *(
            (f"{words}, best cut", mean(results.best(column)[inside]))
            for column, words in results.methods.items()
        ),
        ("fewest, most", f"{whole(fewest.min())}, {largest(fewest)}"),
    ]


def _name(knot: KnotRow) -> str:
    """The knot's name if it is one of the tables', whose names say what the knot is; else ""."""
    return "" if knot.crossing_number is None else knot.knot


def _none_or_not(members: Members) -> list[bool | None]:
    return [None if member is None else not member for member in members]
