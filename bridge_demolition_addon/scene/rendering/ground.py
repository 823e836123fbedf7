"""The ground of a scene as it is looked at: what is laid on it follows it, and what the mouse is over lies on it."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Vector

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import transformed
from ...engineering.terrain.recorded import NamedSurface, RecordedGround
from ...engineering.terrain.surface import Surface
from ..bodies import bodies_of, is_uneven_ground, member_of, triangle_mesh


def ground_of(scene: bpy.types.Scene) -> RecordedGround:
    """Return the ground that was built in a scene, where it lies now."""
    world, terrain, surfaces = scene.rigidbody_world, None, []
    for body in bodies_of(scene) if world and world.collection else []:
        if not is_uneven_ground(body):
            continue
        mesh, matrix = triangle_mesh(body.data), np.array(body.matrix_world, float)
        surface = Surface(TriangleMesh(transformed(matrix[:3, :3], mesh.vertices) + matrix[:3, 3], mesh.triangles))
        name, kind = member_of(body)
        if name:
            surfaces.append(NamedSurface(name, kind, surface))
        else:
            terrain = surface
    return RecordedGround(terrain, tuple(surfaces))


def terrain_under(scene: bpy.types.Scene, eye: Vector, ray: Vector) -> Vector | None:
    """Return where a ray meets the terrain of a scene, or a surface on it; None where it meets none."""
    world = scene.rigidbody_world
    places = []
    for body in bodies_of(scene) if world and world.collection else []:
        if not is_uneven_ground(body) or not body.visible_get():
            continue
        back = body.matrix_world.inverted_safe()
        met, place, _, _ = body.ray_cast(back @ eye, back.to_3x3() @ ray)
        if met:
            places.append(body.matrix_world @ place)
    return min(places, key=lambda place: (place - eye).length, default=None)
