"""What a solver is asked and what it answers, the same for every backend."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:  # options of the command line are read from `Limits`, at once
    from formulations.instance import Instance


class Status(StrEnum):
    """What is known about an instance."""

    OPTIMAL = "optimal"  # a solution and the proof that none is better
    FEASIBLE = "feasible"  # a solution; better ones may exist
    INFEASIBLE = "infeasible"  # no solution exists
    UNKNOWN = "unknown"  # stopped before anything was known
    ERROR = "error"  # the solver failed, or what it returned violates the rows


class Feature(StrEnum):
    """What a backend can do beyond finding an optimum."""

    BOUND = "bound"  # gives a lower bound when it stops early
    GAP = "gap"  # stops at a relative gap
    START = "start"  # takes a first guess
    ENUMERATION = "enumeration"  # lists all optimal sets
    THREADS = "threads"  # uses more than one
    SEED = "seed"  # has randomness to fix

    @property
    def phrase(self) -> str:
        """What a user asks for, in words."""
        return {"gap": "a gap", "threads": "more than one thread"}.get(self, self)


class BackendError(ValueError):
    """A backend that does not exist, or is asked for what it cannot do."""


class MissingSolverError(BackendError):
    """A backend whose solver is not installed.

    Attributes
    ----------
    package, extra : str
        What is missing and the optional extra of this project that brings it.
    """

    def __init__(self, backend: str, package: str, extra: str) -> None:
        super().__init__(f"solver {backend} needs {package}, which is not installed")
        self.backend, self.package, self.extra = backend, package, extra


MOST_THREADS = 1024


@dataclass(frozen=True)
class Limits:
    """When a solver stops, and how it may run.

    Parameters
    ----------
    seconds : float or None
        Wall time.
    gap : float
        Relative gap (objective - bound) / objective at which a solution is good enough.
    threads : int
    seed : int

    Raises
    ------
    BackendError
        A limit that makes no sense.
    """

    seconds: float | None = None
    gap: float = 0.0
    threads: int = 1
    seed: int = 0

    def __post_init__(self) -> None:
        if self.seconds is not None and not self.seconds > 0:
            raise BackendError(f"the time limit must be positive, not {self.seconds} s")
        if not 0 <= self.gap < 1:
            raise BackendError(f"the gap must lie in [0, 1), not {self.gap}")
        if self.threads < 1:
            raise BackendError(f"the number of threads must be at least 1, not {self.threads}")
        if self.threads > MOST_THREADS:
            raise BackendError(
                f"the number of threads is at most {MOST_THREADS}, not {self.threads}"
            )
        if not 0 <= self.seed < 2**31:
            raise BackendError(f"the seed must lie in [0, 2^31), not {self.seed}")


@dataclass(frozen=True)
class Solution:
    """A solver's answer.

    Attributes
    ----------
    status : Status
    raw_status : str
        The solver's own words.
    chosen : tuple of int or None
        Decision variables (from 1) that are 1; None if no solution is known.
    objective : int or None
    bound : int or None
        Proven lower bound of the objective (rounded up: weights are integers).
    start_accepted : bool or None
        Whether the solver took the start as its first solution; None if it was given none.
    build_seconds, solve_seconds : float
        Time to hand the instance over, and to solve it [s].
    solver : str
        Backend, package and version.
    threads, seed : int
    interrupted : bool
        Whether it was stopped by Ctrl-C, so that whoever solves many should stop as well.
    """

    status: Status
    raw_status: str
    chosen: tuple[int, ...] | None = None
    objective: int | None = None
    bound: int | None = None
    start_accepted: bool | None = None
    build_seconds: float = 0.0
    solve_seconds: float = 0.0
    solver: str = "none"
    threads: int = 1
    seed: int = 0
    interrupted: bool = False

    @property
    def gap(self) -> float | None:
        """Relative gap between objective and bound; None while either is unknown."""
        if self.objective is None or self.bound is None:
            return None
        return (self.objective - self.bound) / max(1, self.objective)


@dataclass(frozen=True)
class Enumeration:
    """All optimal sets, or as many as the limit allowed.

    `sets` are sorted lexicographically; `complete` says that there are no others.
    """

    sets: tuple[tuple[int, ...], ...]
    complete: bool


class Backend(Protocol):
    """One solver."""

    name: str
    features: frozenset[Feature]

    def solve(self, instance: Instance, limits: Limits) -> Solution:
        """Minimise the instance's objective. Ctrl-C ends it with the best solution so far."""
        ...


class Enumerator(Backend, Protocol):
    """A backend that can also list solutions."""

    def enumerate(self, instance: Instance, limits: Limits, count: int) -> Enumeration:
        """All solutions of the rows, whatever their cost, until `count` are found."""
        ...


@dataclass
class Answer:
    """What a backend found, before anyone has checked it."""

    status: Status
    raw_status: str
    values: list[int] | None = None  # of all variables
    bound: float | None = None
    start_accepted: bool | None = None
    solve_seconds: float = 0.0


def checked(
    answer: Answer, instance: Instance, limits: Limits, *, build_seconds: float, solver: str
) -> Solution:
    """The answer as a `Solution`: never a set that violates a row, whatever the solver said."""
    status, raw = answer.status, answer.raw_status
    chosen: tuple[int, ...] | None = None
    objective = None
    bound = None if answer.bound is None else math.ceil(answer.bound - 1e-6)
    if answer.values is not None:
        violated = instance.violated(answer.values)
        if violated:
            row = instance.rows[violated[0]]
            raw += f"; but its solution violates {row.family}: {row.origin}"
            status = Status.ERROR
        else:
            chosen = tuple(j for j, v in enumerate(answer.values[: instance.decisions], 1) if v)
            objective = instance.cost(answer.values)
            if status is Status.OPTIMAL:
                bound = objective if bound is None else bound
                status = Status.OPTIMAL if bound >= objective else Status.FEASIBLE
            elif status is Status.FEASIBLE and bound is not None and bound >= objective:
                status = Status.OPTIMAL
    elif status is Status.INFEASIBLE:
        bound = None
    elif status in (Status.OPTIMAL, Status.FEASIBLE):
        raw += "; but it returned no solution"
        status = Status.ERROR
    return Solution(
        status,
        raw,
        chosen,
        objective,
        bound,
        answer.start_accepted,
        build_seconds,
        answer.solve_seconds,
        solver,
        limits.threads,
        limits.seed,
        _interrupted(answer, status, objective, bound, limits),
    )


def answer_at_once(instance: Instance, limits: Limits, solver: str) -> Solution | None:
    """The solution of an instance that needs no solver: without rows, or with an impossible one.

    Solvers differ in what they say of these.
    """
    if instance.impossible is not None:
        row = instance.impossible
        answer = Answer(Status.INFEASIBLE, f"{row.family}: {row.origin}: too few literals")
    elif not instance.rows:
        answer = Answer(Status.OPTIMAL, "no rows", [0] * len(instance.variables))
    else:
        return None
    return checked(answer, instance, limits, build_seconds=0.0, solver=solver)


def _interrupted(
    answer: Answer, status: Status, objective: int | None, bound: int | None, limits: Limits
) -> bool:
    """Whether a solver stopped early although no limit was reached."""
    if status not in (Status.FEASIBLE, Status.UNKNOWN):
        return False
    if limits.seconds is not None:
        # Solvers may stop a little before their limit; of a very short one nothing can be said.
        early = max(0.05, 0.1 * limits.seconds)
        if answer.solve_seconds > limits.seconds - early:
            return False
    if limits.gap and objective is not None and bound is not None:
        return (objective - bound) / max(1, objective) > limits.gap
    return True
