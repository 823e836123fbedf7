"""Panel Ground and Air: drawings there, zones by the mouse, a site plan under the bridge, dust."""

from __future__ import annotations

import bpy
import numpy as np
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d

from ...display.dust import puffs
from ...errors import DemolitionError
from ...model.scenario import Zone
from ...model.toml_tables import toml_value
from ...scene.rendering.dust import raise_dust, remove_dust
from ...scene.rendering.ground import lay_site_plan, terrain_under
from ...simulation.blender_events import recorded_scene
from ..languages.words import translated
from ..operators import GuardedOperator, UndoableAction, absolute, recording_runs, refused, unset
from ..scene_units import length_text
from ..sidebar import SidebarPanel, draw_sentence
from ..view_drawing import ViewDrawing, draw_lines
from ..viewport import redraw_views, region_of
from . import decorator
from .decorator import RINGS, ZONES


class BDA_PT_ground_and_air(SidebarPanel, bpy.types.Panel):
    """Drawings on the ground and in the air."""

    bl_label = "Ground and Air"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        if error := decorator.drawing.error:
            draw_sentence(layout, context, error)
        layout.column(align=True).prop(settings, "overlays")
        if RINGS in settings.overlays:
            row = layout.row(align=True)
            row.prop(settings, "distance_spacing_m")
            row.prop(settings, "distance_count")
        layout.operator("bda.draw_zone", icon="GREASEPENCIL")
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        for name in ("plan_picture", "plan_width_m", "plan_bearing_deg", "plan_origin"):
            column.prop(settings, name)
        layout.operator("bda.lay_site_plan")
        dust = layout.row(align=True)
        dust.operator("bda.raise_dust")
        dust.operator("bda.settle_dust", text="", icon="X")


