"""The last run of a scene, kept with it, so that a file that is opened again finds what was recorded."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ..display.moments import moments
from ..errors import OutputError
from ..model.results.arrays import Results, load_results
from ..model.results.files import RESULTS_FILE, SUMMARY_FILE
from ..scene.blast.charges import charges_of
from ..scene.blast.settings import blast_of
from ..scene.rendering.markers import mark_moments

_FOLDER, _DIGEST = "bda_run_folder", "bda_run_digest"


def keep_run(scene: bpy.types.Scene, folder: Path, summary: dict[str, Any]) -> None:
    """Keep with a scene where the results of its run are, and what they are known by."""
    scene[_FOLDER], scene[_DIGEST] = str(folder.resolve()), summary["fingerprint"]["result"]


def mark_run(scene: bpy.types.Scene, results: Results, summary: dict[str, Any]) -> None:
    """Mark on the scene's timeline what happened in its run."""
    settings = blast_of(scene)
    charges = charges_of(scene) if settings.explosion else ()
    detonations_s = {each.name: settings.start_s + each.delay_s for each in charges if each.mass_kg > 0.0}
    rest_s = summary.get("came_to_rest_s")
    mark_moments(scene, moments(results, np.array(scene.gravity), detonations_s, rest_s))


def forget_run(scene: bpy.types.Scene) -> None:
    """Keep no run with a scene any more."""
    for name in (_FOLDER, _DIGEST):
        if name in scene:
            del scene[name]


def has_run(scene: bpy.types.Scene) -> bool:
    """Return whether a run is kept with a scene."""
    return _FOLDER in scene


def digest_of_run(scene: bpy.types.Scene) -> str:
    """Return what the results of the run that is kept with a scene are known by."""
    return str(scene.get(_DIGEST))


def is_run_of(scene: bpy.types.Scene, folder: Path) -> bool:
    """Return whether a folder holds the results of the run that is kept with a scene."""
    return has_run(scene) and _digest_in(folder) == scene.get(_DIGEST)


def folder_of_run(scene: bpy.types.Scene) -> Path:
    """Return where the results of the run are that is kept with a scene: its folder, or one that moved with the file.

    Raises
    ------
    OutputError
        They are not there any more, or are of another run by now.
    """
    for folder in _places(Path(str(scene[_FOLDER]))):
        if _digest_in(folder) == scene.get(_DIGEST):
            return folder
    raise OutputError(
        f"{scene[_FOLDER]}: holds the results of this scene's run no more; load them from where they are, or run the "
        "scene again"
    )


def results_of_run(scene: bpy.types.Scene) -> Results:
    """Return the results of the run that is kept with a scene.

    Raises
    ------
    OutputError
        They are not there any more, are of another run by now, or cannot be read.
    """
    return load_results(folder_of_run(scene) / RESULTS_FILE)


def _places(folder: Path) -> Iterator[Path]:
    yield folder
    if bpy.data.filepath:
        beside = Path(bpy.data.filepath).parent
        yield from (beside, beside / folder.name)


def _digest_in(folder: Path) -> str | None:
    """Return what the results in a folder are known by; None where there are none that can be told."""
    try:
        return json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))["fingerprint"]["result"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
