"""Prime planar diagrams of knots with 6 to 60 crossings, which grids of that size seldom are.

Forty PD codes made once by Spherogram, as `random_link(n, num_components=1, simplify=None)`; its
planar maps are others in each run.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from knotopt.planar.planar_diagram import PlanarDiagram

_FILE = Path(__file__).parents[1] / "data" / "random_pd_codes.json"


@cache
def random_diagrams() -> tuple[PlanarDiagram, ...]:
    """The forty diagrams, smallest first."""
    return tuple(map(PlanarDiagram.from_edges, json.loads(_FILE.read_text("utf-8"))))
