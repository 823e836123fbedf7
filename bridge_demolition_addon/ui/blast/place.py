"""Where a new charge is put in a scene: at a pier of what is built, or else of what the panels show."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

import bpy
import numpy as np

from ...engineering.geometry.mesh import TriangleMesh, joined_meshes
from ...errors import DemolitionError
from ...model.blast.new_charge import is_on_bridge, place_at_pier
from ...model.bridge.member import Member
from ...model.bridge.mesh_files import placed_mesh
from ...model.bridge.own_axes import is_standing
from ...model.bridge.parametric import bridge_members
from ...scene.bodies import Kind, bodies_of, kind_of, member_of, scaled_mesh
from ..preview.decorator import sizes_shown


def place_of_new(scene: bpy.types.Scene) -> tuple[float, float, float] | None:
    """Return where a new charge is put at a pier, m; None where the 3D cursor is on the bridge, or there is no pier."""
    cursor_m = np.array(scene.cursor.location, float)
    pieces = _built(scene) or _shown(scene)
    boxes_m = [np.array((piece.solid.vertices.min(axis=0), piece.solid.vertices.max(axis=0))) for piece in pieces]
    if (
        cursor_m.any() and boxes_m and is_on_bridge(cursor_m, np.stack(boxes_m))
    ):  # it starts at the origin, where the user has not put it
        return None
    return place_at_pier([member.solid for member in _whole(pieces) if is_standing(member)], cursor_m)


def _built(scene: bpy.types.Scene) -> list[Member]:
    """Return each shard where it was built, as a piece of its member."""
    shards = [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]
    return [Member(*member_of(shard), _placed(shard)) for shard in shards]


def _placed(shard: bpy.types.Object) -> TriangleMesh:
    """Return the triangles of a shard at its own position: the simulation moves it elsewhere, and not that."""
    mesh = scaled_mesh(shard)
    return TriangleMesh(mesh.vertices + np.array(shard.matrix_basis.translation), mesh.triangles)


def _shown(scene: bpy.types.Scene) -> list[Member]:
    """Return the members that the panels show; none of those that cannot be built."""
    bridge, _, own = sizes_shown(scene.bda)
    try:
        of_bridge = bridge_members(replace(bridge, merge=False)) if bridge and not own else ()
        return [*of_bridge, *(Member(table.name, table.kind, placed_mesh(table)) for table in own)]
    except (DemolitionError, ValueError):  # Build Scenario says why
        return []


def _whole(pieces: Sequence[Member]) -> list[Member]:
    """Return members put together of their pieces."""
    solids = defaultdict(list)
    for piece in pieces:
        solids[piece.name, piece.kind].append(piece.solid)
    return [Member(name, kind, joined_meshes(parts)) for (name, kind), parts in solids.items()]
