"""Invariants computed by SnapPy's packages (Spherogram, knot_floer_homology, PARI), not by us."""

from __future__ import annotations

from dataclasses import dataclass

import spherogram
from cypari import pari

from knotopt.cable.cable import Cable
from knotopt.cable.notation import pd_code
from knotopt.diagram.grid import GridDiagram

Ranks = dict[tuple[int, int], int]
UNKNOT_RANKS: Ranks = {(0, 0): 1}


@dataclass(frozen=True)
class Invariants:
    """`alexander` has its constant term first and a positive leading coefficient; `signature` is
    that of V + V^T; `ranks` are those of knot Floer homology, which tells mirror images apart."""

    alexander: tuple[int, ...]
    signature: int
    ranks: Ranks


def link_of(cable: Cable) -> spherogram.Link:
    return spherogram.Link([list(crossing) for crossing in pd_code(cable)])


def seifert_invariants(link: spherogram.Link) -> tuple[tuple[int, ...], int]:
    """Alexander polynomial and signature from Spherogram's Seifert matrix, exactly, by PARI."""
    rows = link.seifert_matrix()
    if not rows:
        return (1,), 0
    matrix = pari.matrix(len(rows), len(rows), [entry for row in rows for entry in row])
    polynomial = [int(c) for c in (matrix - pari("t") * matrix.mattranspose()).matdet().Vecrev()]
    low = next(k for k, c in enumerate(polynomial) if c)
    polynomial = polynomial[low:]
    while polynomial[-1] == 0:
        polynomial.pop()
    sign = 1 if polynomial[-1] > 0 else -1
    plus, minus = (int(n) for n in (matrix + matrix.mattranspose()).qfsign())
    return tuple(sign * c for c in polynomial), plus - minus


def invariants(diagram: GridDiagram) -> Invariants:
    """Invariants of a grid diagram's knot, by way of the PD code of its cable cut at L+."""
    cable = Cable(diagram, "L+")
    if not len(cable.crossings):
        return Invariants((1,), 0, UNKNOT_RANKS)
    link = link_of(cable)
    alexander, signature = seifert_invariants(link)
    return Invariants(alexander, signature, homology_ranks(link))


def homology_ranks(link: spherogram.Link) -> Ranks:
    """Ranks of knot Floer homology by (Alexander, Maslov) grading. Simplifies the link given."""
    link.simplify("basic")  # knot_floer_homology refuses kinks
    if not link.crossings:
        return UNKNOT_RANKS
    ranks: Ranks = link.knot_floer_homology()["ranks"]
    return ranks


def euler_characteristic(ranks: Ranks) -> tuple[int, ...]:
    """The Alexander polynomial, as the graded Euler characteristic of knot Floer homology
    (Ozsvath and Szabo, doi:10.1016/j.aim.2003.05.001)."""
    polynomial: dict[int, int] = {}
    for (alexander, maslov), rank in ranks.items():
        polynomial[alexander] = polynomial.get(alexander, 0) + (-1) ** maslov * rank
    degrees = [degree for degree, coefficient in polynomial.items() if coefficient]
    found = [polynomial.get(degree, 0) for degree in range(min(degrees), max(degrees) + 1)]
    return tuple(c if found[-1] > 0 else -c for c in found)


def mirrored(found: Invariants) -> Invariants:
    """The invariants of the mirror image."""
    ranks = {(-a, -m): rank for (a, m), rank in found.ranks.items()}
    return Invariants(found.alexander, -found.signature, ranks)
