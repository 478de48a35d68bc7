"""Why an instance has no solution: a smallest conflict among its rows, by a deletion filter."""

from __future__ import annotations

from dataclasses import replace

from formulations.instance import Instance
from formulations.solution import Backend, Limits, Status
from formulations.timing import Deadline

Group = tuple[str, str]  # family and origin of the rows


def conflict(
    instance: Instance, backend: Backend, limits: Limits
) -> tuple[tuple[Group, ...], bool]:
    """Groups of rows that cannot be met together, while any of them can be left out.

    The second value says whether the latter is sure: it is not if a limit struck.

    Rows of one family and origin form a group and stay together. The filter tries to do without
    ever smaller blocks of groups (Chinneck and Dravnieks 1991, doi:10.1287/ijoc.3.2.157). The
    objective does not matter.

    Examples
    --------
    >>> from formulations.backends import get_backend
    >>> from formulations.instance import Row
    >>> rows = (Row((1, 2), 1, "cover", "ab"), Row((-1,), 1, "no", "a"), Row((-2,), 1, "no", "b"),
    ...     Row((3,), 1, "cover", "c"))
    >>> conflict(Instance("", ("a", "b", "c"), 3, (1, 1, 1), rows), get_backend(), Limits())
    ((('cover', 'ab'), ('no', 'a'), ('no', 'b')), True)
    """
    deadline = Deadline(limits)
    free = replace(instance, objective=(0,) * len(instance.variables), start=None)
    groups = list(dict.fromkeys((row.family, row.origin) for row in instance.rows))
    sure = True
    block = len(groups)
    while block:
        position = 0
        while position < len(groups):
            kept = groups[:position] + groups[position + block :]
            wanted = set(kept)
            rows = tuple(row for row in free.rows if (row.family, row.origin) in wanted)
            solution = backend.solve(replace(free, rows=rows), deadline.left())
            if solution.status is Status.INFEASIBLE:
                groups = kept
                continue
            position += block
            sure = sure and (solution.chosen is not None or block > 1)
            if deadline.passed:
                return tuple(groups), False
        block //= 2
    return tuple(groups), sure
