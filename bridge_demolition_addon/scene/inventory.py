"""The bodies and connections of a scene's rigid-body world, as results keep them."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, volumes_and_centres
from ..errors import SimulationError
from ..model.results.frames import Inventory
from .bodies import is_uneven_ground, kind_of, member_of, scaled_mesh
from .connections.constraints import sections_of


def take_inventory(bodies: Sequence[bpy.types.Object], connections: Sequence[bpy.types.Object]) -> Inventory:
    """Read all that stays the same throughout a simulation."""
    moves = np.array([body.rigid_body.type == "ACTIVE" for body in bodies], bool)
    pairs = _pairs(bodies, connections)  # first, as a section needs both bodies too
    areas, normals, second_moments = sections_of(connections)
    meshes = [scaled_mesh(body) for body in bodies]
    members = np.array([member_of(body) for body in bodies], str).reshape(-1, 2)
    uneven = [is_uneven_ground(body) for body in bodies]
    triangles = [mesh.triangles[: None if kept else 0] for mesh, kept in zip(meshes, uneven, strict=True)]
    has_triangles = any(map(len, triangles))
    return Inventory(
        body_names=np.array([body.name for body in bodies], str),
        body_kinds=np.array([kind_of(body).value for body in bodies]),
        masses_kg=np.where(moves, [body.rigid_body.mass for body in bodies], 0.0),
        volumes_m3=np.where(moves, _volumes(meshes), 0.0),
        body_members=members[:, 0],
        body_member_kinds=members[:, 1],
        vertices_m=np.concatenate([np.zeros((0, 3)), *(mesh.vertices for mesh in meshes)]),
        vertex_counts=np.array([len(mesh.vertices) for mesh in meshes], int),
        connection_names=np.array([connection.name for connection in connections], str),
        pairs=pairs,
        points_m=np.array([empty.matrix_world.translation for empty in connections], float).reshape(-1, 3),
        areas_m2=areas,
        normals=normals,
        second_moments_m4=second_moments,
        triangles=np.concatenate(triangles).astype(int) if has_triangles else None,
        triangle_counts=np.array([len(triangle) for triangle in triangles], int) if has_triangles else None,
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


def _volumes(meshes: Sequence[TriangleMesh]) -> np.ndarray:
    solid = [row for row, mesh in enumerate(meshes) if len(mesh.triangles)]
    volumes = np.zeros(len(meshes))
    volumes[solid] = abs(volumes_and_centres([meshes[row] for row in solid])[0])
    return volumes
