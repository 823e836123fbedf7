"""The section through the pile: its panel, settings and buttons, and its drawing in the 3D view.

Nothing here changes any data, and nothing raises: the panel says what cannot be drawn.
"""

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Quaternion

from ..display.section_lines import ground_line, height_scale, section_outline, section_triangles
from ..model.debris.pile_sections import Direction, PileSection, pile_section
from ..scene.bodies import bodies_of
from ..simulation.blender_events import shown_results
from .languages.words import translated
from .operators import Action, UndoableAction, recording_runs
from .results.shown_run import follow_later, shown_run
from .scene_units import area_text, length_text
from .sidebar import SidebarPanel, draw_sentence
from .view_drawing import FONT_PX, ViewDrawing, draw_lines, draw_triangles, write_at
from .viewport import look_at_box, redraw_views

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
    follow_later(context.scene)
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
        from ..exports.section_drawings import DXF, SVG, new_section_file, write_section

        section, folder = section_of(context.scene), shown_run(context.scene).folder
        written = [new_section_file(folder, section, ending) for ending in (SVG, DXF)]
        for path in written:
            write_section(section, path)
        return f"Section: {written[0]} and {written[1].name}"


def _put(context: bpy.types.Context, position_m: np.ndarray) -> None:
    settings = context.scene.bda
    settings.section_place_m = float(position_m[Direction[settings.section_direction].normal_axis])
    settings.show_section = True


class BDA_PT_section(SidebarPanel, bpy.types.Panel):
    """A section through the pile, along or across the bridge, in the frame that is shown."""

    bl_label = "Section"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "show_section")
        layout.row().prop(settings, "section_direction", expand=True)
        layout.prop(settings, "section_place_m")
        row = layout.row(align=True)
        row.operator("bda.section_at_shard")
        row.operator("bda.section_at_cursor")
        if reason := no_section(context) or drawing.error:
            draw_sentence(layout, context, reason, icon="INFO")
        elif settings.show_section:
            self._draw_figures(context)
        layout.operator("bda.look_at_section", icon="VIEW_ORTHO")
        layout.operator("bda.write_section", icon="EXPORT")

    def _draw_figures(self, context: bpy.types.Context) -> None:
        section = section_of(context.scene)
        if section.is_empty:
            draw_sentence(self.layout, context, "The plane cuts nothing here: move it", icon="INFO")
            return
        if section.debris.is_empty():
            draw_sentence(self.layout, context, "The plane cuts no debris in this frame", icon="INFO")
            return
        column = self.layout.column(align=True)
        for line in (
            translated("Debris: {}").format(area_text(section.debris_area_m2, ".1f")),
            translated("Width: {}").format(length_text(section.debris_width_m, ".2f")),
            translated("Height above the ground: {}").format(length_text(section.debris_height_m, ".2f")),
        ):
            column.label(text=line, translate=False)


_DIRECTIONS = (
    (Direction.ACROSS.name, "Across Bridge", "An upright plane across the bridge, at a position x"),
    (Direction.ALONG.name, "Along Bridge", "An upright plane along the bridge, at a position y"),
)


class SectionProperties:
    """Part of the settings of a scene."""

    show_section: BoolProperty(
        name="Show Section",
        description="Draw what an upright plane cuts of debris and bridge in the frame that is shown, with a scale of "
        "heights",
        default=False,
        update=redraw_views,
    )
    section_direction: EnumProperty(
        name="Plane", description="Which way the plane of the section runs", items=_DIRECTIONS, update=redraw_views
    )
    section_place_m: FloatProperty(
        name="Position",
        description="Where the plane is: x of one across the bridge, y of one along it, such as 6.5 m",
        default=0.0,
        soft_min=-1000.0,
        soft_max=1000.0,
        step=10,
        unit="LENGTH",
        update=redraw_views,
    )
