"""A study in the sidebar: its buttons and panels, and its map and limit on the ground."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from manifold3d import CrossSection

from ...display.ground_lines import map_triangles, outline_lines
from ...errors import OutputError
from ...model.schema import subtable_fields
from ...model.study.file import Study, read_study, study_of
from ...model.study.sampled_runs import sampled_run
from ...model.study.settings import StudySettings
from ...report.ensemble.reported_ensemble import StudyRuns, read_study_runs
from ...report.wording.study import study_sentences
from ...studies.session import EnsembleSession
from ..operators import UndoableAction
from ..scenario.operator import BDA_OT_build_anew, build_and_show, stop_playing
from ..scenario.ui import draw_keys, draw_tables
from ..scenario.values import scenario_of, table_of
from ..sidebar import SidebarPanel, draw_sentence
from ..view_drawing import ViewDrawing, draw_lines, draw_triangles
from ..viewport import redraw_views
from .panel import EnsembleAction, EnsemblePanel, LoadEnsemble, StartEnsemble, StopEnsemble, draw_whose_result
from .session import WORKS, Work

_LIMIT_COLOUR = (1.0, 0.2, 0.2, 1.0)
_LIMIT_WIDTH_PX = 3.0
_TABLES = {item.name: item for item in subtable_fields(StudySettings)}


@dataclass(frozen=True, slots=True, eq=False)
class ShownStudy:
    """A study that the panel describes and the 3D view shows.

    Attributes
    ----------
    triangles
        Cells that runs hit: corners (3 k, 3), m, and their colours (3 k, 4).
    limit_lines
        Lines (2 k, 3) around the area of the distance to keep, m; none where there is no limit yet.
    """

    runs: StudyRuns
    sentences: tuple[str, ...]
    triangles: tuple[np.ndarray, np.ndarray]
    limit_lines: np.ndarray

    @classmethod
    def of(cls, runs: StudyRuns) -> ShownStudy:
        """Work out map, limit and sentences of a study."""
        sentences = (f"{len(runs.table)} of {runs.ensemble.settings.runs} runs are there: the study goes on.",)
        if runs.conclusions:
            sentences = tuple(study_sentences(runs.ensemble, runs.conclusions))
        triangles = map_triangles(runs.map) if runs.map else (np.zeros((0, 3)), np.zeros((0, 4)))
        return cls(runs, sentences, triangles, outline_lines(runs.to_keep[1] if runs.to_keep else CrossSection()))

    @classmethod
    def of_session(cls, session: EnsembleSession) -> ShownStudy:
        """Work them out for a study that has ended."""
        return cls.of(read_study_runs(session.folder.path))


WORK = Work("study", "study", StudySettings, ShownStudy.of_session)
WORKS.append(WORK)


def show(path: Path) -> ShownStudy:
    """Show the study in a folder, in place of any other; OutputError where none of its runs finished."""
    WORK.result = ShownStudy.of(read_study_runs(path))
    WORK.scenario = WORK.result.runs.ensemble.scenario
    redraw_views()
    return WORK.result


def shown_study(settings: bpy.types.PropertyGroup) -> Study:
    """Return the study that the panels show, of the scenario that they show."""
    return study_of(table_of(settings.study, StudySettings), scenario_of(settings))


class BDA_OT_load_study(LoadEnsemble, bpy.types.Operator):
    """Show a study file's values in the panels, with those of the scenario that it varies; nothing runs yet"""

    bl_label = "Load Study"
    work, read = WORK, staticmethod(read_study)


class BDA_OT_start_study(StartEnsemble, bpy.types.Operator):
    """Run the scenario many times with what varies, beside your work; goes on where the folder stands"""

    bl_label = "Start Study"
    bl_description = (
        "Run the scenario in the panels many times with what varies, beside your work; goes on where the folder "
        "stands, also with more runs than before"
    )
    work, shown = WORK, staticmethod(shown_study)


class BDA_OT_stop_study(StopEnsemble, bpy.types.Operator):
    """Stop the study; runs that are done are kept, and Start goes on with them"""

    bl_label = "Stop Study"
    work = WORK


class BDA_OT_pause_study(EnsembleAction, bpy.types.Operator):
    """Begin no further run; those under way are finished"""

    bl_label = "Pause Study"
    work = WORK

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        if WORK.session is None:
            return "No study is at work"
        return "The study is paused already" if WORK.session.is_paused else None

    def act(self, _context: bpy.types.Context) -> None:
        WORK.session.is_paused = True


