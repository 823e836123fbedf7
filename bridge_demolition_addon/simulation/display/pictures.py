"""Pictures of a run: before it, at the moment that shows most, and at its end."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bpy

from ...errors import OutputError
from ...model.run_folder.files import AFTER, BEFORE, IMPACT, PICTURE_FOLDER
from ...model.scenario import Scenario
from ...model.scenario.recording import PictureSettings
from ...scene.blast.charges import charge_objects, show_never, show_until
from ...scene.demolition import first_frame_after
from ...scene.rendering.stills import prepared_for_pictures, render_picture
from ...scene.world import START_FRAME
from ...system.disk import writing


def check_camera(view: PictureSettings) -> None:
    """Check that pictures of a scene that is built next can be rendered."""
    if reason := view.why_not_without_window:
        raise OutputError(reason)


def show_charges(scene: bpy.types.Scene, scenario: Scenario) -> None:
    """Show charges in pictures until they go off, and not at all where there is no explosion."""
    for empty, charge in zip(charge_objects(scene), scenario.charges, strict=True):
        if empty.library:  # animated in another file
            continue
        if scenario.blast.explosion:
            show_until(empty, first_frame_after(scenario, scenario.blast.start_s + charge.delay_s))
        else:
            show_never(empty)


def rendered_pictures(
    scene: bpy.types.Scene, folder: Path, view: PictureSettings, key_frame: int, last_frame: int
) -> Iterator[Path]:
    """Render the pictures of a run that was just played into its folder, one by one, and yield their paths."""
    frames = {BEFORE: START_FRAME, IMPACT: key_frame, AFTER: last_frame}
    with writing(folder):
        (folder / PICTURE_FOLDER).mkdir(parents=True, exist_ok=True)
    with prepared_for_pictures(scene, view):
        for name, frame in frames.items():
            path = folder.resolve() / PICTURE_FOLDER / f"{name}.png"
            render_picture(scene, frame, path)
            if not path.exists():
                raise OutputError(f"{path}: Blender wrote no picture; see what it says on its console")
            yield path
