"""Loops over elastic connections that are compiled, where Numba is installed."""

from __future__ import annotations

from types import ModuleType

from ..compilation import where_compiled


@where_compiled
def joint_position_loops() -> ModuleType:
    """Loops over where elastic connections are."""
    from . import joint_position_loops

    return joint_position_loops


@where_compiled
def joint_loops() -> ModuleType:
    """Loops over what elastic connections do in a sub-step."""
    from . import joint_loops

    return joint_loops


@where_compiled
def equation_loops() -> ModuleType:
    """Loops over the equations of bodies and elastic connections."""
    from . import equation_loops

    return equation_loops
