"""Nonlinear programs made of many small equal terms, with sparse exact derivatives.

A program is a sum of objective terms and a list of constraint terms; every term applies one small
function, an *element*, to a few variables. CasADi differentiates each element once; values,
gradients and Hessians of all terms of a kind are then one mapped call, and one sparse matrix adds
them up. No loop over terms runs in Python, and no graph colouring is needed.

The Hessian given to IPOPT is the objective's alone. Many constraints, such as those on triangles,
curve both ways, and with their curvature the step's matrix is indefinite time and again: on a grid
of size 21 that took four times as many iterations, each with several factorisations.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from formulations.arrays import IntArray


@dataclass(frozen=True)
class Element:
    """A twice differentiable function of a few variables and parameters.

    Attributes
    ----------
    name : str
    arity, parameters : int
        Numbers of variables and of parameters.
    expression : callable
        `expression(variables, parameters)` with CasADi column vectors gives a scalar.
    """

    name: str
    arity: int
    parameters: int
    expression: Callable[[ca.SX, ca.SX], ca.SX]


@dataclass(frozen=True)
class Terms:
    """An element applied to T lists of variables.

    Attributes
    ----------
    element : Element
    variables : int array, shape (T, arity)
        Indices of variables, the free ones first, then the fixed ones.
    """

    element: Element
    variables: IntArray


@dataclass(frozen=True)
class Structure:
    """Which terms a program has, without any numbers: one CasADi function serves all numbers.

    Attributes
    ----------
    free, fixed : int
        Numbers of variables to be found and of given ones.
    objective, constraints : tuple of (Element, shape (T, arity) bytes of int64)
    """

    free: int
    fixed: int
    objective: tuple[tuple[Element, bytes], ...]
    constraints: tuple[tuple[Element, bytes], ...]

    @classmethod
    def of(
        cls, free: int, fixed: int, objective: Sequence[Terms], constraints: Sequence[Terms]
    ) -> Structure:
        """The structure of the given terms; kinds without terms are left out."""

        def frozen(kinds: Sequence[Terms]) -> tuple[tuple[Element, bytes], ...]:
            return tuple(
                (terms.element, np.ascontiguousarray(terms.variables, dtype=np.int64).tobytes())
                for terms in kinds
                if len(terms.variables)
            )

        return cls(free, fixed, frozen(objective), frozen(constraints))


@lru_cache(maxsize=16)
def build_solver(structure: Structure, options: tuple[tuple[str, Any], ...]) -> ca.Function:
    """An IPOPT solver for a structure.

    Its `x` are the free variables; its `p` are the values of the fixed ones, then the parameters of
    every term, those of the objective first; its `g` are the constraint terms in order.
    """
    x = ca.MX.sym("x", structure.free)
    kinds = [
        (element, np.frombuffer(raw, dtype=np.int64).reshape(-1, element.arity))
        for element, raw in (*structure.objective, *structure.constraints)
    ]
    sizes = [len(variables) * element.parameters for element, variables in kinds]
    p = ca.MX.sym("p", structure.fixed + sum(sizes))
    every = ca.vertcat(x, p[: structure.fixed])
    offsets = structure.fixed + np.concatenate(([0], np.cumsum(sizes)))
    rows = sum(len(variables) for _, variables in kinds[len(structure.objective) :])
    multiplier, multipliers = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", rows)

    f = ca.MX(0)
    gradient, jacobian, hessian = _Sum(), _Sum(), _Sum()
    values: list[ca.MX] = []
    row = 0
    for kind, (element, variables) in enumerate(kinds):
        count = len(variables)
        inputs = ca.reshape(every[variables.ravel().tolist()], element.arity, count)
        parameters = ca.reshape(
            p[int(offsets[kind]) : int(offsets[kind + 1])], element.parameters, count
        )
        first, second = _derivatives(element)
        value, slope = first.map(count)(inputs, parameters)
        if kind >= len(structure.objective):
            values.append(value.T)
            each = np.repeat(np.arange(row, row + count), element.arity)
            jacobian.add(each.reshape(variables.shape), variables, slope)
            row += count
            continue
        f += ca.sum2(value)
        gradient.add(variables, np.zeros_like(variables), slope)
        low, high = _upper(element.arity)
        left, right = variables[:, low], variables[:, high]
        curvature = multiplier * second.map(count)(inputs, parameters)
        hessian.add(np.minimum(left, right), np.maximum(left, right), curvature)

    g = ca.vertcat(*values)
    n = structure.free
    functions = {
        "grad_f": ca.Function(
            "nlp_grad_f", [x, p], [f, ca.densify(gradient.matrix(n, 1))], ["x", "p"], _GRADIENT
        ),
        "jac_g": ca.Function(
            "nlp_jac_g", [x, p], [g, jacobian.matrix(rows, n)], ["x", "p"], _JACOBIAN
        ),
        "hess_lag": ca.Function(
            "nlp_hess_l",
            [x, p, multiplier, multipliers],
            [hessian.matrix(n, n)],
            ["x", "p", "lam_f", "lam_g"],
            _HESSIAN,
        ),
    }
    return ca.nlpsol(
        "solver", "ipopt", {"x": x, "p": p, "f": f, "g": g}, {**dict(options), **functions}
    )


_GRADIENT, _JACOBIAN = ["f", "grad_f_x"], ["g", "jac_g_x"]
_HESSIAN = ["triu_hess_gamma_x_x"]


class _Sum:
    """A sparse matrix as a sum of entries, many of which may stand at the same place."""

    def __init__(self) -> None:
        self._rows: list[IntArray] = []
        self._columns: list[IntArray] = []
        self._values: list[ca.MX] = []

    def add(self, rows: IntArray, columns: IntArray, values: ca.MX) -> None:
        """Add entries: indices of shape (T, k), values of shape (k, T)."""
        self._rows.append(rows.ravel())
        self._columns.append(columns.ravel())
        self._values.append(ca.vec(values))

    def matrix(self, height: int, width: int) -> ca.MX:
        """The sum; what lies outside (entries of fixed variables) is dropped."""
        if not self._values:
            return ca.MX(height, width)
        rows, columns = np.concatenate(self._rows), np.concatenate(self._columns)
        kept = np.flatnonzero((rows < height) & (columns < width))
        places, place = np.unique(columns[kept] * height + rows[kept], return_inverse=True)
        pattern = _pattern(height, width, places % height, places // height)
        adding = ca.DM(_pattern(len(places), len(rows), place, kept), 1.0)
        return ca.MX(pattern, adding @ ca.vertcat(*self._values))


def _pattern(height: int, width: int, rows: IntArray, columns: IntArray) -> ca.Sparsity:
    """The sparsity with entries at the given places, which are sorted by column, then row."""
    starts = np.searchsorted(columns, np.arange(width + 1))
    return ca.Sparsity(height, width, starts.tolist(), rows.tolist())


@lru_cache(maxsize=64)
def _derivatives(element: Element) -> tuple[ca.Function, ca.Function]:
    """Value with gradient, and the upper triangle of the Hessian."""
    u, w = ca.SX.sym("u", element.arity), ca.SX.sym("w", element.parameters)
    value = element.expression(u, w)
    slope = ca.densify(ca.gradient(value, u))
    curvature = ca.densify(ca.hessian(value, u)[0])
    low, high = _upper(element.arity)
    upper = ca.vertcat(*(curvature[i, j] for i, j in zip(low, high, strict=True)))
    return (
        ca.Function(element.name, [u, w], [value, slope]),
        ca.Function(f"{element.name}_hessian", [u, w], [upper]),
    )


def _upper(arity: int) -> tuple[list[int], list[int]]:
    low, high = np.triu_indices(arity)
    return low.tolist(), high.tolist()


def solver_options(settings: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    """IPOPT's settings as `build_solver` takes them, without output and what nobody asks for."""
    quiet = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "error_on_fail": False}
    unused = {"calc_lam_p": False, "no_nlp_grad": True}  # half the time to build a solver
    return tuple(
        sorted({**quiet, **unused, **{f"ipopt.{k}": v for k, v in settings.items()}}.items())
    )
