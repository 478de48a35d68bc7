"""Summands that a planar diagram shows."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from knotopt.planar.sums import summands
from tests.helpers.knotinfo_codes import knotinfo_codes
from tests.helpers.strategies import planar_diagrams

PRIMES = [PlanarDiagram.from_edges(codes.crossings) for codes in knotinfo_codes(9)]
KINKS = [PlanarDiagram(((0, 0, 1, 1),)), PlanarDiagram(((0, 1, 1, 0),))]


def spliced(first: PlanarDiagram, second: PlanarDiagram) -> PlanarDiagram:
    """Both cut at their edge 0 and joined: from the first one's last edge into the second."""
    shift = 2 * len(first.crossings)
    edges = shift + 2 * len(second.crossings)
    crossings = []
    for planar, offset, end in ((first, 0, shift), (second, shift, edges)):
        for crossing, sign in zip(planar.crossings, planar.signs, strict=True):
            outgoing = (2, 1 if sign > 0 else 3)
            crossings.append(
                tuple(
                    (end if edge == 0 and side in outgoing else edge + offset) % edges
                    for side, edge in enumerate(crossing)
                )
            )
    return PlanarDiagram(tuple(crossings))


def turned(planar: PlanarDiagram, by: int) -> PlanarDiagram:
    """Edges numbered from another one on."""
    edges = 2 * len(planar.crossings)
    return PlanarDiagram(
        tuple(tuple((edge + by) % edges for edge in crossing) for crossing in planar.crossings)
    )


def canonical(planar: PlanarDiagram) -> tuple[tuple[int, int, int, int], ...]:
    """The same for every edge that the numbers may begin with."""
    turns = range(2 * len(planar.crossings))
    return min((tuple(sorted(turned(planar, by).crossings)) for by in turns), default=())


def test_knotinfos_diagrams_are_prime() -> None:
    for planar in PRIMES:
        assert summands(planar) == (planar,)


@given(
    st.lists(st.sampled_from([*PRIMES, *KINKS]), min_size=1, max_size=5),
    st.lists(st.integers(0, 100), min_size=5, max_size=5),
)
def test_summands_are_found_wherever_they_are_joined(
    parts: list[PlanarDiagram], turns: list[int]
) -> None:
    """Each is joined to any edge of those before, so some lie within others."""
    whole = parts[0]
    for part, turn in zip(parts[1:], turns, strict=False):
        whole = spliced(turned(whole, turn), turned(part, turn // 7))
    found = summands(whole)
    knotted = [part for part in parts if len(part.crossings) > 1]
    assert sorted(map(canonical, found)) == sorted(map(canonical, knotted or [PlanarDiagram(())]))


@given(planar_diagrams(max_size=9))
def test_signatures_add_up(planar: PlanarDiagram) -> None:
    found = summands(planar)
    assert sum(map(signature, found)) == signature(planar)
    assert all(summands(part) == (part,) for part in found)
