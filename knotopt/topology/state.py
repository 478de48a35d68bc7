"""The topological state of a rope: its crossings as seen from above, in the order of the rope.

Trace the rope from its first end, the head, to its last, the tail. Each crossing is visited twice;
a visit says where the other one is, whether the rope is over or under here, and the crossing's
sign, (l_over x l_under) . e_z with the strands' directions l. This fixes the curve on the sphere
up to deformation; which face lies outside is not recorded. Source: Yan, Li, Zhu and Bohg,
"Learning topological motion primitives for knot planning", IROS 2020, arXiv:2009.02615, section IV
and eq. 1.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from operator import index

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import IntArray
from knotopt.errors import KnotoptError
from knotopt.topology.faces import Code, face_cycles, lies_in_the_plane, prefix


class RopeStateError(KnotoptError):
    """A code that is no state of a rope: the message names the visit, from 1 as in the matrix."""


@dataclass(frozen=True, slots=True)
class RopeState:
    """A topological state with n crossings, visited 2 n times.

    Parameters
    ----------
    code : tuple of int, length 2 n
        4 * partner + 2 * over + positive at each visit: the partner visit (from 0), whether the
        rope passes over here, and whether the crossing's sign is +1. Not checked: see `checked`.

    Notes
    -----
    Segment s = 0 ... 2 n lies between visits s - 1 and s (from 0), so segments 0 and 2 n are the
    ends.

    Examples
    --------
    The overhand knot whose crossings are positive and that passes under first:

    >>> overhand = RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+")
    >>> overhand.crossings, overhand.is_planar
    (3, True)
    >>> print(overhand.mirror())
    U1- O2- U3- O1- U2- O3-
    >>> overhand.canonical() == overhand.reverse().mirror().canonical()
    True
    """

    code: Code

    @classmethod
    def checked(cls, code: Iterable[int]) -> RopeState:
        """The state with this code.

        Raises
        ------
        RopeStateError
            The code is not that of a rope in the plane; the message names the visit.
        """
        entries = tuple(index(entry) for entry in code)
        _check_visits(
            [entry >> 2 for entry in entries],
            [2 * (entry >> 1 & 1) - 1 for entry in entries],
            [2 * (entry & 1) - 1 for entry in entries],
        )
        if not lies_in_the_plane(entries):
            last = next(
                k for k in range(1, len(entries) + 1) if not lies_in_the_plane(prefix(entries, k))
            )
            raise RopeStateError(
                f"visit {last}: a rope in the plane cannot come back to visit "
                f"{(entries[last - 1] >> 2) + 1} here with sign {'-+'[entries[last - 1] & 1]}"
            )
        return cls(entries)

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> RopeState:
        """The state with this matrix, shape (4, 2 n); its rows are those of `matrix`.

        Raises
        ------
        RopeStateError
            The matrix is not that of a rope in the plane; the message names the visit.
        """
        try:
            table = np.asarray(matrix)
        except ValueError:
            raise RopeStateError("the rows of the matrix differ in length") from None
        if table.size == 0:
            return cls(())
        if table.ndim != 2 or len(table) != 4:
            raise RopeStateError(
                f"the matrix has shape {table.shape}; expected 4 rows: "
                f"visit, partner visit, over (+1) or under (-1), sign"
            )
        if table.dtype.kind not in "iuf":
            raise RopeStateError("the matrix has entries that are not numbers")
        whole = np.abs(table) < 2**31  # false for nan
        whole[whole] = table[whole] % 1 == 0
        if not whole.all():
            column = int(np.flatnonzero(~whole.all(axis=0))[0])
            raise RopeStateError(f"visit {column + 1}: the matrix has an entry that is not whole")
        numbers, partners, over, signs = table.astype(np.int64).tolist()
        for visit, number in enumerate(numbers, 1):
            if number != visit:
                raise RopeStateError(f"column {visit} of the matrix is numbered {number}")
        _check_visits([partner - 1 for partner in partners], over, signs)
        return cls.checked(
            4 * (partner - 1) + (up > 0) * 2 + (sign > 0)
            for partner, up, sign in zip(partners, over, signs, strict=True)
        )

    @classmethod
    def from_gauss(cls, code: str | Sequence[int], signs: Sequence[int] | None = None) -> RopeState:
        """The state with this Gauss code along the rope.

        Parameters
        ----------
        code : str or sequence of int
            Signed O/U code, as "O1+ U2+ O3+ U1+ O2+ U3+"; or, with `signs`, the numbers that
            `knotopt.cable.notation.gauss_code` gives, +k over and -k under, as a sequence or text.
        signs : sequence of +1 or -1, optional
            Sign of crossing k at place k - 1, for a code of numbers, which alone does not tell a
            curve from its mirror image.

        Raises
        ------
        RopeStateError
            The text cannot be read, or is not the code of a rope in the plane; the message names
            the visit.

        Examples
        --------
        >>> print(RopeState.from_gauss((1, -2, 3, -1, 2, -3), (1, 1, 1)))
        O1+ U2+ O3+ U1+ O2+ U3+
        >>> RopeState.from_gauss("O1+ U2+ O1+")
        Traceback (most recent call last):
        ...
        knotopt.topology.state.RopeStateError: 3 visits: every crossing has two
        """
        visits = _read_text(code) if isinstance(code, str) else [(abs(k), k > 0, 0) for k in code]
        if signs is not None:
            visits = [(k, over, _listed_sign(signs, k)) for k, over, _ in visits]
        for visit, (name, _, sign) in enumerate(visits, 1):
            if not sign:
                raise RopeStateError(
                    f"visit {visit} of crossing {name} has no sign, and without signs a Gauss code "
                    f"does not tell a rope from its mirror image; write O{name}+ or O{name}-, "
                    f"U{name}+ or U{name}-, or give the crossings' signs"
                )
        return cls.checked(_paired(visits))

    @property
    def crossings(self) -> int:
        """Number of crossings n."""
        return len(self.code) // 2

    @property
    def matrix(self) -> IntArray:
        """Shape (4, 2 n): visit and partner visit, from 1; +1 over, -1 under; sign of the crossing.

        Examples
        --------
        >>> RopeState.from_gauss("U1+ O1+").matrix.tolist()
        [[1, 2], [2, 1], [-1, 1], [1, 1]]
        """
        code = np.array(self.code, dtype=np.int64)
        visits = np.arange(1, len(code) + 1)
        return np.stack((visits, (code >> 2) + 1, (code & 2) - 1, 2 * (code & 1) - 1))

    def mirror(self) -> RopeState:
        """Reflected in a line of the plane: every sign changes, over and under stay."""
        return RopeState(tuple([entry ^ 1 for entry in self.code]))

    def reverse(self) -> RopeState:
        """Head and tail exchanged; signs stay."""
        return RopeState(reversed_code(self.code))

    def canonical(self) -> RopeState:
        """The state with the smallest code among the mirror images and reverses of this one."""
        code = self.code
        back = reversed_code(code)
        return RopeState(
            min(code, back, tuple([c ^ 1 for c in code]), tuple([c ^ 1 for c in back]))
        )

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        """Darts around each face, the face on their left: 2 s along segment s, 2 s + 1 against."""
        return face_cycles(self.code)

    @property
    def is_planar(self) -> bool:
        """Whether it has n + 1 faces, as every curve in the plane has."""
        return lies_in_the_plane(self.code)

    def __str__(self) -> str:
        """Signed O/U Gauss code; crossings numbered from 1 in the order of their first visits."""
        number: dict[int, int] = {}
        words = []
        for visit, entry in enumerate(self.code):
            k = number.setdefault(min(visit, entry >> 2), len(number) + 1)
            words.append(f"{'UO'[entry >> 1 & 1]}{k}{'-+'[entry & 1]}")
        return " ".join(words) or "trivial"


TRIVIAL = RopeState(())
"""A rope without crossings."""


def reversed_code(code: Code) -> Code:
    """The code with head and tail exchanged: visit k becomes visit 2 n - 1 - k."""
    last = 4 * (len(code) - 1)
    return tuple([last - (entry & ~3) + (entry & 3) for entry in reversed(code)])


def _check_visits(partners: Sequence[int], over: Sequence[int], signs: Sequence[int]) -> None:
    """Raise unless visits pair up, one over and one under, with one sign; `over`, `signs`: +-1."""
    count = len(partners)
    if count % 2:
        raise RopeStateError(f"{count} visits: every crossing has two")
    for visit, (partner, up, sign) in enumerate(zip(partners, over, signs, strict=True)):
        if not 0 <= partner < count:
            raise RopeStateError(
                f"visit {visit + 1}: its partner is visit {partner + 1}, but there are visits 1 "
                f"to {count}"
            )
        if partner == visit:
            raise RopeStateError(f"visit {visit + 1} is its own partner")
        if partners[partner] != visit:
            raise RopeStateError(
                f"visit {visit + 1}: its partner is visit {partner + 1}, whose partner is visit "
                f"{partners[partner] + 1}"
            )
        for name, value in (("over or under", up), ("sign", sign)):
            if value not in {1, -1}:
                raise RopeStateError(f"visit {visit + 1}: {name} is {value}, not +1 or -1")
        if over[partner] == up:
            raise RopeStateError(
                f"visits {visit + 1} and {partner + 1} of one crossing are both "
                f"{'over' if up > 0 else 'under'}"
            )
        if signs[partner] != sign:
            raise RopeStateError(
                f"visits {visit + 1} and {partner + 1} of one crossing have opposite signs"
            )


def _read_text(text: str) -> list[tuple[int, bool, int]]:
    """Crossing, over or not, sign (0 if not said) of each visit of a Gauss code in text."""
    words = re.findall(r"[OUou]\d+[+-]?|[^\s,;()\[\]]+", text)
    if words == ["trivial"]:
        return []
    visits = []
    for visit, word in enumerate(words, 1):
        signed = re.fullmatch(r"([OUou])(\d+)([+-]?)", word)
        number = re.fullmatch(r"([+-]?)(\d+)", word)
        if signed:
            side, name, sign = signed.groups()
            visits.append((int(name), side in "Oo", {"+": 1, "-": -1, "": 0}[sign]))
        elif number and int(number[2]):
            visits.append((int(number[2]), number[1] != "-", 0))
        else:
            raise RopeStateError(
                f"visit {visit}: {word!r} is not a visit such as O1+, U2-, 1 or -2"
            )
    return visits


def _listed_sign(signs: Sequence[int], name: int) -> int:
    if not 1 <= name <= len(signs):
        raise RopeStateError(
            f"crossing {name} has no sign: {len(signs)} signs are given, for crossings 1 to "
            f"{len(signs)}"
        )
    return signs[name - 1]


def _paired(visits: Sequence[tuple[Hashable, bool, int]]) -> list[int]:
    """The code of visits given by crossing, over or not, and sign."""
    if len(visits) % 2:
        raise RopeStateError(f"{len(visits)} visits: every crossing has two")
    met: dict[Hashable, list[int]] = {}
    for visit, (name, _, _) in enumerate(visits):
        met.setdefault(name, []).append(visit)
    for name, places in met.items():
        if len(places) != 2:
            times = {1: "once"}.get(len(places), f"{len(places)} times")
            raise RopeStateError(
                f"visit {places[-1] + 1}: crossing {name} is met {times}, not twice"
            )
    for visit, (name, _, sign) in enumerate(visits):
        if sign not in {1, -1}:
            raise RopeStateError(
                f"visit {visit + 1}: crossing {name} has sign {sign}, not +1 or -1"
            )
    return [
        4 * (sum(met[name]) - visit) + 2 * over + (sign > 0)
        for visit, (name, over, sign) in enumerate(visits)
    ]
