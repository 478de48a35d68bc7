"""Faces of a rope's projection, from its crossings alone.

Segment s lies between visits s - 1 and s of the rope. Its dart 2 s runs along the rope and its dart
2 s + 1 against it; a face is a cycle of darts with the face on their left. At a crossing the cycle
turns left, at an end of the rope it turns round. The projection with n crossings is a connected
graph with n + 2 vertices and 2 n + 1 edges, so by Euler's formula it lies on a sphere, and with any
face outside in the plane, exactly if there are n + 1 faces.
"""

from __future__ import annotations

Code = tuple[int, ...]
"""4 * partner + 2 * over + positive at each visit (from 0) along the rope."""


def next_darts(code: Code) -> list[int]:
    """The dart that follows each dart around the face on its left, length 4 n + 2."""
    after: list[int] = []
    back = 0  # dart 1 comes to the rope's first end and turns round
    for entry in code:
        out = entry // 4 * 2 + 2  # the dart along the rope out of the partner visit
        # The partner strand points to the left of this one if `over` and `positive` are equal.
        if entry & 3 in {0, 3}:
            after += (out, back)
            back = out - 1
        else:
            after += (out - 1, back)
            back = out
    after += (len(code) * 2 + 1, back)
    return after


def dart_faces(code: Code) -> list[int]:
    """The face on the left of each dart, numbered in the order of their first darts."""
    after = next_darts(code)
    face = [-1] * len(after)
    count = 0
    for start in range(len(after)):
        if face[start] < 0:
            dart = start
            while face[dart] < 0:
                face[dart] = count
                dart = after[dart]
            count += 1
    return face


def face_cycles(code: Code) -> tuple[tuple[int, ...], ...]:
    """The darts around each face in cyclic order, each from its smallest dart.

    Examples
    --------
    A rope without crossings has one face; a loop adds one inside it.

    >>> face_cycles(())
    ((0, 1),)
    >>> face_cycles((5, 3))
    ((0, 3, 4, 5, 1), (2,))
    """
    after = next_darts(code)
    cycles: list[list[int]] = []
    for dart, face in enumerate(dart_faces(code)):
        if face == len(cycles):
            cycles.append([dart])
            while (following := after[cycles[-1][-1]]) != dart:
                cycles[-1].append(following)
    return tuple(map(tuple, cycles))


def lies_in_the_plane(code: Code) -> bool:
    """Whether a code with matching visits is that of a curve in the plane."""
    return 2 * max(dart_faces(code)) == len(code)


def prefix(code: Code, visits: int) -> Code:
    """The code of the rope's first piece, up to that many visits: crossings met twice on it."""
    kept = [k for k in range(visits) if code[k] >> 2 < visits]
    place = {visit: k for k, visit in enumerate(kept)}
    return tuple(4 * place[code[k] >> 2] + (code[k] & 3) for k in kept)
