"""Rigid bodies of a demolition: shards, the ball and the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from enum import StrEnum
from typing import Any

import bpy
import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..model.scenario import Ground, GroundSurface, ShardSettings
from ..model.scenario.kept import values_from_text, values_text
from ..model.terrain.built import TerrainFacts
from .naming import make_named, numbered_names

_KIND = "bda_kind"
_MEMBER = "bda_member"
_TERRAIN = "bda_terrain"
_MEMBER_KIND = "bda_member_kind"
_GROUND_THICKNESS_M = 2.0

_CONCRETE = (0.80, 0.78, 0.73)
SOIL = (0.45, 0.39, 0.26, 1.0)
_SURFACE_COLOURS = {
    "water": (0.16, 0.30, 0.38, 1.0),
    "carriageway": (0.12, 0.12, 0.13, 1.0),
    "railway": (0.25, 0.22, 0.20, 1.0),
}
_SHADES = (1.0, 0.94, 0.88, 0.97, 0.91)


class Kind(StrEnum):
    """What a rigid body stands for."""

    SHARD = "shard"
    BALL = "ball"
    GROUND = "ground"
    TOOL = "tool"
    CRANE = "crane"


_KINDS = tuple(Kind)


def kind_of(body: bpy.types.Object) -> Kind:
    """Return what a body stands for; one without a mark is a shard where it can move, and ground where it cannot."""
    if (mark := body.get(_KIND)) in _KINDS:
        return Kind(mark)
    return Kind.SHARD if body.rigid_body.type == "ACTIVE" else Kind.GROUND


def member_of(body: bpy.types.Object) -> tuple[str, str]:
    """Return name and kind of the member that a body is a piece of, both empty where it is of none."""
    return str(body.get(_MEMBER, "")), str(body.get(_MEMBER_KIND, ""))


def mark_member(body: bpy.types.Object, name: str, kind: str) -> None:
    """Mark a body with the member that it is a piece of."""
    body[_MEMBER], body[_MEMBER_KIND] = name, kind


def is_marked(body: bpy.types.Object) -> bool:
    """Return whether the add-on made a body."""
    return _KIND in body


def bodies_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return all mesh objects that take part in the scene's rigid-body world."""
    return [body for body in scene.rigidbody_world.collection.all_objects if body.type == "MESH" and body.rigid_body]


def lacks_ground(scene: bpy.types.Scene) -> bool:
    """Return whether a scene has shards that were built here, and no ground under them, nor any of the user's own."""
    bodies = bodies_of(scene)
    has_ours = any(is_marked(body) and kind_of(body) == Kind.SHARD for body in bodies)
    return has_ours and all(kind_of(body) != Kind.GROUND for body in bodies)


def scaled_mesh(body: bpy.types.Object) -> TriangleMesh:
    """Return a body's triangles, scaled as it is, from its origin, which Bullet takes for its centre of mass."""
    mesh = triangle_mesh(body.data)
    return TriangleMesh(mesh.vertices * np.array(body.matrix_world.to_scale(), float), mesh.triangles)


def triangle_mesh(mesh: bpy.types.Mesh) -> TriangleMesh:
    """Return the triangles of a mesh, in its own axes."""
    mesh.calc_loop_triangles()
    vertices = np.empty(3 * len(mesh.vertices), np.float32)
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.vertices.foreach_get("co", vertices)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return TriangleMesh(vertices.reshape(-1, 3).astype(float), triangles.reshape(-1, 3))


def create_shards(
    collection: bpy.types.Collection,
    settings: ShardSettings,
    shards: Sequence[TriangleMesh],
    centres_m: np.ndarray,
    masses_kg: np.ndarray,
) -> list[bpy.types.Object]:
    """Make an active body for each shard, its origin at its centre of mass.

    Parameters
    ----------
    collection : bpy.types.Collection
        Where the bodies go: that of a rigid-body world, best while `off_scene`.
    settings : ShardSettings
        Surface, damping and rest of all of them.
    shards : sequence of length n
        Their meshes.
    centres_m, masses_kg : (n, 3) float, (n,) float
        Their centres of mass and masses.
    """
    names = numbered_names("Shard", len(shards), bpy.data.objects, bpy.data.meshes)
    meshes = make_named(bpy.data.meshes, names, lambda name, _: bpy.data.meshes.new(name))
    bodies = make_named(bpy.data.objects, names, lambda name, row: bpy.data.objects.new(name, meshes[row]))
    columns = zip(bodies, shards, centres_m, masses_kg.tolist(), strict=True)
    for number, (body, shard, centre, mass) in enumerate(columns):
        body.data.from_pydata(shard.vertices - centre, [], shard.triangles.tolist())
        body.location = centre
        body.color = (*(channel * _SHADES[number % len(_SHADES)] for channel in _CONCRETE), 1.0)
        body[_KIND] = Kind.SHARD.value
        collection.objects.link(body)
        body.rigid_body.mass = mass
        _set_shard(body.rigid_body, settings)
    return bodies


