"""Panels and buttons of contours, films, vectors and charges, and of earlier runs."""

import bpy

from ...display.contour_quantities import ContourQuantity
from ...model.results.arrays import FRAMES_FILE, load_results, results_in
from ...model.scenario.recording import PictureSettings
from ...scene.rendering.film import RenderSettings
from ...scene.visibility import has_symbols, hide_symbols, symbols_are_hidden
from ...scene.world import start_over
from ...simulation.blender_events import recorded_scene, shown_results
from ...simulation.display.film import FilmKind, FilmRendering, FilmSettings
from ..languages.words import translated
from ..modal_task import RenderingTask
from ..operators import Action, UndoableAction, absolute, recording_runs, unset
from ..scenario.values import table_of
from ..sidebar import SidebarPanel, draw_sentence
from . import decorator as overlay
from . import view as contour_view


class BDA_PT_contours(SidebarPanel, bpy.types.Panel):
    """Contours of the recorded bodies."""

    bl_label = "Contours"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "contours")
        if reason := contour_view.refusal(context.scene) or overlay.drawing.error:
            draw_sentence(layout, context, reason)
        column = layout.column()
        column.enabled = settings.contours
        column.use_property_split, column.use_property_decorate = True, False
        column.prop(settings, "contour_quantity")
        column.prop(settings, "contour_peak")
        if settings.contour_peak:
            column.prop(settings, "contour_whole_run")
        column.prop(settings, "contour_range")
        if settings.contour_range == "FIXED":
            unit = ContourQuantity[settings.contour_quantity].units.of_range.name
            ends = column.column(align=True)
            ends.prop(settings, "contour_low", text=f"{translated('Lowest')}, {unit}", translate=False)
            ends.prop(settings, "contour_high", text=f"{translated('Highest')}, {unit}", translate=False)
        column.prop(settings, "contour_logarithmic")
        if settings.contour_logarithmic and settings.contour_range != "FIXED":
            column.prop(settings, "contour_decades")
        if settings.contour_range != "FIXED":
            column.prop(settings, "contour_percentile")
        for name in ("contour_map", "contour_shaded", "contour_magnification", "colour_bar"):
            column.prop(settings, name)
        if shown_results(context.scene).are_loaded:
            _draw_loaded(layout, context)


class BDA_PT_overlay(SidebarPanel, bpy.types.Panel):
    """Force vectors and charges over the 3D view."""

    bl_label = "Vectors and Charges"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "show_vectors")
        column = layout.column()
        column.enabled = settings.show_vectors
        column.prop(settings, "vectors")
        column.prop(settings, "vector_length_m")
        layout.prop(settings, "show_charges")
        layout.prop(settings, "show_rings")
        row = layout.row()
        row.enabled = settings.show_rings
        row.prop(settings, "ring_damage", text="")
        hidden = symbols_are_hidden(context.view_layer, context.scene)
        text = "Show Connections and Forces" if hidden else "Hide Connections and Forces"
        layout.operator("bda.toggle_symbols", text=text, icon="HIDE_ON" if hidden else "HIDE_OFF")


class BDA_PT_film(SidebarPanel, bpy.types.Panel):
    """Contours as a film or as pictures."""

    bl_label = "Film"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "film_directory", text="", placeholder=translated("Folder for the film"))
        layout.row().prop(settings, "film_kind", expand=True)
        layout.prop(settings.scenario.pictures, "camera")
        column = layout.column(align=True)
        column.prop(settings, "film_width")
        column.prop(settings, "film_height")
        if settings.film_kind == "FILM":
            column = layout.column(align=True)
            column.prop(settings, "film_rate")
            column.prop(settings, "film_slowness")
        layout.operator("bda.render_contours")


class BDA_PT_earlier_run(SidebarPanel, bpy.types.Panel):
    """Contours of an earlier run, from its folder."""

    bl_label = "Earlier Run"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "results_path", text="", placeholder=translated("results.npz of an earlier run"))
        layout.operator("bda.load_results")
        if shown_results(context.scene).are_loaded:
            _draw_loaded(layout, context)


