"""Section: the knots where LCF wastes most, and where it fails worst."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.atlas.report.heuristic import difference
from knotopt.atlas.report.results import Results
from knotopt.cable.cable import Cable
from knotopt.cable.cut import OUTER_CUTS
from knotopt.document.cells import whole
from knotopt.document.model import NONE, Block, Picture, Section, table_of
from knotopt.tables.methods import Supports

SHOWN = 10


@dataclass(frozen=True)
class Case:
    """A knot on one cut: LCF's set and a smallest open one.

    Attributes
    ----------
    knot, cut : int
        Indices, from 0.
    name : str
    cable : Cable
    lcf, smallest : tuple of int
        Supports without the ends.
    """

    knot: int
    cut: int
    name: str
    cable: Cable
    lcf: Supports
    smallest: Supports

    @property
    def difference(self) -> int:
        """Robots of LCF less those of the smallest open set."""
        return len(self.lcf) - len(self.smallest)


def wasteful(results: Results) -> list[Case]:
    """The knots with the largest excess of an open LCF set on one of their cuts.

    Ties: the one whose smallest set is smaller, then the order of the list; of a knot's cuts the
    first.
    """
    less = difference(results)
    excess = np.where(results.holds("lcf_open"), less, -np.inf)
    return _cases(results, excess, results.cuts("opening_robots"))


def failing(results: Results) -> list[Case]:
    """The knots with the largest deficit on one of their cuts.

    Ties: the one where LCF has too few robots on more cuts, then the order of the list; of a
    knot's cuts the first.
    """
    deficit = -difference(results)
    fewer = -(deficit > 0).sum(axis=1, keepdims=True) * np.ones_like(deficit)
    return _cases(results, deficit, fewer)


def cases_section(results: Results) -> Section:
    """Both lists, as tables and pictures."""
    blocks: list[Block] = []
    for stem, cases, extra, words, told, none in (
        (
            "wasteful",
            wasteful(results),
            ("cuts open", "LCF, best open cut", "smallest, best cut"),
            "The knots where LCF wastes most: its set is open, but has more robots than the "
            "smallest open set of the same cut, by most; one cut a knot. Beside it, on how many "
            "outer cuts LCF's set is open, its robots on the best of these, and the smallest open "
            "set on the knot's best outer cut.",
            "Where LCF wastes most: left its open set, right a smallest open set on the same cut.",
            "No open set of LCF has more robots than the smallest open set of its cut.",
        ),
        (
            "failing",
            failing(results),
            ("cuts below", "cuts open", "smallest, best cut"),
            "The knots where LCF fails worst: its set has fewer robots than any open set of the "
            "same cut, by most; one cut a knot. Beside it, on how many outer cuts it has too few, "
            "on how many its set is open, and the smallest open set on the knot's best outer cut.",
            "Where LCF fails worst: left its set, with the shortest region that it lets close "
            "(shaded boundary), the polygon that is left of that region (dashed), and the turning "
            "points that should thread it (crosses); right a smallest open set on the same cut.",
            "Nowhere has LCF fewer robots than a smallest open set.",
        ),
    ):
        if not cases:
            blocks.append(none)
            continue
        rows = [_row(results, case, extra) for case in cases]
        count = f" {len(cases)} of {len(results.knots):,} knots."
        blocks.append(table_of(rows, words + count))
        names = ", ".join(case.name for case in cases)
        blocks.append(Picture(stem, told, f"grid diagrams of {names}", is_wide=True))
    return Section("Where LCF wastes most, and where it fails worst", tuple(blocks))


def _cases(results: Results, score: FloatArray, ties: FloatArray) -> list[Case]:
    """The first knots by score, then ties, of those with a positive score on some cut."""
    cuts = [
        min(range(len(OUTER_CUTS)), key=lambda c: (-score[k, c], ties[k, c]))
        for k in range(len(score))
    ]
    order = sorted(range(len(cuts)), key=lambda k: (-score[k, cuts[k]], ties[k, cuts[k]]))
    return [_case(results, k, cuts[k]) for k in order[:SHOWN] if score[k, cuts[k]] > 0]


def _case(results: Results, knot: int, cut: int) -> Case:
    row = results.knots[knot]
    return Case(
        knot,
        cut,
        row.knot,
        Cable(row.diagram, OUTER_CUTS[cut]),
        results.supports("lcf_supports", knot, cut),
        results.supports("opening_supports", knot, cut),
    )


def _row(results: Results, case: Case, extra: tuple[str, ...]) -> list[tuple[str, str]]:
    is_open = results.holds("lcf_open")[case.knot]
    lcf = results.cuts("lcf_robots")[case.knot]
    below = difference(results)[case.knot] < 0
    more = {
        "cuts open": f"{is_open.sum()}",
        "cuts below": f"{below.sum()}",
        "LCF, best open cut": whole(lcf[is_open].min()) if is_open.any() else NONE,
        "smallest, best cut": whole(results.best("opening_robots")[case.knot]),
    }
    return [
        ("knot", case.name),
        ("cut", str(case.cable.cut)),
        ("baseline", str(len(case.cable.path))),
        ("LCF", str(len(case.lcf) + 2)),
        ("smallest open", str(len(case.smallest) + 2)),
        ("difference", f"{case.difference:+d}".replace("-", "\N{MINUS SIGN}")),
        *((head, more[head]) for head in extra),
    ]
