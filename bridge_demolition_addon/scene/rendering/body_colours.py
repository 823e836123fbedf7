"""Colours of contours on bodies, and the look of a scene that shows them as they are.

Colours are written into Blender's evaluated copies of the bodies, never into the bodies themselves. That takes a tenth
of the time, as Blender has nothing to update. It works in a render, which has copies of its own. And the bodies keep
their own colours and materials, however the display ends.
"""

from __future__ import annotations

from collections.abc import Mapping

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...display.colour_scale import linear
from ..collections import ROLE
from ..custom_properties import keep
from .materials import new_nodes

_MATERIALS = ("Contours", "Shaded contours")
"""Flat and shaded."""
_LOOK = "bda_look_before"
_HAD_MATERIAL, _MATERIAL_BEFORE = "bda_contours", "bda_material_before"

_PLAIN = {
    "view_settings": {"view_transform": "Standard", "look": "None", "exposure": 0.0, "gamma": 1.0},
    "display.shading": {
        "light": "FLAT",
        "color_type": "OBJECT",
        "show_shadows": False,
        "show_cavity": False,
        "show_specular_highlight": False,
        "show_object_outline": True,
    },
}
"""Settings that leave colours in a render as they are."""

SHADED_LIGHT = "STUDIO"
_STUDIO_LIGHT = "paint.sl"
"""Blender's own, of white light alone, which keeps hues as they are."""

_SHADED = {**_PLAIN, "display.shading": {**_PLAIN["display.shading"], "light": SHADED_LIGHT}}
_KEPT = {**_PLAIN, "display.shading": {**_PLAIN["display.shading"], "studio_light": _STUDIO_LIGHT}}
"""Settings of which one of the two changes any."""

_LIGHT_FROM = Vector((0.35, -0.55, 0.76))
_DARKEST = 0.45
"""Part of its colour that a face has which looks away from the light."""


def paint(
    scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph, rows: Mapping[str, int], screen_colours: np.ndarray
) -> None:
    """Colour bodies until Blender evaluates them again or they are painted again.

    Parameters
    ----------
    depsgraph
        Has the evaluated copies that are painted.
    rows
        Row of each body's colour, by its name; a body that is missing keeps its own colour.
    screen_colours : (n, 3) float
        Colours as a screen has them; a body with a nan keeps its own.
    """
    painted = np.column_stack((linear(screen_colours), np.ones(len(screen_colours))))
    colours, is_known = painted.tolist(), np.isfinite(painted).all(axis=1).tolist()
    for body in _bodies(scene):
        row = rows.get(body.name)
        if row is None or is_known[row]:
            _set_colour(body, depsgraph, body.color if row is None else colours[row])


def place(
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    rows: Mapping[str, int],
    positions_m: np.ndarray,
    rotations: np.ndarray,
) -> None:
    """Show bodies where they were recorded until Blender evaluates them again, as `paint` shows colours.

    Blender forgets the frames it played with any change of a setting of the scene, even one in the sidebar.

    Bodies are given by their names and rows, origins as positions (n, 3) and rotations as matrices (n, 3, 3).
    """
    for body in _bodies(scene):
        row = rows.get(body.name)
        if row is not None and (evaluated := body.evaluated_get(depsgraph)).is_evaluated:
            evaluated.matrix_world = _recorded_matrix(body, positions_m[row], rotations[row])


def put_back(scene: bpy.types.Scene) -> None:
    """Have Blender evaluate bodies again that were placed."""
    for body in _bodies(scene):
        body.update_tag()


def put_back_to_start(
    scene: bpy.types.Scene, rows: Mapping[str, int], positions_m: np.ndarray, rotations: np.ndarray
) -> None:
    """Show bodies that were placed where they stand as a simulation begins, which begins where they are shown.

    Evaluated again in the frame in which Blender makes the simulation, they would have no meshes yet, and get boxes.
    Blender may make it before it evaluates constraints: bodies that have them go where the run began with them.

    The start of the run is given by bodies' names and rows, origins as positions (n, 3) and rotations as matrices
    (n, 3, 3).
    """
    for body in _bodies(scene):
        row = rows.get(body.name)
        if len(body.constraints) and row is not None:
            start = _recorded_matrix(body, positions_m[row], rotations[row])
        else:
            parent = body.parent.matrix_world @ body.matrix_parent_inverse if body.parent else Matrix()
            start = parent @ body.matrix_basis
        for layer in scene.view_layers:
            if layer.depsgraph and (evaluated := body.evaluated_get(layer.depsgraph)).is_evaluated:
                evaluated.matrix_world = start
                evaluated.matrix_basis = body.matrix_basis  # which constraints, evaluated later, begin with


