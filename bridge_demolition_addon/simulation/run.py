"""A run from beginning to end: scenario, model, scene, simulation, results in a folder."""

from __future__ import annotations

import gc
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import bpy

from ..display.camera_targets import points_to_see
from ..display.contours import ContourSettings
from ..engineering.core.library import missing_core
from ..errors import DemolitionError, SimulationError, text_of
from ..model.results.arrays import FRAMES_FILE
from ..model.run_folder.files import BLEND_FILE
from ..model.run_folder.folder import check_folder, keep_scenario, lock_in_place, prepare_folder
from ..model.run_folder.summary import write_summary
from ..model.scenario import Scenario
from ..model.scenario.contact_facts import own_values_sentence
from ..model.scenario.recording import PictureSettings
from ..model.sequence.checked_model import checked_model
from ..model.sequence.ending import only_motion_text
from ..model.sequence.lifts import pick_warnings
from ..model.stages.stability import stability_of
from ..model.structure.model import Model
from ..scene.as_built import keep_stability
from ..scene.demolition import build_demolition
from ..scene.rendering.stills import prepare_scene_for_pictures
from ..scene.rendering.surroundings import stage
from ..scene.tools.ground_motion import ground_motion_of
from ..scene.world import keep_played_frames
from ..system.native_output import without_noise
from ..system.progress import Progress
from ..system.signals import Interrupted, interrupted_afterwards, signals_noted
from .display.film import FilmRendering, FilmSettings
from .display.pictures import check_camera, rendered_pictures, show_blast_zones, show_charges, stage_of_pictures
from .kept_run import keep_recording
from .playback import Playing
from .recording.recorder import Recording
from .run_summary import RunContext, rest_watch, run_summary

_END_OF_PACKED = (0x8F92EAB1).to_bytes(4, "little")
"""Last bytes of a packed file of Blender: the mark at the end of a seek table (Zstandard Seekable Format 0.1.0)."""

SLOW_MOTION = 5.0
"""Seconds of the slower film for a second of the simulation."""


def run_scenario(
    scenario: Scenario,
    output: Path,
    *,
    overwrite: bool,
    pictures: bool,
    progress: Progress,
    film: bool = False,
    model: Model | None = None,
) -> dict[str, Any]:
    """Simulate a scenario in a new, otherwise empty Blender file, keep everything in a folder and return its summary.

    Parameters
    ----------
    output
        Folder for the results; made here.
    overwrite
        Whether results of an earlier run in that folder may be replaced.
    film
        Whether to render a film of the contours, in real time and in slow motion, which takes a second or more for
        every frame without a graphics card.
    model
        Its model, if it is built already.
    """
    check_folder(output, overwrite=overwrite)
    if pictures or film:
        check_camera(scenario.pictures)
    if (missing := missing_core()) and scenario.connections.is_elastic:
        raise SimulationError(missing.needed_by("elastic connections need"))
    lap_s = _laps()
    progress.stage("building the bridge and its shards")
    if of_bodies := own_values_sentence(scenario):
        progress.stage(f"friction and restitution are given {of_bodies}")
    model = model or checked_model(scenario)
    stability = stability_of(scenario, model, with_factor=False)
    progress.stage(stability.sentence)
    if stability.is_asleep:
        progress.stage(stability.asleep_sentence)
    for warning in pick_warnings(scenario.lifts, model):
        progress.stage(warning)
    with ExitStack() as locks:
        lock = locks.enter_context(prepare_folder(output, overwrite=overwrite))
        keep_scenario(lock.folder, scenario)
        scene = _empty_scene(scenario.title)
        shards = build_demolition(scene, scenario, model)
        keep_stability(scene, stability.to_json())
        _prepare_view(scene, scenario, model, shards)
        times = {"building": lap_s()}
        progress.stage(f"simulating {len(model.shards)} shards and {len(model.connections)} connections")
        context = RunContext.of(scene, scenario.title, scenario)
        with signals_noted() as signals, _model_not_searched():
            playing = _simulate(scene, lock.folder, scenario, progress, signals)
            recording = playing.recording
            times |= {"blender": playing.seconds - recording.seconds, "recording": recording.seconds}
            times["starting_and_ending"] = lap_s() - playing.seconds
            if recording.only_motion_because:
                progress.stage(only_motion_text(recording.only_motion_because))
            elif recording.rigid_because:
                progress.stage(f"connections were rigid, as they cannot be elastic here: {recording.rigid_because}")
            is_whole = not (signals or progress.is_stopped or recording.error)
            summary = run_summary(recording, recording.results(), context, completed=is_whole)
            summary["density_kg_m3"] = model.density_kg_m3
            summary["members_kg"] = {member.name: member.mass_kg for member in model.members}
            times["summary"] = lap_s()
            summary["wall_time_s"] = times
            progress.stage("writing the results")
            with _results_of_failure(recording.error, lock.folder):
                kept = locks.enter_context(lock_in_place(lock))
                keep_recording(kept.folder, recording, summary, context)
                _save_scene(scene, kept.folder)
                times["results"] = lap_s()
                locks.callback(recording.forget)  # its files are gone when the folder is free, on Windows too
        if recording.error:
            raise SimulationError(f"{recording.error}; the results up to then are in {kept.folder}")
        if kept is not lock:
            moved = f"{lock.folder}: was moved or deleted, and the logs with it"
            raise SimulationError(f"{moved}; the results are in {kept.folder}")
        if signals:
            raise Interrupted(signals[0])
        if progress.is_stopped:
            return summary
        if pictures:
            progress.stage(stage_of_pictures(scenario.pictures))
            key_frame = summary["key_frame"]["frame"]
            list(rendered_pictures(scene, lock.folder, scenario.pictures, key_frame, scene.frame_end))
            times["pictures"] = lap_s()
        if film:
            progress.stage("rendering the film")
            _render_film(scene, lock.folder, scenario.pictures, progress)
            times["film"] = lap_s()
        if not lock.in_place:
            raise SimulationError(f"{lock.folder}: was moved or deleted before all pictures were in it")
        write_summary(lock.folder, summary)  # again, with all times
    return summary


