"""The knot that a rope becomes when its ends are joined above everything.

Lifting both ends straight up and joining them there is, seen from above, to lead the last end over
everything to the first one, along any way; here along one that crosses the fewest segments.
"""

from __future__ import annotations

from bisect import bisect
from collections import deque

from knotopt.planar.gauss import from_visits
from knotopt.topology.faces import dart_faces
from knotopt.topology.state import RopeState


def brought_together(state: RopeState) -> RopeState:
    """The rope led on from its last end over everything into the face of its first end.

    Examples
    --------
    A rope whose last end lies inside its loop:

    >>> print(brought_together(RopeState.from_gauss("U1+ U2- O1+ O2-")))
    U1+ U2- U3+ O1+ O2- O3+
    """
    way = _way_between_ends(state)
    visits = len(state.code)
    segments = sorted(segment for segment, _ in way)
    under = {segment: segment + rank for rank, segment in enumerate(segments)}
    shift = [visit + bisect(segments, visit) for visit in range(visits)]
    code = [0] * (visits + 2 * len(way))
    for visit, entry in enumerate(state.code):
        code[shift[visit]] = 4 * shift[entry >> 2] + (entry & 3)
    for over, (segment, from_right) in enumerate(way, visits + len(way)):
        code[under[segment]] = 4 * over + (not from_right)
        code[over] = 4 * under[segment] + 2 + (not from_right)
    return RopeState(tuple(code))


def closed_gauss(state: RopeState) -> tuple[list[int], list[bool], list[int]]:
    """The closed knot's crossings as `knotopt.cable.alexander.alexander_from_gauss` takes them.

    Returns
    -------
    visits : list of int, length 2 C
        Index (from 0) of the crossing at each visit; crossings are numbered as first met.
    over : list of bool, length 2 C
    signs : list of +1 or -1, length C

    Examples
    --------
    >>> from knotopt.cable.alexander import alexander_from_gauss
    >>> trefoil = closed_gauss(RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+"))
    >>> trefoil[0], alexander_from_gauss(*trefoil)
    ([0, 1, 2, 0, 1, 2], (1, -1, 1))
    """
    code = brought_together(state).code
    number: dict[int, int] = {}
    visits = [
        number.setdefault(min(visit, entry >> 2), len(number)) for visit, entry in enumerate(code)
    ]
    signs = [2 * (code[visit] & 1) - 1 for visit in number]
    return visits, [entry & 2 > 0 for entry in code], signs


def closed_pd(state: RopeState) -> tuple[tuple[int, int, int, int], ...]:
    """Planar diagram code of the closed knot, edges counted from 1.

    Examples
    --------
    >>> closed_pd(RopeState.from_gauss("O1+ U2+ O3+ U1+ O2+ U3+"))
    ((4, 2, 5, 1), (2, 6, 3, 5), (6, 4, 1, 3))
    """
    return from_visits(*closed_gauss(state)).pd_code


def _way_between_ends(state: RopeState) -> list[tuple[int, bool]]:
    """Segments crossed from the last end to the first end, and whether each from its right."""
    face = dart_faces(state.code)
    doors: dict[int, list[tuple[int, int]]] = {}
    for dart, here in enumerate(face):
        doors.setdefault(here, []).append((dart, face[dart ^ 1]))
    last, first = face[-1], face[0]
    entered: dict[int, tuple[int, int]] = {last: (-1, -1)}
    waiting = deque([last])
    while first not in entered:
        here = waiting.popleft()
        for dart, beyond in doors[here]:
            if beyond not in entered:
                entered[beyond] = (here, dart)
                waiting.append(beyond)
    way = []
    at = first
    while at != last:
        at, dart = entered[at]
        way.append((dart // 2, dart % 2 == 1))
    return way[::-1]
