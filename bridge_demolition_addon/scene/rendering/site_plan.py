"""A site plan, or a picture from the air, on the ground under the bridge."""

from __future__ import annotations

import math
from pathlib import Path

import bpy
import numpy as np

from ...engineering.geometry.rotations import turn_in_plane
from ...engineering.geometry.vectors import transformed
from ...errors import OutputError
from ..collections import collection_for, find_collection
from .ground import ground_of

_ROLE, _MARK = "Site plan", "bda_role"
_ABOVE_M = 0.01
"""Above the ground, so that the two do not flicker."""

_PARTS = 128
"""Parts of a side where the ground is not flat, which the picture then follows."""


def lay_site_plan(
    scene: bpy.types.Scene, path: Path, width_m: float, bearing_deg: float, origin: tuple[float, float]
) -> tuple[float, float]:
    """Lay a picture on the ground in place of the one that was there; it takes no part in the simulation.

    Parameters
    ----------
    scene
        Where to.
    path
        The picture.
    width_m
        How wide it is on the ground.
    bearing_deg
        Direction of the x axis, clockwise from the upward direction of the picture.
    origin
        Where the origin of the scene lies in it, as shares of its width and height, from its left and its foot.

    Returns
    -------
    tuple of float
        Width and height on the ground, m.
    """
    image = _loaded(path)
    height_m = width_m * image.size[1] / image.size[0]
    remove_site_plan(scene)
    left, low = -origin[0] * width_m, -origin[1] * height_m
    ground, turn = ground_of(scene), turn_in_plane(math.radians(bearing_deg - 90.0))
    parts = 1 if ground.is_flat else _PARTS
    shares = np.stack(np.meshgrid(*2 * (np.linspace(0.0, 1.0, parts + 1),)), -1).reshape(-1, 2)
    places = shares * (width_m, height_m) + (left, low)
    corners = np.column_stack((places, ground.heights_at(transformed(turn, places))))
    first = (np.arange(parts)[:, None] * (parts + 1) + np.arange(parts)).ravel()
    faces = np.column_stack((first, first + 1, first + parts + 2, first + parts + 1))
    mesh = bpy.data.meshes.new("Site plan")
    mesh.from_pydata(corners.tolist(), [], faces.tolist())
    layer = mesh.uv_layers.new(name="Picture")
    for loop, place in zip(layer.data, shares[faces.ravel()].tolist(), strict=True):
        loop.uv = place
    mesh.materials.append(_material(image))
    plan = bpy.data.objects.new("Site plan", mesh)
    plan[_MARK] = _ROLE
    # The picture's upward direction lies at a bearing of 0, and the x axis so far clockwise from it.
    plan.location, plan.rotation_euler = (0.0, 0.0, _ABOVE_M), (0.0, 0.0, math.radians(bearing_deg - 90.0))
    plan.hide_select = True
    collection_for(scene, _ROLE).objects.link(plan)
    return width_m, height_m


def remove_site_plan(scene: bpy.types.Scene) -> None:
    """Remove the picture from the ground, if there is one."""
    collection = find_collection(scene, _ROLE)
    if collection is None:
        return
    ours = [obj for obj in collection.objects if obj.get(_MARK) == _ROLE]
    meshes, materials = {our.data for our in ours}, {slot.material for our in ours for slot in our.material_slots}
    bpy.data.batch_remove(ours)
    bpy.data.batch_remove([mesh for mesh in meshes if not mesh.users])
    bpy.data.batch_remove([material for material in materials if material and not material.users])
    if not collection.objects and not collection.children:
        bpy.data.collections.remove(collection)


def _loaded(path: Path) -> bpy.types.Image:
    try:
        image = bpy.data.images.load(str(path), check_existing=True)
    except RuntimeError as error:
        raise OutputError(f"{path}: Blender cannot read this picture; choose a PNG, JPEG or TIFF file") from error
    if not all(image.size):
        if not image.users:
            bpy.data.images.remove(image)
        raise OutputError(f"{path}: is no picture that Blender can read; choose a PNG, JPEG or TIFF file")
    return image


def _material(image: bpy.types.Image) -> bpy.types.Material:
    material = bpy.data.materials.new("Site plan")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    kinds = ("ShaderNodeTexImage", "ShaderNodeBsdfPrincipled", "ShaderNodeOutputMaterial")
    picture, shader, output = (tree.nodes.new(kind) for kind in kinds)
    picture.image = image
    shader.inputs["Roughness"].default_value = 1.0
    tree.links.new(picture.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return material
