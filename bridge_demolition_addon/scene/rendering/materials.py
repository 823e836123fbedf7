"""Procedural materials: what is made of nodes alone, and needs no picture from outside."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import bpy

BUILT_AT = "bda_built_at_m"
"""Property of a body: where its origin was built, so that a pattern runs on from shard to shard and falls with them."""

_ROLE = "bda_role"


class SurfaceMaterial(StrEnum):
    """What a face is made of."""

    CONCRETE = "Concrete"
    BROKEN_CONCRETE = "Broken concrete"
    ASPHALT = "Asphalt"
    STEEL = "Steel"
    PAINT = "Yellow paint"
    SOIL = "Soil"
    WATER = "Water"
    CHARGE = "Charge"


@dataclass(frozen=True, slots=True)
class _Look:
    """A material.

    Attributes
    ----------
    plain
        The colour where no pattern is drawn, as in Solid view, linear light.
    dark, light
        The colours between which the pattern lies, linear light.
    roughness, metallic
        As of Blender's Principled BSDF.
    grain_m
        Size of the pattern's largest patches.
    depth_m
        How deep its bumps look.
    """

    plain: tuple[float, float, float]
    dark: tuple[float, float, float]
    light: tuple[float, float, float]
    roughness: float
    metallic: float = 0.0
    grain_m: float = 1.0
    depth_m: float = 0.0


_LOOKS = {
    SurfaceMaterial.CONCRETE: _Look(
        (0.60, 0.58, 0.54), (0.25, 0.24, 0.22), (0.40, 0.39, 0.36), 0.75, grain_m=2.5, depth_m=0.004
    ),
    SurfaceMaterial.BROKEN_CONCRETE: _Look(
        (0.86, 0.84, 0.79), (0.45, 0.43, 0.39), (0.70, 0.68, 0.63), 1.0, grain_m=0.25, depth_m=0.04
    ),
    SurfaceMaterial.ASPHALT: _Look(
        (0.085, 0.085, 0.09), (0.022, 0.022, 0.024), (0.060, 0.060, 0.062), 0.9, grain_m=0.6, depth_m=0.004
    ),
    SurfaceMaterial.STEEL: _Look(
        (0.08, 0.09, 0.10), (0.04, 0.04, 0.045), (0.10, 0.10, 0.105), 0.35, metallic=0.9, grain_m=0.4
    ),
    SurfaceMaterial.PAINT: _Look((0.60, 0.37, 0.02), (0.55, 0.33, 0.02), (0.65, 0.41, 0.03), 0.4, grain_m=0.5),
    SurfaceMaterial.WATER: _Look(
        (0.10, 0.20, 0.26), (0.012, 0.035, 0.045), (0.02, 0.05, 0.06), 0.12, grain_m=9.0, depth_m=0.01
    ),
    SurfaceMaterial.SOIL: _Look(
        (0.18, 0.17, 0.12), (0.075, 0.075, 0.035), (0.165, 0.145, 0.085), 1.0, grain_m=6.0, depth_m=0.03
    ),
    SurfaceMaterial.CHARGE: _Look((0.80, 0.05, 0.02), (0.75, 0.04, 0.015), (0.85, 0.06, 0.02), 0.5, grain_m=0.2),
}


def material_of(surface: SurfaceMaterial) -> bpy.types.Material:
    """Return the material of a surface, which is made when it is first asked for."""
    found = next((each for each in bpy.data.materials if each.get(_ROLE) == surface and not each.library), None)
    if found:
        return found
    material = bpy.data.materials.new(surface.value)
    material[_ROLE] = surface.value
    look = _LOOKS[surface]
    material.diffuse_color = (*look.plain, 1.0)  # which Solid view and Workbench show
    material.roughness, material.metallic = look.roughness, look.metallic
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    _lay_out(material.node_tree, look)
    return material


def remove_unused_materials() -> None:
    """Remove the materials of surfaces that nothing has any more."""
    ours = [
        material
        for material in bpy.data.materials
        if material.get(_ROLE) in set(SurfaceMaterial) and not material.library
    ]
    bpy.data.batch_remove([our for our in ours if not our.users])


def _lay_out(tree: bpy.types.NodeTree, look: _Look) -> None:
    """Colour by noise in two sizes, and bumps by the same noise."""
    tree.nodes.clear()
    place = _place_as_built(tree)
    large, small = (_noise(tree, place, size) for size in (look.grain_m, look.grain_m / 12.0))
    mixed = _node(tree, "ShaderNodeMath", operation="MULTIPLY_ADD")
    _link(tree, large, mixed.inputs[0])
    mixed.inputs[1].default_value = 0.6
    halved = _node(tree, "ShaderNodeMath", operation="MULTIPLY")
    _link(tree, small, halved.inputs[0])
    halved.inputs[1].default_value = 0.4
    _link(tree, halved.outputs[0], mixed.inputs[2])
    ramp = _node(tree, "ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.3, (*look.dark, 1.0)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.7, (*look.light, 1.0)
    _link(tree, mixed.outputs[0], ramp.inputs[0])
    shader, output = _node(tree, "ShaderNodeBsdfPrincipled"), _node(tree, "ShaderNodeOutputMaterial")
    shader.inputs["Roughness"].default_value = look.roughness
    shader.inputs["Metallic"].default_value = look.metallic
    _link(tree, ramp.outputs[0], shader.inputs["Base Color"])
    if look.depth_m:
        bump = _node(tree, "ShaderNodeBump")
        bump.inputs["Distance"].default_value = look.depth_m
        _link(tree, mixed.outputs[0], bump.inputs["Height"])
        _link(tree, bump.outputs[0], shader.inputs["Normal"])
    _link(tree, shader.outputs[0], output.inputs["Surface"])
    for number, node in enumerate(tree.nodes):
        node.location = (220.0 * number, 0.0)


def _place_as_built(tree: bpy.types.NodeTree) -> bpy.types.NodeSocket:
    """Return where a point of a body was when it was built; in its own axes where the body does not say."""
    own, built = _node(tree, "ShaderNodeTexCoord"), _node(tree, "ShaderNodeAttribute", attribute_type="OBJECT")
    built.attribute_name = BUILT_AT
    added = _node(tree, "ShaderNodeVectorMath", operation="ADD")
    _link(tree, own.outputs["Object"], added.inputs[0])
    _link(tree, built.outputs["Vector"], added.inputs[1])
    return added.outputs[0]


def _noise(tree: bpy.types.NodeTree, place: bpy.types.NodeSocket, size_m: float) -> bpy.types.NodeSocket:
    noise = _node(tree, "ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 1.0 / size_m
    noise.inputs["Detail"].default_value = 6.0
    _link(tree, place, noise.inputs["Vector"])
    return noise.outputs[0]


def _node(tree: bpy.types.NodeTree, kind: str, **settings: str) -> bpy.types.Node:
    node = tree.nodes.new(kind)
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def _link(tree: bpy.types.NodeTree, source: bpy.types.NodeSocket, target: bpy.types.NodeSocket) -> None:
    tree.links.new(source, target)
