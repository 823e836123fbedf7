"""Drawing of the section through the pile in the 3D view: outlines, areas, ground and a scale of heights.

Nothing here changes any data, and nothing raises: the panel says what cannot be drawn.
"""

from __future__ import annotations

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

from ...display.section_lines import ground_line, height_scale, section_outline, section_triangles
from ...model.debris.pile_sections import Direction, PileSection, pile_section
from ...simulation.blender_events import shown_results
from ..results import placed
from ..scene_units import length_text
from ..view_drawing import FONT_PX, ViewDrawing, draw_lines, draw_triangles, write_at

_DEBRIS, _STANDING = (1.0, 0.55, 0.1), (0.75, 0.85, 1.0)
_GROUND, _SCALE = (0.4, 0.9, 0.4, 1.0), (1.0, 1.0, 1.0, 1.0)
_FILLED, _WIDTH_PX = 0.4, 2.0
_LINE = 2.0
"""Distance of two heights that are written, over the size of their letters."""

_kept: dict[tuple, PileSection] = {}
"""The section that was cut last."""


def section_of(scene: bpy.types.Scene) -> PileSection | None:
    """Return the section of the frame that is shown; None without a run, and while one goes on."""
    shown = shown_results(scene)
    results, series = shown.results, shown.series
    row = series.row_at(scene.frame_current) if series else None
    if results is None or row is None:
        return None
    settings = scene.bda
    key = (scene.session_uid, shown.number, row, settings.section_direction, settings.section_place_m)
    if key not in _kept:
        _kept.clear()
        _kept[key] = pile_section(results, Direction[settings.section_direction], settings.section_place_m, row)
    return _kept[key]


def _draw_in_space(context: bpy.types.Context) -> None:
    placed.follow_later(context.scene)
    section = section_of(context.scene) if context.scene.bda.show_section else None
    if section is None:
        return
    for area, colour in ((section.standing, _STANDING), (section.debris, _DEBRIS)):
        triangles = section_triangles(section, area)
        draw_triangles(triangles, np.tile((*colour, _FILLED), (len(triangles), 1)), through=True)
        draw_lines(context, section_outline(section, area), (*colour, 1.0), _WIDTH_PX)
    draw_lines(context, ground_line(section), _GROUND, _WIDTH_PX)
    if scale := height_scale(section):
        draw_lines(context, scale.lines, _SCALE, _WIDTH_PX)


def _draw_on_screen(context: bpy.types.Context) -> None:
    section = section_of(context.scene) if context.scene.bda.show_section else None
    scale = height_scale(section) if section else None
    lowest_px = -np.inf
    for position, height in scale.marks if scale else ():
        point = location_3d_to_region_2d(context.region, context.region_data, position)
        if point is not None and abs(point.y - lowest_px) > _LINE * FONT_PX * context.preferences.system.ui_scale:
            write_at(context, position, length_text(height, "g"))
            lowest_px = point.y


drawing = ViewDrawing(_draw_in_space, _draw_on_screen, forget=_kept.clear)
