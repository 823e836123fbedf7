"""Procedural materials, of nodes alone: they need no picture."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import bpy

from ..collections import ROLE

BUILT_AT = "bda_built_at_m"
"""Property of a body: where its origin was built, so that a pattern runs on from shard to shard and falls with them."""


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
    MARKING = "White marking"
    RED_PAINT = "Red paint"
    BLACK_PAINT = "Black paint"
    RUST = "Rusty steel"
    SKIN = "Skin"
    BRIDGE_PAINT = "Painted steel"


@dataclass(frozen=True, slots=True)
class _Look:
    """A material: roughness and metallic as of Blender's Principled BSDF, colours in linear light.

    `plain` is the colour where no pattern is drawn, as in Solid view; the pattern lies between `dark` and `light`. Its
    largest patches are `grain_m` wide, and its bumps look `depth_m` deep.
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
        (0.18, 0.17, 0.12), (0.060, 0.075, 0.028), (0.185, 0.155, 0.090), 1.0, grain_m=9.0, depth_m=0.03
    ),
    SurfaceMaterial.MARKING: _Look((0.80, 0.80, 0.78), (0.55, 0.55, 0.53), (0.80, 0.80, 0.78), 0.7, grain_m=0.4),
    SurfaceMaterial.RED_PAINT: _Look((0.55, 0.06, 0.03), (0.45, 0.05, 0.025), (0.60, 0.07, 0.035), 0.4, grain_m=0.5),
    SurfaceMaterial.BLACK_PAINT: _Look((0.03, 0.03, 0.03), (0.012, 0.012, 0.012), (0.03, 0.03, 0.03), 0.6, grain_m=0.4),
    SurfaceMaterial.RUST: _Look((0.25, 0.10, 0.04), (0.12, 0.045, 0.02), (0.26, 0.11, 0.045), 0.8, grain_m=0.1),
    SurfaceMaterial.BRIDGE_PAINT: _Look(
        (0.16, 0.24, 0.20), (0.085, 0.135, 0.11), (0.13, 0.19, 0.155), 0.5, grain_m=1.5
    ),
    SurfaceMaterial.SKIN: _Look((0.45, 0.27, 0.18), (0.40, 0.23, 0.15), (0.50, 0.30, 0.20), 0.7, grain_m=0.2),
    SurfaceMaterial.CHARGE: _Look((0.80, 0.05, 0.02), (0.75, 0.04, 0.015), (0.85, 0.06, 0.02), 0.5, grain_m=0.2),
}


def new_nodes(owner: bpy.types.Material | bpy.types.World, *kinds: str) -> list[bpy.types.Node]:
    """Return new nodes of some kinds, the only ones of a material or world."""
    if bpy.app.version < (5, 0, 0):
        owner.use_nodes = True
    nodes = owner.node_tree.nodes
    nodes.clear()
    made = [nodes.new(kind) for kind in kinds]
    for number, node in enumerate(made):
        node.location = (220.0 * number, 0.0)
    return made


def material_of(surface: SurfaceMaterial) -> bpy.types.Material:
    """Return the material of a surface, which the first call makes."""
    for material in bpy.data.materials:
        if material.get(ROLE) == surface and not material.library:
            return material
    material = bpy.data.materials.new(surface.value)
    material[ROLE] = surface.value
    look = _LOOKS[surface]
    material.diffuse_color = (*look.plain, 1.0)  # which Solid view and Workbench show
    material.roughness, material.metallic = look.roughness, look.metallic
    _lay_out(material, look)
    return material


def remove_unused_materials() -> None:
    """Remove the materials of surfaces that nothing uses any more."""
    unused = [material for material in bpy.data.materials if not (material.users or material.library)]
    bpy.data.batch_remove([material for material in unused if material.get(ROLE) in set(SurfaceMaterial)])


def _lay_out(material: bpy.types.Material, look: _Look) -> None:
    """Colour by noise in two sizes, and bumps by the same noise."""
    own, built, position, large, small, halved, mixed, ramp, shader, output = new_nodes(
        material,
        *("ShaderNodeTexCoord", "ShaderNodeAttribute", "ShaderNodeVectorMath", "ShaderNodeTexNoise"),
        *("ShaderNodeTexNoise", "ShaderNodeMath", "ShaderNodeMath", "ShaderNodeValToRGB"),
        *("ShaderNodeBsdfPrincipled", "ShaderNodeOutputMaterial"),
    )
    link = material.node_tree.links.new
    # Where a point of a body was when it was built; in its own axes where the body does not say.
    built.attribute_type, built.attribute_name = "OBJECT", BUILT_AT
    position.operation = "ADD"
    link(own.outputs["Object"], position.inputs[0])
    link(built.outputs["Vector"], position.inputs[1])
    for noise, size_m in ((large, look.grain_m), (small, look.grain_m / 12.0)):
        noise.inputs["Scale"].default_value, noise.inputs["Detail"].default_value = 1.0 / size_m, 6.0
        link(position.outputs[0], noise.inputs["Vector"])
    halved.operation, mixed.operation = "MULTIPLY", "MULTIPLY_ADD"
    halved.inputs[1].default_value, mixed.inputs[1].default_value = 0.4, 0.6
    link(small.outputs[0], halved.inputs[0])
    link(large.outputs[0], mixed.inputs[0])
    link(halved.outputs[0], mixed.inputs[2])
    for stop, share, colour in zip(ramp.color_ramp.elements, (0.3, 0.7), (look.dark, look.light), strict=True):
        stop.position, stop.color = share, (*colour, 1.0)
    link(mixed.outputs[0], ramp.inputs[0])
    shader.inputs["Roughness"].default_value = look.roughness
    shader.inputs["Metallic"].default_value = look.metallic
    link(ramp.outputs[0], shader.inputs["Base Color"])
    if look.depth_m:
        bump = material.node_tree.nodes.new("ShaderNodeBump")
        bump.inputs["Distance"].default_value = look.depth_m
        link(mixed.outputs[0], bump.inputs["Height"])
        link(bump.outputs[0], shader.inputs["Normal"])
    link(shader.outputs[0], output.inputs["Surface"])
