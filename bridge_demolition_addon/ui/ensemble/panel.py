"""What the panels Study, Search and Optimise share: file and folder, settings, buttons, progress and the result."""

import logging
import os
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ...model.schema import key_fields
from ...model.study.criteria import Criterion
from ...model.study.file import Ensemble
from ...model.study.settings import EnsembleSettings, StudySettings
from ..languages.words import translated
from ..operators import Action, UndoableAction, absolute
from ..recording.session import new_folder
from ..results.operator import open_path
from ..scenario.prop import shown_tables
from ..scenario.ui import draw_keys
from ..scenario.values import show_fields, show_scenario, show_table, table_of
from ..sidebar import SidebarPanel, draw_sentence, path_property
from ..viewport import redraw_views
from .session import Work

_CONSOLE = logging.getLogger(__name__)

CHARGES, BALL_MASS, DROP_HEIGHT, ANOTHER_KEY = "CHARGES", "BALL_MASS", "DROP_HEIGHT", "ANOTHER_KEY"
KEYS = {CHARGES: "charges.mass_kg", BALL_MASS: "ball.mass_kg", DROP_HEIGHT: "ball.drop_height_m"}
"""Keys of the quantities that are searched along most."""

COLLAPSED, SPAN_DOWN, AS_IN_STUDY = "COLLAPSED", "SPAN_DOWN", "AS_IN_STUDY"

_QUANTITIES = (
    (CHARGES, "Factor on All Charges", "How many times as heavy all charges are as in the panels"),
    (BALL_MASS, "Mass of Ball", "Mass of the ball, kg"),
    (DROP_HEIGHT, "Drop Height", "Height that the ball drops from, m"),
    (ANOTHER_KEY, "Another Key", "Any number of the scenario, by its key"),
)
_CRITERIA = (
    (COLLAPSED, "Collapsed", "The shards' common centre of mass loses half of its height"),
    (SPAN_DOWN, "Span Down", "The centre of mass of one span loses half of its height"),
    (AS_IN_STUDY, "As in Study", "All criteria of the panel Study"),
)
_EARLIER_NAMES = ("lowest", "highest", "probability", "confidence", "trials")
"""Keys of a search that were properties of the scene itself, as ``search_lowest``; saved files still have them."""


def read_earlier_names(settings: bpy.types.PropertyGroup, _context: bpy.types.Context | None = None) -> None:
    """Move values that are set under an earlier name to the present one."""
    for name in _EARLIER_NAMES:
        if settings.is_property_set(f"search_{name}"):
            _CONSOLE.warning("scene.bda.search_%s is scene.bda.search.%s now", name, name)
            setattr(settings.search, name, getattr(settings, f"search_{name}"))
            settings.property_unset(f"search_{name}")


@bpy.app.handlers.persistent
def read_earlier_files(*_arguments: object) -> None:
    """Called by Blender when a file is loaded."""
    for scene in bpy.data.scenes:
        read_earlier_names(scene.bda)


def _folder(kind: str) -> object:
    return path_property(
        "Folder",
        f"Folder of the {kind}: made if new; in a folder that was begun it goes on, with more runs too",
        "DIR_PATH",
    )


class EnsembleProperties:
    """Part of the settings of a scene."""

    study_path: path_property("Study", "Study file (TOML) to load, with the scenario that it varies")
    search_path: path_property("Search", "Search file (TOML) to load, with the scenario that it changes")
    optimise_path: path_property("Optimisation", "Optimisation file (TOML) to load, with the scenario that it changes")
    study_directory: _folder("study")
    search_directory: _folder("search")
    optimise_directory: _folder("optimisation")
    study_jobs: IntProperty(
        name="Runs at a Time",
        description="How many runs go on at a time, each in a Blender of its own; such as 1 less than processors",
        default=max((os.cpu_count() or 1) - 1, 1),
        min=1,
        max=1000,
    )
    show_study: BoolProperty(
        name="Show Map and Limit",
        description="Show on the ground how likely debris gets to a position, and the limit as a line",
        default=True,
        update=redraw_views,
    )
    search_quantity: EnumProperty(name="Quantity", description="What is changed from run to run", items=_QUANTITIES)
    search_criterion: EnumProperty(name="Criterion", description="What a success is", items=_CRITERIA)
    search_span: IntProperty(
        name="Span", description="Number of the span, from 1, along the road", default=1, min=1, max=10_000
    )
    optimise_criterion: EnumProperty(name="Criterion", description="What has to hold", items=_CRITERIA)
    optimise_span: IntProperty(
        name="Span", description="Number of the span, from 1, along the road", default=1, min=1, max=10_000
    )

    search_lowest: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_highest: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_probability: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_confidence: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_trials: IntProperty(options={"HIDDEN"}, update=read_earlier_names)


