"""A demolition as it is looked at: materials, sun, sky and cameras; what Blender starts with is hidden."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...engineering.geometry.solids import box
from ...model.scenario.recording import CameraKind, PictureSettings
from ...model.structure.finishes import Finish, finishes
from ...model.structure.model import Model
from ..bodies import SOIL, Kind, bodies_of, is_uneven_ground, kind_of, member_of, mesh_of, scaled_mesh
from ..collections import ROLE, collection_for, remove_marked
from ..custom_properties import edited, keep, kept_numbers, kept_series
from ..tools.keyframes import key_values
from ..visibility import hide_symbols
from .materials import BUILT_AT, SurfaceMaterial, material_of, new_nodes

_LENS_MM = 40.0
_SENSOR_MM = 36.0
_VIEW_FROM = Vector((-0.55, -1.0, 0.28)).normalized()
_ROOM = 1.1


def aim_camera(
    scene: bpy.types.Scene,
    points: np.ndarray,
    aspect: float,
    collection: bpy.types.Collection | None = None,
    view: PictureSettings | None = None,
) -> bpy.types.Object:
    """Add a camera to the scene, or to a collection of it, and make it the scene's.

    Unless the view gives its position, it sees points (n, 3), m, from the roadside or on its way round the bridge. The
    aspect is width : height of the pictures.
    """
    camera = bpy.data.objects.new("Bridge camera", bpy.data.cameras.new("Bridge camera"))
    camera.data.lens, camera.data.sensor_width = _LENS_MM, _SENSOR_MM
    camera.data.sensor_fit = "HORIZONTAL"  # by default a picture that is higher than wide turns the sensor
    if view and view.camera_m:
        stand(camera, view.camera_m, Vector(view.camera_m) - Vector(view.look_at_m))
    elif view and view.camera == CameraKind.ORBITING:
        _orbit(scene, camera, points, aspect, view.orbit_deg)
    else:
        stand(camera, _viewpoint(points, _axes(_VIEW_FROM), aspect), _VIEW_FROM)
    farthest = float(np.linalg.norm(points - camera.location, axis=1).max())
    camera.data.clip_start, camera.data.clip_end = farthest / 1000.0, farthest * 10.0
    (collection or scene.collection).objects.link(camera)
    scene.camera = camera
    return camera


def stand(camera: bpy.types.Object, position: Sequence[float] | np.ndarray, back: Vector) -> None:
    """Put a camera at a position, with this direction behind it."""
    camera.location, camera.rotation_euler = position, back.to_track_quat("Z", "Y").to_euler()


def _orbit(
    scene: bpy.types.Scene, camera: bpy.types.Object, points: np.ndarray, aspect: float, turn_deg: float
) -> None:
    """Animate a camera that goes round the middle of points, so far away that it always sees all of them."""
    frames = np.arange(scene.frame_start, scene.frame_end + 1)
    turns = np.radians(turn_deg) * np.linspace(0.0, 1.0, len(frames))
    middle = _middle(points)
    backs = [Matrix.Rotation(turn, 3, "Z") @ _VIEW_FROM for turn in turns.tolist()]
    distance = _ROOM * max(_needed(points, middle, _axes(back), aspect) for back in backs)
    stand(camera, middle + distance * np.array(_VIEW_FROM), _VIEW_FROM)
    key_values(camera, "location", frames, middle + distance * np.array(backs))
    first = np.array(camera.rotation_euler)
    key_values(camera, "rotation_euler", frames, first + np.outer(turns, (0.0, 0.0, 1.0)))


def _axes(back: Vector) -> np.ndarray:
    """Return right, up and back of a camera as columns (3, 3)."""
    return np.array(back.to_track_quat("Z", "Y").to_matrix())


def _viewpoint(points: np.ndarray, axes: np.ndarray, aspect: float) -> np.ndarray:
    """Return where a camera sees all points (n, 3); its axes (3, 3) are right, up and back, as columns."""
    middle = axes @ _middle(points @ axes)
    return middle + axes[:, 2] * _ROOM * _needed(points, middle, axes, aspect)


def _needed(points: np.ndarray, middle: np.ndarray, axes: np.ndarray, aspect: float) -> float:
    """Return how far from the middle (3,) of its picture a camera has to stand to see all points, m."""
    seen = (points - middle) @ axes
    half_width = _SENSOR_MM / 2.0 / _LENS_MM
    return float((np.maximum(abs(seen[:, 0]), abs(seen[:, 1]) * aspect) / half_width + seen[:, 2]).max())


def _middle(points: np.ndarray) -> np.ndarray:
    return (points.min(axis=0) + points.max(axis=0)) / 2.0


_PUT_AWAY = "bda_put_away"
"""Property of a hidden object: whether it was hidden in renders before, and whether it was the scene's camera."""

