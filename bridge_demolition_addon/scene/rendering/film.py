"""Pictures of frames that were played already, and films made of pictures, by Blender's own renderer and encoder."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy

from ...errors import OutputError
from ...model.scenario.recording import PictureSettings
from ...system.native_output import without_noise
from .stills import IMAGE_SETTINGS, put_back_afterwards, rendered_to, seen_from

_RENDERER = "BLENDER_WORKBENCH"
"""The fastest renderer by far."""

_SMOOTHING = "FXAA"
"""Workbench's default takes three times as long, and flat colours do not need it."""

_KEPT = {
    "render": ("engine", "filepath", "resolution_x", "resolution_y", "resolution_percentage", "dither_intensity"),
    "render.image_settings": IMAGE_SETTINGS,
    "display": ("render_aa",),
}
"""Settings that change while pictures are rendered."""


@dataclass(frozen=True, slots=True)
class RenderSettings:
    """Size of pictures of contours."""

    width_px: int = 1280
    height_px: int = 720

    def __post_init__(self) -> None:
        for size in (self.width_px, self.height_px):
            if size < 2 or size % 2:
                raise OutputError(f"film: its size has to be even, as 1280 × 720 is, not {size} pixels")


@contextmanager
def set_up_for_pictures(scene: bpy.types.Scene, settings: RenderSettings, view: PictureSettings) -> Iterator[None]:
    """Render PNG pictures within this context; afterwards the scene is as it was, at its frame."""
    render, image = scene.render, scene.render.image_settings
    with seen_from(scene, view, settings.width_px / settings.height_px), put_back_afterwards(scene, _KEPT):
        render.engine = _RENDERER
        render.resolution_x, render.resolution_y = settings.width_px, settings.height_px
        render.resolution_percentage = 100
        render.dither_intensity = 0.0  # its noise hides the steps of colour that contours have
        scene.display.render_aa = _SMOOTHING
        if hasattr(image, "media_type"):  # from Blender 5.0 on it decides which formats there are
            image.media_type = "IMAGE"
        image.file_format, image.color_mode, image.color_depth = "PNG", "RGB", "8"
        yield


def encode_film(pictures: Sequence[Path], film: Path, pictures_per_second: float) -> None:
    """Make an MP4 film (H.264) of pictures of one size in one folder; a picture may come several times."""
    if not pictures:
        raise OutputError(f"{film}: there are no pictures to make a film of")
    if not bpy.app.build_options.codec_ffmpeg:
        raise OutputError(f"{film}: this Blender was built without FFmpeg and makes no films; render pictures instead")
    width_px, height_px = _size(pictures[0])
    scene = bpy.data.scenes.new("Film")
    try:
        _set_up_encoder(scene.render, pictures_per_second)
        scene.render.resolution_x, scene.render.resolution_y = width_px, height_px
        scene.render.resolution_percentage = 100
        scene.view_settings.view_transform = "Standard"
        _lay_out(scene, pictures)
        with rendered_to(film) as scene.render.filepath, without_noise():
            bpy.ops.render.render(animation=True, scene=scene.name)
    finally:
        bpy.data.scenes.remove(scene)
    if not film.exists():
        raise OutputError(f"{film}: Blender wrote no film; see what it says on its console")


def _set_up_encoder(render: bpy.types.RenderSettings, pictures_per_second: float) -> None:
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "VIDEO"
    render.image_settings.file_format = "FFMPEG"
    render.ffmpeg.format, render.ffmpeg.codec = "MPEG4", "H264"
    render.ffmpeg.constant_rate_factor, render.ffmpeg.ffmpeg_preset = "HIGH", "GOOD"
    render.fps = max(1, math.ceil(pictures_per_second - 1e-9))
    render.fps_base = render.fps / pictures_per_second
    render.use_file_extension = False
    render.use_sequencer, render.use_compositing = True, False


def _lay_out(scene: bpy.types.Scene, pictures: Sequence[Path]) -> None:
    """Make one strip of the pictures, from the first frame on."""
    editor = scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences  # their name before Blender 4.4
    strip = strips.new_image("Pictures", str(pictures[0]), 1, 1)
    for picture in pictures[1:]:
        strip.elements.append(picture.name)
    scene.frame_start, scene.frame_end = 1, len(pictures)


def _size(picture: Path) -> tuple[int, int]:
    image = bpy.data.images.load(str(picture))
    try:
        return tuple(image.size)
    finally:
        bpy.data.images.remove(image)
