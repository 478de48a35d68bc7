"""Gauss codes: the crossings in the order in which the knot visits them.

An entry is +k where the knot passes over crossing k and -k where it passes under it. The code does
not tell a knot from its mirror image; an oriented code, which adds the crossings' signs, does.

Sources: KnotInfo, "Gauss notation"; SageMath's `Link`, "oriented Gauss code"; the letters O and U
with crossing signs are Kauffman's, "Virtual knot theory", doi:10.1006/eujc.1999.0314.
"""

from __future__ import annotations

from collections.abc import Sequence

from knotopt.errors import DiagramError
from knotopt.planar.embedding import handedness, parts
from knotopt.planar.planar_diagram import PlanarDiagram


def from_visits(visits: Sequence[int], over: Sequence[bool], signs: Sequence[int]) -> PlanarDiagram:
    """The diagram of a closed curve from its visits to crossings.

    Parameters
    ----------
    visits : sequence of int, length 2C
        Index (from 0) of the crossing at each visit.
    over : sequence of bool, length 2C
        Whether the visit passes over; once at each crossing.
    signs : sequence of +1 or -1, length C
        Sign of each crossing.

    Raises
    ------
    DiagramError
        There is no such curve in the plane.
    """
    edges = len(visits)
    places = [[0, 0] for _ in signs]  # [under, over] incoming edge
    for edge, (crossing, is_over) in enumerate(zip(visits, over, strict=True)):
        places[crossing][is_over] = edge
    crossings = []
    for (under, incoming), sign in zip(places, signs, strict=True):
        outgoing = (incoming + 1) % edges
        right, left = (outgoing, incoming) if sign > 0 else (incoming, outgoing)
        crossings.append((under, right, (under + 1) % edges, left))
    return PlanarDiagram(tuple(crossings))


def from_gauss(code: Sequence[int], signs: Sequence[int] | None = None) -> PlanarDiagram:
    """The diagram of a Gauss code: with the crossings' signs exactly, else up to mirror image.

    Parameters
    ----------
    code : sequence of int, length 2C
        +k for the over and -k for the under visit of crossing k; crossings have any numbers.
    signs : sequence of +1 or -1, length C, optional
        Of each crossing, in the order of their numbers. Without them, the first crossing is
        positive, and so is the first one of each part of the diagram that the code leaves to be
        mirrored by itself (`knotopt.planar.embedding.parts`).

    Raises
    ------
    DiagramError
        Naming the first entry that is wrong, or the visit that cannot be reached in the plane.

    Examples
    --------
    >>> from_gauss([1, -2, 3, -1, 2, -3]).signs
    (1, 1, 1)
    >>> from_gauss([-1, 2, -3, 1, -2, 3], [-1, -1, -1]).pd_code
    ((1, 4, 2, 5), (5, 2, 6, 3), (3, 6, 4, 1))
    """
    _check_code(code)
    names = sorted({abs(entry) for entry in code})
    index = {name: crossing for crossing, name in enumerate(names)}
    visits = [index[abs(entry)] for entry in code]
    over = [entry > 0 for entry in code]
    if signs is None:
        return up_to_mirror(visits, over)
    _check_signs(signs, len(names))
    return from_visits(visits, over, signs)


def up_to_mirror(visits: Sequence[int], over: Sequence[bool]) -> PlanarDiagram:
    """The diagram of a closed curve of which the crossings' signs are not known.

    The first crossing is positive, as it is in SnapPy, and so is the first one of each part that
    can be mirrored by itself.

    Parameters
    ----------
    visits, over
        As for `from_visits`.

    Raises
    ------
    DiagramError
        There is no such curve in the plane.
    """
    from_right = handedness(visits)
    first_over: dict[int, bool] = {}
    for crossing, is_over in zip(visits, over, strict=True):
        first_over.setdefault(crossing, is_over)
    signs = [hand if first_over[c] else -hand for c, hand in enumerate(from_right)]
    for part in parts(visits):
        if signs[part[0]] < 0:
            for crossing in part:
                signs[crossing] = -signs[crossing]
    return from_visits(visits, over, signs)


