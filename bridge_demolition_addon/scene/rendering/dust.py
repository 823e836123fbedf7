"""Clouds of dust as volumes, which EEVEE and Cycles render: spheres that grow, rise and thin out."""

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
_DENSITY = 0.5
_COLOUR = (0.62, 0.58, 0.52, 1.0)
_GROWING_S, _GONE_S = 0.6, 4.0
_RISE = 0.8
"""How far a cloud rises, as a part of its radius."""


def raise_dust(scene: bpy.types.Scene, clouds: Iterable[Puff]) -> None:
    """Make clouds in place of those that there were; they take no part in the simulation."""
    remove_dust(scene)
    clouds = list(clouds)
    if not clouds:
        return
    collection, mesh = collection_for(scene, _DUST), mesh_of("Dust", sphere(1.0, _SEGMENTS))
    mesh.materials.append(_material())
    rate = scene.render.fps / scene.render.fps_base
    for number, cloud in enumerate(clouds):
        puff = bpy.data.objects.new(f"Dust {number}", mesh)
        puff[ROLE] = _DUST
        puff.display_type, puff.hide_select = "WIRE", True
        collection.objects.link(puff)
        _animate(puff, cloud, rate)


def remove_dust(scene: bpy.types.Scene) -> int:
    """Remove all clouds, and return how many there were."""
    return remove_marked(scene, _DUST)


def _animate(puff: bpy.types.Object, cloud: Puff, frames_per_second: float) -> None:
    grown = cloud.frame + max(1, round(_GROWING_S * frames_per_second))
    gone = cloud.frame + max(2, round(_GONE_S * frames_per_second))
    x, y, z = cloud.place_m
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
    material = bpy.data.materials.new("Dust")
    kinds = ("ShaderNodeObjectInfo", "ShaderNodeMath", "ShaderNodeVolumePrincipled", "ShaderNodeOutputMaterial")
    info, density, volume, output = new_nodes(material, *kinds)
    link = material.node_tree.links.new
    density.operation = "MULTIPLY"
    density.inputs[1].default_value = _DENSITY
    volume.inputs["Color"].default_value = _COLOUR
    # The same all over a cloud, which renders many times as fast; a sphere is thin at its edge by itself.
    link(info.outputs["Alpha"], density.inputs[0])
    link(density.outputs[0], volume.inputs["Density"])
    link(volume.outputs["Volume"], output.inputs["Volume"])
    return material
