"""Operators of results: looking at a body, opening the folder, charts, exports, and the report in its language.

A choice is written into the scenario that the panels show, and so into its file.
"""

import shutil
import sys
from functools import cache
from pathlib import Path
from typing import ClassVar

import bpy
import numpy as np
from bpy.props import EnumProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ...engineering.blast.pulses import BlastModel
from ...engineering.unit_systems import UnitSystem
from ...errors import OutputError, SimulationError
from ...exports.formats import FORMATS, new_export
from ...model.debris.survey import SURVEY_FILES
from ...model.run_folder.files import FORCE_CHART, REPORT_PAGE, REPORT_PDF, REPORT_WORD
from ...model.run_folder.folder import keep_site
from ...report.document.word_library import word_is_there
from ...report.languages.translation import ENGLISH, language_names
from ...scene.rendering.ground import show_survey
from ...simulation.blender_events import shown_results
from ...simulation.kept_run import folder_of_run, has_run, is_run_of
from ...system.disk import whole_file, writing
from ..modal_task import ModalTask, SteppedThread, Work
from ..operators import Action, UndoableAction, absolute, no_world, recording_runs
from ..scenario.built import shown_site
from ..scenario.prop import USE
from ..sidebar import path_property
from ..viewport import look_at_bridge, look_at_selected, select_only, shards_in_view
from .shown_run import shown_run, why_no_run

_OWN_NAMES = {"en": "English", "de": "Deutsch", "es": "Español", "fr": "Français", "zh_hans": "简体中文"}
"""What speakers call the languages."""

_BEFORE_4 = {"zh_cn": "zh_hans"}
"""What versions of Blender before 4.0 call a language, where they call it otherwise."""

_SYSTEMS = tuple(UnitSystem)


def language_of_blender(locale: str) -> str:
    """Return the language of reports for what Blender calls its own, such as ``de_DE``; English without a table."""
    name = locale.lower()
    name = _BEFORE_4.get(name, name)
    return next((known for known in language_names() if name in (known, f"{known}_{name[len(known) + 1 :]}")), ENGLISH)


def shown_language(settings: bpy.types.PropertyGroup) -> str:
    """Return the language that reports of a scene are made in: the scenario's, or else Blender's."""
    return _asked(settings, "language") or language_of_blender(bpy.app.translations.locale or "")


def shown_units(settings: bpy.types.PropertyGroup) -> str:
    """Return the units that reports of a scene are made in: the scenario's, or else the scene's."""
    of_scene = settings.id_data.unit_settings.system
    return _asked(settings, "units") or (UnitSystem.IMPERIAL if of_scene == "IMPERIAL" else UnitSystem.METRIC).value


def _asked(settings: bpy.types.PropertyGroup, name: str) -> str | None:
    report = settings.scenario.report
    return getattr(report, name) if getattr(report, USE + name) else None


def _ask(settings: bpy.types.PropertyGroup, name: str, value: str) -> None:
    setattr(settings.scenario.report, name, value)
    setattr(settings.scenario.report, USE + name, True)


def _shown_language(settings: bpy.types.PropertyGroup) -> int:
    return language_names().index(shown_language(settings))


def _choose_language(settings: bpy.types.PropertyGroup, number: int) -> None:
    _ask(settings, "language", language_names()[number])


def _shown_units(settings: bpy.types.PropertyGroup) -> int:
    return _SYSTEMS.index(UnitSystem(shown_units(settings)))


def _choose_units(settings: bpy.types.PropertyGroup, number: int) -> None:
    _ask(settings, "units", _SYSTEMS[number].value)


class ReportProperties:
    """Settings of reports."""

    report_language: EnumProperty(
        name="Language",
        description="Language of the report. At first that of the scenario, or of Blender where reports have a table "
        "for it, else English. A choice goes into the scenario",
        items=[(name, _OWN_NAMES.get(name, name), "") for name in language_names()],
        get=_shown_language,
        set=_choose_language,
    )
    report_units: EnumProperty(
        name="Units",
        description="Units of the report. At first those of the scenario, or of Blender's scene: imperial where it "
        "shows feet, else metric. A choice goes into the scenario. Tables, logs and site plans stay in SI units",
        items=[
            (UnitSystem.METRIC.value, "Metric", "SI units: m, mm, t, kN, MPa"),
            (UnitSystem.IMPERIAL.value, "Imperial", "US customary units: ft, in, lb, short tons, kip, ksi, psi"),
        ],
        get=_shown_units,
        set=_choose_units,
    )


CHARTS, PLAN_CHART = "charts", "debris_plan.png"
_OPENER = "xdg-open"
"""Opens folders on Linux. Blender, where it is missing, only writes to the console."""
_SURROUNDINGS = 3.0
"""Distance of the view from a body that is shown, over the distance that is needed."""

_SHARES = {
    "drawing": (0.12, 0.32),
    REPORT_PAGE: (0.32, 0.32),
    REPORT_PDF: (0.55, 0.89),
    REPORT_WORD: (0.89, 1.0),
}
"""Parts of the time that a report takes at the beginning and at the end of its stages, measured with two runs of one
and two spans, with pictures. The first page of the PDF takes as long as four others."""