def _draw_loaded(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    text = "Shown is what was recorded, until something new is. Blender plays it on its own:"
    draw_sentence(layout, context, text, icon="INFO")
    layout.operator("bda.forget_results")


class BDA_OT_load_results(Action, bpy.types.Operator):
    """Show contours of an earlier recording of this scene, kept in a file results.npz or in the folder of its run"""

    bl_label = "Load Results"
    blocked_by = (recording_runs, unset("results_path", "Choose a file results.npz first"))

    def act(self, context: bpy.types.Context) -> str:
        scene = context.scene
        path = absolute(scene.bda.results_path)
        path = results_in(path) if path.is_dir() else path
        results = load_results(path)
        recorded_scene(scene).show_results(results)
        contour_view.follow(scene)
        text = f"{len(results.frames)} frames of {len(results.inventory.body_names)} bodies"
        return f"{text}, of a run that ended before its end" if path.name == FRAMES_FILE else text


def _not_loaded(context: bpy.types.Context) -> str | None:
    is_loaded = shown_results(context.scene).are_loaded
    return None if is_loaded else "No results were loaded: Blender's own motion is shown"


class BDA_OT_forget_results(Action, bpy.types.Operator):
    """Show what Blender simulates, in place of results that were loaded or found with the file; their files stay"""

    bl_label = "Show Blender's Own Motion"
    blocked_by = (recording_runs, _not_loaded)

    def act(self, context: bpy.types.Context) -> None:
        scene = context.scene
        shown_results(scene).forget()
        start_over(scene)
        contour_view.follow(scene)


def _not_recorded(context: bpy.types.Context) -> str | None:
    is_recorded = shown_results(context.scene).series is not None
    return None if is_recorded else "Nothing was recorded in this scene: record it, or load its results"


class BDA_OT_render_contours(RenderingTask, bpy.types.Operator):
    """Render the recorded frames with their contours, as a film or as pictures, to the folder; Esc stops"""

    bl_label = "Render Contours"
    blocked_by = (recording_runs, unset("film_directory", "Choose a folder for the film first"), _not_recorded)

    _rendering: FilmRendering

    def begin(self, context: bpy.types.Context) -> int:
        scene = context.scene
        self._rendering = FilmRendering(
            scene, absolute(scene.bda.film_directory), contour_view.settings_of(scene), _film_settings(scene)
        )
        self._pictures = self._rendering.pictures()
        return self._rendering.picture_count

    def finish(self, context: bpy.types.Context) -> set[str]:
        paths = self._rendering.finish()
        path = paths[0] if len(paths) == 1 else paths[0].parent
        self.report({"INFO"}, f"{self._rendering.picture_count} pictures rendered: {path}")
        return {"FINISHED"}


def _without_symbols(context: bpy.types.Context) -> str | None:
    has = has_symbols(context.view_layer, context.scene)
    return None if has else "This scene has neither connections nor force fields"


class BDA_OT_toggle_symbols(UndoableAction, bpy.types.Operator):
    """Hide the empties of all connections and force fields, or show them; they work all the same"""

    bl_label = "Show or Hide Connections and Forces"
    blocked_by = (_without_symbols,)

    def act(self, context: bpy.types.Context) -> str | None:
        scene, layer = context.scene, context.view_layer
        hide_symbols(layer, scene, hidden=not symbols_are_hidden(layer, scene))


def _film_settings(scene: bpy.types.Scene) -> FilmSettings:
    settings = scene.bda
    return FilmSettings(
        kind=FilmKind[settings.film_kind],
        pictures_per_second=settings.film_rate,
        slowness=settings.film_slowness,
        picture=RenderSettings(settings.film_width, settings.film_height),
        view=table_of(settings.scenario.pictures, PictureSettings),
    )
