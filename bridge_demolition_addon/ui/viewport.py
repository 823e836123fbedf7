"""Selecting objects, what the 3D view looks at, and drawing in it."""

from collections.abc import Iterable

import bpy
import gpu
import numpy as np
from bpy_extras.view3d_utils import region_2d_to_location_3d
from gpu_extras.batch import batch_for_shader

_MOST_COVERED = 0.8
"""Share of the view that the sidebar may cover before the rest is too narrow to show anything in."""


def select_only(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> None:
    """Select these objects and nothing else."""
    for selected_object in context.selected_objects:
        selected_object.select_set(False)
    for obj in objects:
        obj.select_set(True)


def look_at_selected(context: bpy.types.Context, surroundings: float = 1.0) -> None:
    """Make the 3D view that the mouse is in, if any, show what is selected, beside the sidebar.

    It looks from `surroundings` times as far away as needed.
    """
    if not context.area or context.area.type != "VIEW_3D":
        return
    region = next(each for each in context.area.regions if each.type == "WINDOW")
    with context.temp_override(region=region):
        bpy.ops.view3d.view_selected()
    view, covered = context.space_data.region_3d, covered_px(context, "UI")
    if view.view_perspective == "CAMERA" or covered > _MOST_COVERED * region.width:
        return
    view.view_distance *= surroundings * max(min(region.width, region.height) / (region.width - covered), 1.0)
    view.update()
    edge, middle = (region_2d_to_location_3d(region, view, (x, 0.0), view.view_location) for x in (0.0, covered / 2.0))
    view.view_location += middle - edge


def covered_px(context: bpy.types.Context, kind: str) -> float:
    """Return the width of a region that covers a part of the 3D view, px."""
    region = next((each for each in context.area.regions if each.type == kind), None)
    covers = region and context.preferences.system.use_region_overlap and region.width > 1
    return float(region.width) if covers else 0.0


def draw_lines(context: bpy.types.Context, lines: np.ndarray, colour: tuple, width_px: float) -> None:
    """Draw lines (2 k, 3) in the 3D view that is drawn just now."""
    if not len(lines):
        return
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINES", {"pos": lines.astype(np.float32)})
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", width_px * context.preferences.system.ui_scale)
    shader.uniform_float("color", colour)
    batch.draw(shader)


def draw_triangles(triangles: np.ndarray, colours: np.ndarray) -> None:
    """Draw triangles (3 k, 3) with a colour (3 k, 4) at each corner, which lets what is behind it shine through."""
    if not len(triangles):
        return
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    content = {"pos": triangles.astype(np.float32), "color": colours.astype(np.float32)}
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    batch_for_shader(shader, "TRIS", content).draw(shader)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")
