"""Pictures of a run: before it, at the moment that shows most, and at its end."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bpy

from ...errors import GeometryError, OutputError, ScenarioError
from ...model.bridge.preparation import prepared_members
from ...model.run_folder.files import AFTER, BEFORE, IMPACT, PICTURE_FOLDER
from ...model.scenario import Scenario
from ...model.scenario.recording import PictureSettings, Renderer
from ...model.structure.blast_zones import PlacedZone, placed_zones
from ...scene.blast.charges import charge_objects, show_never, show_until
from ...scene.demolition import first_frame_after
from ...scene.rendering.stills import prepared_for_pictures, render_picture
from ...scene.rendering.zone_markers import ShownZone, show_zones
from ...scene.world import START_FRAME
from ...system.disk import writing

_FLASH_S = 0.12


def check_camera(view: PictureSettings) -> None:
    """Check that pictures of a scene that is built next can be rendered."""
    if reason := view.why_not_without_window:
        raise OutputError(reason)


def stage_of_pictures(view: PictureSettings) -> str:
    """Return what a run says before it renders its pictures: how long they take where that is not a moment."""
    if view.renderer == Renderer.CYCLES:
        return "rendering 3 pictures by Cycles, which takes a minute or two"
    return "rendering pictures"


def show_charges(scene: bpy.types.Scene, scenario: Scenario) -> None:
    """Show charges in pictures until they go off, and not at all where there is no explosion."""
    for empty, charge in zip(charge_objects(scene), scenario.charges, strict=True):
        if empty.library:  # animated in another file
            continue
        if scenario.blast.explosion:
            show_until(empty, first_frame_after(scenario, scenario.blast.start_s + charge.delay_s))
        else:
            show_never(empty)


def show_blast_zones(scene: bpy.types.Scene, scenario: Scenario) -> None:
    """Show blast zones in pictures until they fire, with a flash as they do; none where their members are not known."""
    placed: tuple[PlacedZone, ...] = ()
    if scenario.blast_zones:
        try:
            placed = placed_zones(scenario, prepared_members(scenario).members)
        except (GeometryError, ScenarioError):  # files of members may be gone since the scene was built
            placed = ()
    show_zones(scene, [_shown(scenario, one) for one in placed])


def _shown(scenario: Scenario, placed: PlacedZone) -> ShownZone:
    if not (placed.zone.goes_off and scenario.blast.explosion):
        return ShownZone(placed, None)
    fires_s = scenario.blast.start_s + placed.zone.fired_after_s(scenario.seed)
    fired_in, over_in = (first_frame_after(scenario, time_s) for time_s in (fires_s, fires_s + _FLASH_S))
    return ShownZone(placed, fired_in, max(over_in, fired_in + 1))


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
