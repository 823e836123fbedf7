"""Finding the Bullet world of a scene, its bodies and its constraints. All is checked, and nothing is written."""

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
    """Copies of the connections that have the constraints.

    Attributes
    ----------
    depsgraph
        Address of the dependency graph that made them.
    rows
        Which connection each copy is of, by its address.
    """

    depsgraph: int
    rows: dict[int, int]

    def edited_rows(self, scene: bpy.types.Scene) -> np.ndarray:
        """Rows (k,) of the connections whose copies the coming update replaces, or frees as their collection is hidden.

        What waits for an update is known by its copy: the original may be deleted by now.
        """
        depsgraphs = (layer.depsgraph for layer in scene.view_layers)
        depsgraph = next((each for each in depsgraphs if each and each.as_pointer() == self.depsgraph), None)
        if depsgraph is None:
            return np.empty(0, int)
        constraints = scene.rigidbody_world.constraints
        if depsgraph.id_type_updated("SCENE") and not _is_shown(constraints, depsgraph.view_layer.layer_collection):
            return np.arange(len(self.rows))
        if not depsgraph.id_type_updated("OBJECT"):
            return np.empty(0, int)
        rows = (self.rows.get(update.id.as_pointer()) for update in depsgraph.updates)
        return np.array([row for row in rows if row is not None], int)


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
    holders, addresses = [], []
    for body in bodies:
        shared = read_pointer(body.rigid_body.as_pointer() + layout.blender.body_shared)
        holder = read_pointer(shared) if shared else 0
        if to_read and not holder:
            raise SimulationError(f"body {body.name!r} is not simulated: give it a mesh and a rigid body")
        holders.append(holder)
        addresses.append(read_pointer(holder) if holder else 0)
    simulated = [row for row in zip(bodies, holders, addresses, strict=True) if row[1]]
    if to_read:
        checks.check_bodies(layout, simulated, depsgraph)
    else:
        checks.check_owners(layout, simulated)
    return np.array(addresses, np.uint64)


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
