"""Section: how the smallest number of robots goes with invariants of the knot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.stats import rankdata

from knotopt.arrays import FloatArray
from knotopt.atlas.report.invariants import Invariants
from knotopt.atlas.report.results import Results
from knotopt.document.cells import signed
from knotopt.document.model import Block, Picture, Section, Table, table_of

ARC, CROSSINGS = "arc index", "crossing number"
_MEANING = (
    "Spearman's rank correlation (ties have their mean rank) between invariants of a knot and "
    "its smallest number of robots on its best outer cut. Larger knots tend to larger "
    "invariants of every kind, and to more robots: the partial correlations (of the same ranks) "
    "say what is left among knots of the same arc index, of the same crossing number, and of both. "
    "There are no p-values: these are all knots of a list, with one diagram each, not a sample "
    "of some larger set. What they rest on, the diagrams, is a choice, and it would "
    "have to be drawn at random to be tested."
)


def relations_section(results: Results, known: Mapping[str, Invariants]) -> Section:
    """Rank correlations, plain and with what a grid's size alone explains taken out."""
    columns = invariant_columns(results, known)
    tables = [correlation_table(results, columns, robots) for robots in results.smallest]
    blocks: list[Block] = [each for each in tables if each.rows]
    blocks.insert(0, _MEANING if blocks else "There are too few knots for rank correlations.")
    if not known:
        blocks.append(
            "Bridge index, braid index and unknotting number are missing: the `knotinfo` extra was "
            "not installed when this report was written, or it has none of these knots."
        )
    if not np.isnan(columns[ARC]).all():
        blocks.append(
            Picture(
                "relations",
                "Smallest number of robots on the best outer cut (`opening`) against the arc "
                "index: knots, those that alternate and those that do not. Areas are numbers of "
                "knots; the lines join the means.",
                "robots against arc index, alternating and not",
            )
        )
    return Section("Relation to invariants", tuple(blocks))


def invariant_columns(results: Results, known: Mapping[str, Invariants]) -> dict[str, FloatArray]:
    """Invariants of the knots by name, nan where unknown, each of shape (K,)."""
    none = Invariants(None, None, None, None)
    more = [known.get(knot.knot, none) for knot in results.knots]
    columns: dict[str, Sequence[int | bool | None]] = {
        ARC: [knot.arc_index for knot in results.knots],
        CROSSINGS: [knot.crossing_number for knot in results.knots],
        "determinant": [knot.determinant for knot in results.knots],
        "absolute signature": [
            None if knot.signature is None else abs(knot.signature) for knot in results.knots
        ],
        "alternating (1) or not (0)": [knot.alternating for knot in results.knots],
        "bridge index": [each.bridge_index for each in more],
        "braid index": [each.braid_index for each in more],
        "unknotting number": [each.unknotting_number for each in more],
    }
    return {name: np.array(values, dtype=float) for name, values in columns.items()}


def correlation_table(results: Results, columns: Mapping[str, FloatArray], robots: str) -> Table:
    """Correlations of every invariant that is known of three knots or more."""
    fewest = results.best(robots)
    rows = []
    given = {
        "rank correlation": (),
        f"given {ARC}": (ARC,),
        f"given {CROSSINGS}": (CROSSINGS,),
        "given both": (ARC, CROSSINGS),
    }
    for name, values in columns.items():
        count = int(np.sum(~np.isnan(values + fewest)))
        if count < 3:
            continue
        row = [("invariant", name), ("knots", f"{count:,}")]
        for head, fixed in given.items():
            others = [columns[each] for each in fixed]
            value = np.nan if name in fixed else partial_spearman(values, fewest, *others)
            row.append((head, signed(value)))
        rows.append(row)
    return table_of(
        rows,
        f"Rank correlation with the smallest number of robots on the best outer cut "
        f"({results.methods[robots]}), over the knots of which the invariant is known; knots known "
        "only between bounds are left out.",
    )


def partial_spearman(x: FloatArray, y: FloatArray, *given: FloatArray) -> float:
    """Spearman's rank correlation of x and y with the ranks of others held fixed.

    Parameters
    ----------
    x, y, *given : float array, shape (n,)
        Entries with a nan in any of them are left out.

    Returns
    -------
    float
        nan where it is undefined: something is constant, or fixed by the others.

    Notes
    -----
    The partial correlation of ranks, from the inverse of their correlation matrix.

    Examples
    --------
    >>> x = np.arange(6.0)
    >>> round(partial_spearman(x, x**2), 3)
    1.0
    >>> y, given = np.array([1.0, 0, 3, 2, 5, 4]), np.array([0.0, 0, 2, 2, 4, 4])
    >>> round(partial_spearman(x, y, given), 3)
    -1.0
    """
    stacked = np.array([x, y, *given])
    stacked = stacked[:, ~np.isnan(stacked).any(axis=0)]
    if stacked.shape[1] < 3 or np.any(np.ptp(stacked, axis=1) == 0):
        return float("nan")
    matrix = np.corrcoef(rankdata(stacked, axis=1))
    if not given:
        return float(matrix[0, 1])
    of_others = np.linalg.inv(matrix[2:, 2:]) if np.linalg.cond(matrix[2:, 2:]) < 1e9 else None
    if of_others is None:
        return float("nan")
    left = matrix[:2, :2] - matrix[:2, 2:] @ of_others @ matrix[2:, :2]
    if min(left[0, 0], left[1, 1]) < 1e-9:
        return float("nan")
    return float(np.clip(left[0, 1] / np.sqrt(left[0, 0] * left[1, 1]), -1, 1))
