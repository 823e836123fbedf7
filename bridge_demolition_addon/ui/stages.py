"""Stages in the sidebar: does the bridge stand between the steps of its demolition?"""

import math
from dataclasses import dataclass

import bpy
from bpy.props import IntProperty

from ..display.contour_quantities import ContourQuantity
from ..display.contours import StageContours
from ..model.scenario import Scenario
from ..model.sequence.checked_model import checked_model
from ..model.stages.misfires import misfire_sentences, misfires
from ..model.stages.stages import criticality, stages_of
from ..model.stages.standing import StandingBridge, made_elastic
from ..model.stages.tables import (
    all_reaction_rows,
    bearing_rows,
    bearing_sentences,
    criticality_sentences,
    reaction_sentences,
    stage_row,
    stage_sentences,
    write_tables,
)
from ..simulation.blender_events import contours_of
from ..system.disk import writing
from .contours import view as contour_view
from .languages.words import translated
from .modal_task import ModalTask, SteppedThread, Work
from .operators import UndoableAction, absolute, no_world
from .scenario.built import is_built, panels_show
from .scenario.values import scenario_of
from .sidebar import SidebarPanel, draw_of_one_cut, draw_sentence, path_property
from .task_progress import draw_task_progress, going_on


@dataclass(frozen=True, slots=True, eq=False)
class CheckedStages:
    """Results of a check of stages, for the panel.

    Attributes
    ----------
    scene_uid
        Blender's number of the scene in this session.
    scenario
        What was checked.
    rows
        Rows of the table of stages.
    reactions
        Rows of the table of reactions, of each stage.
    bearings
        Rows of the table of bearings, of each stage.
    sentences
        What is said of each stage: first which it is.
    members
        A sentence on each member, without which others come down.
    contours
        Utilisation of each shard in each stage.
    """

    scene_uid: int
    scenario: Scenario
    rows: tuple[dict, ...]
    reactions: tuple[tuple[dict, ...], ...]
    bearings: tuple[tuple[dict, ...], ...]
    sentences: tuple[tuple[str, ...], ...]
    members: tuple[str, ...]
    contours: StageContours


_checked: list[CheckedStages] = []


def keep(checked: CheckedStages) -> None:
    """Keep a check in place of the one before."""
    _checked[:] = [checked]


def checked_in(scene: bpy.types.Scene) -> CheckedStages | None:
    """Return the last check of a scene; None where there was none, or another scene was checked since."""
    return next((checked for checked in _checked if checked.scene_uid == scene.session_uid), None)


def why_not_shown(scene: bpy.types.Scene) -> str | None:
    """Return in a sentence why no stages are shown; None where they belong to what the panels show."""
    checked = checked_in(scene)
    if checked is None:
        return "Check the stages first"
    if not panels_show(scene.bda, checked.scenario):
        return "The stages that were checked are of other values than the panels show: check them again"
    return None


def show_checked(scene: bpy.types.Scene) -> None:
    """Show the last check of a scene in its contours, if it is of what is built there."""
    checked = checked_in(scene)
    is_shown = checked is not None and is_built(scene.bda, checked.scenario)
    contours_of(scene).stages = checked.contours if is_shown else None
    if is_shown and scene.bda.stage_shown > len(checked.contours):
        scene.bda.stage_shown = len(checked.contours)


def unregister() -> None:
    """Forget the check."""
    _checked.clear()


