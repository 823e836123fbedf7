"""Pictures of a run: before it, at the moment that shows most, and at its end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import bpy

from ...errors import GeometryError, OutputError, ScenarioError
from ...model.bridge.preparation import prepared_members
from ...model.results.arrays import load_results
from ...model.run_folder.files import AFTER, BEFORE, IMPACT, PICTURE_FOLDER, SCENARIO_FILE
from ...model.scenario import Scenario
from ...model.scenario.file import read_scenario
from ...model.scenario.recording import PictureSettings, Renderer
from ...model.structure.blast_zones import PlacedZone, placed_zones
from ...scene.blast.charges import charge_objects, show_never, show_until
from ...scene.demolition import first_frame_after
from ...scene.rendering.markers import ShownZone, show_zones
from ...scene.rendering.picture_scene import dressed_pictures
from ...scene.rendering.stills import prepared_for_pictures, render_picture, renderer_of
from ...scene.world import START_FRAME
from ...system.disk import writing
from ...system.processor import processor_count

_FLASH_S = 0.12

PICTURE_NAMES = (BEFORE, IMPACT, AFTER)
_SECONDS_PER_MEGAPIXEL = 65.0
"""That one processor takes by Cycles: 0.5 min for 1280 × 720 px on two."""


def check_camera(view: PictureSettings) -> None:
    """Check that pictures of a scene that is built next can be rendered."""
    if reason := view.why_not_without_window:
        raise OutputError(reason)


def stage_of_pictures(view: PictureSettings) -> str:
    """Return what a run says before it renders its pictures: how long they take where that is not a moment."""
    renderer = renderer_of(view)
    if renderer == Renderer.WORKBENCH:
        return "rendering pictures"
    if renderer == Renderer.REALISTIC:
        return "rendering 3 pictures by EEVEE, which takes some seconds"
    return f"rendering 3 pictures by Cycles, {time_of_cycles_text(view, processor_count())}"


def time_of_cycles_text(view: PictureSettings, count: int) -> str:
    """Return how long the pictures of a run take by Cycles on a number of processors, roughly."""
    needed_s = len(PICTURE_NAMES) * _SECONDS_PER_MEGAPIXEL * view.width_px * view.height_px / 1e6 / count
    rounded = f"{max(1, round(needed_s / 60.0))} min" if needed_s >= 90.0 else f"{max(5, 5 * round(needed_s / 5.0))} s"
    on = "1 processor" if count == 1 else f"{count} processors"
    return f"which takes about {rounded} on {on} with nothing else to do"


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
    with run_renderer(scene, folder, view) as render:
        for name, frame in frames.items():
            path = folder.resolve() / PICTURE_FOLDER / f"{name}.png"
            render(frame, path)
            if not path.exists():
                raise OutputError(f"{path}: Blender wrote no picture; see what it says on its console")
            yield path


@contextmanager
def run_renderer(
    scene: bpy.types.Scene, folder: Path, view: PictureSettings, *, is_captioned: bool = True
) -> Iterator[Callable[[int, Path], None]]:
    """Give what renders a frame of a run to a file: of the scene itself by Workbench, or dressed for looks by others.

    The results of the run are in the folder. `is_captioned` is whether time, scale and what is for looks only stand in
    dressed pictures.
    """
    if renderer_of(view) == Renderer.WORKBENCH:
        with prepared_for_pictures(scene, view):
            yield partial(render_picture, scene)
        return
    pictures = dressed_pictures(
        scene, load_results(folder), view, has_bars=_has_bars(folder), is_captioned=is_captioned
    )
    with pictures as dressed:
        yield dressed.render


def _has_bars(folder: Path) -> bool:
    """Return whether the bridge of a run had reinforcement; False where its scenario is not in its folder."""
    path = folder / SCENARIO_FILE
    return path.is_file() and read_scenario(path).is_reinforced
