"""KnotInfo's grids, read as its own, are the knots of its own PD codes, mirror image or not."""

from __future__ import annotations

import json

import pytest
import spherogram

from knotopt.reading.knot import read_knot
from tests.helpers.snappy_invariants import homology_ranks, invariants, mirrored, seifert_invariants


@pytest.mark.slow
def test_chirality_of_all_knots_up_to_10_crossings() -> None:
    from database_knotinfo import link_list

    _, *rows = link_list()
    rows = [row for row in rows if row["grid_notation"] and int(row["crossing_number"]) <= 10]
    assert len(rows) == 249
    told = 0
    for row in rows:
        link = spherogram.Link([list(crossing) for crossing in json.loads(row["pd_notation"])])
        _, signature = seifert_invariants(link)
        named = read_knot(json.dumps({"grid_notation": row["grid_notation"]}))
        assert not named.ambiguous and "rows pass over columns" in named.notes[0]
        assert named.diagram == read_knot(row["name"]).diagram
        assert named.diagram == read_knot(row["grid_notation"], over="rows").diagram
        found = invariants(named.diagram)
        assert (found.signature, found.ranks) == (signature, homology_ranks(link)), row["name"]
        told += found != mirrored(found)
    assert told >= 173
