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
from ..model.scenario import GroundSurface, ShardSettings, SurfaceValues
from ..model.scenario.kept import values_text
from ..model.terrain.built import TerrainFacts
from .collections import make_named, numbered_names
from .custom_properties import kept_numbers, kept_values

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

_START_MOTION = "bda_start_motion"

SHARD_PROPERTIES = {
    "linear_damping": "linear_damping",
    "angular_damping": "angular_damping",
    "use_deactivation": "use_deactivation",
    "start_deactivated": "use_start_deactivated",
    "deactivation_linear_velocity_m_s": "deactivate_linear_velocity",
    "deactivation_angular_velocity_rad_s": "deactivate_angular_velocity",
}
"""Keys of a scenario, and the properties of Blender's rigid bodies that they set."""


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
    """Return name and kind of the member that a body is a piece of; both are empty for other bodies."""
    return str(body.get(_MEMBER, "")), str(body.get(_MEMBER_KIND, ""))


def mark_member(body: bpy.types.Object, name: str, kind: str) -> None:
    """Mark a body with the member that it is a piece of."""
    body[_MEMBER], body[_MEMBER_KIND] = name, kind


def is_marked(body: bpy.types.Object) -> bool:
    """Return whether the add-on made a body."""
    return _KIND in body


def bodies_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return all mesh objects that take part in the scene's rigid-body world, if it has one."""
    world = scene.rigidbody_world
    objects = world.collection.all_objects if world and world.collection else ()
    return [body for body in objects if body.type == "MESH" and body.rigid_body]


def lacks_ground(scene: bpy.types.Scene) -> bool:
    """Return whether a scene has shards of the add-on, and no ground, not even one of the user's own."""
    bodies = bodies_of(scene)
    has_ours = any(is_marked(body) and kind_of(body) == Kind.SHARD for body in bodies)
    return has_ours and all(kind_of(body) != Kind.GROUND for body in bodies)


def scaled_mesh(body: bpy.types.Object) -> TriangleMesh:
    """Return a body's triangles, scaled as it is, relative to its origin, which is its centre of mass in Bullet."""
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
    surface: SurfaceValues,
    shards: Sequence[TriangleMesh],
    centres_m: np.ndarray,
    masses_kg: np.ndarray,
) -> list[bpy.types.Object]:
    """Make an active body for each of n shards, its origin at its centre of mass (n, 3), m.

    The bodies go into the collection of a rigid-body world, fastest while it is `off_scene`.
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
        _set_shard(body.rigid_body, settings, surface)
    return bodies


def _set_shard(rigid: bpy.types.RigidBodyObject, settings: ShardSettings, surface: SurfaceValues) -> None:
    rigid.collision_shape = "CONVEX_HULL"
    set_surface(rigid, surface, settings.collision_margin_m)
    for key, name in SHARD_PROPERTIES.items():
        setattr(rigid, name, getattr(settings, key))


def keep_start_motion(
    bodies: Sequence[bpy.types.Object], velocities_m_s: np.ndarray, angular_velocities_rad_s: np.ndarray
) -> None:
    """Have bodies (n,) begin with velocities (n, 3) and angular velocities (n, 3), where these are not 0."""
    for body, motion in zip(bodies, np.column_stack((velocities_m_s, angular_velocities_rad_s)).tolist(), strict=True):
        if any(motion):
            body[_START_MOTION] = motion  # Blender has no such property of rigid bodies


def start_motion_of(bodies: Sequence[bpy.types.Object]) -> np.ndarray:
    """Return velocities, m/s, and angular velocities, rad/s, (n, 6) with which bodies (n,) begin."""
    return np.array([kept_numbers(body, _START_MOTION, (0.0,) * 6) for body in bodies], float).reshape(-1, 6)


def create_flat_ground(world: bpy.types.RigidBodyWorld, half_size_m: float, surface: SurfaceValues) -> bpy.types.Object:
    """Make a passive block with its top at height 0, `half_size_m` to every side of the origin."""
    solid = box((2.0 * half_size_m, 2.0 * half_size_m, _GROUND_THICKNESS_M), (0.0, 0.0, 0.0))
    ground = _create_passive(world, mesh_of("Ground", solid), "BOX", surface)
    ground.location = (0.0, 0.0, -_GROUND_THICKNESS_M / 2.0)
    return ground


def create_terrain(
    world: bpy.types.RigidBodyWorld, mesh: TriangleMesh, surface: SurfaceValues, facts: TerrainFacts | None = None
) -> bpy.types.Object:
    """Make passive ground of triangles, not of their convex hull; it keeps facts on the file that it was made from."""
    ground = _create_passive(world, mesh_of("Ground", mesh), "MESH", surface)
    if facts is not None:
        ground[_TERRAIN] = values_text(asdict(facts))
    return ground


def is_uneven_ground(body: bpy.types.Object) -> bool:
    """Return whether a body is ground of the add-on that others meet at its triangles."""
    return is_marked(body) and kind_of(body) == Kind.GROUND and body.rigid_body.collision_shape == "MESH"


def terrain_facts(scene: bpy.types.Scene) -> dict[str, Any] | None:
    """Return the facts on the file of a scene's terrain, by the names of `TerrainFacts`; None where it is flat."""
    return next((kept_values(body, _TERRAIN, {}) for body in bodies_of(scene) if _TERRAIN in body), None)


def create_surface(
    world: bpy.types.RigidBodyWorld, mesh: TriangleMesh, settings: GroundSurface, surface: SurfaceValues
) -> bpy.types.Object:
    """Make a passive surface on the ground, such as water, marked with its name and kind as a member is."""
    body = _create_passive(world, mesh_of(settings.name, mesh), "MESH", surface)
    body.color = _SURFACE_COLOURS.get(settings.kind, SOIL)
    mark_member(body, settings.name, settings.kind)
    return body


def _create_passive(
    world: bpy.types.RigidBodyWorld, mesh: bpy.types.Mesh, collision_shape: str, surface: SurfaceValues
) -> bpy.types.Object:
    body = create_body(world, mesh, Kind.GROUND, collision_shape)
    body.color = SOIL
    body.rigid_body.type = "PASSIVE"
    set_surface(body.rigid_body, surface, 0.0)
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


def set_surface(rigid: bpy.types.RigidBodyObject, surface: SurfaceValues, margin_m: float) -> None:
    """Set friction and restitution of a body by itself, and its collision margin."""
    rigid.friction, rigid.restitution = surface.friction, surface.restitution
    rigid.use_margin, rigid.collision_margin = True, margin_m


def mesh_of(name: str, solid: TriangleMesh) -> bpy.types.Mesh:
    """Make a mesh of a solid."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
    return mesh
