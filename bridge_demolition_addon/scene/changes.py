"""Changes to the structure in the course of time, kept with the scene, and the members that they name."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict

import bpy
import numpy as np

from ..core.events import Event, Structure, schedule
from ..core.scenario import Change, Removal, SawCut, Weakening
from .bodies import Kind, kind_of
from .inventory import Inventory

_CHANGES = "bda_changes"
_MEMBER = "bda_member"
_MEMBER_KIND = "bda_member_kind"
_TABLES = {each.table: each for each in (Removal, SawCut, Weakening)}


def keep_changes(scene: bpy.types.Scene, changes: Sequence[Change]) -> None:
    """Note changes in the scene, which is saved with it; a recording of the scene makes them happen."""
    if changes:
        scene[_CHANGES] = json.dumps([{"table": each.table, **asdict(each)} for each in changes])
    elif _CHANGES in scene:
        del scene[_CHANGES]


def changes_of(scene: bpy.types.Scene) -> tuple[Change, ...]:
    """Changes that were noted in a scene.

    Raises
    ------
    ScenarioError
        A note holds a value that no change can have.
    """
    notes = json.loads(scene.get(_CHANGES, "[]"))
    return tuple(
        _TABLES[note["table"]](**{name: value for name, value in note.items() if name != "table"}) for note in notes
    )


def mark_member(body: bpy.types.Object, name: str, kind: str) -> None:
    """Note on a body the member that it is a part of."""
    body[_MEMBER], body[_MEMBER_KIND] = name, kind


def events_of(scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], inventory: Inventory) -> tuple[Event, ...]:
    """The scene's changes as events on its bodies and connections, in order of time.

    Raises
    ------
    ScenarioError
        A change concerns nothing in the scene.
    """
    changes = changes_of(scene)
    if not changes:
        return ()
    structure = Structure(
        centres_m=np.array([body.matrix_world.translation for body in bodies]).reshape(-1, 3),
        member_names=np.array([body.get(_MEMBER, "") for body in bodies]),
        member_kinds=np.array([body.get(_MEMBER_KIND, "") for body in bodies]),
        is_shard=np.array([kind_of(body) is Kind.SHARD and body.rigid_body.type == "ACTIVE" for body in bodies], bool),
        pairs=inventory.pairs,
        points_m=inventory.points_m,
    )
    return schedule(changes, structure)
