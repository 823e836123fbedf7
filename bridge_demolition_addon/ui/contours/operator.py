"""Operators of contours, films and symbols."""

from pathlib import Path

import bpy

from ...core.errors import DemolitionError
from ...core.results.arrays import load_results, results_in
from ...core.results.files import FRAMES_FILE
from ...core.scenario.recording import PictureSettings
from ...scene.rendering.film import RenderSettings
from ...scene.visibility import has_symbols, hide_symbols, symbols_are_hidden
from ...scene.world import start_over
from ...simulation.blender_events import contours_of
from ...simulation.display.film import FilmKind, FilmRendering, FilmSettings
from .. import course, messages
from ..operators import Action, Refusing, absolute, recording_runs, refused
from ..scenario.values import table_of
from . import view as contour_view

_TICK_S = 0.01


class BDA_OT_load_results(Action, bpy.types.Operator):
    """Show contours of an earlier recording of this scene, kept in a file results.npz or in the folder of its run"""

    bl_idname = "bda.load_results"
    bl_label = "Load Results"

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        return recording_runs(context) or (
            None if context.scene.bda.results_path else "Choose a file results.npz first"
        )

    def act(self, context: bpy.types.Context) -> str:
        scene = context.scene
        path = absolute(scene.bda.results_path)
        path = results_in(path) if path.is_dir() else path
        results = load_results(path)
        contours_of(scene).use_results(results)
        contour_view.follow(scene)
        found = f"{len(results.frames)} frames of {len(results.inventory.body_names)} bodies"
        return f"{found}, of a run that ended before its end" if path.name == FRAMES_FILE else found


class BDA_OT_forget_results(Action, bpy.types.Operator):
    """Show what Blender simulates, in place of results that were loaded or found with the file; their files stay"""

    bl_idname = "bda.forget_results"
    bl_label = "Show Blender's Own Motion"

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        shows = contours_of(context.scene).shows_loaded
        return recording_runs(context) or (None if shows else "No results were loaded: Blender's own motion is shown")

    def act(self, context: bpy.types.Context) -> None:
        scene = context.scene
        contours_of(scene).forget()
        start_over(scene)
        contour_view.follow(scene)


class BDA_OT_render_contours(Refusing, bpy.types.Operator):
    """Render the recorded frames with their contours, as a film or as pictures, to the folder; Esc stops"""

    bl_idname = "bda.render_contours"
    bl_label = "Render Contours"

    _rendering: FilmRendering
    _pictures = None
    _timer = None
    _done = 0

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        if reason := recording_runs(context):
            return reason
        if not context.scene.bda.film_directory:
            return "Choose a folder for the film first"
        if contours_of(context.scene).series is None:
            return "Nothing was recorded in this scene: record it, or load its results"
        return None

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            self._begin(context.scene)
            for _ in self._pictures:
                pass
            return self._finish()
        except (DemolitionError, OSError) as error:  # a full disk, for one
            return refused(self, error)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        try:
            self._begin(context.scene)
        except (DemolitionError, OSError) as error:
            return refused(self, error)
        manager = context.window_manager
        self._course = course.begin(context, "Rendering", "pictures", self._rendering.picture_count)
        self._timer = manager.event_timer_add(_TICK_S, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC":
            self._end(context)
            messages.tell(self, "WARNING", f"Stopped after {self._done} of {self._rendering.picture_count} pictures")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            if next(self._pictures, None) is not None:
                self._done += 1
                self._course.step()
                course.show(context)
                return {"RUNNING_MODAL"}
            self._end(context)
            return self._finish()
        except (DemolitionError, OSError) as error:
            self._end(context)
            return refused(self, error)

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender where it ends the film itself, as it does before another file is loaded."""
        self._end(context)

    def _begin(self, scene: bpy.types.Scene) -> None:
        messages.clear(self)
        self._rendering = FilmRendering(
            scene, absolute(scene.bda.film_directory), contour_view.settings_of(scene), _film_settings(scene)
        )
        self._pictures = self._rendering.pictures()

    def _end(self, context: bpy.types.Context) -> None:
        self._pictures.close()
        context.window_manager.event_timer_remove(self._timer)
        course.end(context)

    def _finish(self) -> set[str]:
        paths = self._rendering.finish()
        place: Path = paths[0] if len(paths) == 1 else paths[0].parent
        self.report({"INFO"}, f"{self._rendering.picture_count} pictures rendered: {place}")
        return {"FINISHED"}


class BDA_OT_toggle_symbols(Action, bpy.types.Operator):
    """Hide the empties of all connections and force objects, or show them; they work all the same"""

    bl_idname = "bda.toggle_symbols"
    bl_label = "Show or Hide Connections and Forces"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        if not has_symbols(context.view_layer, context.scene):
            return "This scene has neither connections nor force objects"
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
