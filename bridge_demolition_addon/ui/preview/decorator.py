"""Drawing what the panels would build, as outlines in the 3D view: nothing of it gets into the file."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import bpy
import numpy as np

from ...display.bridge_preview import outline, sharp_edges
from ...errors import DemolitionError
from ...model.bridge.mesh_files import placed_mesh
from ...model.scenario import Ball, Bridge, Geometry, Scenario
from ...model.scenario.file import scenario_from_text
from ..scenario.prop import shown_tables
from ..scenario.values import inner_of
from ..sidebar import SidebarPanel
from ..view_drawing import ViewDrawing, draw_lines
from . import zone_handles

_COLOUR = (0.45, 0.85, 1.0, 0.9)
_WIDTH_PX = 1.5

_FIELDS = {item.name: item for item in shown_tables(Scenario) if item.name in ("bridge", "ball", "geometry")}

Sizes = tuple[Bridge | None, Ball | None, tuple[Geometry, ...]]
"""Bridge, ball, and members of the user's own."""


def is_wanted(context: bpy.types.Context) -> bool:
    """Return whether a preview and its handles are shown: while the tab is open, and nothing plays."""
    return is_wanted_in(context.scene, context.screen)


def is_wanted_in(scene: bpy.types.Scene, screen: bpy.types.Screen) -> bool:
    """Return whether previews are shown of a scene on a screen."""
    return scene.bda.show_preview and not screen.is_animation_playing and _tab_is_open(screen)


def preview_lines(settings: bpy.types.PropertyGroup) -> np.ndarray:
    """Return what the panels would build as lines (2 k, 3) float, m; none where it is built."""
    sizes = bridge, ball, own = sizes_shown(settings)
    if settings.built_scenario and sizes == _sizes_of(settings.built_scenario):
        return np.zeros((0, 3))
    return np.concatenate([_lines(bridge, ball, not own), *(_own_lines(table, _written_ns(table)) for table in own)])


def sizes_shown(settings: bpy.types.PropertyGroup) -> Sizes:
    """Return bridge, ball and members of the user's own as the panels show them."""
    group = settings.scenario
    bridge, ball, own = (inner_of(group, _FIELDS[name]) for name in ("bridge", "ball", "geometry"))
    return bridge, ball, own


@lru_cache(maxsize=4)
def _sizes_of(text: str) -> Sizes:
    built = scenario_from_text(text)
    return built.bridge, built.ball, built.geometry


@lru_cache(maxsize=64)
def _own_lines(table: Geometry, _written_ns: int) -> np.ndarray:
    """Lines of a member of the user's own; none of a mesh that cannot be built: Build Scenario says why."""
    try:
        return sharp_edges(placed_mesh(table))
    except (DemolitionError, ValueError):
        return np.zeros((0, 3))


def _written_ns(table: Geometry) -> int:
    """When the file of a member was written last; 0 where there is none."""
    path = Path(table.file)
    return path.stat().st_mtime_ns if path.is_file() else 0


@lru_cache(maxsize=4)
def _lines(bridge: Bridge | None, ball: Ball | None, is_all: bool) -> np.ndarray:
    return outline(bridge, ball, is_all=is_all)


def _tab_is_open(screen: bpy.types.Screen) -> bool:
    sidebars = (
        region
        for area in screen.areas
        if area.type == "VIEW_3D"
        for region in area.regions
        if region.type == "UI" and region.width > 1
    )
    return any(sidebar.active_panel_category == SidebarPanel.bl_category for sidebar in sidebars)


def _draw(context: bpy.types.Context) -> None:
    if is_wanted(context):
        draw_lines(context, preview_lines(context.scene.bda), _COLOUR, _WIDTH_PX)


def _forget() -> None:
    _lines.cache_clear()
    _own_lines.cache_clear()
    _sizes_of.cache_clear()
    zone_handles.forget()


drawing = ViewDrawing(_draw, forget=_forget)
