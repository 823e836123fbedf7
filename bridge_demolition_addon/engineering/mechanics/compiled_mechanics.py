"""Loops over connections, their loads and their work, compiled where Numba is installed."""

from __future__ import annotations

from types import ModuleType

from ..compilation import where_compiled


@where_compiled
def overload_loops() -> ModuleType:
    """Loops over connections that are judged."""
    from . import overload_loops

    return overload_loops


@where_compiled
def frame_loops() -> ModuleType:
    """Loops over loads and their work."""
    from . import frame_loops

    return frame_loops


@where_compiled
def touch_loops() -> ModuleType:
    """Loops over bodies that touch."""
    from . import touch_loops

    return touch_loops
