"""Plain functions on integers, compiled by numba where it is installed.

Compiled functions take arrays of int64 where plain ones take lists, whose items Python reads many
times faster. Both give the same results as long as no number leaves 64 bits.
"""

from __future__ import annotations

import hashlib
import importlib.util
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any, TypeVar, cast

import numpy as np

Function = TypeVar("Function", bound=Callable[..., Any])


def can_compile() -> bool:
    """Whether numba is installed."""
    return importlib.util.find_spec("numba") is not None


@cache
def compiled(function: Function) -> Function:
    """The function, and all that it calls, compiled.

    The machine code is kept beside the modules or, if nothing can be written there, in the user's
    cache folder. It takes seconds to make and is made once for each state of this package.
    """
    import numba

    namespace = dict(function.__globals__)
    for name, value in namespace.items():
        if name in function.__code__.co_names and isinstance(value, FunctionType):
            namespace[name] = compiled(value)
    # numba knows kept code by the function's name and file alone, not by what it calls elsewhere.
    name = f"{function.__name__}_{_state_of_package()}"
    copy = FunctionType(function.__code__.replace(co_name=name, co_qualname=name), namespace, name)
    result: Any = numba.njit(copy)
    with suppress(RuntimeError):  # nowhere to keep it
        result = numba.njit(cache=True)(copy)
    return cast(Function, result)


def numbers(values: list[int], *, compile: bool) -> Any:
    """A copy of the values: an array for compiled functions, else a list."""
    return np.array(values, dtype=np.int64) if compile else list(values)


@cache
def _state_of_package() -> str:
    """What changes whenever a module of this package does."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:8]
