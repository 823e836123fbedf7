"""Sun, sky and camera around a bridge, in a collection of their own."""

from __future__ import annotations

import math

import bpy
import numpy as np

from ...engineering.geometry.solids import box
from ...model.scenario.recording import PictureSettings
from ..bodies import SOIL, bodies_of, is_uneven_ground, mesh_of, scaled_mesh
from ..collections import ROLE, collection_for, remove_marked
from ..custom_properties import edited, keep, kept_series
from .camera import aim_camera
from .materials import SurfaceMaterial, material_of, new_nodes
from .startup_objects import bring_startup_objects_back, put_startup_objects_away

_SURROUNDINGS = "Surroundings"
_SKY = "Sky"
_WORLD_BEFORE = "bda_world_before"
"""Property of our sky: the world that it replaced."""

_POINTS = "bda_points_in_view"

_LAND_THICKNESS_M = 0.02
_SUN_W_M2 = 4.5
_SUN_ANGLE_DEG = 0.53
"""How large the sun looks from the earth."""

_SUN_TURN_DEG = (48.0, 0.0, -35.0)
"""From the vertical, and about it: over the shoulder of the camera at `camera._VIEW_FROM`."""

_SKY_STRENGTH = 0.7
_HAZE, _BLUE = (0.62, 0.70, 0.78), (0.13, 0.27, 0.52)
PLAIN_SKY = (0.36, 0.45, 0.55)
"""Of renderers that know no gradient, such as Workbench."""

_STARTUP_NAME = "World"
_STARTUP_NODES = {"ShaderNodeOutputWorld", "ShaderNodeBackground"}
_STARTUP_GREY = 0.0509


def surround(scene: bpy.types.Scene, points: np.ndarray, view: PictureSettings | None = None) -> None:
    """Put a scene under sun and sky, before a camera that sees points (n, 3) float, m, or stands where `view` says.

    Blender's start-up objects are put away. A camera and a world of the user's own stay the scene's.
    """
    clear_surroundings(scene)  # left where the user has taken the world away by Blender's own button
    put_startup_objects_away(scene)
    if scene.world is None or _is_of_startup(scene.world):
        _put_sky_up(scene)
    collection, own = collection_for(scene, _SURROUNDINGS), scene.camera
    show_points(scene, points)
    camera = aim_camera(scene, points, scene.render.resolution_x / scene.render.resolution_y, collection, view)
    scene.camera = own or camera
    land = _land(camera.data.clip_end / 2.0, _lowest_ground(scene))
    for obj in (_sun(), land):
        collection.objects.link(obj)
    for obj in collection.objects:
        obj[ROLE] = _SURROUNDINGS
    for layer in scene.view_layers:
        land.hide_set(True, view_layer=layer)  # for pictures alone: View All would show nothing else


def show_points(scene: bpy.types.Scene, points: np.ndarray) -> None:
    """Have cameras that are aimed from now on in a scene see points (n, 3) float, m."""
    scene[_POINTS] = np.asarray(points, float).ravel().tolist()


def points_in_view(scene: bpy.types.Scene) -> np.ndarray | None:
    """Return the points (n, 3) float, m, that cameras of a scene are to see; None where it was not built here."""
    if _POINTS not in scene:
        return None
    numbers = kept_series(scene, _POINTS, "three numbers for each point")
    if not len(numbers) or len(numbers) % 3:
        raise edited(scene, _POINTS, "three numbers for each point")
    return numbers.reshape(-1, 3)


def share_view(scene: bpy.types.Scene, other: bpy.types.Scene) -> None:
    """Have another scene be seen as this one: its world, camera, frames, and points for cameras to see."""
    other.world, other.camera = scene.world, scene.camera
    other.frame_start, other.frame_end = scene.frame_start, scene.frame_end
    other.render.fps, other.render.fps_base = scene.render.fps, scene.render.fps_base
    other.render.resolution_x, other.render.resolution_y = scene.render.resolution_x, scene.render.resolution_y
    if _POINTS in scene:
        other[_POINTS] = scene[_POINTS]
    if hasattr(scene, "cycles"):
        for name in ("device", "samples", "use_adaptive_sampling", "max_bounces", "use_denoising"):
            setattr(other.cycles, name, getattr(scene.cycles, name))


