"""Operators of contours, films and symbols."""

from collections.abc import Iterator
from pathlib import Path

import bpy

from ...model.results.arrays import FRAMES_FILE, load_results, results_in
from ...model.scenario.recording import PictureSettings
from ...scene.rendering.film import RenderSettings
from ...scene.visibility import has_symbols, hide_symbols, symbols_are_hidden
from ...scene.world import start_over
from ...simulation.blender_events import recorded_scene, shown_results
from ...simulation.display.film import FilmKind, FilmRendering, FilmSettings
from .. import messages
from ..modal_task import RenderingTask
from ..operators import Action, absolute, recording_runs
from ..scenario.values import table_of
from . import view as contour_view


class BDA_OT_load_results(Action, bpy.types.Operator):
    """Show contours of an earlier recording of this scene, kept in a file results.npz or in the folder of its run"""

    bl_idname = "bda.load_results"
    bl_label = "Load Results"

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        return recording_runs(context) or (
            None if context.scene.bda.results_path else "Choose a file results.npz first"
        )

    def act(self, context: bpy.types.Context) -> str:
        scene = context.scene
        path = absolute(scene.bda.results_path)
        path = results_in(path) if path.is_dir() else path
        results = load_results(path)
        recorded_scene(scene).show_results(results)
        contour_view.follow(scene)
        found = f"{len(results.frames)} frames of {len(results.inventory.body_names)} bodies"
        return f"{found}, of a run that ended before its end" if path.name == FRAMES_FILE else found


class BDA_OT_forget_results(Action, bpy.types.Operator):
    """Show what Blender simulates, in place of results that were loaded or found with the file; their files stay"""

    bl_idname = "bda.forget_results"
    bl_label = "Show Blender's Own Motion"

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        shows = shown_results(context.scene).are_loaded
        return recording_runs(context) or (None if shows else "No results were loaded: Blender's own motion is shown")

    def act(self, context: bpy.types.Context) -> None:
        scene = context.scene
        shown_results(scene).forget()
        start_over(scene)
        contour_view.follow(scene)


class BDA_OT_render_contours(RenderingTask, bpy.types.Operator):
    """Render the recorded frames with their contours, as a film or as pictures, to the folder; Esc stops"""

    bl_idname = "bda.render_contours"
    bl_label = "Render Contours"

    _rendering: FilmRendering

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if reason := recording_runs(context):
            return reason
        if not context.scene.bda.film_directory:
            return "Choose a folder for the film first"
        if shown_results(context.scene).series is None:
            return "Nothing was recorded in this scene: record it, or load its results"
        return None

    def begin(self, context: bpy.types.Context) -> tuple[Iterator[Path], int]:
        messages.clear(self)
        scene = context.scene
        self._rendering = FilmRendering(
            scene, absolute(scene.bda.film_directory), contour_view.settings_of(scene), _film_settings(scene)
        )
        return self._rendering.pictures(), self._rendering.picture_count

    def finish(self) -> set[str]:
        paths = self._rendering.finish()
        place: Path = paths[0] if len(paths) == 1 else paths[0].parent
        self.report({"INFO"}, f"{self._rendering.picture_count} pictures rendered: {place}")
        return {"FINISHED"}


class BDA_OT_toggle_symbols(Action, bpy.types.Operator):
    """Hide the empties of all connections and force fields, or show them; they work all the same"""

    bl_idname = "bda.toggle_symbols"
    bl_label = "Show or Hide Connections and Forces"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if not has_symbols(context.view_layer, context.scene):
            return "This scene has neither connections nor force fields"
        return None

    def act(self, context: bpy.types.Context) -> str | None:
        scene, layer = context.scene, context.view_layer
        hide_symbols(layer, scene, hidden=not symbols_are_hidden(layer, scene))


CLASSES = (BDA_OT_load_results, BDA_OT_forget_results, BDA_OT_render_contours, BDA_OT_toggle_symbols)


def _film_settings(scene: bpy.types.Scene) -> FilmSettings:
    settings = scene.bda
    return FilmSettings(
        kind=FilmKind[settings.film_kind],
        pictures_per_second=settings.film_rate,
        slowness=settings.film_slowness,
        picture=RenderSettings(settings.film_width, settings.film_height),
        view=table_of(settings.scenario.pictures, PictureSettings),
    )
