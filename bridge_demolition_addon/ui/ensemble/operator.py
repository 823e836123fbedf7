"""Operators that studies, searches and optimisations share: load, start, stop, and open the picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import bpy

from ...model.schema import key_fields
from ...model.study.criteria import Criterion
from ...model.study.file import Ensemble
from ...model.study.settings import EnsembleSettings, StudySettings
from ..operators import Action, UndoableAction, absolute
from ..recording.paths import new_folder
from ..results.operator import open_path
from ..scenario.prop import shown_tables
from ..scenario.values import show_fields, show_scenario, show_table, table_of
from .prop import AS_IN_STUDY, COLLAPSED
from .session import Work


class EnsembleAction(Action):
    """Base of all of them, each for the work of a kind."""

    changes_scene = False
    work: Work

    @classmethod
    def of_kind(cls, context: bpy.types.Context, name: str) -> str:
        """Return a property of the scene, such as ``study_directory``."""
        return getattr(context.scene.bda, f"{cls.work.key}_{name}")

    @classmethod
    def folder(cls, context: bpy.types.Context) -> Path:
        """Return the folder that the panel shows."""
        return absolute(cls.of_kind(context, "directory"))


class LoadEnsemble(EnsembleAction, UndoableAction):
    """Base of buttons that show the values of a file in the panels."""

    changes_scene = changes_objects = True
    read: Callable[[Path], Ensemble]

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        return None if cls.of_kind(context, "path") else f"Choose the {cls.work.name} file first"

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        ensemble = type(self).read(absolute(self.of_kind(context, "path")))
        show_scenario(settings, ensemble.scenario)
        show_ensemble(settings, self.work, ensemble.settings)
        return f"Loaded the {self.work.name} of {ensemble.scenario.title}"


class StartEnsemble(EnsembleAction):
    """Base of buttons that begin, or go on where the folder stands; `shown` returns what the panels show.

    Without a folder they begin in a new one, as a run does.
    """

    changes_scene = True
    shown: Callable[[bpy.types.PropertyGroup], Ensemble]

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        return f"The {cls.work.name} is at work already" if cls.work.session else None

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        ensemble, is_chosen = type(self).shown(settings), bool(self.of_kind(context, "directory"))
        path = self.folder(context) if is_chosen else new_folder(f"{self.work.name} {ensemble.scenario.title}")
        self.work.begin(ensemble, path, settings.study_jobs)
        if not is_chosen:
            setattr(settings, f"{self.work.key}_directory", str(path))
        return f"The {self.work.name} runs in {path}: go on working, and leave Blender open"


class StopEnsemble(EnsembleAction):
    """Base of buttons that stop; runs that are done are kept."""

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        return None if cls.work.session else f"No {cls.work.name} is at work"

    def act(self, _context: bpy.types.Context) -> str:
        session = self.work.session
        self.work.stop()
        return f"Stopped after {session.planner.done} of {session.planner.total} runs"


class OpenPicture(EnsembleAction):
    """Base of buttons that open the picture of a result."""

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        if cls.work.result is None:
            return f"No {cls.work.name} has ended yet"
        return None if cls.work.result.picture else f"The {cls.work.name} has no picture: its scenario has no charges"

    def act(self, _context: bpy.types.Context) -> None:
        open_path(self.work.result.picture)


def show_ensemble(settings: bpy.types.PropertyGroup, work: Work, loaded: EnsembleSettings) -> None:
    """Show the settings of a file: its own in their panel, and those that all kinds share in the panel Study."""
    show_table(getattr(settings, work.key), loaded)
    if work.key == "study":
        return
    show_fields(settings.study, loaded, [*key_fields(EnsembleSettings), *shown_tables(EnsembleSettings)])
    setattr(settings, f"{work.key}_criterion", AS_IN_STUDY)


def with_shared(settings: bpy.types.PropertyGroup, work: Work, **others: Any) -> EnsembleSettings:
    """Return the settings that a panel shows, with those that all kinds share from the panel Study."""
    study = table_of(settings.study, StudySettings)
    shared = {item.name: getattr(study, item.name) for item in fields(EnsembleSettings)}
    shared["criteria"] = _criteria(settings, work, study.criteria)
    return table_of(getattr(settings, work.key), work.settings_class, **shared, **others)


def _criteria(settings: bpy.types.PropertyGroup, work: Work, of_study: tuple[Criterion, ...]) -> tuple[Criterion, ...]:
    chosen, span = getattr(settings, f"{work.key}_criterion"), getattr(settings, f"{work.key}_span")
    if chosen == AS_IN_STUDY:
        return of_study
    if chosen == COLLAPSED:
        return (Criterion(name="it comes down", kind="collapsed"),)
    return (Criterion(name=f"span {span} comes down", kind="span down", span=span),)
