"""Drawing a study on the ground of the 3D view: its map and its limit.

Nothing here changes any data, and nothing raises: the sidebar says what cannot be drawn.
"""

from __future__ import annotations

import bpy

from ..view_drawing import ViewDrawing
from ..viewport import draw_lines, draw_triangles
from . import session

_LIMIT_COLOUR = (1.0, 0.2, 0.2, 1.0)
_LIMIT_WIDTH_PX = 3.0


def register() -> None:
    """Draw from now on; what is drawn depends on the settings."""
    drawing.begin()


def unregister() -> None:
    """Stop drawing."""
    drawing.end()


def _draw(context: bpy.types.Context) -> None:
    shown = session.shown_study()
    if shown is None or not context.scene.bda.show_study:
        return
    draw_triangles(*shown.triangles)
    draw_lines(context, shown.limit_lines, _LIMIT_COLOUR, _LIMIT_WIDTH_PX)


drawing = ViewDrawing(_draw)
