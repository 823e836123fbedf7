"""Functions that draw over the 3D view, called by Blender at every redraw."""

from __future__ import annotations

from collections.abc import Callable

import bpy

Draw = Callable[[bpy.types.Context], None]


class ViewDrawing:
    """Draws over all 3D views, and never raises: the console would get the error with every redraw.

    Parameters
    ----------
    in_space, on_screen
        What draws in metres, and over it in pixels of the view; None for nothing.
    """

    def __init__(self, in_space: Draw, on_screen: Draw | None = None):
        self._draws = {"POST_VIEW": in_space} | ({"POST_PIXEL": on_screen} if on_screen else {})
        self._handles: list[object] = []
        self._trouble: dict[str, str] = {}

    @property
    def trouble(self) -> str:
        """Why something could not be drawn the last time, for the sidebar; empty where everything was."""
        return next(iter(self._trouble.values()), "")

    def begin(self) -> None:
        """Draw from now on."""
        for when in self._draws:
            handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (when,), "WINDOW", when)
            self._handles.append(handle)

    def end(self) -> None:
        """Stop drawing."""
        while self._handles:
            bpy.types.SpaceView3D.draw_handler_remove(self._handles.pop(), "WINDOW")
        self._trouble.clear()

    def _draw(self, when: str) -> None:
        try:
            self._draws[when](bpy.context)
            self._trouble.pop(when, None)
        except Exception as error:  # the sidebar shows it
            self._trouble[when] = str(error)
