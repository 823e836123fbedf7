"""Panels of contours, films, vectors and charges, and of earlier runs."""

import bpy

from ...display.contour_quantities import ContourQuantity
from ...scene.visibility import symbols_are_hidden
from ...simulation.blender_events import shown_results
from ..languages.words import translated
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
