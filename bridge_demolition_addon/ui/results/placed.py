"""Bodies that stay where they were recorded while a section or another run is drawn beside them.

Blender forgets the frames that it played with many a change, and would show the bridge as it was built beside a pile.
"""

from __future__ import annotations

import bpy

from ...simulation.blender_events import contours_of, shown_results


def follow_later(scene: bpy.types.Scene) -> None:
    """Place the bodies, or leave them to Blender, once it has finished its present drawing."""
    if shown_results(scene).stays_placed != _is_wanted(scene) and not bpy.app.timers.is_registered(follow):
        bpy.app.timers.register(follow, first_interval=0.0)


def unregister() -> None:
    """Leave all bodies to Blender."""
    if bpy.app.timers.is_registered(follow):
        bpy.app.timers.unregister(follow)
    for scene in bpy.data.scenes:
        shown_results(scene).stays_placed = False


def _is_wanted(scene: bpy.types.Scene) -> bool:
    settings = scene.bda
    return settings.show_section or bool(settings.compared_folder and settings.show_compared)


def follow() -> None:
    """Place the bodies of all scenes, or leave them to Blender, as their settings are now."""
    for scene in bpy.data.scenes:
        shown = shown_results(scene)
        if shown.stays_placed == _is_wanted(scene):
            continue
        shown.stays_placed = not shown.stays_placed
        if shown.stays_placed:
            contours_of(scene).refresh()
        elif not contours_of(scene).is_shown:
            shown.put_bodies_back()
