"""Operators of stages: checking them, and showing how much of its strength each shard uses."""

from __future__ import annotations

import bpy

from ...display.contour_quantities import ContourQuantity
from ...display.stage_contours import StageContours
from ...model.sequence.checked_model import checked_model
from ...model.stages.misfires import misfire_sentences, misfires
from ...model.stages.stages import criticality, stages_of
from ...model.stages.standing import StandingBridge, made_elastic
from ...model.stages.tables import (
    all_reaction_rows,
    bearing_rows,
    bearing_sentences,
    criticality_sentences,
    reaction_sentences,
    stage_row,
    stage_sentences,
    write_tables,
)
from ...system.disk import writing
from ..modal_task import ModalTask, Work
from ..operators import UndoableAction, absolute, no_world
from ..scenario.values import scenario_of
from ..stepped_thread import SteppedThread
from .shown import CheckedStages, keep, show_checked, why_not_shown

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
