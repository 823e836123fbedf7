"""Redrawing the sidebar while a recording runs: by itself Blender leaves it alone as long as the timeline plays."""

import bpy

from ...simulation.blender_events import running_recording

_INTERVAL_S = 0.25


def follow_recording() -> None:
    """Redraw the sidebars from now on, for as long as a recording runs."""
    if not bpy.app.timers.is_registered(_redraw):
        bpy.app.timers.register(_redraw, persistent=True)


def unregister() -> None:
    """Leave them alone."""
    if bpy.app.timers.is_registered(_redraw):
        bpy.app.timers.unregister(_redraw)


def _redraw() -> float | None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if area.type == "VIEW_3D" and region.type == "UI":
                    region.tag_redraw()
    return _INTERVAL_S if running_recording() else None
