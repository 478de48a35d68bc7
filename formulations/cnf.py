"""Rows as clauses: "at least k of m literals" in conjunctive normal form."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

from formulations.instance import Instance

Clause = tuple[int, ...]


def clauses(instance: Instance) -> Iterator[Clause]:
    """All rows of an instance as clauses; variables beyond the instance's are auxiliary.

    A set of variables satisfies the rows exactly if auxiliary values exist with which it
    satisfies the clauses.
    """
    fresh = count(len(instance.variables) + 1)
    for row in instance.rows:
        yield from at_least(row.literals, row.at_least, fresh)


def at_least(literals: Sequence[int], bound: int, fresh: Iterator[int]) -> Iterator[Clause]:
    """Clauses that say: at least `bound` of the literals are true.

    Parameters
    ----------
    literals : sequence of int
    bound : int
    fresh : iterator of int
        Gives variables that are used nowhere else.

    Notes
    -----
    Two of m literals: every m - 1 of them hold a true one. Beyond that a sequential counter of
    the false ones (Sinz 2005, doi:10.1007/11564751_73): O(m (m - bound)) clauses.

    Examples
    --------
    >>> list(at_least([1, 2, 3], 1, count(4)))
    [(1, 2, 3)]
    >>> list(at_least([1, 2, 3], 2, count(4)))
    [(2, 3), (1, 3), (1, 2)]
    """
    literals = tuple(literals)
    if bound <= 0:
        return
    if bound > len(literals):
        yield ()
    elif bound == 1:
        yield literals
    elif bound == len(literals):
        yield from ((literal,) for literal in literals)
    elif bound == 2:
        yield from (literals[:i] + literals[i + 1 :] for i in range(len(literals)))
    else:
        yield from at_most([-literal for literal in literals], len(literals) - bound, fresh)


def at_most(literals: Sequence[int], bound: int, fresh: Iterator[int]) -> Iterator[Clause]:
    """Clauses that say: at most `bound` of the literals are true, 1 <= bound < their number.

    Sequential counter: register (i, j) is true if at least j of the first i literals are. The
    registers are drawn in the order (1, 1), (2, 1), (2, 2), ... up to the last but one literal.
    """
    before: list[int] = []
    for position, literal in enumerate(literals[:-1]):
        registers = [next(fresh) for _ in range(min(bound, position + 1))]
        yield (-literal, registers[0])
        for j, register in enumerate(before):
            yield (-register, registers[j])
            if j + 1 < bound:
                yield (-literal, -register, registers[j + 1])
        if len(before) == bound:
            yield (-literal, -before[-1])
        before = registers
    yield (-literals[-1], -before[-1])
