"""Regions as the unit squares between the columns and rows of a grid."""

from __future__ import annotations

import numpy as np

from knotopt.arrays import BoolArray, IntArray
from knotopt.supports.regions import Regions


def active_layers(regions: Regions) -> IntArray:
    """Active regions over each unit square [c, c + 1] x [r, r + 1], shape (N + 1, N + 1)."""
    size = regions.cable.diagram.size
    layers = np.zeros((size + 1, size + 1), dtype=np.int64)
    for index in regions.active.tolist():
        layers += squares(regions[index].interior)
    return layers


def squares(interior: BoolArray) -> BoolArray:
    """Unit squares that touch an interior cell, which fill a region up to its boundary."""
    padded = np.pad(interior, 1)
    return padded[1:, 1:] | padded[:-1, 1:] | padded[1:, :-1] | padded[:-1, :-1]
