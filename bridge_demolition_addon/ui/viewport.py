"""Selecting objects, and moving the 3D view."""

from collections.abc import Iterable

import bpy
import numpy as np
from bpy_extras.view3d_utils import region_2d_to_location_3d
from mathutils import Quaternion

from ..scene.bodies import Kind, bodies_of, kind_of

_MOST_COVERED = 0.8
"""Share of the view that the sidebar may cover before the rest is too narrow to show anything in."""


_OTHER_SIZE = 0.1
"""Of the largest size of a bridge, by which another one differs: other seeds cut shards elsewhere."""

_ROOM = 1.2
"""Distance of the view from a box, over the box's diagonal."""


def redraw_views(_settings: object = None, _context: object = None) -> None:
    """Redraw all 3D views with their sidebars; also called by Blender when a setting changes."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()


def shards_in_view(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Return the shards that are in the view layer: Blender selects no others."""
    return _in_view(context, Kind.SHARD)


def _in_view(context: bpy.types.Context, *kinds: Kind) -> list[bpy.types.Object]:
    in_layer = set(context.view_layer.objects)
    return [body for body in bodies_of(context.scene) if kind_of(body) in kinds and body in in_layer]


def look_at_bridge(context: bpy.types.Context) -> None:
    """Let the view show shards and balls, and keep the selection: the ground is too large for Blender's View All."""
    selected = list(context.selected_objects)
    select_only(context, _in_view(context, Kind.SHARD, Kind.BALL))
    look_at_selected(context)
    select_only(context, selected)


def look_at_other_bridge(context: bpy.types.Context, before_m: np.ndarray) -> None:
    """Let the view show the bridge where it has another position or size than before: a box (2, 3), m."""
    now_m = bridge_box(context)
    if np.abs(now_m - before_m).max() > _OTHER_SIZE * np.ptp(now_m, axis=0).max():
        look_at_bridge(context)


def bridge_box(context: bpy.types.Context) -> np.ndarray:
    """Return the box (2, 3) around the shards' middles, m; all 0 without any."""
    middles_m = np.array([shard.location for shard in shards_in_view(context)])
    return np.array([middles_m.min(axis=0), middles_m.max(axis=0)]) if len(middles_m) else np.zeros((2, 3))


def select_only(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> None:
    """Select these objects and nothing else."""
    for selected_object in context.selected_objects:
        selected_object.select_set(False)
    for obj in objects:
        obj.select_set(True)


def look_at_selected(context: bpy.types.Context, surroundings: float = 1.0) -> None:
    """Make the 3D view under the mouse, if any, show the selected objects clear of the sidebar.

    It looks from `surroundings` times as far away as needed.
    """
    if not context.area or context.area.type != "VIEW_3D":
        return
    region = region_of(context.area, "WINDOW")
    with context.temp_override(region=region):
        bpy.ops.view3d.view_selected()
    view, covered = context.space_data.region_3d, covered_px(context, "UI")
    if view.view_perspective == "CAMERA" or covered > _MOST_COVERED * region.width:
        return
    view.view_distance *= surroundings * max(min(region.width, region.height) / (region.width - covered), 1.0)
    view.update()
    edge, middle = (region_2d_to_location_3d(region, view, (x, 0.0), view.view_location) for x in (0.0, covered / 2.0))
    view.view_location += middle - edge


def look_at_box(context: bpy.types.Context, box_m: np.ndarray, rotation: Quaternion | None = None) -> None:
    """Make the 3D view under the mouse, if any, show a box (2, 3), m, clear of the sidebar.

    With a `rotation` it looks from there, without perspective.
    """
    if not context.area or context.area.type != "VIEW_3D":
        return
    region, view = region_of(context.area, "WINDOW"), context.space_data.region_3d
    if rotation is not None:
        view.view_rotation, view.view_perspective = rotation, "ORTHO"
    elif view.view_perspective == "CAMERA":
        view.view_perspective = "PERSP"
    covered = min(covered_px(context, "UI"), _MOST_COVERED * region.width)
    view.view_location = box_m.mean(axis=0).tolist()
    size_m = float(np.linalg.norm(box_m[1] - box_m[0]))
    view.view_distance = _ROOM * size_m * max(region.width, region.height) / (region.width - covered)
    view.update()
    edge, middle = (region_2d_to_location_3d(region, view, (x, 0.0), view.view_location) for x in (0.0, covered / 2.0))
    view.view_location += middle - edge


def region_of(area: bpy.types.Area, kind: str) -> bpy.types.Region | None:
    """Return the region of an editor that is of a kind, such as ``WINDOW``."""
    return next((region for region in area.regions if region.type == kind), None)


def covered_px(context: bpy.types.Context, kind: str) -> float:
    """Return the width of a region that covers a part of the 3D view, px."""
    region = region_of(context.area, kind)
    covers = region and context.preferences.system.use_region_overlap and region.width > 1
    return float(region.width) if covers else 0.0