_NEAR_M = 1e-3
_PLACES = {
    "MESH": ("Cube", Vector((0.0, 0.0, 0.0))),
    "LIGHT": ("Light", Vector((4.0762, 1.0055, 5.9039))),
    "CAMERA": ("Camera", Vector((7.3589, -6.9258, 4.9583))),
}
_CUBE_CORNERS = 8


def put_startup_objects_away(scene: bpy.types.Scene) -> None:
    """Hide the objects of Blender's start-up file that are as they were, and take their camera from the scene."""
    for obj in scene.objects:
        if _PUT_AWAY not in obj and _is_untouched(obj):
            obj[_PUT_AWAY] = [obj.hide_render, scene.camera == obj]
            obj.hide_render = True
            for layer in scene.view_layers:
                if obj.name in layer.objects:
                    obj.hide_set(True, view_layer=layer)
            if scene.camera == obj:
                scene.camera = None


def bring_startup_objects_back(scene: bpy.types.Scene) -> None:
    """Show what was hidden, and give the scene its camera back where it has none now."""
    for obj in scene.objects:
        if _PUT_AWAY in obj:
            hidden, was_camera = kept_numbers(obj, _PUT_AWAY, (0.0, 0.0))
            del obj[_PUT_AWAY]
            obj.hide_render = bool(hidden)
            for layer in scene.view_layers:
                if obj.name in layer.objects:
                    obj.hide_set(False, view_layer=layer)
            if was_camera and scene.camera is None:
                scene.camera = obj


def _is_untouched(obj: bpy.types.Object) -> bool:
    if obj.type not in _PLACES or obj.library or obj.rigid_body or obj.modifiers or obj.parent:
        return False
    name, position = _PLACES[obj.type]
    is_there = obj.name == name and (obj.matrix_basis.translation - position).length < _NEAR_M
    if obj.type != "MESH":
        return is_there and not obj.animation_data
    return is_there and len(obj.data.vertices) == _CUBE_CORNERS and obj.matrix_basis == Matrix.Identity(4)


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
    """Make ground to the horizon, just below the simulation's."""
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


_OF_FINISH = {
    Finish.CAST: SurfaceMaterial.CONCRETE,
    Finish.BROKEN: SurfaceMaterial.BROKEN_CONCRETE,
    Finish.ROAD: SurfaceMaterial.ASPHALT,
}
_OF_KIND = {
    Kind.BALL: SurfaceMaterial.STEEL,
    Kind.TOOL: SurfaceMaterial.STEEL,
    Kind.CRANE: SurfaceMaterial.PAINT,
    Kind.GROUND: SurfaceMaterial.SOIL,
}
_OF_SURFACE = {"water": SurfaceMaterial.WATER, "carriageway": SurfaceMaterial.ASPHALT}
"""Of surfaces on the ground, by their kind."""


def stage(
    scene: bpy.types.Scene,
    shards: Sequence[bpy.types.Object],
    model: Model,
    points: np.ndarray,
    view: PictureSettings | None = None,
) -> None:
    """Make a demolition look real that was just built of a model, with its shards in the model's order.

    The camera sees points (k, 3), m; without a view it stands at the roadside. Nothing of this takes part in the
    simulation.
    """
    _finish_shards(shards, model)
    _finish_others(bodies_of(scene))
    surround(scene, points, view)
    for layer in scene.view_layers:
        hide_symbols(layer, scene, hidden=True)


def _finish_shards(shards: Sequence[bpy.types.Object], model: Model) -> None:
    """Give the faces of shards the materials of cast and broken concrete and of asphalt."""
    materials = [material_of(_OF_FINISH[finish]) for finish in Finish]
    of_shards = finishes(model.shards, model.members, model.member_of_shard)
    for shard, of_faces in zip(shards, of_shards, strict=True):
        for material in materials:
            shard.data.materials.append(material)
        shard.data.polygons.foreach_set("material_index", of_faces.astype(np.int32))
        shard[BUILT_AT] = tuple(shard.location)


def _finish_others(bodies: Iterable[bpy.types.Object]) -> None:
    """Give ball, tools, crane and ground their materials; a ball is smooth."""
    for body in bodies:
        kind = kind_of(body)
        if kind in _OF_KIND and not body.data.materials:
            surface = _OF_SURFACE.get(member_of(body)[1], _OF_KIND[kind]) if kind == Kind.GROUND else _OF_KIND[kind]
            body.data.materials.append(material_of(surface))
        if kind == Kind.BALL:
            body.data.polygons.foreach_set("use_smooth", np.ones(len(body.data.polygons), bool))
