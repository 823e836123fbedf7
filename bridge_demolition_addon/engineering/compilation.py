"""Loops that Numba compiles where it is installed (the extra `[fast]`); elsewhere numpy does the same.

Numpy is the reference: loops do its operations in its order, and give its bits. Numba neither fuses nor reorders any,
as its `fastmath` is off.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, wraps
from importlib.util import find_spec
from types import ModuleType
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Return a function as Numba compiles it; use this only in modules of loops."""
    import numba

    return cast("Function", numba.njit(cache=True, nogil=True, error_model="numpy")(function))


def where_compiled(load: Callable[[], ModuleType]) -> Callable[[], Any | None]:
    """Return a function that loads a module of loops when these are first needed, and returns None without Numba.

    Loading takes a third of a second, and most calls of the program need no loops.
    """

    @cache
    @wraps(load)
    def loaded() -> Any | None:
        return load() if find_spec("numba") is not None else None

    return loaded
