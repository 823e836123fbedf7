"""What is written into a picture: its time, the length of its scale bar, and what of it is for looks only."""

from __future__ import annotations

import bpy
from mathutils import Vector

from .materials import new_nodes

_HEIGHT, _SMALL, _LINE = 0.07, 0.048, 0.065
"""Heights of letters, and of the lowest line, as parts of the picture's height."""

_MARGIN = 0.03
_AWAY_M = 1.0

_SHADE, _BEHIND = 0.06, 1.0005
"""How far a dark copy lies below and beside each text, in heights of its letters, and behind it: on white walls white
words are read by it."""

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
        height = top - bottom
        self._materials = _of_colour("Caption", 1.0), _of_colour("Caption shade", 0.01)
        margin, small, line = _MARGIN * height, _SMALL * height, _LINE * height
        place = (left + margin, bottom + margin + line)
        self._time = self._words(scene, "Time", place, _HEIGHT * height, "LEFT", time_text(0.0))
        self._words(scene, "Note", (left + margin, bottom + margin), small, "LEFT", looks_only)
        self._words(scene, "Scale", (right - margin, bottom + margin + line), small, "RIGHT", f"bar: {length}")

    def show_time(self, time_s: float) -> None:
        """Write the time of the run."""
        for text in self._time:
            text.data.body = time_text(time_s)

    def _words(
        self, scene: bpy.types.Scene, name: str, place: tuple[float, float], size: float, aligned: str, words: str
    ) -> list[bpy.types.Object]:
        """Add words and their dark copy behind them."""
        texts = []
        for suffix, material, off, away in zip(
            ("", " shade"), self._materials, (0.0, _SHADE * size), (_AWAY_M, _BEHIND * _AWAY_M), strict=True
        ):
            text = _text(scene, name + suffix, (place[0] + off, place[1] - off), size, aligned, material, away)
            text.data.body = words
            texts.append(text)
        return texts


def _text(
    scene: bpy.types.Scene,
    name: str,
    place: tuple[float, float],
    size: float,
    aligned: str,
    material: bpy.types.Material,
    away_m: float,
) -> bpy.types.Object:
    data = bpy.data.curves.new(name, "FONT")
    data.size, data.align_x, data.align_y = size, aligned, "BOTTOM"
    data.materials.append(material)
    text = bpy.data.objects.new(name, data)
    text.parent = scene.camera
    text.location = (*place, -away_m)
    text.visible_shadow = text.visible_diffuse = text.visible_glossy = False
    scene.collection.objects.link(text)
    return text


def _of_colour(name: str, brightness: float) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.diffuse_color = (brightness, brightness, brightness, 1.0)
    emission, output = new_nodes(material, "ShaderNodeEmission", "ShaderNodeOutputMaterial")
    emission.inputs["Color"].default_value = material.diffuse_color
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material
