"""Handles in the 3D view: points of the ball, charges and blast zones, and dragging them with the mouse."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatVectorProperty, IntProperty
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d
from mathutils import Matrix, Vector

from ...display.dragging import dragged_along, dragged_level
from ...errors import GeometryError, ScenarioError
from ...model.bridge import deck_top_at
from ...scene.blast.charges import charge_objects
from ...scene.world import FIRST_STEP_FRAME, simulated_time_s
from ..languages.words import translated
from ..operators import Action, recording_runs, refused
from ..scene_units import length_text
from ..viewport import redraw_views
from .decorator import is_wanted, sizes_shown
from .zone_handles import drag_zone, ends_of, zones_shown

_DECIMALS = 2
"""Of a metre: the mouse is no finer, and the panels show all digits."""

_LEAST_DROP_M = 0.01

_UP = (0.0, 0.0, 1.0)
_ENDS = {0: "", -1: ", begin", 1: ", end"}


class HandleKind(StrEnum):
    """The point that is dragged: target or drop of the ball, charge, or blast zone or one of its ends."""

    TARGET = "TARGET"
    DROP = "DROP"
    CHARGE = "CHARGE"
    ZONE = "ZONE"
    ZONE_BEGIN = "ZONE_BEGIN"
    ZONE_END = "ZONE_END"


_OF_ZONE = {HandleKind.ZONE: 0, HandleKind.ZONE_BEGIN: -1, HandleKind.ZONE_END: 1}
"""Which way an end of a zone lies from its middle."""


@dataclass(frozen=True, slots=True)
class Handle:
    """A point that can be dragged, up and down or level: of the drop of the ball, charge or zone with an index.

    A zone and its ends go along an axis, 0 to 2. `points_to` is the direction of its arrow; None for a ring.
    """

    kind: HandleKind
    index: int
    is_upright: bool
    name: str
    position_m: tuple[float, float, float]
    axis: int | None = None
    points_to: tuple[float, float, float] | None = None


def handles(scene: bpy.types.Scene) -> list[Handle]:
    """Return all points of a scene that can be dragged; the ball's only over a bridge of the panels.

    A size in the panels that cannot be used raises ScenarioError, which names the key.
    """
    return [*_of_ball(scene), *_of_charges(scene), *_of_zones(scene)]


def dragged_values(scene: bpy.types.Scene, kind: HandleKind, index: int) -> list[tuple[Any, str, Any]]:
    """Return owners, names and values of the properties that dragging sets, so that they can be put back."""
    if kind == HandleKind.CHARGE:
        charge = charge_objects(scene)[index]
        return [(charge, "location", tuple(charge.location))]
    if kind in _OF_ZONE:
        zone = scene.bda.scenario.blast_zones[index]
        return [(zone, name, getattr(zone, name)) for name in ("middle_m", "height_m")]
    drop = _drops(scene)[index]
    return [(drop, "target_m", tuple(drop.target_m)), (drop, "drop_height_m", drop.drop_height_m)]


def drag(scene: bpy.types.Scene, kind: HandleKind, index: int, position_m: Sequence[float]) -> None:
    """Move a charge, a zone or its end, or set the target of a drop, or its height over the deck, m."""
    if kind in _OF_ZONE:
        axis = next(handle.axis for handle in _of_zones(scene) if (handle.kind, handle.index) == (kind, index))
        drag_zone(scene.bda, index, _OF_ZONE[kind], position_m[axis or 0])
        return
    x, y, z = (round(coordinate, _DECIMALS) for coordinate in position_m)
    if kind == HandleKind.CHARGE:
        charge_objects(scene)[index].location = (x, y, z)
        return
    drop = _drops(scene)[index]
    if kind == HandleKind.TARGET:
        drop.target_m = (x, y)
    else:
        height_m = position_m[2] - deck_top_at(sizes_shown(scene.bda)[0], *_drops(scene)[index].target_m)
        drop.drop_height_m = max(round(height_m, _DECIMALS), _LEAST_DROP_M)


def _drops(scene: bpy.types.Scene) -> tuple[bpy.types.PropertyGroup, ...]:
    ball = scene.bda.scenario.ball
    return ball, *ball.hits


def _of_ball(scene: bpy.types.Scene) -> Iterator[Handle]:
    bridge, ball, own = sizes_shown(scene.bda)
    if not (bridge and ball) or own:
        return
    for index, drop in enumerate(ball.drops):
        number = f" of hit {index + 1}" if ball.hits else ""
        x, y = drop.target_m
        top = deck_top_at(bridge, x, y)
        yield Handle(HandleKind.TARGET, index, False, f"Target{number}", (x, y, top))
        yield Handle(
            HandleKind.DROP, index, True, f"Drop height{number}", (x, y, top + drop.drop_height_m), points_to=_UP
        )


def _of_charges(scene: bpy.types.Scene) -> Iterator[Handle]:
    """Give the handles of charges without a parent or a constraint, which would move them back."""
    for index, charge in enumerate(charge_objects(scene)):
        if not charge.parent and not len(charge.constraints) and not charge.library:
            for is_upright in (False, True):
                arrow = _UP if is_upright else None
                position = tuple(charge.location)
                yield Handle(HandleKind.CHARGE, index, is_upright, charge.name, position, points_to=arrow)


def _of_zones(scene: bpy.types.Scene) -> Iterator[Handle]:
    """Give the handles of the panels' zones that lie in their members, until time begins: then these move away."""
    if scene.rigidbody_world and simulated_time_s(scene, FIRST_STEP_FRAME) > 0.0:
        return
    try:
        zones = zones_shown(scene.bda)
    except GeometryError:  # building says what is wrong
        return
    kinds = {direction: kind for kind, direction in _OF_ZONE.items()}
    for index, placed in enumerate(zones):
        for position, axis, direction in ends_of(placed) if placed else ():
            x, y, z = (float(direction * (axis == number)) for number in range(3))
            name = f"{placed.zone.name}{_ENDS[direction]}"
            arrow = (x, y, z) if direction else None
            yield Handle(kinds[direction], index, False, name, position, axis, arrow)


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
        """Put a gizmo at each handle before all are drawn, and hide the gizmos of handles that are gone."""
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
        """Move it as far as the mouse was moved since it was pressed, which was off the middle of the handle."""
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
