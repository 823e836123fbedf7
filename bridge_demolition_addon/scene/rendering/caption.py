"""What is written into a picture: its time, the length of its scale bar, and what of it is for looks only."""

from __future__ import annotations

import bpy
from mathutils import Vector

from .materials import new_nodes

_HEIGHT, _SMALL, _LINE = 0.07, 0.048, 0.065
"""Heights of letters, and of the lowest line, as parts of the picture's height."""

_MARGIN = 0.03
_AWAY_M = 1.0
_DECIMALS = 2


def time_text(time_s: float) -> str:
    """Return a time of a run as pictures show it."""
    return f"t = {time_s:.{_DECIMALS}f} s"


class Caption:
    """Texts that stand before the camera of a scene."""

    def __init__(self, scene: bpy.types.Scene, length: str, looks_only: str) -> None:
        camera = scene.camera
        corners = [Vector(corner) for corner in camera.data.view_frame(scene=scene)]
        scale = _AWAY_M / -corners[0].z
        right, left = max(c.x for c in corners) * scale, min(c.x for c in corners) * scale
        top, bottom = max(c.y for c in corners) * scale, min(c.y for c in corners) * scale
        height, material = top - bottom, _white()
        margin, small, line = _MARGIN * height, _SMALL * height, _LINE * height
        self._time = _text(scene, "Time", (left + margin, bottom + margin + line), _HEIGHT * height, "LEFT", material)
        note = _text(scene, "Note", (left + margin, bottom + margin), small, "LEFT", material)
        note.data.body = looks_only
        bar = _text(scene, "Scale", (right - margin, bottom + margin + line), small, "RIGHT", material)
        bar.data.body = f"bar: {length}"
        self.show_time(0.0)

    def show_time(self, time_s: float) -> None:
        """Write the time of the run."""
        self._time.data.body = time_text(time_s)


def _text(
    scene: bpy.types.Scene,
    name: str,
    place: tuple[float, float],
    size: float,
    aligned: str,
    material: bpy.types.Material,
) -> bpy.types.Object:
    data = bpy.data.curves.new(name, "FONT")
    data.size, data.align_x, data.align_y = size, aligned, "BOTTOM"
    data.materials.append(material)
    text = bpy.data.objects.new(name, data)
    text.parent = scene.camera
    text.location = (*place, -_AWAY_M)
    text.visible_shadow = text.visible_diffuse = text.visible_glossy = False
    scene.collection.objects.link(text)
    return text


def _white() -> bpy.types.Material:
    material = bpy.data.materials.new("Caption")
    material.diffuse_color = (1.0, 1.0, 1.0, 1.0)
    emission, output = new_nodes(material, "ShaderNodeEmission", "ShaderNodeOutputMaterial")
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material
