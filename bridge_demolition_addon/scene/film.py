"""Films through Blender's own encoder: pictures of simulated frames with contours, put together by its sequencer."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import bpy
import numpy as np

from .rendering import render_picture

_LINEAR_BELOW = 0.04045
"""Where the curve of sRGB begins with a straight line (IEC 61966-2-1)."""


@contextmanager
def contour_shading(scene: bpy.types.Scene) -> Iterator[None]:
    """Show colours of objects as they are, without light and shadow, so that a colour bar can be read."""
    shading, view, render = scene.display.shading, scene.view_settings, scene.render
    kept = {
        shading: ("light", "show_shadows", "show_cavity", "show_specular_highlight"),
        view: ("exposure",),
        scene.display: ("render_aa",),
        render: ("filepath",),
    }
    before = [(holder, name, getattr(holder, name)) for holder, names in kept.items() for name in names]
    shading.light, shading.show_shadows, shading.show_cavity = "FLAT", False, False
    view.exposure = 0.0
    scene.display.render_aa = "FXAA"  # a film has hundreds of pictures, and without a graphics card each takes seconds
    try:
        yield
    finally:
        for holder, name, value in before:
            setattr(holder, name, value)


def render_coloured(
    scene: bpy.types.Scene, frame: int, bodies: Sequence[bpy.types.Object], colours: np.ndarray, path: Path
) -> None:
    """Render one frame that was simulated already with bodies in colours (n, 3) of sRGB."""
    linear = np.where(colours <= _LINEAR_BELOW, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    for body, colour in zip(bodies, linear, strict=True):
        body.color = (*colour, 1.0)
    render_picture(scene, frame, path)


def encode_film(pictures: Sequence[Path], path: Path, pictures_per_second: int, size_px: tuple[int, int]) -> None:
    """Put pictures together to a film (MP4, H.264), each as often as it is named.

    Parameters
    ----------
    pictures
        PNG files of one folder, in the order of the film.
    path
        File to write.
    pictures_per_second
        How fast they follow each other.
    size_px
        Width and height, even numbers.
    """
    scene = bpy.data.scenes.new("Film")
    try:
        _prepare(scene, path, pictures_per_second, size_px, len(pictures))
        editor = scene.sequence_editor_create()
        strips = editor.strips if hasattr(editor, "strips") else editor.sequences  # up to Blender 4.3
        strip = strips.new_image("Pictures", str(pictures[0]), channel=1, frame_start=1)
        for picture in pictures[1:]:
            strip.elements.append(picture.name)
        bpy.ops.render.render(animation=True, scene=scene.name)
    finally:
        bpy.data.scenes.remove(scene)


def _prepare(
    scene: bpy.types.Scene, path: Path, pictures_per_second: int, size_px: tuple[int, int], count: int
) -> None:
    render = scene.render
    scene.frame_start, scene.frame_end = 1, count
    scene.view_settings.view_transform = "Standard"
    render.fps, render.fps_base = pictures_per_second, 1.0
    render.resolution_x, render.resolution_y, render.resolution_percentage = *size_px, 100
    render.use_sequencer, render.use_compositing = True, False
    if hasattr(render.image_settings, "media_type"):  # since Blender 5
        render.image_settings.media_type = "VIDEO"
    render.image_settings.file_format = "FFMPEG"
    render.ffmpeg.format, render.ffmpeg.codec, render.ffmpeg.audio_codec = "MPEG4", "H264", "NONE"
    render.ffmpeg.constant_rate_factor = "HIGH"
    render.filepath, render.use_file_extension = str(path), False
