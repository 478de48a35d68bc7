"""An instance: a 0-1 program in which every row says "at least k of these literals are true".

A literal is +j (variable j is 1) or -j (variable j is 0), variables counted from 1 as in DIMACS.
A clause has k = 1, "at most one of a, b, c" is "at least two of -a, -b, -c": one kind of row serves
integer programming, constraint programming and satisfiability alike.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from formulations.arrays import IntArray

FORMAT = "knotopt instance 1"


class InstanceError(ValueError):
    """Data that is not an instance: the message names the row or key."""


@dataclass(frozen=True)
class Row:
    """At least `at_least` of `literals` are true.

    `family` is the constraint family that the row belongs to, `origin` what it comes from, in the
    words of whoever compiled the instance.
    """

    literals: tuple[int, ...]
    at_least: int
    family: str
    origin: str


@dataclass(frozen=True, eq=False)
class Instance:
    """Choose the fewest (or lightest) of the decision variables such that every row holds.

    Attributes
    ----------
    name : str
    variables : tuple of str
        Names of all V variables; the first `decisions` of them are what is asked for.
    decisions : int
    objective : tuple of int, length V
        Weights >= 0, to be minimised.
    rows : tuple of Row
    definitions : tuple of tuple of int
        For each variable after the decisions: the literals of earlier variables whose
        conjunction it stands for.
    start : tuple of int or None
        Decision variables (from 1) that are 1 in a first guess, which need not satisfy the rows.

    Raises
    ------
    InstanceError
        A row, weight, definition or start that names what is not there.

    Examples
    --------
    >>> cover = Instance("edge", ("a", "b"), 2, (1, 1), (Row((1, 2), 1, "cover", "edge ab"),))
    >>> cover.violated([0, 0]), cover.violated([1, 0])
    ((0,), ())
    >>> Instance.from_json(cover.to_json()).hash == cover.hash
    True
    """

    name: str
    variables: tuple[str, ...]
    decisions: int
    objective: tuple[int, ...]
    rows: tuple[Row, ...]
    definitions: tuple[tuple[int, ...], ...] = ()
    start: tuple[int, ...] | None = None

    def __post_init__(self) -> None:
        count = len(self.variables)
        if len(self.objective) != count:
            raise InstanceError(f"{len(self.objective)} weights for {count} variables")
        if any(weight < 0 for weight in self.objective):
            raise InstanceError(f"weights are not negative; found {min(self.objective)}")
        if self.decisions + len(self.definitions) != count:
            raise InstanceError(
                f"{count} variables are not {self.decisions} decisions and "
                f"{len(self.definitions)} definitions"
            )
        for number, row in enumerate(self.rows, 1):
            named = set(map(abs, row.literals))
            if named and (min(named) < 1 or max(named) > count):
                raise InstanceError(f"row {number} ({row.family}): a literal names no variable")
            if len(named) < len(row.literals):
                raise InstanceError(f"row {number} ({row.family}): a variable stands there twice")
        for number, literals in enumerate(self.definitions, self.decisions + 1):
            if not literals or max(map(abs, literals)) >= number or 0 in literals:
                raise InstanceError(f"variable {number} is not defined by earlier ones")
        for variable in self.start or ():
            if not 1 <= variable <= self.decisions:
                raise InstanceError(f"start: {variable} is no decision variable")

    @cached_property
    def matrix(self) -> tuple[csr_array, IntArray]:
        """The rows as A x >= b: sparse A (rows, V) with entries +1 and -1, and b."""
        lengths = [len(row.literals) for row in self.rows]
        literals = np.fromiter(
            (literal for row in self.rows for literal in row.literals), np.int64, sum(lengths)
        )
        starts = np.concatenate(([0], np.cumsum(lengths, dtype=np.int64)))
        matrix = csr_array(
            (np.sign(literals), np.abs(literals) - 1, starts),
            shape=(len(self.rows), len(self.variables)),
        )
        negative = np.concatenate(([0], np.cumsum(literals < 0)))
        at_least = np.array([row.at_least for row in self.rows], dtype=np.int64)
        return matrix, at_least - (negative[starts[1:]] - negative[starts[:-1]])

    def complete(self, chosen: Iterable[int]) -> IntArray:
        """Values of all variables when exactly the decision variables `chosen` (from 1) are 1."""
        values = np.zeros(len(self.variables) + 1, dtype=np.int64)
        values[list(chosen)] = 1
        for variable, literals in enumerate(self.definitions, self.decisions + 1):
            values[variable] = all(values[abs(x)] == (x > 0) for x in literals)
        return values[1:]

    def violated(self, values: Sequence[int] | IntArray) -> tuple[int, ...]:
        """Indices of the rows that an assignment, shape (V,), does not satisfy."""
        matrix, bound = self.matrix
        return tuple(np.flatnonzero(matrix @ np.asarray(values) < bound).tolist())

    def cost(self, values: Sequence[int] | IntArray) -> int:
        """Objective of an assignment, shape (V,)."""
        return int(np.dot(self.objective, np.asarray(values)))

    @cached_property
    def fixed(self) -> dict[int, int]:
        """Decision variables that a row of one literal fixes, and to what."""
        units = (row.literals[0] for row in self.rows if len(row.literals) == row.at_least == 1)
        return {abs(x): int(x > 0) for x in units if abs(x) <= self.decisions}

    @cached_property
    def impossible(self) -> Row | None:
        """A row that asks for more true literals than it has, if there is one."""
        return next((row for row in self.rows if row.at_least > len(row.literals)), None)

    def with_rows(self, rows: Iterable[Row]) -> Instance:
        """The instance with further rows."""
        return replace(self, rows=(*self.rows, *rows))

    def at_most(self, bound: int) -> Row:
        """The row that says: at most `bound` decision variables are 1."""
        literals = tuple(range(-1, -self.decisions - 1, -1))
        return Row(literals, self.decisions - bound, "at most", f"at most {bound}")

    def packing_bound(self) -> int:
        """A lower bound of how many decisions are 1, by rows that share no variable.

        Greedy over the rows with positive decision literals only, shortest first.
        """
        used: set[int] = set()
        bound = 0
        for row in sorted(self.rows, key=lambda row: len(row.literals)):
            positive = all(0 < x <= self.decisions for x in row.literals)
            if positive and row.at_least > 0 and used.isdisjoint(row.literals):
                used.update(row.literals)
                bound += row.at_least
        return bound

    def to_json(self) -> str:
        """The instance as JSON; the same instance gives the same text."""
        content: dict[str, Any] = {
            "format": FORMAT,
            "name": self.name,
            "variables": self.variables,
            "decisions": self.decisions,
            "objective": self.objective,
            "definitions": self.definitions,
            "start": self.start,
            "rows": [vars(row) for row in self.rows],
        }
        return json.dumps(content, separators=(",", ":"))

    @classmethod
    def from_json(cls, text: str) -> Instance:
        """The instance that `to_json` wrote.

        Raises
        ------
        InstanceError
            The text is not JSON, or a key is missing or of another kind.
        """
        try:
            content = json.loads(text)
        except json.JSONDecodeError as error:
            raise InstanceError(f"not JSON: line {error.lineno}: {error.msg}") from error
        if not isinstance(content, dict) or content.get("format") != FORMAT:
            raise InstanceError(f'not an instance: no "format": "{FORMAT}"')
        try:
            return cls(
                name=str(content["name"]),
                variables=tuple(map(str, content["variables"])),
                decisions=_integer(content["decisions"]),
                objective=_integers(content["objective"]),
                rows=tuple(
                    Row(
                        _integers(row["literals"]),
                        _integer(row["at_least"]),
                        str(row["family"]),
                        str(row["origin"]),
                    )
                    for row in content["rows"]
                ),
                definitions=tuple(map(_integers, content["definitions"])),
                start=None if content["start"] is None else _integers(content["start"]),
            )
        except KeyError as error:
            raise InstanceError(f"key {error} is missing") from error
        except (TypeError, ValueError) as error:
            if isinstance(error, InstanceError):
                raise
            raise InstanceError(f"an entry is of the wrong kind: {error}") from error

    @cached_property
    def hash(self) -> str:
        """SHA-256 of `to_json`."""
        return hashlib.sha256(self.to_json().encode()).hexdigest()


def _integer(value: Any) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise TypeError(f"{value!r} is no integer")
    return value


def _integers(values: Any) -> tuple[int, ...]:
    if not isinstance(values, list):
        raise TypeError(f"{values!r} is no list")
    return tuple(map(_integer, values))
