"""Loops over elastic connections that are compiled, where Numba is installed."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any


@cache
def joint_loops() -> Any | None:
    """Return the module of compiled loops, loaded when connections first need it; None without Numba."""
    if find_spec("numba") is None:
        return None
    from . import joint_loops  # it takes a third of a second, and most calls of the program need none

    return joint_loops