def _no_results(context: bpy.types.Context) -> str | None:
    """Say that nothing is shown of what is built; results that were loaded have no run."""
    return None if shown_results(context.scene).series else _no_run(context)


class BDA_OT_go_to_body(UndoableAction, bpy.types.Operator):
    """Go to that frame, select the body and look at it"""

    bl_label = "Go to Body and Frame"
    changes_scene = False
    changes_objects = True
    blocked_by = (recording_runs, _no_results)

    body: StringProperty(name="Body", description="Name of the body")
    frame: IntProperty(name="Frame", description="Frame to go to", min=0)

    def act(self, context: bpy.types.Context) -> str | None:
        go_to(context, self.body, self.frame)


class BDA_OT_look_at_bridge(UndoableAction, bpy.types.Operator):
    """Back from a body to the whole bridge: look at all shards as they stand at the start frame, and go there"""

    bl_label = "Back to the Bridge"
    changes_objects = True
    blocked_by = (no_world, recording_runs)

    def act(self, context: bpy.types.Context) -> None:
        if not shards_in_view(context):
            raise SimulationError("no shard is in this view layer: show the collection of its bodies")
        scene = context.scene
        scene.frame_set(scene.rigidbody_world.point_cache.frame_start)
        look_at_bridge(context)


def _no_run(context: bpy.types.Context) -> str | None:
    try:
        return why_no_run(context.scene)
    except OutputError as error:
        return str(error)


class BDA_OT_open_results(Action, bpy.types.Operator):
    """Open the folder of the last recording in the system's file manager"""

    bl_label = "Open Folder"
    changes_scene = False
    blocked_by = (_no_run,)

    def act(self, context: bpy.types.Context) -> str | None:
        open_path(shown_run(context.scene).folder)


class BDA_OT_show_survey(UndoableAction, ImportHelper, bpy.types.Operator):
    """Show a scan of the debris beside the end of the run, coloured by how much higher or lower it is"""

    bl_label = "Show Survey"
    changes_objects = True
    blocked_by = (_no_run, recording_runs)

    filter_glob: StringProperty(default=";".join(f"*{ending}" for ending in SURVEY_FILES), options={"HIDDEN"})
    filepath: path_property("File", "Scan of the site: a point cloud, heights on a grid, or a mesh")

    def act(self, context: bpy.types.Context) -> str:
        if not self.filepath:
            raise OutputError("no file of a survey was given: choose one")
        # Loading matplotlib takes a second, which switching the extension on need not wait for.
        from ...report.survey import survey_rows
        from ...report.write import survey_beside_run

        comparison, run = survey_beside_run(shown_run(context.scene).folder, absolute(self.filepath))
        ground = run.recorded.ground()
        places = np.stack(np.meshgrid(comparison.xs_m, comparison.ys_m), -1)
        heights = np.zeros(places.shape[:2]) if ground.is_flat else ground.heights_at(places)
        show_survey(context.scene, comparison, heights)
        said = dict(survey_rows(comparison))
        overlap, off = said["overlap of the footprints"], said["survey less forecast"]
        return f"Footprints overlap by {overlap}; survey less forecast is {off}"


class BDA_OT_draw_charts(ModalTask, bpy.types.Operator):
    """Draw forces over time and debris in plan into the folder of the run, and charts of charges if any; Esc stops"""

    bl_label = "Draw Charts"
    changes_scene = False
    task, unit = "Drawing charts", "charts"
    blocked_by = (_no_run,)

    def work(self, context: bpy.types.Context) -> Work:
        # Loading matplotlib takes a second, which switching the extension on need not wait for.
        from ...charts.blast_design import ChartSettings, write_charts
        from ...charts.histories import plot_forces
        from ...charts.plan_maps import debris_figure
        from ...model.debris.throws import debris_of
        from ...model.results.motion import without_removed

        run = shown_run(context.scene)
        folder, results = run.folder / CHARTS, run.results()
        zones = shown_site(context.scene.bda)["zones"]
        settings = ChartSettings(model=BlastModel(context.scene.bda.scenario.blast.model))

        def draw(thread: SteppedThread) -> str:
            with writing(folder):
                folder.mkdir(exist_ok=True)
                thread.stage("forces over time")
                plot_forces(results, folder / FORCE_CHART, run.title, run.summary.first_hit_s)
                thread.stage("debris in plan")
                left, _ = without_removed(results)
                with whole_file(folder / PLAN_CHART) as part:
                    debris_figure(left, debris_of(left), zones).savefig(part)
                paths = write_charts(folder, settings, thread.part) if run.summary.has_blast else []
            return f"{len(paths) + 2} charts are in {folder}"

        return draw