def _laps() -> Callable[[], float]:
    """Return a function that returns the wall time since it was last called, s."""
    last_s = time.perf_counter()

    def lap_s() -> float:
        nonlocal last_s
        passed_s = time.perf_counter() - last_s
        last_s += passed_s
        return passed_s

    return lap_s


def _save_scene(scene: bpy.types.Scene, folder: Path) -> None:
    keep_played_frames(scene)
    path = folder.resolve() / BLEND_FILE
    try:  # Blender itself writes next to it and renames
        with without_noise():
            bpy.ops.wm.save_as_mainfile(filepath=str(path), check_existing=False, compress=True)
    except RuntimeError as error:
        raise SimulationError(f"{path}: Blender could not write it: {error}") from error
    if not _is_whole(path):  # Blender does not say so where the disk is full
        path.unlink(missing_ok=True)
        raise SimulationError(f"{path}: Blender could not write all of it, as where the disk is full; it was removed")


def _is_whole(path: Path) -> bool:
    """Return whether a packed file of Blender is there to its end: the table by which it is read in parts."""
    with path.open("rb") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(size - len(_END_OF_PACKED), 0))
        return file.read() == _END_OF_PACKED


@contextmanager
def _results_of_failure(error: Exception | None, folder: Path) -> Iterator[None]:
    """Report both errors if saving fails after a failed run."""
    try:
        yield
    except (DemolitionError, OSError) as failure:
        if error is None:
            raise
        left = f"the frames up to then are in {folder}, " if (folder / FRAMES_FILE).is_file() else ""
        raise SimulationError(f"{error}; {left}the results could not be kept: {text_of(failure)}") from failure


def _render_film(scene: bpy.types.Scene, folder: Path, view: PictureSettings, progress: Progress) -> None:
    film = FilmRendering(scene, folder, ContourSettings(), FilmSettings(slow_motion=SLOW_MOTION, view=view))
    for done, _ in enumerate(film.pictures(), start=1):
        progress.part(done, film.picture_count, "frames rendered")
    film.finish()


def _empty_scene(title: str) -> bpy.types.Scene:
    with interrupted_afterwards():
        # Not the factory's preferences too: with them Blender deletes the libraries of the user's extensions.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.name = title[:60]
    return scene


def _prepare_view(scene: bpy.types.Scene, scenario: Scenario, model: Model, shards: Sequence[bpy.types.Object]) -> None:
    prepare_scene_for_pictures(scene, scenario.pictures)
    stage(scene, shards, model, points_to_see(scenario, model.members), scenario.pictures)
    show_charges(scene, scenario)
    show_blast_zones(scene, scenario)


@contextmanager
def _model_not_searched() -> Iterator[None]:
    """Leave out what was built where Python looks for memory to free: 4 % of a run went into looking through it."""
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()


def _simulate(
    scene: bpy.types.Scene, folder: Path, scenario: Scenario, progress: Progress, signals: Sequence[int]
) -> Playing:
    """Play the timeline once, until it is stopped or fails; a scene that stops at rest ends with that frame."""
    rest = rest_watch(scenario, ground_motion_of(scene)) if scenario.time.stop_at_rest else None
    asked = scenario.recording
    recording = Recording(scene, folder, every_substep=asked.every_substep, contacts=asked.contacts)
    playing = Playing(recording, stop_at=rest)
    try:
        while not playing.finished and not ((signals or progress.is_stopped) and recording.recorded_frames):
            playing.step()
            if recording.recorded_frames > 1:
                done = recording.recorded_frames - 1
                progress.frame(done, playing.total - 1, recording.counts, playing.left_s)
    except Exception:
        if not (recording.error and recording.recorded_frames):  # or there is something to keep
            raise
    finally:
        playing.end()
    if playing.at_rest:
        scene.frame_end = scene.frame_current
    return playing
