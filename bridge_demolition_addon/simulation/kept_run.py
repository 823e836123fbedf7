"""Runs that are kept in their folder, and with their scene, so that a file that is opened again finds them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import bpy
import numpy as np

from ..display.frames import moments
from ..errors import OutputError
from ..model.results.arrays import RESULTS_FILE, Results, load_results
from ..model.run_folder.files import FORCE_CHART, SCENARIO_FILE
from ..model.run_folder.folder import keep_ground_motion, keep_scenario
from ..model.run_folder.summary import RunSummary, read_summary, result_digest_in, write_summary
from ..model.schema import given
from ..scene.as_built import build_of
from ..scene.blast.charges import blast_of, charges_of
from ..scene.rendering.markers import mark_moments
from .recording.recorder import Recording
from .run_summary import RunContext

_FOLDER, _DIGEST = "bda_run_folder", "bda_run_digest"


class _KeptRun(NamedTuple):
    folder: str
    digest: str
    moments: list[tuple[int, str]]


_runs: dict[tuple[int, str], _KeptRun] = {}
"""The latest run of each building since Blender started, by its scene's number: a run itself is nothing to undo, and
so undo takes what is kept with the scene away."""


def keep_recording(folder: Path, recording: Recording, summary: Mapping[str, Any], context: RunContext) -> None:
    """Write a recording that has ended to its folder, and keep it with its scene."""
    results = recording.results()
    if context.scenario and not (folder / SCENARIO_FILE).exists():  # this folder takes the place of one that was moved
        keep_scenario(folder, context.scenario, context.made_by_hand)
    keep_results(folder, results, summary)
    if motion := context.ground_motion:
        keep_ground_motion(folder, motion.record, motion.start_s)
    recording.remove_stream()
    for scene in bpy.data.scenes:  # undo replaces scenes; none where it was deleted, or another file was loaded
        if scene.session_uid == recording.scene_uid:
            _keep_with_scene(scene, recording.build, folder, results, RunSummary.of(summary))


def keep_results(folder: Path, results: Results, summary: Mapping[str, Any]) -> None:
    """Write arrays, summary and force chart of a recording to the folder of its logs."""
    results.save(folder / RESULTS_FILE)
    write_summary(folder, summary)
    # Loading matplotlib takes a second, for which neither other commands nor switching the add-on on should wait. If it
    # is missing or broken, the results are written by now.
    from ..charts.histories import plot_forces

    plot_forces(results, folder / FORCE_CHART, summary["title"], RunSummary.of(summary).first_hit_s)


def adopt_run(scene: bpy.types.Scene, folder: Path) -> Results:
    """Keep the run in a folder with a scene that is built as its own was, and return what was recorded."""
    try:
        summary = read_summary(folder)
    except ValueError as error:
        raise OutputError(f"{folder}: its summary cannot be read: {error}") from error
    results = load_results(folder / RESULTS_FILE)
    _keep_with_scene(scene, build_of(scene), folder, results, summary)
    return results


def recall_run(scene: bpy.types.Scene) -> None:
    """Keep again with a scene the latest run of what it shows, if undo or redo took it away."""
    kept = _runs.get((scene.session_uid, build_of(scene))) if scene.rigidbody_world else None
    if kept and scene.get(_DIGEST) != kept.digest:
        _mark_run(scene, kept)


def _keep_with_scene(scene: bpy.types.Scene, build: str, folder: Path, results: Results, summary: RunSummary) -> None:
    """Keep the run of a building, with the scene if it still shows that one."""
    kept = _KeptRun(str(folder.resolve()), summary.result_digest, _moments_of(scene, results, summary))
    _runs[scene.session_uid, build] = kept
    if build == build_of(scene):
        _mark_run(scene, kept)


def _mark_run(scene: bpy.types.Scene, kept: _KeptRun) -> None:
    """Name a run in the properties of its scene, and its events on the timeline."""
    scene[_FOLDER], scene[_DIGEST] = kept.folder, kept.digest
    mark_moments(scene, kept.moments)


def _moments_of(scene: bpy.types.Scene, results: Results, summary: RunSummary) -> list[tuple[int, str]]:
    settings = blast_of(scene)
    charges = [charge for charge in charges_of(scene) if charge.mass_kg > 0.0] if settings.explosion else []
    detonations_s = {given(charge.name): settings.start_s + charge.delay_s for charge in charges}
    return list(moments(results, np.array(scene.gravity), detonations_s, summary.came_to_rest_s))


def forget_run(scene: bpy.types.Scene) -> None:
    """Keep no run with a scene any more."""
    for name in (_FOLDER, _DIGEST):
        if name in scene:
            del scene[name]


def has_run(scene: bpy.types.Scene) -> bool:
    """Return whether a run is kept with a scene."""
    return _FOLDER in scene


def digest_of_run(scene: bpy.types.Scene) -> str:
    """Return the digest of the results of the run that is kept with a scene."""
    return str(scene.get(_DIGEST))


def is_run_of(scene: bpy.types.Scene, folder: Path) -> bool:
    """Return whether a folder holds the results of the run that is kept with a scene."""
    return has_run(scene) and result_digest_in(folder) == scene.get(_DIGEST)


def folder_of_run(scene: bpy.types.Scene) -> Path:
    """Return the folder with the results of the run kept with a scene, or a folder that moved with the file."""
    kept = Path(str(scene[_FOLDER]))
    beside = Path(bpy.data.filepath).parent
    for folder in (kept, beside, beside / kept.name) if bpy.data.filepath else (kept,):
        if result_digest_in(folder) == scene.get(_DIGEST):
            return folder
    raise OutputError(
        f"{kept}: holds the results of this scene's run no more; load them from where they are, or run the scene again"
    )


def results_of_run(scene: bpy.types.Scene) -> Results:
    """Return the results of the run that is kept with a scene; raises an `OutputError` if they cannot be read."""
    return load_results(folder_of_run(scene) / RESULTS_FILE)
