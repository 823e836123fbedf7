"""Selecting objects, and what the 3D view looks at."""

from collections.abc import Iterable

import bpy
from bpy_extras.view3d_utils import region_2d_to_location_3d

_MOST_COVERED = 0.8
"""Share of the view that the sidebar may cover before the rest is too narrow to show anything in."""


def select_only(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> None:
    """Select these objects and nothing else."""
    for each in context.selected_objects:
        each.select_set(False)
    for each in objects:
        each.select_set(True)


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
