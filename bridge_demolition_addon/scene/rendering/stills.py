"""Pictures of a demolition by Workbench, Blender's fast renderer, or by Cycles; neither needs a screen.

No cut is seen before it opens: faces of two shards that lie together look like one, as outlines are off.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import bpy
import numpy as np
from mathutils import Vector

from ...display.dust import MOST_PUFFS, MOST_TOUCHDOWNS
from ...errors import OutputError
from ...model.scenario.recording import CameraKind, PictureSettings, Renderer
from ...system.disk import whole_file
from ...system.native_output import without_noise
from ..bodies import bodies_of
from .surroundings import aim_camera, points_in_view

_EXPOSURE = 1.0
"""Of Workbench, whose light is weak."""

_EXPOSURE_IN_LIGHT = 0.5
"""Of renderers that follow light: concrete in the sun is nearly white, and what lies in the shade is seen."""

_SAMPLES, _BOUNCES = 6, 2
"""Of Cycles: so few that noise is left, which is then removed."""

_CLOUDS_BEHIND_EACH_OTHER = 2 * (MOST_PUFFS + MOST_TOUCHDOWNS)
"""Surfaces that light goes through: two of each cloud of dust. With fewer, what is behind many clouds is black."""

_GRAPHICS_CARDS = {"NVIDIA", "AMD", "INTEL", "APPLE", "QUALCOMM"}
"""Kinds of devices that Blender draws on; without a card it says SOFTWARE, or UNKNOWN."""

_STUDIO_LIGHT = "outdoor.sl"
"""One of Blender's own: a bright sun, and shadows that are blue from the sky."""

IMAGE_SETTINGS = ("media_type", "file_format", "color_mode", "color_depth")
_KEPT = {
    "render": ("engine", "filepath", "resolution_x", "resolution_y", "resolution_percentage"),
    "render.image_settings": IMAGE_SETTINGS,
    "display.shading": (
        *("light", "studio_light", "color_type", "show_shadows", "show_cavity", "show_object_outline"),
        "background_type",
    ),
    "view_settings": ("view_transform", "exposure"),
}
"""Settings of a scene that `prepare_pictures` changes, and those that Blender changes with them."""


def prepare_scene_for_pictures(scene: bpy.types.Scene, view: PictureSettings) -> None:
    """Set a scene up, before anything is simulated in it, for the pictures that are rendered afterwards."""
    prepare_pictures(scene, view)
    if view.renderer != Renderer.WORKBENCH and hasattr(scene, "cycles"):
        _use_few_samples(scene)


def prepare_pictures(scene: bpy.types.Scene, view: PictureSettings) -> None:
    """Choose the renderer that a view names, and its light.

    Settings of Cycles stay as they are: Blender forgets its played frames with any of them.
    """
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = view.width_px, view.height_px, 100
    render.image_settings.file_format = "PNG"
    scene.view_settings.view_transform = "Standard"
    if renderer_of(view) == Renderer.WORKBENCH:
        _prepare_workbench(scene)
    elif renderer_of(view) == Renderer.CYCLES:
        _choose_cycles(scene)
    else:
        scene.render.engine, scene.view_settings.exposure = _eevee(), _EXPOSURE_IN_LIGHT


def renderer_of(view: PictureSettings) -> Renderer:
    """Return what draws the pictures of a view here: `REALISTIC` stands for EEVEE, on a graphics card."""
    asked = Renderer(view.renderer)
    return asked if asked != Renderer.REALISTIC or has_graphics_card() else Renderer.CYCLES


def has_graphics_card() -> bool:
    """Return whether this Blender draws on a graphics card: it has a window, and is not drawn by the processor."""
    if bpy.app.background:
        return False
    import gpu  # which a Blender without a window may lack

    return gpu.platform.device_type_get() in _GRAPHICS_CARDS


def _eevee() -> str:
    engines = bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items.keys()
    return "BLENDER_EEVEE_NEXT" if "BLENDER_EEVEE_NEXT" in engines else "BLENDER_EEVEE"  # its name in 4.2 to 4.5


def _prepare_workbench(scene: bpy.types.Scene) -> None:
    """Show materials in their plain colours."""
    scene.render.engine = "BLENDER_WORKBENCH"
    shading = scene.display.shading
    shading.light, shading.studio_light = "STUDIO", _STUDIO_LIGHT
    shading.color_type = "MATERIAL"
    shading.show_shadows = True
    shading.show_cavity = True
    shading.show_object_outline = False
    shading.background_type = "WORLD"
    scene.view_settings.exposure = _EXPOSURE


