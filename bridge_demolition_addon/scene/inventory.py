"""What is in a scene's rigid-body world: bodies and connections, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ..core.errors import SimulationError
from ..core.geometry.solids import volumes_and_centres
from .bodies import kind_of, member_of, triangulated
from .connections.constraints import sections_of


@dataclass(frozen=True, slots=True)
class Inventory:
    """The n bodies and m connections of a world, as they stand when its simulation begins.

    Attributes
    ----------
    body_names, body_kinds
        (n,) names, and kinds (shard, ball, ground, tool, crane).
    masses_kg, volumes_m3
        (n,) both 0 for a body that never moves.
    body_members, body_member_kinds
        (n,) name and kind of the member that each body is a piece of; empty where it is of none.
    vertices_m, vertex_counts
        (v, 3) vertices of all bodies, each in its own axes from its origin, and (n,) how many each body has.
    connection_names, pairs
        (m,) names and (m, 2) indices of the connected bodies.
    points_m, areas_m2, normals, second_moments_m4
        (m, 3) where the connections are, (m,) the areas they stand for, (m, 3) unit normals from first to second body,
        (m, 2, 2) second moments of these areas about the sections' y and z axes.
    """

    body_names: np.ndarray
    body_kinds: np.ndarray
    masses_kg: np.ndarray
    volumes_m3: np.ndarray
    body_members: np.ndarray
    body_member_kinds: np.ndarray
    vertices_m: np.ndarray
    vertex_counts: np.ndarray
    connection_names: np.ndarray
    pairs: np.ndarray
    points_m: np.ndarray
    areas_m2: np.ndarray
    normals: np.ndarray
    second_moments_m4: np.ndarray


def take_inventory(bodies: Sequence[bpy.types.Object], connections: Sequence[bpy.types.Object]) -> Inventory:
    """Read all that stays the same throughout a simulation.

    Raises
    ------
    SimulationError
        A connection lacks a body.
    """
    moves = np.array([body.rigid_body.type == "ACTIVE" for body in bodies], bool)
    pairs = _pairs(bodies, connections)
    areas, normals, second_moments = sections_of(connections)
    meshes = [triangulated(body) for body in bodies]
    members = np.array([member_of(body) for body in bodies], str).reshape(-1, 2)
    return Inventory(
        body_names=np.array([body.name for body in bodies]),
        body_kinds=np.array([kind_of(body).value for body in bodies]),
        masses_kg=np.where(moves, [body.rigid_body.mass for body in bodies], 0.0),
        volumes_m3=np.where(moves, _volumes(meshes), 0.0),
        body_members=members[:, 0],
        body_member_kinds=members[:, 1],
        vertices_m=np.concatenate([np.zeros((0, 3)), *(vertices for vertices, _ in meshes)]),
        vertex_counts=np.array([len(vertices) for vertices, _ in meshes], int),
        connection_names=np.array([connection.name for connection in connections]),
        pairs=pairs,
        points_m=np.array([each.matrix_world.translation for each in connections]).reshape(-1, 3),
        areas_m2=areas,
        normals=normals,
        second_moments_m4=second_moments,
    )


def _pairs(bodies: Sequence[bpy.types.Object], connections: Sequence[bpy.types.Object]) -> np.ndarray:
    index = {body: number for number, body in enumerate(bodies)}
    pairs = []
    for connection in connections:
        constraint = connection.rigid_body_constraint
        if constraint.object1 not in index or constraint.object2 not in index:
            raise SimulationError(
                f"connection {connection.name!r} lacks a body: give it two, or remove loose connections"
            )
        pairs.append((index[constraint.object1], index[constraint.object2]))
    return np.array(pairs, int).reshape(-1, 2)


def _volumes(meshes: Sequence[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    solid = [row for row, (_, triangles) in enumerate(meshes) if len(triangles)]
    volumes = np.zeros(len(meshes))
    volumes[solid] = abs(volumes_and_centres([meshes[row][0] for row in solid], [meshes[row][1] for row in solid])[0])
    return volumes
