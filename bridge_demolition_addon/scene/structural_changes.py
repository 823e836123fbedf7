"""Changes to the structure and loads on it, kept with the scene until a recording applies them."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..model.scenario import Change, Load, Removal, SawCut, Weakening
from ..model.scenario.kept import tables_from_text, tables_text
from .custom_properties import keep

_CHANGES, _LOADS = "bda_changes", "bda_loads"


def keep_changes(scene: bpy.types.Scene, changes: Sequence[Change]) -> None:
    """Keep changes in the scene, and so in its file; a recording of the scene applies them."""
    keep(scene, _CHANGES, tables_text(changes) if changes else None)


def keep_loads(scene: bpy.types.Scene, loads: Sequence[Load]) -> None:
    """Keep loads in the scene, and so in its file; a recording of the scene applies them."""
    keep(scene, _LOADS, tables_text(loads) if loads else None)


def changes_of(scene: bpy.types.Scene) -> tuple[Change, ...]:
    """Return the changes that a scene keeps."""
    classes: tuple[type[Change], ...] = (Removal, SawCut, Weakening)
    return tables_from_text(scene.get(_CHANGES, ""), classes)


def loads_of(scene: bpy.types.Scene) -> tuple[Load, ...]:
    """Return the loads that a scene keeps."""
    return tables_from_text(scene.get(_LOADS, ""), (Load,))
