"""The workspace BDA: the bridge with its sidebar, charts at its side and the timeline below, made by one button."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import bpy

from ..errors import SimulationError
from .chart_pictures import EDITOR, chart_of, pictures_of, show_in
from .operators import Action
from .sidebar import SidebarPanel
from .viewport import region_of

NAME = "BDA"
_MADE = "bda_is_made"
"""Property of the workspace that was made here: a user's own may have the same name."""

_LEAST_AREAS = 3
_LOOK_EVERY_S = 0.05

_LOOKS = 200
"""Attempts to open the tab: Blender before 4.3 never lets an add-on do so."""

_asked_for: list[str] = []
"""Name of the workspace to show: Blender shows it only when the button has ended."""

_openings: list[partial] = []
"""The timer that opens the tab, if one does."""

_LARGEST, _BESIDE, _BELOW = "VIEW_3D", EDITOR, "TIMELINE"


def _no_window(context: bpy.types.Context) -> str | None:
    return None if context.window else "There is no window to make a workspace in"


class BDA_OT_make_workspace(Action, bpy.types.Operator):
    """Go to the workspace BDA, made if there is none: bridge, timeline, and charts and pictures of the run"""

    bl_label = "BDA Workspace"
    blocked_by = (_no_window,)

    def act(self, context: bpy.types.Context) -> None:
        workspace = made_workspace() or _copy_of_shown(context)
        _asked_for[:] = [workspace.name]
        context.window.workspace = workspace
        if not bpy.app.timers.is_registered(_arrange_when_shown):
            bpy.app.timers.register(_arrange_when_shown, first_interval=_LOOK_EVERY_S)


def made_workspace() -> bpy.types.WorkSpace | None:
    """Return the workspace that was made before, None where there is none in this file."""
    return next((workspace for workspace in bpy.data.workspaces if workspace.get(_MADE)), None)


def arrange(screen: bpy.types.Screen) -> None:
    """Make editors of a screen that is shown those for bridge, timeline and charts: Blender changes no others.

    The largest is for the bridge, the widest of the others for the timeline.
    """
    largest, *others = sorted(screen.areas, key=_size, reverse=True)
    below = max(others, key=lambda area: area.width / area.height)
    beside = max((other for other in others if other != below), key=_size)
    for area, kind in ((largest, _LARGEST), (below, _BELOW), (beside, _BESIDE)):
        if area.ui_type != kind:
            area.ui_type = kind
    view = largest.spaces.active
    view.show_region_ui, view.show_region_toolbar = True, False  # the tools would cover the colour bar's side


def open_tab(screen: bpy.types.Screen) -> bool:
    """Open the tab of the add-on in the sidebar, and return whether it could be: Blender has to have drawn it."""
    views = (area for area in screen.areas if area.type == _LARGEST)
    area = max(views, key=lambda view: view.width, default=None)
    sidebar = area and region_of(area, "UI")
    if not sidebar or sidebar.is_property_readonly("active_panel_category"):
        return False
    sidebar.active_panel_category = SidebarPanel.bl_category
    area.tag_redraw()
    return True


def show_chart(window: bpy.types.Window) -> None:
    """Show the chart of forces in the editor of charts, or another picture of the shown run, if it has one."""
    pictures = pictures_of(window.scene)
    path = chart_of(window.scene) or next(iter(pictures), None)
    if path is not None:
        show_in(window, path)


def show_new_chart() -> None:
    """Show the chart of a run that has just ended in the workspace BDA, if a window shows that."""
    for window in bpy.context.window_manager.windows:
        if window.workspace.get(_MADE):
            show_chart(window)


def _size(area: bpy.types.Area) -> int:
    return area.width * area.height


def unregister() -> None:
    """Arrange nothing any more."""
    _asked_for.clear()
    for timer in (_arrange_when_shown, *_openings):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    _openings.clear()


def _copy_of_shown(context: bpy.types.Context) -> bpy.types.WorkSpace:
    if len(context.window.screen.areas) < _LEAST_AREAS:
        raise SimulationError("this workspace has less than three editors: go to Layout first")
    before = set(bpy.data.workspaces)
    bpy.ops.workspace.duplicate()
    (workspace,) = set(bpy.data.workspaces) - before
    workspace.name, workspace[_MADE] = NAME, True
    return workspace


def _arrange_when_shown() -> float | None:
    """Arrange the workspace that was asked for, once a window shows it; called by Blender's timer."""
    workspace = made_workspace()
    if not _asked_for or workspace is None or workspace.name != _asked_for[0]:
        return None
    window = next((shown for shown in bpy.context.window_manager.windows if shown.workspace == workspace), None)
    if window is None:
        return _LOOK_EVERY_S
    _asked_for.clear()
    if len(window.screen.areas) >= _LEAST_AREAS:  # a user who joined some has made it their own
        arrange(window.screen)
    show_chart(window)
    _openings[:] = [partial(_open_tab_when_drawn, window.screen.name, iter(range(_LOOKS)))]
    bpy.app.timers.register(_openings[0])
    return None


def _open_tab_when_drawn(screen: str, looks: Iterator[int]) -> float | None:
    """Open the tab as soon as that is possible, if it ever is."""
    shown = bpy.data.screens.get(screen)
    return None if shown is None or next(looks, None) is None or open_tab(shown) else _LOOK_EVERY_S
