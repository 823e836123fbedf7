"""Texts over the 3D view."""

from __future__ import annotations

import blf
import bpy
import gpu
from bpy_extras.view3d_utils import location_3d_to_region_2d
from gpu_extras.batch import batch_for_shader

from .viewport import covered_px

_FONT, FONT_PX = 0, 12.0
PANEL_COLOUR = (0.1, 0.1, 0.1, 0.8)
TEXT_COLOUR = (1.0, 1.0, 1.0, 1.0)


def draw_rectangle(left: float, bottom: float, right: float, top: float, colour: tuple) -> None:
    """Draw a rectangle on the screen, px."""
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    corners = ((left, bottom), (right, bottom), (left, top), (right, top))
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("color", colour)
    batch_for_shader(shader, "TRI_STRIP", {"pos": corners}).draw(shader)
    gpu.state.blend_set("NONE")


def write(context: bpy.types.Context, x: float, y: float, text: str) -> None:
    """Write a text on the screen, px."""
    blf.size(_FONT, FONT_PX * context.preferences.system.ui_scale)
    blf.color(_FONT, *TEXT_COLOUR)
    blf.position(_FONT, round(x), round(y), 0.0)
    blf.draw(_FONT, text)


def write_at(context: bpy.types.Context, place_m: tuple, text: str, dot: tuple | None = None) -> None:
    """Write a text beside a place in space, on a dark ground to be seen before any colour; a dot may mark it."""
    where = location_3d_to_region_2d(context.region, context.region_data, place_m)
    if where is None:
        return
    scale = context.preferences.system.ui_scale
    blf.size(_FONT, FONT_PX * scale)
    width, height = blf.dimensions(_FONT, text)
    edge = 4.0 * scale
    x, y = (
        min(where.x + 2.0 * edge, (context.region.width - covered_px(context, "UI")) - width - 2.0 * edge),
        where.y + 2.0 * edge,
    )
    if dot:
        draw_rectangle(where.x - edge, where.y - edge, where.x + edge, where.y + edge, dot)
    draw_rectangle(x - edge, y - edge, x + width + edge, y + height + edge, PANEL_COLOUR)
    write(context, x, y, text)
