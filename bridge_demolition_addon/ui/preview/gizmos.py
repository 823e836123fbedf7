"""Handles in the 3D view, to drag the ball's target and the charges with the mouse."""

from __future__ import annotations

import bpy
from mathutils import Matrix, Vector

from ...errors import ScenarioError
from ..operators import recording_runs
from .decorator import is_wanted
from .handles import Handle, HandleKind, handles

_COLOURS = {
    HandleKind.TARGET: (1.0, 0.85, 0.2),
    HandleKind.DROP: (1.0, 0.85, 0.2),
    HandleKind.CHARGE: (1.0, 0.35, 0.1),
    **dict.fromkeys((HandleKind.ZONE, HandleKind.ZONE_BEGIN, HandleKind.ZONE_END), (1.0, 0.35, 0.1)),
}
_CHOSEN = (1.0, 1.0, 1.0)
_RING_SIZE, _ARROW_SIZE = 0.14, 0.6
"""As Blender sizes all gizmos: by what the user's preferences say, however far away they are."""

_ARROW_FOOT = Matrix.Translation((0.0, 0.0, 0.5))
"""Above the ring at the same position: the shaft of the arrow would take the mouse."""


class BDA_GGT_handles(bpy.types.GizmoGroup):
    """A ring to drag a point level, and an arrow to drag it up and down; of a zone a ring to move it along its member,
    and an arrow at each of its ends."""

    bl_label = "Targets, Charges and Blast Zones"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D", "PERSISTENT"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return is_wanted(context) and context.mode == "OBJECT" and not recording_runs(context)

    def setup(self, context: bpy.types.Context) -> None:
        """Make no gizmos yet: there are as many as handles, which change."""
        self.made: dict[tuple, bpy.types.Gizmo] = {}

    def draw_prepare(self, context: bpy.types.Context) -> None:
        """Put a gizmo at each handle before all are drawn, and hide those of handles that are gone."""
        try:
            wanted = handles(context.scene)
        except ScenarioError:  # the panel Scenario says what is wrong
            wanted = []
        for gizmo in self.gizmos:
            gizmo.hide = True
        for handle in wanted:
            key = (handle.kind, handle.index, handle.is_upright)
            if key not in self.made:
                self.made[key] = _new(self, handle)
            self.made[key].hide = False
            turn = Vector(handle.points_to or (0.0, 0.0, 1.0)).to_track_quat("Z", "Y").to_matrix().to_4x4()
            self.made[key].matrix_basis = Matrix.Translation(handle.position_m) @ turn


def _new(group: BDA_GGT_handles, handle: Handle) -> bpy.types.Gizmo:
    has_arrow = handle.points_to is not None
    gizmo = group.gizmos.new("GIZMO_GT_arrow_3d" if has_arrow else "GIZMO_GT_move_3d")
    gizmo.color, gizmo.alpha = _COLOURS[handle.kind], 0.9
    gizmo.color_highlight, gizmo.alpha_highlight = _CHOSEN, 1.0
    gizmo.scale_basis = _ARROW_SIZE if has_arrow else _RING_SIZE
    gizmo.use_draw_modal = True
    if handle.is_upright:
        gizmo.matrix_offset = _ARROW_FOOT
    elif not has_arrow:
        gizmo.draw_options = {"FILL_SELECT", "ALIGN_VIEW"}
    drag = gizmo.target_set_operator("bda.drag_handle")
    drag.kind, drag.index, drag.is_upright = handle.kind.value, handle.index, handle.is_upright
    return gizmo
