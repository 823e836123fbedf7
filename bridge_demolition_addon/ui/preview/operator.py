"""Dragging a point of the scenario in the 3D view, called by its handle."""

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatVectorProperty, IntProperty
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d

from ...display.dragging import dragged_along, dragged_level
from ...errors import ScenarioError
from ..languages.words import translated
from ..operators import Action, recording_runs, refused
from ..scene_units import length_text
from ..viewport import redraw_views
from .handles import Handle, HandleKind, drag, dragged_values, handles

_SNAP_M = 0.1

_KINDS = [
    (HandleKind.TARGET.value, "Target", "Where a drop of the ball hits the deck"),
    (HandleKind.DROP.value, "Drop Height", "How high the ball hangs over the deck"),
    (HandleKind.CHARGE.value, "Charge", "Where a charge is"),
    (HandleKind.ZONE.value, "Blast Zone", "Where a blast zone is along its member"),
    (HandleKind.ZONE_BEGIN.value, "Begin of Blast Zone", "Where a blast zone begins along its member"),
    (HandleKind.ZONE_END.value, "End of Blast Zone", "Where a blast zone ends along its member"),
]


class BDA_OT_drag_handle(Action, bpy.types.Operator):
    """Drag to move it, with Ctrl in steps of 0.1 m; Esc or a right click puts it back"""

    bl_label = "Drag"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    kind: EnumProperty(name="What", description="What is moved", items=_KINDS)
    index: IntProperty(name="Number", description="Which of them, from 0", min=0, options={"HIDDEN"})
    is_upright: BoolProperty(name="Upright", description="Whether it goes up and down only", options={"HIDDEN"})
    position_m: FloatVectorProperty(name="Position", description="Where to", size=3, subtype="XYZ", unit="LENGTH")

    blocked_by = (recording_runs,)

    def act(self, context: bpy.types.Context) -> None:
        self._handle(context)
        drag(context.scene, HandleKind(self.kind), self.index, tuple(self.position_m))

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        try:
            handle = self._handle(context)
        except ScenarioError as error:
            return refused(self, error)
        self._start, self._held, self._axis = np.array(handle.position_m), None, handle.axis
        self._before = dragged_values(context.scene, handle.kind, handle.index)
        self._follow(context, event)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self.position_m = self._start
            for owner, name, value in self._before:
                setattr(owner, name, value)
            return self._leave(context, {"CANCELLED"})
        if event.type == "MOUSEMOVE":
            self._follow(context, event)
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            return self._leave(context, {"FINISHED"})
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """End the dragging; Blender calls this before it loads another file."""
        self._leave(context, {"CANCELLED"})

    def _handle(self, context: bpy.types.Context) -> Handle:
        wanted = (self.kind, self.index, self.is_upright)
        for handle in handles(context.scene):
            if (handle.kind, handle.index, handle.is_upright) == wanted:
                return handle
        kind = self.kind.lower().replace("_", " ")
        raise ScenarioError(f"there is no {kind} {self.index + 1} here to be dragged")

    def _follow(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        """Move it as far as the mouse was moved since it was pressed, which was beside the middle of the handle."""
        under = _position_under(context, event, self._start, 2 if self.is_upright else self._axis)
        if under is None:
            return
        self._held = under - self._start if self._held is None else self._held
        position_m = under - self._held
        self.position_m = np.round(position_m / _SNAP_M) * _SNAP_M if event.ctrl else position_m
        drag(context.scene, HandleKind(self.kind), self.index, tuple(self.position_m))
        position = ", ".join(length_text(coordinate, ".2f") for coordinate in self.position_m)
        if context.area:
            hint = translated("Ctrl: steps of {} | Let go: done | Esc: back").format(length_text(_SNAP_M, "g"))
            context.area.header_text_set(f"{position} | {hint}")
        redraw_views()

    def _leave(self, context: bpy.types.Context, ended: set[str]) -> set[str]:
        if context.area:
            context.area.header_text_set(None)
        redraw_views()
        return ended


def _position_under(
    context: bpy.types.Context, event: bpy.types.Event, start: np.ndarray, axis: int | None
) -> np.ndarray | None:
    region, view = context.region, context.region_data
    mouse = (event.mouse_x - region.x, event.mouse_y - region.y)
    eye = np.array(region_2d_to_origin_3d(region, view, mouse))
    ray = np.array(region_2d_to_vector_3d(region, view, mouse))
    return dragged_level(eye, ray, float(start[2])) if axis is None else dragged_along(eye, ray, start, axis)
