"""Changes to the structure and loads on it, kept with the scene until a recording applies them."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ..engineering.geometry.vectors import transformed
from ..model.results.inventory import Inventory
from ..model.scenario import Change, Load, Removal, SawCut, Weakening
from ..model.scenario.kept import tables_from_text, tables_text
from ..model.schema import Table
from ..model.sequence.events import Event, recorded_structure, schedule
from ..model.sequence.loads import PlacedLoad, placed_loads

_CHANGES, _LOADS = "bda_changes", "bda_loads"


def keep_changes(scene: bpy.types.Scene, changes: Sequence[Change]) -> None:
    """Keep changes in the scene, and so in its file; a recording of the scene applies them."""
    _keep(scene, _CHANGES, changes)


def keep_loads(scene: bpy.types.Scene, loads: Sequence[Load]) -> None:
    """Keep loads in the scene, and so in its file; a recording of the scene applies them."""
    _keep(scene, _LOADS, loads)


def _keep(scene: bpy.types.Scene, name: str, tables: Sequence[Table]) -> None:
    if tables:
        scene[name] = tables_text(tables)
    elif name in scene:
        del scene[name]


def changes_of(scene: bpy.types.Scene) -> tuple[Change, ...]:
    """Return the changes that a scene keeps.

    Raises
    ------
    ScenarioError
        A kept text holds a value that no change can have.
    """
    return tables_from_text(scene.get(_CHANGES, ""), (Removal, SawCut, Weakening))


def loads_of(scene: bpy.types.Scene) -> tuple[Load, ...]:
    """Return the loads that a scene keeps.

    Raises
    ------
    ScenarioError
        A kept text holds a value that no load can have.
    """
    return tables_from_text(scene.get(_LOADS, ""), (Load,))


def events_of(scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], inventory: Inventory) -> tuple[Event, ...]:
    """Return the scene's changes as events on its bodies and connections, in order of time.

    Raises
    ------
    ScenarioError
        A change concerns nothing in the scene.
    """
    changes = changes_of(scene)
    if not changes:
        return ()
    return schedule(changes, recorded_structure(inventory, _centres(bodies)))


def placed_loads_of(
    scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], inventory: Inventory
) -> tuple[PlacedLoad, ...]:
    """Return the scene's loads on its bodies.

    Raises
    ------
    ScenarioError
        Nothing in the scene bears one of them.
    """
    loads = loads_of(scene)
    if not loads:
        return ()
    matrices = np.array([body.matrix_world for body in bodies], float)
    corners = np.array([body.bound_box for body in bodies], float)
    corners = transformed(matrices[:, None, :3, :3], corners) + matrices[:, None, :3, 3]
    boxes_m = np.stack((corners.min(axis=1), corners.max(axis=1)), axis=1)
    return placed_loads(loads, recorded_structure(inventory, _centres(bodies)), inventory.masses_kg, boxes_m)


def _centres(bodies: Sequence[bpy.types.Object]) -> np.ndarray:
    return np.array([body.matrix_world.translation for body in bodies], float).reshape(-1, 3)
