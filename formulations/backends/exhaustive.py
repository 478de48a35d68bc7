"""Every subset, smallest first, as bit masks: slow, simple, and right by inspection."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator

import numpy as np

from formulations.instance import Instance
from formulations.solution import (
    Answer,
    BackendError,
    Enumeration,
    Feature,
    Limits,
    Solution,
    Status,
    answer_at_once,
    checked,
)
from formulations.timing import Deadline

MAX_FREE = 22  # decision variables that no row fixes
_AT_ONCE = 1 << 14


class Exhaustive:
    """Goes through the subsets of up to `MAX_FREE` decisions in order of their size.

    The objective must weigh all decisions alike and nothing else.
    """

    name = "exhaustive"
    features = frozenset({Feature.BOUND, Feature.ENUMERATION})

    def solve(self, instance: Instance, limits: Limits) -> Solution:
        """The lexicographically first of the smallest sets; Ctrl-C ends with the bound so far."""
        if (known := answer_at_once(instance, limits, self.name)) is not None:
            return known
        began = time.perf_counter()
        subsets = _Subsets(instance)
        build_seconds = time.perf_counter() - began
        began = time.perf_counter()
        weight = instance.objective[0] if instance.objective else 0
        answer = Answer(Status.INFEASIBLE, "no subset satisfies the rows")
        try:
            for size in range(len(subsets.free) + 1):
                bound = weight * (size + len(subsets.always))
                if limits.seconds is not None and time.perf_counter() - began > limits.seconds:
                    answer = Answer(Status.UNKNOWN, f"stopped before size {size}", bound=bound)
                    break
                found = next(subsets.of_size(size), None)
                if found is not None:
                    values = instance.complete(found).tolist()
                    answer = Answer(Status.OPTIMAL, f"first at size {size}", values, bound)
                    break
        except KeyboardInterrupt:
            answer = Answer(Status.UNKNOWN, f"interrupted at size {size}", bound=bound)
        answer.solve_seconds = time.perf_counter() - began
        solver = f"{self.name} (numpy {np.__version__})"
        return checked(answer, instance, limits, build_seconds=build_seconds, solver=solver)

    def enumerate(self, instance: Instance, limits: Limits, count: int) -> Enumeration:
        """Every set that satisfies the rows, `count` at most."""
        deadline = Deadline(limits)
        subsets = _Subsets(instance)
        sets: list[tuple[int, ...]] = []
        try:
            for size in range(len(subsets.free) + 1):
                if deadline.passed:
                    return Enumeration(tuple(sorted(sets)), complete=False)
                sets += itertools.islice(subsets.of_size(size), count + 1 - len(sets))
        except KeyboardInterrupt:
            return Enumeration(tuple(sorted(sets[:count])), complete=False)
        return Enumeration(tuple(sorted(sets[:count])), len(sets) <= count)


class _Subsets:
    """The sets of decisions that satisfy an instance, by size."""

    def __init__(self, instance: Instance) -> None:
        weights = set(instance.objective[: instance.decisions])
        if len(weights) > 1 or any(instance.objective[instance.decisions :]):
            raise BackendError("exhaustive search needs one weight for all decisions")
        fixed = instance.fixed
        self.always = [j for j, value in fixed.items() if value]
        self.free = [j for j in range(1, instance.decisions + 1) if j not in fixed]
        if len(self.free) > MAX_FREE:
            raise BackendError(
                f"exhaustive search goes through 2^n subsets of at most {MAX_FREE} variables; "
                f"this instance has {len(self.free)}"
            )
        self.instance = instance
        bit = {variable: 1 << position for position, variable in enumerate(self.free)}
        self.clauses: list[tuple[int, np.uint64, np.uint64]] = []
        others = []
        for index, row in enumerate(instance.rows):
            if any(abs(x) > instance.decisions for x in row.literals):
                others.append(index)
                continue
            open_literals = [x for x in row.literals if abs(x) in bit]
            true = sum(fixed.get(abs(x)) == int(x > 0) for x in row.literals)
            positive = sum(bit[x] for x in open_literals if x > 0)
            negative = sum(bit[-x] for x in open_literals if x < 0)
            self.clauses.append((row.at_least - true, np.uint64(positive), np.uint64(negative)))
        self.others = np.array(others, dtype=np.int64)

    def of_size(self, size: int) -> Iterator[tuple[int, ...]]:
        """The sets with `size` free decisions, in lexicographic order."""
        combinations = itertools.combinations(range(len(self.free)), size)
        while batch := list(itertools.islice(combinations, _AT_ONCE)):
            positions = np.array(batch, dtype=np.uint64).reshape(len(batch), size)
            masks = np.bitwise_or.reduce(np.uint64(1) << positions, axis=1)
            kept = np.arange(len(batch))
            for at_least, positive, negative in self.clauses:
                true = np.bitwise_count(masks[kept] & positive).astype(np.int64)
                true += np.bitwise_count(~masks[kept] & negative)
                kept = kept[true >= at_least]
            found = [
                tuple(sorted((*self.always, *(self.free[i] for i in batch[index]))))
                for index in kept.tolist()
            ]
            yield from self._satisfying_others(found)

    def _satisfying_others(self, sets: list[tuple[int, ...]]) -> Iterator[tuple[int, ...]]:
        """Those of the sets that satisfy the rows with variables beyond the decisions."""
        if not len(self.others) or not sets:
            yield from sets
            return
        instance = self.instance
        values = np.zeros((len(sets), len(instance.variables) + 1), dtype=bool)
        for row, chosen in enumerate(sets):
            values[row, list(chosen)] = True
        for variable, literals in enumerate(instance.definitions, instance.decisions + 1):
            columns = [values[:, abs(x)] == (x > 0) for x in literals]
            values[:, variable] = np.logical_and.reduce(columns)
        matrix, bound = instance.matrix
        holds = matrix[self.others] @ values[:, 1:].T.astype(np.int64)
        good = (holds >= bound[self.others, None]).all(axis=0)
        yield from itertools.compress(sets, good)
