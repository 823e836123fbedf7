"""Changes to the structure, kept with the scene until a recording applies them."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ..core.results.inventory import Inventory
from ..core.scenario import Change, Removal, SawCut, Weakening
from ..core.scenario.kept import tables_from_text, tables_text
from ..core.sequence.events import Event, recorded_structure, schedule

_CHANGES = "bda_changes"


def keep_changes(scene: bpy.types.Scene, changes: Sequence[Change]) -> None:
    """Keep changes in the scene, and so in its file; a recording of the scene applies them."""
    if changes:
        scene[_CHANGES] = tables_text(changes)
    elif _CHANGES in scene:
        del scene[_CHANGES]


def changes_of(scene: bpy.types.Scene) -> tuple[Change, ...]:
    """Return the changes that a scene keeps.

    Raises
    ------
    ScenarioError
        A kept text holds a value that no change can have.
    """
    return tables_from_text(scene.get(_CHANGES, ""), (Removal, SawCut, Weakening))


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
    centres = np.array([body.matrix_world.translation for body in bodies], float).reshape(-1, 3)
    return schedule(changes, recorded_structure(inventory, centres))