_COLOUR = (1.0, 1.0, 0.3, 1.0)
_WIDTH_PX = 2.5
_LEAVE = {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE"}
"""Events with which the view is turned meanwhile."""


_unfinished: list[ViewDrawing] = []
"""Zones that are drawn now."""


def _outside_view(context: bpy.types.Context) -> str | None:
    is_view = context.area is not None and context.area.type == "VIEW_3D"
    return None if is_view else "Zones are drawn in a 3D view"


class BDA_OT_draw_zone(GuardedOperator, bpy.types.Operator):
    """Click the corners of a zone on the ground; Enter or a right click ends it, Backspace takes a corner back"""

    bl_label = "Draw Zone"
    bl_options = {"REGISTER", "UNDO"}
    blocked_by = (_outside_view, recording_runs)

    _corners: list[tuple[float, float]]
    _drawing: ViewDrawing

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self._corners = []
        self._drawing = ViewDrawing(self._draw)
        self._drawing.register()
        _unfinished.append(self._drawing)
        context.workspace.status_text_set(
            translated("Zone: click its corners | Enter: done | Backspace: back | Esc: cancel")
        )
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in _LEAVE or event.value != "PRESS":
            return {"PASS_THROUGH"}
        if event.type == "ESC":
            return self._leave(context, {"CANCELLED"})
        if event.type in {"RET", "NUMPAD_ENTER", "RIGHTMOUSE"}:
            return self._leave(context, self._add(context))
        if event.type == "BACK_SPACE":
            del self._corners[-1:]
        elif event.type == "LEFTMOUSE":
            corner = ground_under(context, event.mouse_x, event.mouse_y)
            if corner is None:
                text = translated("There is no ground under the mouse: look down on it, click in the 3D view")
                self.report({"WARNING"}, text)
            else:
                self._corners.append(corner)
        redraw_views()
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """End the drawing; Blender calls this before it loads another file."""
        self._leave(context, {"CANCELLED"})

    def _add(self, context: bpy.types.Context) -> set[str]:
        try:
            name = add_zone(context.scene, self._corners)
        except DemolitionError as error:
            return refused(self, error)
        self.report({"INFO"}, f"{name}: {len(self._corners)} corners; its name and kind stand in Scenario, Zones")
        return {"FINISHED"}

    def _leave(self, context: bpy.types.Context, ended: set[str]) -> set[str]:
        if self._drawing in _unfinished:  # the extension was not switched off meanwhile
            _unfinished.remove(self._drawing)
            self._drawing.unregister()
        if context.workspace:
            context.workspace.status_text_set(None)
        redraw_views()
        return ended

    def _draw(self, context: bpy.types.Context) -> None:
        if not self._corners:
            return
        corners = np.column_stack((np.array(self._corners), np.full(len(self._corners), 0.03)))
        ends = np.roll(corners, -1, axis=0)
        draw_lines(context, np.stack((corners, ends), axis=1).reshape(-1, 3), _COLOUR, _WIDTH_PX)


class BDA_OT_lay_site_plan(UndoableAction, bpy.types.Operator):
    """Lay the picture under the bridge, with this width and bearing. Material Preview and renders show it"""

    bl_label = "Lay Site Plan"
    changes_objects = True
    blocked_by = (recording_runs, unset("plan_picture", "Choose a picture first"))

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        path = absolute(settings.plan_picture)
        width, height = lay_site_plan(
            context.scene, path, settings.plan_width_m, settings.plan_bearing_deg, tuple(settings.plan_origin)
        )
        size = f"{length_text(width, 'g')} × {length_text(height, 'g')}"
        return translated("{}: {} on the ground").format(path.name, size)


def _no_results(context: bpy.types.Context) -> str | None:
    return None if decorator.results_of(context.scene) is not None else "Run the scene first, or load its results"


class BDA_OT_raise_dust(UndoableAction, bpy.types.Operator):
    """Make clouds of dust where connections broke in the last run; they render in EEVEE and Cycles"""

    bl_label = "Raise Dust"
    changes_objects = True
    blocked_by = (recording_runs, _no_results)

    def act(self, context: bpy.types.Context) -> str:
        scene = context.scene
        results = decorator.results_of(scene)
        clouds = puffs(results)
        raise_dust(scene, clouds)
        recorded_scene(scene).show_results(results)  # Blender forgets what it played with any new object
        return f"{len(clouds)} clouds of dust" if clouds else "No connection broke: there is no dust"


class BDA_OT_settle_dust(UndoableAction, bpy.types.Operator):
    """Remove the clouds of dust"""

    bl_label = "Remove Dust"
    changes_objects = True
    blocked_by = (recording_runs,)

    def act(self, context: bpy.types.Context) -> str:
        return f"{remove_dust(context.scene)} clouds of dust removed"


def unregister() -> None:
    """Stop drawing zones that are not finished."""
    while _unfinished:
        _unfinished.pop().unregister()


def ground_under(context: bpy.types.Context, mouse_x: int, mouse_y: int) -> tuple[float, float] | None:
    """Return the point of the ground under the mouse, x and y in m; None where there is no ground."""
    region = region_of(context.area, "WINDOW")
    x, y = mouse_x - region.x, mouse_y - region.y
    if not (0 <= x < region.width and 0 <= y < region.height):
        return None
    view = context.area.spaces.active.region_3d
    eye, ray = region_2d_to_origin_3d(region, view, (x, y)), region_2d_to_vector_3d(region, view, (x, y))
    point = terrain_under(context.scene, eye, ray)
    if point is None:
        if eye.z * ray.z >= 0.0:  # it looks away from the ground
            return None
        point = eye - ray * (eye.z / ray.z)
    return round(point.x, 2), round(point.y, 2)


def add_zone(scene: bpy.types.Scene, corners_m: list[tuple[float, float]]) -> str:
    """Add a zone to the scenario, show it, and return its name."""
    group = scene.bda.scenario
    taken = {zone.name for zone in group.zones}
    name = next(name for number in range(1, len(taken) + 2) if (name := f"Zone {number}") not in taken)
    zone = Zone(name=name, corners_m=tuple(corners_m))
    added = group.zones.add()
    added.name, added.corners_m = zone.name, toml_value(zone.corners_m)
    group.zones_index = len(group.zones) - 1
    scene.bda.overlays |= {ZONES}
    return name
