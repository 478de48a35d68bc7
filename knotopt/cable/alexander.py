"""Alexander polynomial of a knot from its Gauss code and signs, in exact integers.

At a crossing the strands satisfy outgoing = (1 - t) over + t incoming (with incoming and outgoing
under strands exchanged at a negative crossing); the polynomial is the determinant of these rows
with one row and one strand left out. Source: Alexander, "Topological invariants of knots and
links", doi:10.1090/S0002-9947-1928-1501429-1; Crowell and Fox, "Introduction to Knot Theory".

The determinant is evaluated at one power of two so large that the coefficients can be read off its
binary digits (Kronecker substitution); no rounding and no interpolation take part.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import chain

from knotopt.cable.cable import Cable

Row = dict[int, int]


def alexander_polynomial(cable: Cable) -> tuple[int, ...]:
    """Alexander polynomial of the closed-up cable.

    Returns
    -------
    tuple of int
        Coefficients, constant term first, both ends non-zero, leading coefficient positive.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> alexander_polynomial(Cable(torus_knot(2, 5), "L+"))
    (1, -1, 1, -1, 1)
    """
    _, index, over = cable.visits
    return alexander_from_gauss(index.tolist(), over.tolist(), cable.crossings.sign.tolist())


def alexander_from_gauss(
    visits: Sequence[int], over: Sequence[bool], signs: Sequence[int]
) -> tuple[int, ...]:
    """Alexander polynomial from the crossings visited in turn.

    Parameters
    ----------
    visits : sequence of int, length 2C
        Index (from 0) of the crossing at each visit.
    over : sequence of bool, length 2C
    signs : sequence of +1 or -1, length C

    Notes
    -----
    O(C^3) exact operations at worst; the sparse elimination first removes most rows.
    """
    count = len(signs)
    if count < 2:
        return (1,)
    bits = 2 * count + 2  # the rows' absolute sums are 4, so each |coefficient| is < 4 ** count
    t = 1 << bits
    rows: list[Row] = [{} for _ in range(count)]
    strand = 0
    for crossing, is_over in zip(visits, over, strict=True):
        if is_over:
            _add(rows[crossing], strand, 1 - t)
            continue
        after = (strand + 1) % count
        incoming, outgoing = (strand, after) if signs[crossing] > 0 else (after, strand)
        _add(rows[crossing], incoming, t)
        _add(rows[crossing], outgoing, -1)
        strand = after
    minor = [{column: v for column, v in row.items() if column} for row in rows[1:]]
    return _normalised(kronecker_digits(_determinant(minor), bits))


def determinant(polynomial: Sequence[int]) -> int:
    """Determinant of the knot, |Delta(-1)|.

    Examples
    --------
    >>> determinant((1, -3, 1))
    5
    """
    return abs(sum(-c if k % 2 else c for k, c in enumerate(polynomial)))


def format_polynomial(polynomial: Sequence[int] | Mapping[int, int]) -> str:
    """The polynomial in t as text: from coefficients, constant term first, or by their powers.

    Examples
    --------
    >>> format_polynomial((1, -3, 1)), format_polynomial({-1: 2, 0: 1, 1: -1})
    ('1 - 3t + t^2', '2t^-1 + 1 - t')
    """
    terms = []
    by_power = polynomial if isinstance(polynomial, Mapping) else dict(enumerate(polynomial))
    for power, coefficient in by_power.items():
        if coefficient == 0:
            continue
        size = "" if abs(coefficient) == 1 and power else str(abs(coefficient))
        terms.append("- " if coefficient < 0 else "+ ")
        terms[-1] += size + ("", "t")[power != 0] + (f"^{power}" if power not in (0, 1) else "")
    text = " ".join(terms)
    return text[2:] if text.startswith("+") else text.replace("- ", "-", 1)


def _add(row: Row, column: int, value: int) -> None:
    total = row.get(column, 0) + value
    if total:
        row[column] = total
    else:
        row.pop(column, None)


def _determinant(rows: list[Row]) -> int:
    """Determinant up to sign: sparse elimination on entries +-1, then fraction-free on the rest.

    It is never zero: a knot's Alexander polynomial is +-1 at t = 1.
    """
    rows = [dict(row) for row in rows]
    while True:
        users = Counter(chain.from_iterable(rows))
        pivots = [
            ((len(row) - 1) * (users[column] - 1), i, column)
            for i, row in enumerate(rows)
            for column, value in row.items()
            if value in (1, -1)
        ]
        if not pivots:
            break
        _, i, column = min(pivots)
        pivot = rows.pop(i)
        for row in rows:
            factor = row.get(column, 0) * -pivot[column]
            if factor:
                for other, value in pivot.items():
                    _add(row, other, factor * value)
    columns = sorted({column for row in rows for column in row})
    return _bareiss([[row.get(column, 0) for column in columns] for row in rows])


def _bareiss(matrix: list[list[int]]) -> int:
    """Fraction-free determinant up to sign (Bareiss, doi:10.1090/S0025-5718-1968-0226829-0)."""
    previous = 1
    while len(matrix) > 1:
        pivot = next(i for i, row in enumerate(matrix) if row[0])
        head, *tail = matrix.pop(pivot)
        matrix = [
            [
                (head * value - row[0] * top) // previous
                for value, top in zip(row[1:], tail, strict=True)
            ]
            for row in matrix
        ]
        previous = head
    return matrix[0][0] if matrix else 1


def kronecker_digits(value: int, bits: int) -> list[int]:
    """Digits of a signed number in base 2 ** bits, each in [-2 ** (bits-1), 2 ** (bits-1))."""
    digits = []
    while value:
        half = 1 << (bits - 1)
        digits.append((value + half) % (2 * half) - half)
        value = (value - digits[-1]) >> bits
    return digits


def _normalised(coefficients: list[int]) -> tuple[int, ...]:
    low = next(k for k, c in enumerate(coefficients) if c)
    sign = 1 if coefficients[-1] > 0 else -1
    return tuple(sign * c for c in coefficients[low:])