def _recorded_matrix(body: bpy.types.Object, position_m: np.ndarray, rotation: np.ndarray) -> Matrix:
    return Matrix.LocRotScale(Vector(position_m), Matrix(rotation).to_quaternion(), body.scale)


def unpaint(scene: bpy.types.Scene) -> None:
    """Show the bodies' own colours again."""
    for layer in scene.view_layers:
        if layer.depsgraph:
            for body in _bodies(scene):
                _set_colour(body, layer.depsgraph, body.color)


def show_colours(scene: bpy.types.Scene, *, shaded: bool = False) -> None:
    """Make every renderer show the objects' colours as they are: one material for all, no lamps, no tone mapping.

    Shaded, a face is darker the more it looks away from a light over the shoulder; where `place` has turned a body,
    Workbench shades it as it was turned before. What was set before is kept in the scene, and so survives undo and goes
    into files.
    """
    if _LOOK not in scene:
        scene[_LOOK] = {
            f"{path}.{name}": getattr(scene.path_resolve(path), name)
            for path, settings in _KEPT.items()
            for name in settings
        }
    for path, settings in (_SHADED if shaded else _PLAIN).items():
        owner = scene.path_resolve(path)
        for name, value in settings.items():
            if getattr(owner, name) != value:  # any setting counts as a change, and costs Blender what it has played
                setattr(owner, name, value)
    if shaded:  # which other lights it has depends on the kind of light
        scene.display.shading.studio_light = _STUDIO_LIGHT
    for layer in scene.view_layers:
        if _HAD_MATERIAL not in layer:
            layer[_HAD_MATERIAL] = True
            if layer.material_override:
                layer[_MATERIAL_BEFORE] = layer.material_override
        layer.material_override = _material(shaded)


def show_materials(scene: bpy.types.Scene) -> None:
    """Put back what `show_colours` has replaced, if it has."""
    if _LOOK in scene:
        kept = scene[_LOOK].to_dict() if hasattr(scene[_LOOK], "to_dict") else {}  # it can be edited by hand
        for path, settings in _KEPT.items():
            for name in settings:
                if (value := kept.get(f"{path}.{name}")) is not None:
                    setattr(scene.path_resolve(path), name, value)
        del scene[_LOOK]
    for layer in scene.view_layers:
        if _HAD_MATERIAL in layer:
            layer.material_override = layer.get(_MATERIAL_BEFORE)
            keep(layer, _HAD_MATERIAL, None)
            keep(layer, _MATERIAL_BEFORE, None)
    bpy.data.batch_remove(
        [material for material in bpy.data.materials if material.get(ROLE) in _MATERIALS and not material.users]
    )


def _bodies(scene: bpy.types.Scene) -> bpy.types.bpy_prop_collection | tuple:
    world = scene.rigidbody_world
    return world.collection.all_objects if world and world.collection else ()


def _set_colour(body: bpy.types.Object, depsgraph: bpy.types.Depsgraph, colour: tuple[float, ...]) -> None:
    evaluated = body.evaluated_get(depsgraph)
    if evaluated.is_evaluated:  # otherwise it is hidden, and this is the body itself
        evaluated.color = colour


def _material(shaded: bool) -> bpy.types.Material:
    """Return a material that shines in the colour of its object, less so where it looks away from the light."""
    role = _MATERIALS[shaded]
    for material in bpy.data.materials:
        if material.get(ROLE) == role:
            return material
    material = bpy.data.materials.new(role)
    material[ROLE] = role
    kinds = ("ShaderNodeObjectInfo", "ShaderNodeEmission", "ShaderNodeOutputMaterial")
    info, shine, output = new_nodes(material, *kinds)
    tree = material.node_tree
    tree.links.new(info.outputs["Color"], shine.inputs["Color"])
    tree.links.new(shine.outputs["Emission"], output.inputs["Surface"])
    if shaded:
        _dim(tree, shine.inputs["Strength"])
    return material


def _dim(tree: bpy.types.NodeTree, strength: bpy.types.NodeSocket) -> None:
    """Let the strength fall from 1, towards the light, to `_DARKEST` away from it."""
    kinds = ("ShaderNodeNewGeometry", "ShaderNodeVectorMath", "ShaderNodeMapRange")
    face, turned, share = (tree.nodes.new(kind) for kind in kinds)
    turned.operation = "DOT_PRODUCT"
    turned.inputs[1].default_value = _LIGHT_FROM.normalized()
    share.inputs["From Min"].default_value, share.inputs["To Min"].default_value = -1.0, _DARKEST
    # The true normal is found from where the face is, also where bodies were placed and Blender has not noticed.
    tree.links.new(face.outputs["True Normal"], turned.inputs[0])
    tree.links.new(turned.outputs["Value"], share.inputs["Value"])
    tree.links.new(share.outputs["Result"], strength)