class BDA_OT_export_run(ModalTask, bpy.types.Operator):
    """Write the run into its folder for another program: all bodies in every frame; Esc stops"""

    bl_label = "Export"
    changes_scene = False
    task, unit = "Exporting the run", "parts"
    blocked_by = (_no_run, recording_runs)

    form: EnumProperty(
        name="Format",
        description="What the run is written for",
        items=[(form.name, form.title, form.content) for form in FORMATS.values()],
    )

    def work(self, context: bpy.types.Context) -> Work:
        from ...exports.write import export_run

        folder, form, blender = shown_run(context.scene).folder, FORMATS[self.form], bpy.app.binary_path

        def write(thread: SteppedThread) -> str:
            output = new_export(folder, form)
            export_run(folder, form, output, thread, blender)
            return f"{form.title}: {output}"

        return write


def _nothing_to_report(context: bpy.types.Context) -> str | None:
    return None if can_report(context.scene) else "Run the scene first, or choose the folder with the results"


def _no_report(context: bpy.types.Context) -> str | None:
    return None if report_of(context.scene) else "There is no report of these results yet: make one first"


writes_word_files = cache(word_is_there)
"""Asked once, as buttons are drawn many times a second."""


def _no_word_library(context: bpy.types.Context) -> str | None:
    needed = (
        "A Word file needs python-docx, which Blender's Python does not have: bda report --docx writes it elsewhere"
    )
    return None if writes_word_files() else needed


class _MakesReport(ModalTask):
    """Makes a report of the results, with zones and neighbours as the panels show them."""

    changes_scene = False
    task, unit = "Making the report", "parts"
    with_word_file: ClassVar[bool]

    def work(self, context: bpy.types.Context) -> Work:
        # Loading matplotlib takes a second, which switching the extension on need not wait for.
        from ...report.write import write_report

        scene, folder, word = context.scene, folder_to_report(context.scene), self.with_word_file
        language, units = shown_language(scene.bda), shown_units(scene.bda)
        if is_run_of(scene, folder):
            keep_site(folder, shown_site(scene.bda))

        def write(thread: SteppedThread) -> str:
            written = write_report([folder], None, word=word, language=language, units=units, progress=thread)
            names = " and ".join(path.name for path in written[1 : 3 if word else 2])
            return f"Report: {written[0]} and {names}"

        return write

    def share_of(self, thread: SteppedThread) -> float:
        begun, ended = next((shares for word, shares in _SHARES.items() if word in thread.stage_text), (0.0, 0.0))
        return begun + (ended - begun) * super().share_of(thread)


class BDA_OT_make_report(_MakesReport, bpy.types.Operator):
    """Make a report of the results, as a page and as a PDF, with zones and neighbours as shown here; Esc stops"""

    bl_label = "Make Report"
    blocked_by = (_nothing_to_report, recording_runs)
    with_word_file = False


class BDA_OT_make_word_report(_MakesReport, bpy.types.Operator):
    """Make a report of the results, as a page, as a PDF and as a Word file whose blanks can be filled in; Esc stops"""

    bl_label = "Make Report with Word File"
    blocked_by = (_nothing_to_report, recording_runs, _no_word_library)
    with_word_file = True


class BDA_OT_open_report(Action, bpy.types.Operator):
    """Open the report that was made of the results in the folder, in the system's browser"""

    bl_label = "Open Report"
    changes_scene = False
    blocked_by = (*BDA_OT_make_report.blocked_by, _no_report)

    def act(self, context: bpy.types.Context) -> None:
        open_path(folder_to_report(context.scene) / REPORT_PAGE)


def go_to(context: bpy.types.Context, name: str, frame: int) -> None:
    """Go to a frame, select a body, and let the 3D view that the context names, if any, look at it."""
    body = context.view_layer.objects.get(name)
    if body is None:
        raise SimulationError(f"{name!r} is not in this scene any more")
    context.scene.frame_set(frame)
    select_only(context, [body])
    context.view_layer.objects.active = body
    look_at_selected(context, _SURROUNDINGS)


def can_report(scene: bpy.types.Scene) -> bool:
    """Return whether there may be results to make a report of: from the scene's run, or a folder."""
    return bool(scene.bda.output_directory) or has_run(scene)


def report_of(scene: bpy.types.Scene) -> Path | None:
    """Return the page of the report of the results; None where none was made."""
    if not can_report(scene):
        return None
    try:
        path = folder_to_report(scene) / REPORT_PAGE
    except OutputError:  # the panel Results says so
        return None
    return path if path.is_file() else None


def folder_to_report(scene: bpy.types.Scene) -> Path:
    """Return the folder whose run a report is of: the chosen one, or else the scene's run's."""
    chosen = scene.bda.output_directory
    return absolute(chosen) if chosen else folder_of_run(scene)


def open_path(path: Path) -> None:
    """Open a folder or file as the system does."""
    if not path.exists():
        raise OutputError(f"{path}: is not there any more")
    if sys.platform.startswith("linux") and not shutil.which(_OPENER):
        raise OutputError(f"{path}: this system has no {_OPENER}, which opens folders and files")
    bpy.ops.wm.path_open(filepath=str(path))
