"""Functions of ours in Blender's lists of handlers."""

from __future__ import annotations

from collections.abc import Callable

import bpy


class Callbacks:
    """Functions that Blender calls on certain occasions: each is in its list once, or not at all.

    Parameters
    ----------
    functions
        By the names of Blender's lists, such as ``frame_change_pre``. They are persistent.
    """

    def __init__(self, **functions: Callable):
        self._functions = functions

    def attach(self, *, first: bool = False) -> None:
        """Have them called from now on, before those that are there already or after them."""
        for name, function in self._functions.items():
            handlers = getattr(bpy.app.handlers, name)
            if function not in handlers:
                handlers.insert(0 if first else len(handlers), function)

    def detach(self) -> None:
        """Have them called no more; the functions of others stay."""
        for name, function in self._functions.items():
            handlers = getattr(bpy.app.handlers, name)
            while function in handlers:
                handlers.remove(function)
