"""Tables by which a run does what is planned, kept with the scene until a recording applies them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy

from ..errors import ScenarioError
from ..model.actions import PlannedAction
from ..model.scenario.kept import tables_from_text, tables_text
from ..model.scenario.scenario import run_tables
from .custom_properties import edited, keep


def keep_run_tables(scene: bpy.types.Scene, tables: Sequence[PlannedAction]) -> None:
    """Keep tables in the scene, and so in its file, in place of those of before; a recording of it applies them."""
    for name in run_tables():
        keep_tables(scene, name, [table for table in tables if table.kept_in == name])


def keep_tables(scene: bpy.types.Scene, name: str, tables: Sequence[PlannedAction]) -> None:
    """Keep the tables of one name in place of those of before."""
    keep(scene, _property(name), tables_text(tables) if tables else None)


def run_tables_of(scene: bpy.types.Scene, name: str) -> tuple[Any, ...]:
    """Return the tables that a scene keeps under a name."""
    try:
        return tables_from_text(scene.get(_property(name), ""), run_tables()[name])
    except ScenarioError as error:
        raise edited(scene, _property(name), f"the text that the add-on wrote ({error})") from error


def _property(name: str) -> str:
    return f"bda_{name}"
