"""Operators of a search: beginning and stopping it, and opening its curve."""

from __future__ import annotations

import bpy

from ...engineering.single_precision import shortest
from ...errors import ScenarioError
from ...model.scenario import Scenario
from ...model.search.file import Search, search_of
from ...model.search.settings import SearchSettings
from ...model.study.criteria import Criterion
from ...model.study.settings import StudySettings
from ..operators import Action, absolute
from ..results.operator import open_path
from ..scenario.values import scenario_of, table_of
from . import session
from .prop import AS_IN_STUDY, CHARGES, COLLAPSED, KEYS


class BDA_OT_start_search(Action, bpy.types.Operator):
    """Make trials beside your work, and find the value that succeeds as often as it has to"""

    bl_idname = "bda.start_search"
    bl_label = "Find Smallest Charge"
    bl_description = (
        "Make trials beside your work, each a run of the scenario in the panels with shards of its own and with what "
        "varies in the panel Study, and find the value that succeeds as often as it has to; goes on where the folder "
        "stands"
    )
    changes_scene = False

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if session.search_at_work():
            return "A search is at work already"
        return None if context.scene.bda.search_directory else "Choose a folder for the search first"

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        path = absolute(settings.search_directory)
        session.begin(shown_search(settings), path, settings.study_jobs)
        return f"The search runs in {path}: go on working, and leave Blender open"


class BDA_OT_stop_search(Action, bpy.types.Operator):
    """Stop the search; trials that are done are kept, and Find Smallest Charge goes on with them"""

    bl_idname = "bda.stop_search"
    bl_label = "Stop Search"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        return None if session.search_at_work() else "No search is at work"

    def act(self, _context: bpy.types.Context) -> str:
        run = session.search_at_work().run
        session.end()
        return f"Stopped after {run.done} trials of at most {run.total}"


class BDA_OT_open_search_curve(Action, bpy.types.Operator):
    """Open the picture of all trials, and of how likely success is at which value"""

    bl_idname = "bda.open_search_curve"
    bl_label = "Open Curve"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        return None if session.found_by_search() else "No search has ended yet"

    def act(self, _context: bpy.types.Context) -> None:
        open_path(session.found_by_search().picture)


CLASSES = (BDA_OT_start_search, BDA_OT_stop_search, BDA_OT_open_search_curve)


def shown_search(settings: bpy.types.PropertyGroup) -> Search:
    """Return the search that the panels show, of the scenario that they show.

    Raises
    ------
    DemolitionError
        A value cannot be used; the text names the key.
    """
    scenario = scenario_of(settings)
    study = table_of(settings.study, StudySettings)
    asked = SearchSettings(
        scenario=study.scenario,
        key=KEYS[settings.search_quantity],
        factor=settings.search_quantity == CHARGES,
        lowest=shortest(settings.search_lowest),
        highest=shortest(settings.search_highest),
        logarithmic=True,
        probability=shortest(settings.search_probability),
        confidence=shortest(settings.search_confidence),
        trials=settings.search_trials,
        seed=study.seed,
        time_limit_s=study.time_limit_s,
        memory_limit_mb=study.memory_limit_mb,
        vary=study.vary,
        criteria=_criteria(settings, study),
    )
    _check_something_blasts(settings, scenario)
    return search_of(asked, scenario)


def _criteria(settings: bpy.types.PropertyGroup, study: StudySettings) -> tuple[Criterion, ...]:
    if settings.search_criterion == AS_IN_STUDY:
        return study.criteria
    if settings.search_criterion == COLLAPSED:
        return (Criterion(name="it comes down", kind="collapsed"),)
    return (Criterion(name=f"span {settings.search_span} comes down", kind="span down", span=settings.search_span),)


def _check_something_blasts(settings: bpy.types.PropertyGroup, scenario: Scenario) -> None:
    if settings.search_quantity == CHARGES and not (scenario.charges and scenario.blast.explosion):
        raise ScenarioError("the scenario has no charges that go off: add some, or choose another quantity")
