"""An optimisation in the sidebar: its buttons and panels."""

from __future__ import annotations

import bpy

from ...model.optimise.file import Optimisation, optimisation_of, read_optimisation
from ...model.optimise.settings import OptimiseSettings
from ...model.study.file import TRADEOFF_PICTURE
from ...report.wording.optimise import optimise_sentences
from ...studies.proposals import has_optuna
from ...studies.session import EnsembleSession
from ..scenario.prop import shown_tables
from ..scenario.ui import draw_tables
from ..scenario.values import scenario_of
from ..sidebar import SidebarPanel
from .panel import LoadEnsemble, OneValuePanel, OpenPicture, StartEnsemble, StopEnsemble, draw_own_keys, with_shared
from .session import WORKS, SentencesAndPicture, Work

_TABLES = {item.name: item for item in shown_tables(OptimiseSettings)}


def shown_result(session: EnsembleSession) -> SentencesAndPicture:
    """Return the texts and the picture of an optimisation that has ended."""
    return SentencesAndPicture.of(session, optimise_sentences(session.result()), TRADEOFF_PICTURE)


WORK = Work("optimise", "optimisation", OptimiseSettings, shown_result)
WORKS.append(WORK)


def shown_optimisation(settings: bpy.types.PropertyGroup) -> Optimisation:
    """Return the optimisation that the panels show, of the scenario that they show."""
    return optimisation_of(with_shared(settings, WORK), scenario_of(settings))


class BDA_OT_load_optimise(LoadEnsemble, bpy.types.Operator):
    """Show an optimisation file's values in the panels, with those of its scenario; nothing runs yet"""

    bl_label = "Load Optimisation"
    work, read = WORK, staticmethod(read_optimisation)


class BDA_OT_start_optimise(StartEnsemble, bpy.types.Operator):
    """Find the values that do best beside your work, and confirm them on fresh runs; goes on where the folder stands"""

    bl_label = "Start Optimisation"
    work, shown = WORK, staticmethod(shown_optimisation)

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if not has_optuna():
            return "An optimisation needs Optuna, which this Blender's Python does not have: use bda optimise instead"
        return super().disabled_reason(context)


class BDA_OT_stop_optimise(StopEnsemble, bpy.types.Operator):
    """Stop the optimisation; runs that are done are kept, and Start goes on with them"""

    bl_label = "Stop Optimisation"
    work = WORK


class BDA_OT_open_tradeoff(OpenPicture, bpy.types.Operator):
    """Open the picture of charge against debris distance of all candidates"""

    bl_label = "Open Trade-Off"
    work = WORK


class BDA_PT_optimise(OneValuePanel, bpy.types.Panel):
    """The charges, delays, positions or order of steps that do best, where the demolition has to succeed."""

    bl_label = "Optimise"
    work, picture = WORK, "bda.open_tradeoff"

    def draw_settings(self, context: bpy.types.Context) -> None:
        draw_own_keys(self, context)
        self.draw_criterion(self.layout, context.scene.bda)


def _list_panel(name: str, label: str) -> type[bpy.types.Panel]:
    """Return the sub-panel of a list of tables."""

    def draw(panel: bpy.types.Panel, context: bpy.types.Context) -> None:
        draw_tables(panel.layout, context, context.scene.bda.optimise, _TABLES[name])

    contents = {
        "__doc__": f"{label} that may change.",
        "bl_label": label,
        "bl_parent_id": "BDA_PT_optimise",
        "draw": draw,
    }
    return type(f"BDA_PT_optimise_{name}", (SidebarPanel, bpy.types.Panel), contents)


BDA_PT_optimise_quantities = _list_panel("quantities", "Quantities")
BDA_PT_optimise_places = _list_panel("places", "Positions")
BDA_PT_optimise_orders = _list_panel("orders", "Orders")
BDA_PT_optimise_choices = _list_panel("choices", "Choices")
