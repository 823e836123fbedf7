"""Operators of studies: loading, starting, pausing and stopping one, showing one, and opening its worst draw."""

from __future__ import annotations

from pathlib import Path

import bpy

from ...errors import OutputError
from ...model.study.file import Study, read_study, study_of
from ...model.study.sampled_runs import sampled_run
from ...model.study.settings import StudySettings
from ..operators import Action, absolute
from ..scenario.operator import BDA_OT_build_anew, build_and_show, stop_playing
from ..scenario.values import scenario_of, show_scenario, show_table, table_of
from . import session


class BDA_OT_load_study(Action, bpy.types.Operator):
    """Show a study file's values in the panels, with those of the scenario that it varies; nothing runs yet"""

    bl_idname = "bda.load_study"
    bl_label = "Load Study"
    bl_options = {"REGISTER", "UNDO"}
    changes_objects = True

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        return None if context.scene.bda.study_path else "Choose a study file first"

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        study = read_study(absolute(settings.study_path))
        show_scenario(settings, study.scenario)
        show_table(settings.study, study.settings)
        return f"Loaded a study of {study.scenario.title}"


class BDA_OT_start_study(Action, bpy.types.Operator):
    """Run the scenario in the panels many times with what varies, beside your work; goes on where the folder stands"""

    bl_idname = "bda.start_study"
    bl_label = "Start Study"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if session.study_at_work():
            return "A study is at work already"
        return None if context.scene.bda.study_directory else "Choose a folder for the study first"

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        path = _folder(context)
        session.begin(shown_settings(context), path, settings.study_jobs)
        return f"The study runs in {path}: go on working, and leave Blender open"


class BDA_OT_pause_study(Action, bpy.types.Operator):
    """Begin no further draw; those at work are finished"""

    bl_idname = "bda.pause_study"
    bl_label = "Pause Study"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        at_work = session.study_at_work()
        if at_work is None:
            return "No study is at work"
        return "The study is paused already" if at_work.run.is_paused else None

    def act(self, _context: bpy.types.Context) -> None:
        session.study_at_work().run.is_paused = True


class BDA_OT_resume_study(Action, bpy.types.Operator):
    """Go on with the study"""

    bl_idname = "bda.resume_study"
    bl_label = "Resume Study"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        at_work = session.study_at_work()
        return None if at_work and at_work.run.is_paused else "No study is paused"

    def act(self, _context: bpy.types.Context) -> None:
        session.study_at_work().run.is_paused = False


class BDA_OT_stop_study(Action, bpy.types.Operator):
    """Stop the study; draws that are done are kept, and Start goes on with it"""

    bl_idname = "bda.stop_study"
    bl_label = "Stop Study"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        return None if session.study_at_work() else "No study is at work"

    def act(self, _context: bpy.types.Context) -> str:
        run = session.study_at_work().run
        session.end()
        return f"Stopped after {run.done} of {run.total} draws"


class BDA_OT_show_study(Action, bpy.types.Operator):
    """Show what the study in the folder came to: its map on the ground and, once all draws are there, its limit"""

    bl_idname = "bda.show_study"
    bl_label = "Show Study"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if session.study_at_work():
            return "The study is shown once it ends or is stopped"
        return None if context.scene.bda.study_directory else "Choose the folder of a study first"

    def act(self, context: bpy.types.Context) -> str:
        runs = session.show(_folder(context)).runs
        return f"{len(runs.table)} draws of {runs.study.scenario.title}"


class BDA_OT_open_worst_draw(Action, bpy.types.Operator):
    """Build the draw whose debris got farthest, in place of what is built and shown: run it to see what happened"""

    bl_idname = "bda.open_worst_draw"
    bl_label = "Open Worst Draw"
    bl_options = {"REGISTER", "UNDO"}
    changes_objects = True

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if not session.shown_study():
            return "Show a study first"
        return BDA_OT_build_anew.disabled_reason(context) if context.scene.rigidbody_world else None

    def act(self, context: bpy.types.Context) -> str:
        runs, settings = session.shown_study().runs, context.scene.bda
        row = runs.table.worst_row
        if row is None:
            raise OutputError("No draw of this study finished")
        number = int(runs.table.numbers[row])
        stop_playing(context)
        scene, scenario = context.scene, sampled_run(runs.study, number).scenario
        build_and_show(scene, scenario, anew=scene.rigidbody_world is not None)
        settings.scenario_path = settings.loaded_path = ""
        return f"Draw {number}, whose debris got {runs.reaches_m[row]:.1f} m far"


CLASSES = (
    BDA_OT_load_study,
    BDA_OT_start_study,
    BDA_OT_pause_study,
    BDA_OT_resume_study,
    BDA_OT_stop_study,
    BDA_OT_show_study,
    BDA_OT_open_worst_draw,
)


def shown_settings(context: bpy.types.Context) -> Study:
    """Return the study that the panels show, of the scenario that they show.

    Raises
    ------
    DemolitionError
        A value cannot be used; the text names the key.
    """
    settings = context.scene.bda
    return study_of(table_of(settings.study, StudySettings), scenario_of(settings))


def _folder(context: bpy.types.Context) -> Path:
    return absolute(context.scene.bda.study_directory)
