"""A layout written by hand, of no grid diagram: where robots hover, and what each span crosses."""

from __future__ import annotations

from knotopt.flight.layout import Layout, Letter

TREFOIL = Layout(
    [[0.0, 0.0], [3.2, -1.0], [0.0, -3.0]],
    [[], [Letter(1, True, 1, 0), Letter(1, False, -1, 1)]],
    outwards=(-1, 0),
)
"""Three robots: the second span winds once about the first, over it and back under it."""
