"""The stages that were checked last, and which of them is shown."""

from dataclasses import dataclass

import bpy
from bpy.props import IntProperty

from ...display.stage_contours import StageContours
from ...model.scenario import Scenario
from ...simulation.blender_events import contours_of
from ..contours import view as contour_view
from ..scenario.built import is_built, panels_show
from ..sidebar import path_property


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
    """Return in a sentence why no stages are shown; None where they are those of what the panels show."""
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
