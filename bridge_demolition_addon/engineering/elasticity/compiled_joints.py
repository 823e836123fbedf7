"""Loops over elastic connections that are compiled, where Numba is installed."""

from __future__ import annotations

from types import ModuleType

from ..compilation import where_compiled


@where_compiled
def joint_loops() -> ModuleType:
    """Loops over elastic connections."""
    from . import joint_loops

    return joint_loops
