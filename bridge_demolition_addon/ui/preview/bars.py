"""Drawing the reinforcing bars of what is built, as lines in the 3D view: nothing of it gets into the file."""

from __future__ import annotations

from functools import lru_cache

import bpy
import numpy as np

from ...display.bridge_preview import bar_lines
from ...errors import DemolitionError, text_of
from ...model.bridge.preparation import prepared_members
from ...model.reinforcement.design import all_layers
from ...model.scenario.file import scenario_from_text
from ..view_drawing import ViewDrawing, draw_lines

_COLOUR = (0.85, 0.25, 0.2, 0.9)
_WIDTH_PX = 1.0


def shown_bars(settings: bpy.types.PropertyGroup) -> tuple[np.ndarray, str]:
    """Return the bars of what was built as lines (2 k, 3) float, m, and why they cannot be shown; empty where they can.

    They are where the bridge was built: they do not move with it.
    """
    if not settings.show_bars or not settings.built_scenario:
        return np.zeros((0, 3)), ""
    return _lines(settings.built_scenario)


@lru_cache(maxsize=2)
def _lines(text: str) -> tuple[np.ndarray, str]:
    try:
        scenario = scenario_from_text(text)
        members = prepared_members(scenario).members
        return bar_lines(all_layers(scenario, members), members), ""
    except (DemolitionError, OSError) as error:  # said in the panel: files of the scenario may be gone
        return np.zeros((0, 3)), text_of(error)


def _draw(context: bpy.types.Context) -> None:
    if not context.screen.is_animation_playing:
        lines, _ = shown_bars(context.scene.bda)
        draw_lines(context, lines, _COLOUR, _WIDTH_PX)


drawing = ViewDrawing(_draw, forget=_lines.cache_clear)
