"""A checker of refutations in which every step names the clauses it follows from (LRAT).

A step is checked as a person would: suppose all its literals are false; go through the named
clauses; each must have exactly one literal that is not false, which then must be true, and the last
one must have none. No existing checker is packaged for Python, and this is all there is to one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

Clause = tuple[int, ...]


class RefutationError(ValueError):
    """A step that does not follow; the message gives its number."""


def check_refutation(
    clauses: Sequence[Clause], steps: Iterable[tuple[Clause, Sequence[int]]]
) -> None:
    """Whether the steps refute the clauses.

    Parameters
    ----------
    clauses : sequence of clauses
        A clause is a tuple of literals, +j or -j.
    steps : iterable of (clause, hints)
        Hints are indices of clauses, then of earlier steps.

    Raises
    ------
    RefutationError
        A step does not follow from what it names, or the last one is not the empty clause.

    Examples
    --------
    >>> check_refutation([(1, 2), (-1,), (-2,)], [((), [1, 2, 0])])
    >>> check_refutation([(1, 2), (-1,)], [((), [1, 0])])
    Traceback (most recent call last):
    ...
    knotopt.verify.lrat.RefutationError: step 1 does not follow: its hints end without a conflict
    """
    known = list(clauses)
    last: Clause | None = None
    for number, (clause, hints) in enumerate(steps, 1):
        false = set(clause)
        conflict = False
        for hint in hints:
            if conflict or not 0 <= hint < len(known):
                raise RefutationError(f"step {number} does not follow: hint {hint} is out of place")
            left = [literal for literal in known[hint] if literal not in false]
            if len(left) > 1:
                raise RefutationError(f"step {number} does not follow: clause {hint} is not unit")
            if left:
                false.add(-left[0])
            else:
                conflict = True
        if not conflict:
            raise RefutationError(
                f"step {number} does not follow: its hints end without a conflict"
            )
        known.append(tuple(clause))
        last = tuple(clause)
    if last != ():
        raise RefutationError("the last step is not the empty clause")