class BDA_OT_resume_study(EnsembleAction, bpy.types.Operator):
    """Go on with the study"""

    bl_label = "Resume Study"
    work = WORK

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        return None if WORK.session and WORK.session.is_paused else "No study is paused"

    def act(self, _context: bpy.types.Context) -> None:
        WORK.session.is_paused = False


class BDA_OT_show_study(EnsembleAction, bpy.types.Operator):
    """Show the study in the folder: its map on the ground and, once all runs are there, its limit"""

    bl_label = "Show Study"
    work = WORK

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if WORK.session:
            return "The study is shown once it ends or is stopped"
        return None if context.scene.bda.study_directory else "Choose the folder of a study first"

    def act(self, context: bpy.types.Context) -> str:
        runs = show(self.folder(context)).runs
        return f"{len(runs.table)} runs of {runs.ensemble.scenario.title}"


class BDA_OT_open_worst_draw(UndoableAction, bpy.types.Operator):
    """Build the run with the largest debris distance, in place of what is built: run it to see what happened"""

    bl_label = "Open Worst Run"
    changes_objects = True

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if not WORK.result:
            return "Show a study first"
        return BDA_OT_build_anew.disabled_reason(context) if context.scene.rigidbody_world else None

    def act(self, context: bpy.types.Context) -> str:
        runs, settings = WORK.result.runs, context.scene.bda
        row = runs.table.worst_row
        if row is None:
            raise OutputError("No run of this study finished")
        number = int(runs.table.numbers[row])
        stop_playing(context)
        scene, scenario = context.scene, sampled_run(runs.ensemble, number).scenario
        build_and_show(scene, scenario, again=scene.rigidbody_world is not None)
        settings.scenario_path = settings.loaded_path = ""
        return f"Run {number}, whose debris distance is {runs.distances_m[row]:.1f} m"


class BDA_PT_study(EnsemblePanel, bpy.types.Panel):
    """Many runs of the scenario with sampled inputs, and their debris distance."""

    bl_label = "Study"
    work, can_pause = WORK, True


class BDA_PT_study_runs(SidebarPanel, bpy.types.Panel):
    """Number of runs, and the limit to state; searches and optimisations share the seed, time and memory limits."""

    bl_label = "Runs and Limit"
    bl_parent_id = "BDA_PT_study"

    def draw(self, context: bpy.types.Context) -> None:
        draw_keys(self.layout, context, context.scene.bda.study, StudySettings)


class BDA_PT_study_vary(SidebarPanel, bpy.types.Panel):
    """Inputs that are sampled for each run, apart from the seed of the fracture; in searches and optimisations too."""

    bl_label = "What Varies"
    bl_parent_id = "BDA_PT_study"

    def draw(self, context: bpy.types.Context) -> None:
        draw_tables(self.layout, context, context.scene.bda.study, _TABLES["vary"])


class BDA_PT_study_criteria(SidebarPanel, bpy.types.Panel):
    """Conditions that a run meets where it is a success."""

    bl_label = "Criteria"
    bl_parent_id = "BDA_PT_study"

    def draw(self, context: bpy.types.Context) -> None:
        draw_tables(self.layout, context, context.scene.bda.study, _TABLES["criteria"])


class BDA_PT_study_findings(SidebarPanel, bpy.types.Panel):
    """What the runs of a study state."""

    bl_label = "Findings"
    bl_parent_id = "BDA_PT_study"
    bl_options = set()  # open: it is there only once there may be a study

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.scene.bda.study_directory) or WORK.result is not None

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.operator("bda.show_study", text="Show Study in Folder")
        if WORK.result is None:
            return
        draw_whose_result(layout, context, WORK)
        for sentence in WORK.result.sentences:
            draw_sentence(layout, context, sentence, icon="NONE")
        layout.prop(context.scene.bda, "show_study")
        layout.operator("bda.open_worst_draw")
        if drawing.error:
            draw_sentence(layout, context, drawing.error)


def _draw(context: bpy.types.Context) -> None:
    settings = context.scene.bda
    if WORK.result is None or not settings.show_study or WORK.is_of_other(settings):
        return
    draw_triangles(*WORK.result.triangles)
    draw_lines(context, WORK.result.limit_lines, _LIMIT_COLOUR, _LIMIT_WIDTH_PX)


drawing = ViewDrawing(_draw)
