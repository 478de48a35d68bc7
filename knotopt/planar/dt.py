"""Dowker-Thistlethwaite (DT) codes.

The visits to crossings are numbered 1, 2, ... along the knot; at each crossing an odd number meets
an even one, and the code lists the even ones that meet 1, 3, 5, ..., negative where the even visit
passes over. It tells no knot from its mirror image, and of a composite knot no summand from its
mirror image. In letters, a, b, c, ... are 2, 4, 6, ... and capitals are negative.

Sources: Dowker and Thistlethwaite, "Classification of knot projections",
doi:10.1016/0166-8641(83)90004-4; the letters, with their heading and flips, are Knotscape's and
SnapPy's ("Links: planar diagrams and invariants" in SnapPy's documentation).
"""

from __future__ import annotations

from collections.abc import Sequence
from string import ascii_lowercase

from knotopt.errors import DiagramError
from knotopt.planar.gauss import from_visits, up_to_mirror
from knotopt.planar.planar_diagram import PlanarDiagram

MOST_LETTERS = len(ascii_lowercase)
"""Crossings that a code in letters can have."""


def from_dt(code: Sequence[int], flips: Sequence[int] | None = None) -> PlanarDiagram:
    """The diagram of a DT code: with flips exactly, else up to mirror image.

    Parameters
    ----------
    code : sequence of int, length C
        The even number that meets 1, 3, 5, ...; negative where the even visit passes over.
    flips : sequence of 0 or 1, length C, optional
        SnapPy's: 0 where the later visit of a crossing passes from right to left of the earlier
        one. Without them, signs are chosen as by `knotopt.planar.gauss.up_to_mirror`.

    Raises
    ------
    DiagramError
        Naming the first entry that is wrong, or the visit that cannot be reached in the plane.

    Examples
    --------
    >>> print(from_dt([4, 6, 2]))
    PD[X[4,2,5,1], X[6,4,1,3], X[2,6,3,5]]
    >>> from_dt([4, 6, 2], flips=[0, 0, 1]).signs
    (1, 1, 1)
    """
    _check_code(code)
    visits, over = [0] * (2 * len(code)), [False] * (2 * len(code))
    for crossing, even in enumerate(code):
        visits[2 * crossing] = visits[abs(even) - 1] = crossing
        over[2 * crossing], over[abs(even) - 1] = even > 0, even < 0
    if flips is None:
        return up_to_mirror(visits, over)
    if len(flips) != len(code) or not set(flips) <= {0, 1}:
        raise DiagramError(
            f"flips {list(flips)}: expected 0 or 1 for each of {len(code)} crossings"
        )
    signs = []
    for crossing, (even, flip) in enumerate(zip(code, flips, strict=True)):
        first = min(2 * crossing, abs(even) - 1)
        signs.append(1 if over[first] != bool(flip) else -1)
    return from_visits(visits, over, signs)


def dt_code(diagram: PlanarDiagram) -> tuple[int, ...]:
    """DT code, length C: the even number that meets 1, 3, 5, ...; negative if it passes over.

    Examples
    --------
    >>> dt_code(from_dt([4, 8, -12, 2, -14, -16, -6, -10]))
    (4, 8, -12, 2, -14, -16, -6, -10)
    """
    even = {
        crossing: -label if over else label
        for label, (crossing, over) in enumerate(diagram.visits, 1)
        if label % 2 == 0
    }
    return tuple(even[crossing] for crossing, _ in diagram.visits[::2])


def dt_flips(diagram: PlanarDiagram) -> tuple[int, ...]:
    """SnapPy's flips of `dt_code`, length C, which tell the diagram from its mirror image.

    Examples
    --------
    >>> dt_flips(from_dt([4, 6, 2]))
    (0, 0, 1)
    """
    first_over: dict[int, bool] = {}
    for crossing, over in diagram.visits:
        first_over.setdefault(crossing, over)
    return tuple(
        int(first_over[crossing] != (diagram.signs[crossing] > 0))
        for crossing, _ in diagram.visits[::2]
    )


def dt_letters(code: Sequence[int]) -> str:
    """A DT code in letters under Knotscape's heading: crossings, components, crossings of each.

    Raises
    ------
    DiagramError
        More crossings than letters.

    Examples
    --------
    >>> dt_letters((4, 8, -12, 2, -14, -16, -6, -10))
    'hahbdFaGHCE'
    """
    if not 0 < len(code) <= MOST_LETTERS:
        raise DiagramError(
            f"{len(code)} crossings: a DT code in letters has 1 to {MOST_LETTERS} of them"
        )
    letters = "".join(_letter(abs(even) // 2, even < 0) for even in code)
    size = _letter(len(code))
    return f"{size}a{size}{letters}"


def dt_numbers(letters: str) -> tuple[int, ...]:
    """The DT code that letters stand for, with or without a heading.

    Raises
    ------
    DiagramError
        Naming the first letter that is wrong, or the components of a link.

    Examples
    --------
    >>> dt_numbers("hahbdFaGHCE") == dt_numbers("bdFaGHCE") == (4, 8, -12, 2, -14, -16, -6, -10)
    True
    """
    for place, letter in enumerate(letters, 1):
        if letter.lower() not in ascii_lowercase:
            raise DiagramError(f"letter {place} of the DT code is {letter!r}, expected a to z")
    numbers = [_number(letter) for letter in letters]
    # Without a heading each letter stands once, small or capital; a heading repeats letters.
    if sorted(map(abs, numbers)) != list(range(1, len(numbers) + 1)):
        crossings, components = numbers[0], numbers[1] if len(numbers) > 1 else 0
        if crossings < 1 or components < 1 or len(numbers) != 2 + components + crossings:
            raise DiagramError(
                f"the DT code {letters!r} neither has each of its first {len(numbers)} letters "
                "once nor begins with its numbers of crossings and components"
            )
        if components != 1:
            raise DiagramError(f"this DT code is a link of {components} components, a knot has 1")
        if numbers[2] != crossings:
            raise DiagramError(
                f"the DT code {letters!r} has {crossings} crossings by its first letter and "
                f"{abs(numbers[2])} by its third"
            )
        numbers = numbers[3:]
    return tuple(2 * number for number in numbers)


def _letter(number: int, capital: bool = False) -> str:
    letter = ascii_lowercase[number - 1]
    return letter.upper() if capital else letter


def _number(letter: str) -> int:
    place = ascii_lowercase.index(letter.lower()) + 1
    return -place if letter.isupper() else place


def _check_code(code: Sequence[int]) -> None:
    place: dict[int, int] = {}
    for entry, even in enumerate(code, 1):
        if even % 2 or not 2 <= abs(even) <= 2 * len(code):
            raise DiagramError(
                f"entry {entry} of the DT code is {even}: {len(code)} crossings have the even "
                f"numbers 2 to {2 * len(code)}"
            )
        if abs(even) in place:
            raise DiagramError(
                f"entries {place[abs(even)]} and {entry} of the DT code are both {abs(even)}, "
                "expected each even number once"
            )
        place[abs(even)] = entry
