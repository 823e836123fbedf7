"""Drawing over the 3D view: lines, areas and texts, and the functions that Blender calls for them at every redraw."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import blf
import bpy
import gpu
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from gpu_extras.batch import batch_for_shader

from .viewport import covered_px

FONT_PX = 12.0
PANEL_COLOUR = (0.1, 0.1, 0.1, 0.8)
TEXT_COLOUR = (1.0, 1.0, 1.0, 1.0)
_FONT = 0
_LINE, _FOOT_PX = 1.5, 40.0

Draw = Callable[[bpy.types.Context], None]


class ViewDrawing:
    """Draws over all 3D views, and never raises: the console would get the error with every redraw.

    Parameters
    ----------
    in_space, on_screen
        What draws in metres, and over it in pixels of the view; None for nothing.
    forget
        Forgets what was worked out for the drawing, once it ends.
    """

    def __init__(self, in_space: Draw, on_screen: Draw | None = None, forget: Callable[[], None] | None = None):
        self._draws = {"POST_VIEW": in_space} | ({"POST_PIXEL": on_screen} if on_screen else {})
        self._forget = forget
        self._handles: list[object] = []
        self._errors: dict[str, str] = {}

    @property
    def error(self) -> str:
        """Why something could not be drawn the last time, for the sidebar; empty where everything was."""
        return next(iter(self._errors.values()), "")

    def register(self) -> None:
        """Draw from now on."""
        for when in self._draws:
            handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (when,), "WINDOW", when)
            self._handles.append(handle)

    def unregister(self) -> None:
        """Stop drawing."""
        while self._handles:
            bpy.types.SpaceView3D.draw_handler_remove(self._handles.pop(), "WINDOW")
        self._errors.clear()
        if self._forget:
            self._forget()

    def _draw(self, when: str) -> None:
        try:
            self._draws[when](bpy.context)
            self._errors.pop(when, None)
        except Exception as error:  # the sidebar shows it
            self._errors[when] = str(error)


def draw_lines(context: bpy.types.Context, lines: np.ndarray, colour: tuple, width_px: float) -> None:
    """Draw lines (2 k, 3), m, in the 3D view that Blender draws now."""
    if not len(lines):
        return
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINES", {"pos": lines.astype(np.float32)})
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", width_px * context.preferences.system.ui_scale)
    shader.uniform_float("color", colour)
    batch.draw(shader)


def draw_triangles(triangles: np.ndarray, colours: np.ndarray, *, through: bool = False, solid: bool = False) -> None:
    """Draw triangles (3 k, 3), m, with a colour (3 k, 4) at each corner, which may be transparent.

    Those that go `through` are seen through all that stands before them; `solid` ones hide what is behind them.
    """
    if not len(triangles):
        return
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    content = {"pos": triangles.astype(np.float32), "color": colours.astype(np.float32)}
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("NONE" if through else "LESS_EQUAL")
    gpu.state.depth_mask_set(solid)
    batch_for_shader(shader, "TRIS", content).draw(shader)
    gpu.state.depth_mask_set(False)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


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


def write_at(context: bpy.types.Context, position_m: tuple, text: str, dot: tuple | None = None) -> None:
    """Write a text next to a position, m, on a dark ground, so that it can be read over any colour; `dot` marks it."""
    point = location_3d_to_region_2d(context.region, context.region_data, position_m)
    if point is None:
        return
    scale = context.preferences.system.ui_scale
    blf.size(_FONT, FONT_PX * scale)
    width, height = blf.dimensions(_FONT, text)
    edge = 4.0 * scale
    most_right = context.region.width - covered_px(context, "UI") - width - 2.0 * edge
    x, y = min(point.x + 2.0 * edge, most_right), point.y + 2.0 * edge
    if dot:
        draw_rectangle(point.x - edge, point.y - edge, point.x + edge, point.y + edge, dot)
    draw_rectangle(x - edge, y - edge, x + width + edge, y + height + edge, PANEL_COLOUR)
    write(context, x, y, text)


def write_at_foot(context: bpy.types.Context, lines: Sequence[str]) -> None:
    """Write lines on a dark ground at the foot of the view, in the middle of what tools and sidebar leave of it."""
    if not lines:
        return
    scale = context.preferences.system.ui_scale
    blf.size(_FONT, FONT_PX * scale)
    widths = [blf.dimensions(_FONT, line)[0] for line in lines]
    line_px, edge, foot = _LINE * FONT_PX * scale, FONT_PX * scale, _FOOT_PX * scale
    left, right = covered_px(context, "TOOLS"), context.region.width - covered_px(context, "UI")
    x = max((left + right - max(widths)) / 2.0, left + edge)
    draw_rectangle(x - edge, foot, x + max(widths) + edge, foot + len(lines) * line_px + edge, PANEL_COLOUR)
    for number, line in enumerate(reversed(lines)):
        write(context, x, foot + edge + number * line_px, line)
