"""Finding the Bullet world of a scene, its bodies and its constraints; all is checked, and nothing is written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ..errors import LayoutError, SimulationError
from . import checks
from .layout import Layout
from .memory import read_pointer


@dataclass(frozen=True, slots=True, eq=False)
class EvaluatedCopies:
    """Copies of the connections that have the constraints, by a dependency graph at an address.

    `rows` has the connection of each copy by its address.
    """

    depsgraph: int
    rows: dict[int, int]

    def edited_rows(self, scene: bpy.types.Scene) -> np.ndarray:
        """Return the connections (k,) whose copies the coming update replaces, or frees as their collection is hidden.

        An update is known by the copy: the original may be deleted by now.
        """
        for depsgraph in (layer.depsgraph for layer in scene.view_layers):
            if not depsgraph or depsgraph.as_pointer() != self.depsgraph:
                continue
            constraints = scene.rigidbody_world.constraints
            if depsgraph.id_type_updated("SCENE") and not _is_shown(constraints, depsgraph.view_layer.layer_collection):
                return np.arange(len(self.rows))
            if depsgraph.id_type_updated("OBJECT"):
                rows = (self.rows.get(update.id.as_pointer()) for update in depsgraph.updates)
                return np.array([row for row in rows if row is not None], int)
        return np.empty(0, int)


def find_dynamics_world(layout: Layout, world: bpy.types.RigidBodyWorld | None) -> int:
    """Return the address of the btDiscreteDynamicsWorld, 0 while there is none."""
    if world is None:
        return 0
    checks.check_settings(layout, world)
    shared = read_pointer(world.as_pointer() + layout.blender.world_shared)
    holder = read_pointer(shared + layout.blender.shared_physics_world) if shared else 0
    if not holder:
        return 0
    # Blender 4.2 points at the physics world itself, later ones at a block whose first field points at it.
    inner = read_pointer(holder)
    if not inner:
        return 0
    for candidate in (holder, inner):
        if checks.is_physics_world(layout, candidate):
            return read_pointer(candidate)
    raise LayoutError("no Bullet world where Blender should keep it")


def find_bodies(
    layout: Layout, bodies: Sequence[bpy.types.Object], depsgraph: bpy.types.Depsgraph, to_read: bool
) -> np.ndarray:
    """Return Bullet's bodies (n,); 0 for one that is not simulated, where nothing is to be read."""
    holders = [_holder(layout, body) for body in bodies]
    if to_read and 0 in holders:
        name = bodies[holders.index(0)].name
        raise SimulationError(f"body {name!r} is not simulated: give it a mesh and a rigid body")
    addresses = [read_pointer(holder) if holder else 0 for holder in holders]
    simulated = [row for row in zip(bodies, holders, addresses, strict=True) if row[1]]
    if to_read:
        checks.check_bodies(layout, simulated, depsgraph)
    else:
        checks.check_owners(layout, simulated)
    return np.array(addresses, np.uint64)


def bodies_in_use(layout: Layout) -> set[int]:
    """Return the addresses of Bullet's bodies of all objects that there are now."""
    holders = (_holder(layout, body) for body in bpy.data.objects if body.rigid_body)
    return {read_pointer(holder) for holder in holders if holder}


def _holder(layout: Layout, body: bpy.types.Object) -> int:
    """Address of Blender's rbRigidBody, which points at Bullet's; 0 for a body that is not simulated."""
    shared = read_pointer(body.rigid_body.as_pointer() + layout.blender.body_shared)
    return read_pointer(shared) if shared else 0


def find_copies(
    scene: bpy.types.Scene, connections: Sequence[bpy.types.Object], depsgraph: bpy.types.Depsgraph
) -> tuple[Sequence[bpy.types.Object], EvaluatedCopies | None]:
    """Return the objects on which Blender notes the constraints of connections, and which of them are copies.

    It notes them on the objects that it finds in the collection of the world's constraints. Where that collection is
    not in the scene, as Blender's own buttons leave it, these are the connections themselves, which stay.
    """
    constraints = scene.rigidbody_world.constraints
    if not (constraints and constraints.evaluated_get(depsgraph).is_evaluated):
        return connections, None
    copies = [connection.evaluated_get(depsgraph) for connection in connections]
    rows = {copy.as_pointer(): row for row, copy in enumerate(copies)}
    return copies, EvaluatedCopies(depsgraph.as_pointer(), rows)


def find_constraints(
    layout: Layout,
    connections: Sequence[bpy.types.Object],
    holders: Sequence[bpy.types.Object],
    bodies: dict[bpy.types.Object, int],
    to_read: bool,
) -> np.ndarray:
    """Return Bullet's constraints (m,) of connections between bodies, noted on holders; 0 for one switched off."""
    offset = layout.blender.connection_physics
    addresses = [read_pointer(holder.rigid_body_constraint.as_pointer() + offset) for holder in holders]
    existing = [pair for pair in zip(connections, addresses, strict=True) if pair[1]]
    for connection, address in zip(connections, addresses, strict=True):
        if to_read and not address and connection.rigid_body_constraint.enabled:
            raise SimulationError(f"connection {connection.name!r} is not simulated: give it two bodies and show it")
    checks.check_connections(layout, existing, bodies, were_edited=not to_read)
    return np.array(addresses, np.uint64)


def _is_shown(collection: bpy.types.Collection, layer_collection: bpy.types.LayerCollection) -> bool:
    """Return whether a collection is in a part of a view layer, so that Blender evaluates what is in it."""
    if layer_collection.collection.hide_viewport:
        return False
    if layer_collection.collection == collection and not layer_collection.exclude:
        return True
    return any(_is_shown(collection, child) for child in layer_collection.children)
