"""Operators of the section through the pile: where its plane is, looking at it, and its drawings."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Quaternion

from ...display.section_lines import height_scale
from ...model.debris.pile_sections import Direction
from ...scene.bodies import bodies_of
from ..operators import Action, UndoableAction, recording_runs
from ..results.shown_run import shown_run
from ..viewport import look_at_box
from .decorator import section_of

_SEEN_FROM = {
    Direction.ACROSS.name: Quaternion((0.5, 0.5, 0.5, 0.5)),
    Direction.ALONG.name: Quaternion((0.5**0.5, 0.5**0.5, 0.0, 0.0)),
}
"""Rotations of a view that sees a plane from before it: widths to the right, heights upwards."""


def no_section(context: bpy.types.Context) -> str | None:
    """Say that there is nothing that could be cut."""
    if reason := recording_runs(context):
        return reason
    return None if section_of(context.scene) else "Nothing was recorded yet: run the scene first"


def _nothing_cut(context: bpy.types.Context) -> str | None:
    section = section_of(context.scene)
    return "The plane cuts nothing here: move it" if section and section.is_empty else None


def _no_body_chosen(context: bpy.types.Context) -> str | None:
    world, body = context.scene.rigidbody_world, context.view_layer.objects.active
    is_body = body is not None and world and world.collection and body in bodies_of(context.scene)
    return None if is_body and body.select_get() else "Select a shard first"


class BDA_OT_section_at_shard(UndoableAction, bpy.types.Operator):
    """Put the plane of the section through the selected shard, where it is now"""

    bl_label = "At Selected Shard"
    blocked_by = (no_section, _no_body_chosen)

    def act(self, context: bpy.types.Context) -> None:
        body = context.view_layer.objects.active.evaluated_get(context.evaluated_depsgraph_get())
        _put(context, np.array(body.matrix_world.translation))


class BDA_OT_section_at_cursor(UndoableAction, bpy.types.Operator):
    """Put the plane of the section through the 3D cursor; Shift and the right button of the mouse place that"""

    bl_label = "At 3D Cursor"
    blocked_by = (no_section,)

    def act(self, context: bpy.types.Context) -> None:
        _put(context, np.array(context.scene.cursor.location))


class BDA_OT_look_at_section(UndoableAction, bpy.types.Operator):
    """Look at the plane of the section from before it, without perspective"""

    bl_label = "Look at Section"
    changes_scene = False
    blocked_by = (no_section,)

    def act(self, context: bpy.types.Context) -> None:
        context.scene.bda.show_section = True
        section = section_of(context.scene)
        scale = height_scale(section)
        bounds = [area.bounds() for area in (section.debris, section.standing) if not area.is_empty()]
        corners = section.in_space(np.array(bounds or [section.ground_m[[0, -1]].ravel()]).reshape(-1, 2))
        corners = np.concatenate([corners, scale.lines]) if scale else corners
        look_at_box(
            context,
            np.array((corners.min(axis=0), corners.max(axis=0))),
            _SEEN_FROM[context.scene.bda.section_direction],
        )


class BDA_OT_write_section(Action, bpy.types.Operator):
    """Write the section of the frame that is shown into the folder of the run, as a picture (SVG) and for CAD (DXF)"""

    bl_label = "Write Section"
    changes_scene = False
    blocked_by = (no_section, _nothing_cut)

    def act(self, context: bpy.types.Context) -> str:
        from ...exports.section_drawings import DXF, SVG, new_section_file, write_section

        section, folder = section_of(context.scene), shown_run(context.scene).folder
        written = [new_section_file(folder, section, ending) for ending in (SVG, DXF)]
        for path in written:
            write_section(section, path)
        return f"Section: {written[0]} and {written[1].name}"


def _put(context: bpy.types.Context, position_m: np.ndarray) -> None:
    settings = context.scene.bda
    settings.section_place_m = float(position_m[Direction[settings.section_direction].normal_axis])
    settings.show_section = True