def _choose_cycles(scene: bpy.types.Scene) -> None:
    """Follow light.

    Raises
    ------
    OutputError
        This Blender has no Cycles, or it is switched off.
    """
    if not hasattr(scene, "cycles"):
        raise OutputError(
            'pictures.renderer is "cycles", which this Blender lacks: switch on Cycles Render Engine in Edit, '
            'Preferences, Add-ons, or choose "workbench"'
        )
    scene.render.engine = "CYCLES"
    scene.view_settings.exposure = _EXPOSURE_IN_LIGHT


def _use_few_samples(scene: bpy.types.Scene) -> None:
    """Have Cycles take few samples on the processor, which every computer has, and remove their noise."""
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.use_adaptive_sampling, cycles.max_bounces = _SAMPLES, False, _BOUNCES
    cycles.use_denoising = True


def render_picture(scene: bpy.types.Scene, frame: int, path: Path) -> None:
    """Render a frame that was simulated already; Blender plays it back from its cache."""
    scene.frame_set(frame)
    with rendered_to(path) as scene.render.filepath, without_noise():
        bpy.ops.render.render(write_still=True, scene=scene.name)


@contextmanager
def rendered_to(path: Path) -> Iterator[str]:
    """Give a path for Blender to render to, from which the whole file then goes to its own path.

    Blender takes braces in a path for variables, and ``#`` for the number of a frame; this path has none of them.
    """
    with TemporaryDirectory(prefix="bda_") as folder:
        rendered = Path(folder) / path.name
        yield str(rendered)
        if rendered.exists():
            with whole_file(path) as part, rendered.open("rb") as source, part.open("wb") as target:
                shutil.copyfileobj(source, target)


@contextmanager
def prepared_for_pictures(scene: bpy.types.Scene, view: PictureSettings) -> Iterator[None]:
    """Render pictures within this context; afterwards the scene is as it was, at its frame."""
    with seen_from(scene, view, view.width_px / view.height_px), put_back_afterwards(scene, _KEPT):
        prepare_pictures(scene, view)
        yield


@contextmanager
def pictures_rendered_in(scene: bpy.types.Scene, view: PictureSettings) -> Iterator[None]:
    """Set up a scene that was made for pictures, and is gone afterwards."""
    with seen_from(scene, view, view.width_px / view.height_px):
        prepare_pictures(scene, view)
        if hasattr(scene, "cycles"):
            scene.cycles.transparent_max_bounces = _CLOUDS_BEHIND_EACH_OTHER
        yield


@contextmanager
def put_back_afterwards(scene: bpy.types.Scene, names: Mapping[str, Sequence[str]]) -> Iterator[None]:
    """Give settings of a scene, by the paths of their groups, and its frame the values back that they have now."""
    frame = scene.frame_current
    settings = [(scene.path_resolve(path), name) for path, of_group in names.items() for name in of_group]
    # Blender before 5.0 has fewer settings.
    kept = [(group, name, getattr(group, name)) for group, name in settings if hasattr(group, name)]
    try:
        yield
    finally:
        for group, name, value in kept:
            setattr(group, name, value)
        scene.frame_set(frame)


@contextmanager
def seen_from(scene: bpy.types.Scene, view: PictureSettings, aspect: float) -> Iterator[None]:
    """Make the camera that a view asks for the scene's within this context."""
    before = scene.camera
    if view.camera == CameraKind.OWN and not view.camera_m:
        if before is None:
            raise OutputError(
                f"scene {scene.name!r} has no camera: add one, or choose another camera in Scenario, Pictures"
            )
        yield
        return
    points = points_in_view(scene)
    camera = aim_camera(scene, _corners(scene) if points is None else points, aspect, view=view)
    try:
        yield
    finally:
        scene.camera = before
        _remove(scene, camera)


def _remove(scene: bpy.types.Scene, camera: bpy.types.Object) -> None:
    """Remove a camera; taken out of the scene first, as Blender forgets its played frames with any object there."""
    parts = [camera.data, *([camera.animation_data.action] if camera.animation_data else [])]
    for collection in camera.users_collection:
        collection.objects.unlink(camera)
    for layer in scene.view_layers:
        layer.update()
    bpy.data.objects.remove(camera)
    bpy.data.batch_remove([part for part in parts if part])


def _corners(scene: bpy.types.Scene) -> np.ndarray:
    """Return the corners (c, 3) float of the boxes around all bodies that move, m."""
    moving = [body for body in bodies_of(scene) if body.rigid_body.type == "ACTIVE"]
    corners = [body.matrix_world @ Vector(corner) for body in moving for corner in body.bound_box]
    if not corners:
        raise OutputError(
            f"scene {scene.name!r} has no body that moves, and nothing to see: choose a camera of its own"
        )
    return np.array(corners)