def _set_shard(rigid: bpy.types.RigidBodyObject, settings: ShardSettings) -> None:
    rigid.collision_shape = "CONVEX_HULL"
    set_surface(rigid, settings.friction, settings.restitution, settings.collision_margin_m)
    rigid.linear_damping = settings.linear_damping
    rigid.angular_damping = settings.angular_damping
    rigid.use_deactivation = settings.use_deactivation
    rigid.use_start_deactivated = settings.start_deactivated
    rigid.deactivate_linear_velocity = settings.deactivation_linear_velocity_m_s
    rigid.deactivate_angular_velocity = settings.deactivation_angular_velocity_rad_s


def create_flat_ground(world: bpy.types.RigidBodyWorld, half_size_m: float, settings: Ground) -> bpy.types.Object:
    """Make a passive block with its top at height 0, `half_size_m` to every side of the origin."""
    solid = box((2.0 * half_size_m, 2.0 * half_size_m, _GROUND_THICKNESS_M), (0.0, 0.0, 0.0))
    ground = _create_passive(world, mesh_of("Ground", solid), "BOX", settings)
    ground.location = (0.0, 0.0, -_GROUND_THICKNESS_M / 2.0)
    return ground


def create_terrain(
    world: bpy.types.RigidBodyWorld, mesh: TriangleMesh, settings: Ground, facts: TerrainFacts | None = None
) -> bpy.types.Object:
    """Make passive ground of triangles, which bodies meet as they are and not as their convex hull.

    It keeps what became of the file that it was made from.
    """
    ground = _create_passive(world, mesh_of("Ground", mesh), "MESH", settings)
    if facts is not None:
        ground[_TERRAIN] = values_text(asdict(facts))
    return ground


def is_uneven_ground(body: bpy.types.Object) -> bool:
    """Return whether a body is ground that was built here, which others meet at its triangles."""
    return is_marked(body) and kind_of(body) == Kind.GROUND and body.rigid_body.collision_shape == "MESH"


def terrain_facts(scene: bpy.types.Scene) -> dict[str, Any] | None:
    """Return what became of the file of a scene's terrain, by the names of `TerrainFacts`; None where it is flat."""
    world = scene.rigidbody_world
    bodies = bodies_of(scene) if world and world.collection else []
    return next((values_from_text(str(body[_TERRAIN]), {}) for body in bodies if _TERRAIN in body), None)


def create_surface(world: bpy.types.RigidBodyWorld, mesh: TriangleMesh, settings: GroundSurface) -> bpy.types.Object:
    """Make a passive surface on the ground, such as water; its name and kind are marked as those of a member."""
    surface = _create_passive(world, mesh_of(settings.name, mesh), "MESH", settings)
    surface.color = _SURFACE_COLOURS.get(settings.kind, SOIL)
    mark_member(surface, settings.name, settings.kind)
    return surface


def _create_passive(
    world: bpy.types.RigidBodyWorld, mesh: bpy.types.Mesh, collision_shape: str, settings: Ground | GroundSurface
) -> bpy.types.Object:
    body = create_body(world, mesh, Kind.GROUND, collision_shape)
    body.color = SOIL
    body.rigid_body.type = "PASSIVE"
    set_surface(body.rigid_body, settings.friction, settings.restitution, 0.0)
    return body


def create_body(
    world: bpy.types.RigidBodyWorld, mesh: bpy.types.Mesh, kind: Kind, collision_shape: str
) -> bpy.types.Object:
    """Make a body of a mesh in the world's collection, which makes it a rigid body."""
    body = bpy.data.objects.new(mesh.name, mesh)
    world.collection.objects.link(body)
    body.rigid_body.collision_shape = collision_shape
    body[_KIND] = kind.value
    return body


def set_surface(rigid: bpy.types.RigidBodyObject, friction: float, restitution: float, margin_m: float) -> None:
    """Set friction, bounce and collision margin of a body."""
    rigid.friction, rigid.restitution = friction, restitution
    rigid.use_margin, rigid.collision_margin = True, margin_m


def mesh_of(name: str, solid: TriangleMesh) -> bpy.types.Mesh:
    """Make a mesh of a solid."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
    return mesh
