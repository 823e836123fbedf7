"""Drawing a study on the ground of the 3D view: its map and its limit.

Nothing here changes any data, and nothing raises: the sidebar says what cannot be drawn.
"""

from __future__ import annotations

import bpy

from ..viewport import draw_lines, draw_triangles
from . import session

_LIMIT_COLOUR = (1.0, 0.2, 0.2, 1.0)
_LIMIT_WIDTH_PX = 3.0

_draw_handles: list[object] = []
_trouble: list[str] = []


def register() -> None:
    """Draw from now on; what is drawn depends on the settings."""
    _draw_handles.append(bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW"))


def unregister() -> None:
    """Stop drawing."""
    while _draw_handles:
        bpy.types.SpaceView3D.draw_handler_remove(_draw_handles.pop(), "WINDOW")
    _trouble.clear()


def trouble() -> str:
    """Return why the study could not be drawn the last time; empty where it was."""
    return _trouble[0] if _trouble else ""


def _draw() -> None:
    context, shown = bpy.context, session.shown_study()
    if shown is None or not context.scene.bda.show_study:
        return
    try:
        draw_triangles(*shown.triangles)
        draw_lines(context, shown.limit_lines, _LIMIT_COLOUR, _LIMIT_WIDTH_PX)
        _trouble.clear()
    except Exception as error:  # the sidebar shows it; the console would get it with every redraw
        _trouble[:] = [str(error)]
