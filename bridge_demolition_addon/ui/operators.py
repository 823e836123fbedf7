"""What the buttons of the sidebar do."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ..core.errors import DemolitionError, OutputError
from ..core.events import model_structure, schedule
from ..core.model import build_model
from ..core.scenario.file import read_scenario
from ..core.summary import summarise
from ..scene.demolition import build_demolition
from ..simulation import handlers, standstill
from ..simulation.output import keep_results, prepared_folder
from ..simulation.recording import Recording
from . import redraw

_subject: dict[str, Any] = {}
"""Title and gravity of what is recorded: undo or another file may take its scene away before the results are kept."""


class BDA_OT_build_scenario(bpy.types.Operator):
    """Build the bridge of a scenario file, its shards, connections, ground and ball in this scene"""

    bl_idname = "bda.build_scenario"
    bl_label = "Build Scenario"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012  Blender wants a plain set

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if context.scene.rigidbody_world:
            cls.poll_message_set("This scene has a rigid-body world already: use a new scene")
            return False
        if not context.scene.bda.scenario_path:
            cls.poll_message_set("Choose a scenario file first")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            scenario = read_scenario(_absolute(context.scene.bda.scenario_path))
            model = build_model(scenario)
            schedule(scenario.changes, model_structure(model))  # refuses what concerns nothing
        except DemolitionError as error:
            return _refused(self, error)
        build_demolition(context.scene, scenario, model)
        context.scene.bda.title = scenario.title
        self.report({"INFO"}, f"{len(model.shards)} shards, {len(model.connections)} connections")
        return {"FINISHED"}


class BDA_OT_register_handler(bpy.types.Operator):
    """Go to the start frame, and record forces and debris from there while the timeline plays"""

    bl_idname = "bda.register_handler"
    bl_label = "Register Handler"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not context.scene.rigidbody_world:
            cls.poll_message_set("This scene has no rigid-body world: build a scenario first")
            return False
        if context.scene.rigidbody_world.point_cache.is_baked:
            cls.poll_message_set("The simulation is baked and only played back: delete the bake of its cache first")
            return False
        if handlers.current():
            cls.poll_message_set("The handler is registered already")
            return False
        if not context.scene.bda.output_directory:
            cls.poll_message_set("Choose a folder for the results first")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.bda
        try:
            folder = prepared_folder(_absolute(settings.output_directory), overwrite=settings.overwrite)
            handlers.start(Recording(context.scene, folder))
        except DemolitionError as error:
            return _refused(self, error)
        _subject.update(title=settings.title or context.scene.name, gravity=np.array(context.scene.gravity))
        _start_over(context.scene)
        redraw.follow_recording()
        self.report({"INFO"}, f"Recording to {folder}: play the timeline")
        return {"FINISHED"}


class BDA_OT_unregister_handler(bpy.types.Operator):
    """End the recording and write its results"""

    bl_idname = "bda.unregister_handler"
    bl_label = "Unregister Handler"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not handlers.current():
            cls.poll_message_set("No handler is registered")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        recording = handlers.stop()
        try:
            results = recording.results()
            summary = {"title": _subject["title"], **summarise(results, _subject["gravity"])}
            summary["events"] = recording.happenings
            keep_results(recording.folder, results, summary)
        except DemolitionError as error:
            return _refused(self, recording.error or error)
        if recording.error:
            self.report({"WARNING"}, f"The recording ended early: {recording.error}")
        if recording.distrust:
            self.report({"WARNING"}, f"Forces are estimated from motion: {recording.distrust}")
        self.report({"INFO"}, f"Results are in {recording.folder}")
        return {"FINISHED"}


class BDA_OT_make_report(bpy.types.Operator):
    """Make a report, as a page and as a PDF, from the results in the folder"""

    bl_idname = "bda.make_report"
    bl_label = "Make Report"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not context.scene.bda.output_directory:
            cls.poll_message_set("Choose the folder with the results first")
            return False
        if handlers.current():
            cls.poll_message_set("The recording still goes on: unregister the handler first")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        # Loading matplotlib takes a second, which nobody should wait for when the add-on is switched on.
        from ..report.write import write_report

        progress = _CursorProgress(context.window_manager)
        try:
            written = write_report([_absolute(context.scene.bda.output_directory)], None, progress=progress)
        except DemolitionError as error:
            return _refused(self, error)
        finally:
            progress.finish()
        self.report({"INFO"}, f"Report: {written[0]} and {written[1].name}")
        return {"FINISHED"}


class _CursorProgress:
    """How far a report is, at the mouse."""

    def __init__(self, manager: bpy.types.WindowManager):
        self._manager = manager
        manager.progress_begin(0.0, 1.0)

    def stage(self, text: str) -> None:
        """Blender's cursor shows numbers only."""

    def part(self, done: int, total: int, text: str) -> None:
        """Show how many parts of a stage are done."""
        self._manager.progress_update(done / total)

    def finish(self) -> None:
        """Give the mouse back."""
        self._manager.progress_end()


CLASSES = (BDA_OT_build_scenario, BDA_OT_register_handler, BDA_OT_unregister_handler, BDA_OT_make_report)


def register() -> None:
    """Make the operators known to Blender."""
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """End a recording that runs, and take the operators away."""
    handlers.stop()
    standstill.forget()
    redraw.unregister()
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)


def _start_over(scene: bpy.types.Scene) -> None:
    """Go to the start frame, and have frames that were played before simulated anew instead of played back."""
    world = scene.rigidbody_world
    world.substeps_per_frame = world.substeps_per_frame  # Blender takes any setting for a change
    scene.frame_set(world.point_cache.frame_start)


def _absolute(path: str) -> Path:
    """A path as the user gave it, where ``//`` is the folder of the saved file.

    Raises
    ------
    OutputError
        The path is relative to a file that has not been saved yet.
    """
    if path.startswith("//") and not bpy.data.filepath:
        raise OutputError(f"{path}: is relative to this file, which has no place yet; save it or give a full path")
    return Path(bpy.path.abspath(path))


def _refused(operator: bpy.types.Operator, error: Exception) -> set[str]:
    operator.report({"ERROR"}, str(error))
    return {"CANCELLED"}
