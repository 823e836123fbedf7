"""Changes to the structure and loads on it, kept with the scene until a recording applies them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import bpy

from ..errors import ScenarioError
from ..model.scenario import (
    Change,
    LiftingAway,
    Load,
    Pull,
    Removal,
    SawCut,
    Severing,
    Sling,
    TendonCut,
    Weakening,
    ZoneFiring,
)
from ..model.scenario.kept import tables_from_text, tables_text
from .custom_properties import edited, keep

_CHANGES, _LOADS, _PULLS = "bda_changes", "bda_loads", "bda_pulls"

_Kept = TypeVar("_Kept", Change, Load, Pull)


def keep_changes(scene: bpy.types.Scene, changes: Sequence[Change]) -> None:
    """Keep changes in the scene, and so in its file; a recording of the scene applies them."""
    keep(scene, _CHANGES, tables_text(changes) if changes else None)


def keep_loads(scene: bpy.types.Scene, loads: Sequence[Load]) -> None:
    """Keep loads in the scene, and so in its file; a recording of the scene applies them."""
    keep(scene, _LOADS, tables_text(loads) if loads else None)


def keep_pulls(scene: bpy.types.Scene, pulls: Sequence[Pull]) -> None:
    """Keep cables and slings in the scene, and so in its file; a recording of the scene pulls by them."""
    keep(scene, _PULLS, tables_text(pulls) if pulls else None)


def changes_of(scene: bpy.types.Scene) -> tuple[Change, ...]:
    """Return the changes that a scene keeps."""
    classes: tuple[type[Change], ...] = (
        LiftingAway,
        Removal,
        SawCut,
        Severing,
        TendonCut,
        Weakening,
        ZoneFiring,
    )
    return _kept_tables(scene, _CHANGES, classes)


def loads_of(scene: bpy.types.Scene) -> tuple[Load, ...]:
    """Return the loads that a scene keeps."""
    return _kept_tables(scene, _LOADS, (Load,))


def pulls_of(scene: bpy.types.Scene) -> tuple[Pull, ...]:
    """Return the cables and the slings that a scene keeps."""
    classes: tuple[type[Pull], ...] = (Pull, Sling)
    return _kept_tables(scene, _PULLS, classes)


def _kept_tables(scene: bpy.types.Scene, name: str, classes: Sequence[type[_Kept]]) -> tuple[_Kept, ...]:
    try:
        return tables_from_text(scene.get(name, ""), classes)
    except ScenarioError as error:
        raise edited(scene, name, f"the text that the add-on wrote ({error})") from error
