"""Markers of the events of a run on the timeline; the user's own stay as they are."""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from ...model.scenario.kept import values_text
from ..custom_properties import keep, kept_values

_OURS = "bda_markers"
"""Property of a scene: frames and names of the add-on's markers, as markers have no properties."""

_LOCKED = "bda_markers_locked"
"""Property of a scene whose markers the add-on has locked."""


def mark_moments(scene: bpy.types.Scene, moments: Iterable[tuple[int, str]]) -> None:
    """Mark frames by name, in place of those of the run before.

    Where the user has no markers, they are locked: in a low timeline they cover the ruler, and a drag along it would
    move one of them.
    """
    clear_markers(scene)
    if not scene.timeline_markers and not scene.tool_settings.lock_markers:
        scene.tool_settings.lock_markers = scene[_LOCKED] = True
    made = [[frame, name] for frame, name in moments]
    for frame, name in made:
        scene.timeline_markers.new(name, frame=frame)
    scene[_OURS] = values_text(made)


def clear_markers(scene: bpy.types.Scene) -> None:
    """Remove the add-on's markers that are still where they were put."""
    ours = kept_values(scene, _OURS, [])
    for marker in list(scene.timeline_markers):
        if [marker.frame, marker.name] in ours:
            scene.timeline_markers.remove(marker)
    keep(scene, _OURS, None)
    if _LOCKED in scene:
        scene.tool_settings.lock_markers = False
        del scene[_LOCKED]