class EnsemblePanel(SidebarPanel):
    """Base of the three panels, each for the work of a kind; `can_pause` says that it has buttons for that."""

    work: Work
    can_pause = False

    def draw_settings(self, context: bpy.types.Context) -> None:
        """Draw the settings."""

    def draw_result(self, context: bpy.types.Context) -> None:
        """Draw the result."""

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings, work = self.layout, context.scene.bda, self.work
        name = translated(work.name)
        row = layout.row(align=True)
        row.prop(settings, f"{work.key}_path", text="", placeholder=translated("{} file").format(name))
        row.operator(f"bda.load_{work.key}", text="Load")
        layout.prop(settings, f"{work.key}_directory", text="", placeholder=translated("Folder of the {}").format(name))
        self.draw_settings(context)
        layout.prop(settings, "study_jobs")
        if work.session:
            self._draw_progress()
        else:
            layout.operator(f"bda.start_{work.key}", text="Start")
        if work.why_ended:
            draw_sentence(layout, context, work.why_ended)
        if work.result:
            self.draw_result(context)

    def _draw_progress(self) -> None:
        """Draw the buttons above the lines that come and go: so they stay under the mouse."""
        layout, work = self.layout, self.work
        layout.progress(
            factor=work.session.planner.done / work.session.planner.total, text=work.session.folder.path.name
        )
        row = layout.row(align=True)
        if self.can_pause:
            if work.session.is_paused:
                row.operator(f"bda.resume_{work.key}", text="Resume")
            else:
                row.operator(f"bda.pause_{work.key}", text="Pause")
        row.operator(f"bda.stop_{work.key}", text="Stop")
        column = layout.column(align=True)
        for line in work.progress:
            column.label(text=line, translate=False)


class OneValuePanel(EnsemblePanel):
    """Base of the panels Search and Optimise: keys, a criterion, and a result in sentences with a picture."""

    picture: str

    def draw_criterion(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
        """Draw what a success is."""
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        column.prop(settings, f"{self.work.key}_criterion")
        if getattr(settings, f"{self.work.key}_criterion") == SPAN_DOWN:
            column.prop(settings, f"{self.work.key}_span")

    def draw_result(self, context: bpy.types.Context) -> None:
        draw_whose_result(self.layout, context, self.work)
        for sentence in self.work.result.sentences:
            draw_sentence(self.layout, context, sentence, icon="NONE")
        self.layout.operator(self.picture)


def draw_whose_result(layout: bpy.types.UILayout, context: bpy.types.Context, work: Work) -> None:
    """Say where a result is of another bridge, or of other charges, than the panels show."""
    if work.is_of_other(context.scene.bda):
        sentence = translated("This result is of other values than the panels show: {}")
        draw_sentence(layout, context, sentence.format(work.scenario.title))


def draw_own_keys(panel: EnsemblePanel, context: bpy.types.Context, without: tuple[str, ...] = ()) -> None:
    """Draw the keys that only this kind has, from the schema; those that all kinds share are in the panel Study."""
    column = panel.layout.column()
    column.enabled = panel.work.session is None
    group = getattr(context.scene.bda, panel.work.key)
    draw_keys(column, context, group, panel.work.settings_class, without=without)


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
