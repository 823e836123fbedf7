"""Clouds of dust, which EEVEE and Cycles render: soft spheres that grow, rise and thin out; for looks only."""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from ...display.dust import Puff
from ...engineering.geometry.solids import sphere
from ..bodies import mesh_of
from ..collections import ROLE, collection_for, remove_marked
from .materials import new_nodes

_DUST = "Dust"
_SEGMENTS = 24
_SOFTNESS = 1.6
"""How soon a cloud thins out towards its edge."""

_COLOUR = (0.62, 0.58, 0.52, 1.0)
_GROWING_S, _GONE_S = 0.6, 4.0
_RISE = 0.8
"""How far a cloud rises, as a part of its radius."""


def raise_dust(scene: bpy.types.Scene, clouds: Iterable[Puff]) -> list[bpy.types.Object]:
    """Make clouds in place of those that there were, and return them; they take no part in the simulation."""
    remove_dust(scene)
    clouds = list(clouds)
    if not clouds:
        return []
    collection, mesh = collection_for(scene, _DUST), mesh_of("Dust", sphere(1.0, _SEGMENTS))
    mesh.materials.append(_material())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    rate = scene.render.fps / scene.render.fps_base
    made = []
    for number, cloud in enumerate(clouds):
        puff = bpy.data.objects.new(f"Dust {number}", mesh)
        puff[ROLE] = _DUST
        puff.display_type, puff.hide_select = "WIRE", True
        puff.visible_shadow = False  # clouds are lit as if alone: in each other's shade they would look like smoke
        collection.objects.link(puff)
        _animate(puff, cloud, rate)
        made.append(puff)
    return made


def remove_dust(scene: bpy.types.Scene) -> int:
    """Remove all clouds, and return how many there were."""
    return remove_marked(scene, _DUST)


def _animate(puff: bpy.types.Object, cloud: Puff, frames_per_second: float) -> None:
    grown = cloud.frame + max(1, round(_GROWING_S * frames_per_second))
    gone = cloud.frame + max(2, round(_GONE_S * frames_per_second))
    x, y, z = cloud.position_m
    for frame, size, risen, density in ((cloud.frame, 0.25, 0.0, 1.0), (grown, 1.0, 0.3, 0.6), (gone, 1.6, 1.0, 0.0)):
        puff.scale = (size * cloud.radius_m,) * 3
        puff.location = (x, y, z + risen * _RISE * cloud.radius_m)
        puff.color = (*_COLOUR[:3], density)  # which the material takes its density from
        for path in ("scale", "location", "color"):
            puff.keyframe_insert(path, frame=frame)
    for frame, hidden in ((0, True), (cloud.frame, False), (gone, True)):
        puff.hide_render = puff.hide_viewport = hidden
        for path in ("hide_render", "hide_viewport"):
            puff.keyframe_insert(path, frame=frame)


def _material() -> bpy.types.Material:
    """Return a surface that is seen through, least in its middle and wholly at its edge, in wisps.

    It looks like a cloud in the tenth of the time that a volume takes, and needs no more samples than all else.
    """
    material = bpy.data.materials.new("Dust")
    if hasattr(material, "surface_render_method"):
        material.surface_render_method = "BLENDED"
    info, edge, inside, noise, wisps, facing, thinned, powder, clear, mixed, output = new_nodes(
        material,
        *("ShaderNodeObjectInfo", "ShaderNodeLayerWeight", "ShaderNodeMath", "ShaderNodeTexNoise"),
        *("ShaderNodeMapRange", "ShaderNodeMath", "ShaderNodeMath", "ShaderNodeBsdfDiffuse"),
        *("ShaderNodeBsdfTransparent", "ShaderNodeMixShader", "ShaderNodeOutputMaterial"),
    )
    link = material.node_tree.links.new
    edge.inputs["Blend"].default_value = 0.5
    inside.operation, inside.inputs[1].default_value = "POWER", _SOFTNESS
    facing.operation, facing.inputs[0].default_value = "SUBTRACT", 1.0
    link(edge.outputs["Facing"], facing.inputs[1])
    link(facing.outputs[0], inside.inputs[0])
    noise.inputs["Scale"].default_value, noise.inputs["Detail"].default_value = 2.0, 4.0
    wisps.inputs["From Min"].default_value, wisps.inputs["From Max"].default_value = 0.35, 0.65
    link(noise.outputs[0], wisps.inputs["Value"])
    thinned.operation = "MULTIPLY"
    link(inside.outputs[0], thinned.inputs[0])
    whole = material.node_tree.nodes.new("ShaderNodeMath")
    whole.operation = "MULTIPLY"
    link(wisps.outputs["Result"], whole.inputs[0])
    link(info.outputs["Alpha"], whole.inputs[1])
    link(whole.outputs[0], thinned.inputs[1])
    powder.inputs["Color"].default_value = _COLOUR
    for number, part in enumerate((clear, powder), start=1):
        link(part.outputs[0], mixed.inputs[number])
    link(thinned.outputs[0], mixed.inputs["Fac"])
    link(mixed.outputs[0], output.inputs["Surface"])
    return material
