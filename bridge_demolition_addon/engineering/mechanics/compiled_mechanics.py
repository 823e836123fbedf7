"""Loops over connections, their loads and their work, compiled where Numba is installed."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any


@cache
def overload_loops() -> Any | None:
    """Return the module of compiled loops, loaded when connections are first judged; None without Numba."""
    if find_spec("numba") is None:
        return None
    from . import overload_loops  # it takes a third of a second, and most calls of the program need none

    return overload_loops


@cache
def frame_loops() -> Any | None:
    """Return the module of compiled loops, loaded when loads are first added up; None without Numba."""
    if find_spec("numba") is None:
        return None
    from . import frame_loops  # it takes a third of a second, and most calls of the program need none

    return frame_loops
