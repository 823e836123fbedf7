"""A search in the sidebar: its buttons and its panel."""

from __future__ import annotations

import bpy

from ...errors import ScenarioError
from ...model.search.file import Search, read_search, search_of
from ...model.search.settings import SearchSettings
from ...model.study.file import CURVE_PICTURE
from ...report.wording.search import search_sentences
from ...studies.session import EnsembleSession
from ..scenario.values import scenario_of
from .panel import (
    ANOTHER_KEY,
    CHARGES,
    KEYS,
    LoadEnsemble,
    OneValuePanel,
    OpenPicture,
    StartEnsemble,
    StopEnsemble,
    draw_own_keys,
    with_shared,
)
from .session import WORKS, SentencesAndPicture, Work

_QUANTITY = ("key", "factor", "logarithmic")
"""Keys that a quantity of the menu sets."""


def shown_result(session: EnsembleSession) -> SentencesAndPicture:
    """Return the texts and the picture of a search that has ended."""
    return SentencesAndPicture.of(session, search_sentences(session.result()), CURVE_PICTURE)


WORK = Work("search", "search", SearchSettings, shown_result)
WORKS.append(WORK)


def shown_search(settings: bpy.types.PropertyGroup) -> Search:
    """Return the search that the panels show, of the scenario that they show."""
    scenario, quantity = scenario_of(settings), settings.search_quantity
    of_quantity = {}
    if quantity != ANOTHER_KEY:
        of_quantity = {"key": KEYS[quantity], "factor": quantity == CHARGES, "logarithmic": True}
    search = with_shared(settings, WORK, **of_quantity)
    if search.key == KEYS[CHARGES] and not (scenario.charges and scenario.blast.explosion):
        raise ScenarioError("the scenario has no charges that go off: add some, or choose another quantity")
    return search_of(search, scenario)


class BDA_OT_load_search(LoadEnsemble, bpy.types.Operator):
    """Show a search file's values in the panels, with those of its scenario; nothing runs yet"""

    bl_label = "Load Search"
    work, read = WORK, staticmethod(read_search)

    def act(self, context: bpy.types.Context) -> str:
        loaded = super().act(context)
        context.scene.bda.search_quantity = ANOTHER_KEY
        return loaded


class BDA_OT_start_search(StartEnsemble, bpy.types.Operator):
    """Find the value that succeeds as often as it has to"""

    bl_label = "Find Smallest Charge"
    bl_description = (
        "Make runs of the scenario in the panels beside your work, with what varies in the panel Study, and find the "
        "value that succeeds as often as it has to; goes on where the folder stands, also with more runs than before"
    )
    work, shown = WORK, staticmethod(shown_search)


class BDA_OT_stop_search(StopEnsemble, bpy.types.Operator):
    """Stop the search; runs that are done are kept, and Start goes on with them"""

    bl_label = "Stop Search"
    work = WORK


class BDA_OT_open_search_curve(OpenPicture, bpy.types.Operator):
    """Open the picture of all runs, and of the probability of success over the quantity"""

    bl_label = "Open Curve"
    work = WORK


class BDA_PT_search(OneValuePanel, bpy.types.Panel):
    """The smallest charge, ball or drop with which the demolition succeeds as often as it has to."""

    bl_label = "Search"
    work, picture = WORK, "bda.open_search_curve"

    def draw_settings(self, context: bpy.types.Context) -> None:
        settings = context.scene.bda
        self.layout.prop(settings, "search_quantity")
        draw_own_keys(self, context, without=() if settings.search_quantity == ANOTHER_KEY else _QUANTITY)
        self.draw_criterion(self.layout, settings)