def parts_by_themselves(diagram: PlanarDiagram) -> tuple[PlanarDiagram, ...]:
    """Each part that can be reflected by itself, closed up: the knot is their connected sum.

    Examples
    --------
    >>> two = from_gauss([1, -2, 3, -1, 2, -3, 4, -5, 6, -4, 5, -6])
    >>> [len(part.crossings) for part in parts_by_themselves(two)]
    [3, 3]
    """
    found = []
    for part in parts([crossing for crossing, _ in diagram.visits]):
        index = {crossing: place for place, crossing in enumerate(part)}
        own = [(index[crossing], over) for crossing, over in diagram.visits if crossing in index]
        signs = [diagram.signs[crossing] for crossing in part]
        found.append(from_visits([c for c, _ in own], [over for _, over in own], signs))
    return tuple(found)


def gauss_code(diagram: PlanarDiagram) -> tuple[int, ...]:
    """Gauss code, length 2C: +k for the over and -k for the under visit of crossing k.

    Crossings are numbered from 1 in the order of their first visits.

    Examples
    --------
    >>> gauss_code(from_gauss([1, -2, 3, -1, 2, -3]))
    (1, -2, 3, -1, 2, -3)
    """
    number: dict[int, int] = {}
    return tuple(
        (1 if over else -1) * number.setdefault(crossing, len(number) + 1)
        for crossing, over in diagram.visits
    )


def oriented_gauss_code(diagram: PlanarDiagram) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Gauss code and the signs of crossings 1, 2, ..., as SageMath's `Link` takes them.

    Examples
    --------
    >>> oriented_gauss_code(from_gauss([1, -2, 3, -1, 2, -3], [1, 1, 1]))
    ((1, -2, 3, -1, 2, -3), (1, 1, 1))
    """
    first = dict.fromkeys(crossing for crossing, _ in diagram.visits)
    return gauss_code(diagram), tuple(diagram.signs[crossing] for crossing in first)


def gauss_letters(diagram: PlanarDiagram) -> str:
    """Oriented Gauss code in letters: O or U, the crossing's number, and its sign.

    Examples
    --------
    >>> gauss_letters(from_gauss([1, -2, 3, -1, 2, -3], [1, 1, 1]))
    'O1+U2+O3+U1+O2+U3+'
    """
    code, signs = oriented_gauss_code(diagram)
    return "".join(
        f"{'O' if entry > 0 else 'U'}{abs(entry)}{'+' if signs[abs(entry) - 1] > 0 else '-'}"
        for entry in code
    )


def _check_code(code: Sequence[int]) -> None:
    seen: dict[int, list[int]] = {}
    for visit, entry in enumerate(code, 1):
        if entry == 0:
            raise DiagramError(f"visit {visit} is 0: crossings are numbered from 1")
        before = seen.setdefault(abs(entry), [])
        before.append(visit)
        if len(before) > 2:
            raise DiagramError(
                f"crossing {abs(entry)} is visited at {before[0]}, {before[1]} and {visit}, "
                "expected two visits"
            )
        if len(before) == 2 and code[before[0] - 1] == entry:
            passes = "over" if entry > 0 else "under"
            raise DiagramError(
                f"crossing {abs(entry)} is passed {passes} at visits {before[0]} and {visit}, "
                "expected once over and once under"
            )
    for name, visits in seen.items():
        if len(visits) == 1:
            raise DiagramError(
                f"crossing {name} is visited once, at {visits[0]}, expected two visits"
            )


def _check_signs(signs: Sequence[int], crossings: int) -> None:
    if len(signs) != crossings:
        raise DiagramError(f"{len(signs)} signs of {crossings} crossings, expected one of each")
    for number, sign in enumerate(signs, 1):
        if sign not in (-1, 1):
            raise DiagramError(f"sign {number} is {sign!r}, expected 1 or -1")