def _show_stage(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    display = contours_of(settings.id_data)
    display.stage = min(settings.stage_shown, len(display.stages)) if display.stages else 1
    contour_view.follow(settings.id_data)


class StageProperties:
    """Part of the settings of a scene."""

    stages_directory: path_property(
        "Tables",
        "Folder for stages.csv, reactions.csv, bearings.csv and the other tables; none to write no tables",
        "DIR_PATH",
    )
    stage_shown: IntProperty(
        name="Stage",
        description="Which stage the panel describes, and the contours of utilisation at rest show, such as 1",
        default=1,
        min=1,
        soft_max=20,
        update=_show_stage,
    )


_STAGES, _MEMBERS = "stages", "without each member"
_SHARES = {_STAGES: (0.0, 0.83), _MEMBERS: (0.83, 1.0)}
"""Parts of the time that both take, measured with the example of four stages and ten members."""


class BDA_OT_check_stages(ModalTask, bpy.types.Operator):
    """Work out how the bridge in the panels stands before each step and after the last; Esc stops"""

    bl_label = "Check Stages"
    bl_description = (
        "Work out how the bridge in the panels stands before each step and after the last, and without each of its "
        "members, by its stiffness and without a simulation; Esc stops"
    )
    task, unit = "Checking stages", "parts"
    shortest_step_s = 0.1  # about what Blender takes to draw its progress without a graphics card

    def work(self, context: bpy.types.Context) -> Work:
        settings = context.scene.bda
        scenario, scene_uid = scenario_of(settings), context.scene.session_uid
        folder = absolute(settings.stages_directory) if settings.stages_directory else None

        def check(thread: SteppedThread) -> str:
            thread.stage("cutting the bridge")
            model = checked_model(made_elastic(scenario))
            bridge = StandingBridge(model, scenario.joints, lambda: thread.part(thread.done, thread.total))
            thread.stage(_STAGES)
            stages = stages_of(scenario, bridge, thread.part)
            thread.stage(_MEMBERS)
            members = criticality(bridge, thread.part)
            failures = misfires(scenario, bridge, thread.part)
            if folder is None:
                rows = [stage_row(number, stage, bridge) for number, stage in enumerate(stages, start=1)]
            else:
                with writing(folder):
                    rows = write_tables(folder, stages, members, bridge, failures)
            all_reactions = all_reaction_rows(stages, model)
            reactions = tuple(
                tuple(reaction for reaction in all_reactions if reaction["stage"] == row["stage"]) for row in rows
            )
            all_bearings = list(bearing_rows(stages, model))
            bearings = tuple(tuple(one for one in all_bearings if one["stage"] == row["stage"]) for row in rows)
            sentences = tuple(
                (*stage_sentences(stage, row), *reaction_sentences(carried), *bearing_sentences(on_bearings))
                for stage, row, carried, on_bearings in zip(stages, rows, reactions, bearings, strict=True)
            )
            keep(
                CheckedStages(
                    scene_uid=scene_uid,
                    scenario=scenario,
                    rows=tuple(rows),
                    reactions=reactions,
                    bearings=bearings,
                    sentences=sentences,
                    members=(*criticality_sentences(members), *misfire_sentences(failures)),
                    contours=StageContours.of_stages(model, stages),
                )
            )
            return f"{len(rows)} stages" + (f", with tables in {folder}" if folder else "")

        return check

    def share_of(self, thread: SteppedThread) -> float:
        begun, ended = _SHARES.get(thread.stage_text, (0.0, 0.0))
        return begun + (ended - begun) * super().share_of(thread)

    def finish(self, context: bpy.types.Context) -> set[str]:
        finished = super().finish(context)
        show_checked(context.scene)
        return finished


def _not_checked(context: bpy.types.Context) -> str | None:
    return why_not_shown(context.scene)


class BDA_OT_show_utilisation(UndoableAction, bpy.types.Operator):
    """Colour the shards by how much of their strength their connections use at rest, in the stage that is shown"""

    bl_label = "Show Utilisation"
    blocked_by = (no_world, _not_checked)

    def act(self, context: bpy.types.Context) -> None:
        scene, settings = context.scene, context.scene.bda
        show_checked(scene)
        scene.frame_set(scene.rigidbody_world.point_cache.frame_start)  # a pile is not what was calculated
        settings.contour_quantity = ContourQuantity.UTILISATION.name
        settings.contours = True


_MOST_TIMES = 64
"""Up to which load factor the collapse is looked for."""

_UNITS = {"force": "kN", "moment": "kNm"}
_HEADS = {
    "support": {"force": "Reactions, kN", "moment": "Moments, kN·m"},
    "bearing": {"force": "Bearings, kN", "moment": "Bearings, kN·m"},
}


class BDA_PT_stages(SidebarPanel, bpy.types.Panel):
    """How the bridge stands between the steps of its demolition, by its stiffness and without a simulation."""

    bl_label = "Stages"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.bda
        layout.prop(settings, "stages_directory", text="", placeholder=translated("Folder for tables"))
        layout.operator("bda.check_stages")
        if progress := going_on(BDA_OT_check_stages.task):
            draw_task_progress(layout, context, progress)
        checked = checked_in(context.scene)
        if checked is None:
            return
        if reason := why_not_shown(context.scene):
            draw_sentence(layout, context, reason)
            return
        grid = layout.column(align=True)
        for row in [{}, *checked.rows]:
            line = grid.row(align=True)
            for text in cells_of(row):
                line.label(text=text, translate=False)
        layout.operator("bda.show_utilisation")
        layout.prop(settings, "stage_shown")
        shown = min(settings.stage_shown, len(checked.rows)) - 1
        if carried := carried_text(checked.rows[shown]):
            draw_sentence(layout, context, carried, icon="NONE")
        for sentence in (*checked.sentences[shown], *checked.members):
            draw_sentence(layout, context, sentence, icon="NONE")
        for kind, rows in (("support", checked.reactions[shown]), ("bearing", checked.bearings[shown])):
            for quantity in _HEADS[kind] if rows else ():
                grid = layout.column(align=True)
                for row in [{}, *rows]:
                    line = grid.row(align=True)
                    for text in reaction_cells_of(row, quantity, kind):
                        line.label(text=text, translate=False)
        if checked.bearings[shown]:
            draw_of_one_cut(layout, context)


def reaction_cells_of(row: dict, quantity: str, kind: str) -> tuple[str, ...]:
    """Return what the tables say of a support or bearing: its force or moment; the head of the table for no row."""
    if not row:
        return translated(_HEADS[kind][quantity]), "x", "y", "z"
    return row[kind], *(f"{row[f'{quantity}_{axis}_{_UNITS[quantity]}']:.1f}" for axis in "xyz")


def carried_text(row: dict) -> str:
    """Return in a sentence how many times its weight the bridge carries in a stage; empty where it is not held."""
    factor = row["collapse_factor"]
    if math.isnan(factor):
        return ""
    if math.isinf(factor):
        return translated("Carries more than {} times its weight").format(_MOST_TIMES)
    return translated("Carries {} times its weight").format(f"{factor:.2f}")


def cells_of(row: dict) -> tuple[str, ...]:
    """Return what the table says of a stage; its head for no row."""
    if not row:
        return tuple(map(translated, ("Stage", "From", "Used", "Carries, × weight")))
    used, factor = row["largest_utilisation"], row["collapse_factor"]
    return (
        str(row["stage"]),
        f"{row['time_s']:g} s",
        "" if used is None else f"{used:.0%}",
        translated("not held") if math.isnan(factor) else f"> {_MOST_TIMES}" if math.isinf(factor) else f"{factor:.2f}",
    )
