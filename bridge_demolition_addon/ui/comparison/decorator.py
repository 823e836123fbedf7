"""Drawing of another run in the 3D view. Nothing here changes any data: the rigid-body world knows nothing of it."""

from __future__ import annotations

import bpy

from ..results import placed
from ..view_drawing import ViewDrawing, draw_triangles, write_at
from . import shown

_texts: list[tuple[tuple[float, float, float], str]] = []
"""Position, m, and text of the view that is drawn now."""


def _draw_in_space(context: bpy.types.Context) -> None:
    _texts.clear()
    placed.follow_later(context.scene)
    run = shown.drawn_run(context.scene)
    if run is None:
        return
    draw_triangles(run.triangles, run.colours, solid=not run.is_over)
    _texts.append((run.position_m, run.text))


def _draw_on_screen(context: bpy.types.Context) -> None:
    for position, text in _texts:
        write_at(context, position, text)


def _forget() -> None:
    _texts.clear()
    shown.forget()


drawing = ViewDrawing(_draw_in_space, _draw_on_screen, forget=_forget)