def is_land(obj: bpy.types.Object) -> bool:
    """Return whether an object is the ground to the horizon."""
    return obj.get(ROLE) == _SURROUNDINGS and obj.type == "MESH"


def clear_surroundings(scene: bpy.types.Scene) -> None:
    """Remove what `surround` has made, and bring back what it has put away."""
    remove_marked(scene, _SURROUNDINGS)
    sky = scene.world
    if sky and sky.get(ROLE) == _SKY:
        before = sky.get(_WORLD_BEFORE)
        scene.world = before if isinstance(before, bpy.types.World) else None
        if not sky.users:
            bpy.data.worlds.remove(sky)
    keep(scene, _POINTS, None)
    bring_startup_objects_back(scene)


def _sun() -> bpy.types.Object:
    light = bpy.data.lights.new("Sun", "SUN")
    light.energy, light.angle = _SUN_W_M2, math.radians(_SUN_ANGLE_DEG)
    sun = bpy.data.objects.new("Sun", light)
    sun.rotation_euler = [math.radians(turn) for turn in _SUN_TURN_DEG]
    sun.location = (0.0, 0.0, 30.0)
    return sun


def _lowest_ground(scene: bpy.types.Scene) -> float:
    """Return the height of the lowest place of ground that is not flat, m; 0 without such."""
    uneven = [body for body in bodies_of(scene) if is_uneven_ground(body)]
    return min((float(scaled_mesh(body).vertices[:, 2].min()) for body in uneven), default=0.0)


def _land(half_size_m: float, height_m: float) -> bpy.types.Object:
    """Make ground to the horizon, just below that of the simulation."""
    size = 2.0 * half_size_m
    mesh = mesh_of("Land", box((size, size, _LAND_THICKNESS_M), (0.0, 0.0, min(height_m, 0.0) - _LAND_THICKNESS_M)))
    mesh.materials.append(material_of(SurfaceMaterial.SOIL))
    land = bpy.data.objects.new("Land", mesh)
    land.color, land.hide_select = SOIL, True
    return land


def _is_of_startup(world: bpy.types.World) -> bool:
    """Return whether a world is the grey one that Blender starts with."""
    if world.library or world.name != _STARTUP_NAME or not world.node_tree:
        return False
    if {node.bl_idname for node in world.node_tree.nodes} != _STARTUP_NODES:
        return False
    background = next(node for node in world.node_tree.nodes if node.bl_idname == "ShaderNodeBackground")
    return all(abs(channel - _STARTUP_GREY) < 1e-3 for channel in background.inputs["Color"].default_value[:3])


def _put_sky_up(scene: bpy.types.Scene) -> None:
    """Make a sky with haze at the horizon and blue overhead the scene's world."""
    sky = bpy.data.worlds.new(_SKY)
    sky[ROLE] = _SKY
    if scene.world:
        sky[_WORLD_BEFORE] = scene.world  # a user of it, so that it is saved with the file
    sky.color = PLAIN_SKY
    position, parts, ramp, background, output = new_nodes(
        sky,
        *("ShaderNodeTexCoord", "ShaderNodeSeparateXYZ", "ShaderNodeValToRGB"),
        *("ShaderNodeBackground", "ShaderNodeOutputWorld"),
    )
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (*_HAZE, 1.0), (*_BLUE, 1.0)
    ramp.color_ramp.elements[1].position = 0.6
    background.inputs["Strength"].default_value = _SKY_STRENGTH
    link = sky.node_tree.links.new
    link(position.outputs["Generated"], parts.inputs[0])
    link(parts.outputs["Z"], ramp.inputs[0])
    link(ramp.outputs[0], background.inputs["Color"])
    link(background.outputs[0], output.inputs["Surface"])
    scene.world = sky
