"""The panel Study: what varies, its course, and what it came to."""

from __future__ import annotations

import bpy

from ...model.schema import subtable_fields
from ...model.study.runs_table import DONE
from ...model.study.settings import StudySettings
from ..scenario.ui import draw_keys, draw_tables
from ..sidebar import SidebarPanel, draw_sentence
from . import decorator, session
from .session import StudyAtWork

_TABLES = {item.name: item for item in subtable_fields(StudySettings)}


class BDA_PT_study(SidebarPanel, bpy.types.Panel):
    """Many runs of the scenario, with inputs drawn by chance, and what holds for such runs."""

    bl_label = "Study"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings, at_work = self.layout, context.scene.bda, session.study_at_work()
        row = layout.row(align=True)
        row.prop(settings, "study_path", text="", placeholder="Study file")
        row.operator("bda.load_study", text="Load")
        layout.prop(settings, "study_directory", text="", placeholder="Folder of the study")
        layout.prop(settings, "study_jobs")
        if at_work:
            _draw_course(layout, at_work)
        else:
            layout.operator("bda.start_study", text="Start")
        if why := session.why_ended():
            draw_sentence(layout, context, why)


class BDA_PT_study_runs(SidebarPanel, bpy.types.Panel):
    """How often the scenario is run, and what is to be said of it."""

    bl_label = "Runs and Limit"
    bl_parent_id = "BDA_PT_study"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        draw_keys(self.layout, context, context.scene.bda.study, StudySettings)


class BDA_PT_study_vary(SidebarPanel, bpy.types.Panel):
    """What is drawn anew for each run, besides the seed of the fracture."""

    bl_label = "What Varies"
    bl_parent_id = "BDA_PT_study"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        draw_tables(self.layout, context, context.scene.bda.study, _TABLES["vary"])


class BDA_PT_study_criteria(SidebarPanel, bpy.types.Panel):
    """What makes a run count as a success."""

    bl_label = "Criteria"
    bl_parent_id = "BDA_PT_study"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        draw_tables(self.layout, context, context.scene.bda.study, _TABLES["criteria"])


class BDA_PT_study_findings(SidebarPanel, bpy.types.Panel):
    """What a study came to."""

    bl_label = "Findings"
    bl_parent_id = "BDA_PT_study"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout, shown = self.layout, session.shown_study()
        layout.operator("bda.show_study", text="Show Study in Folder")
        if shown is None:
            return
        for sentence in shown.sentences:
            draw_sentence(layout, context, sentence, icon="NONE")
        layout.prop(context.scene.bda, "show_study")
        layout.operator("bda.open_worst_draw")
        if trouble := decorator.drawing.trouble:
            draw_sentence(layout, context, trouble)


CLASSES = (BDA_PT_study, BDA_PT_study_runs, BDA_PT_study_vary, BDA_PT_study_criteria, BDA_PT_study_findings)


def course_of(at_work: StudyAtWork) -> list[str]:
    """Return how far a study is, each in a few words."""
    run = at_work.run
    lines = [f"{run.done} of {run.total} draws" + (", paused" if run.is_paused else "")]
    if others := run.done - run.statuses.get(DONE, 0):
        lines.append(f"{others} of them did not finish")
    if not run.is_paused and (left := round(run.remaining_s)):
        lines.append(f"{left // 3600}:{left // 60 % 60:02d}:{left % 60:02d} h left")
    return lines


def _draw_course(layout: bpy.types.UILayout, at_work: StudyAtWork) -> None:
    """Draw the buttons above what comes and goes: so they stay under the mouse."""
    layout.progress(factor=at_work.run.done / at_work.run.total, text=at_work.path.name)
    row = layout.row(align=True)
    if at_work.run.is_paused:
        row.operator("bda.resume_study", text="Resume")
    else:
        row.operator("bda.pause_study", text="Pause")
    row.operator("bda.stop_study", text="Stop")
    column = layout.column(align=True)
    for line in course_of(at_work):
        column.label(text=line)
