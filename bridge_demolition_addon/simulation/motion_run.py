"""A run that records motion and breaking alone, as in a study: no loads, no logs, no pictures, no scene."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import bpy

from ..model.results.arrays import Results
from ..model.run_folder.summary import RunSummary
from ..model.scenario import Scenario
from ..model.sequence.ending import left_alone
from ..model.structure.model import Model, build_model
from ..scene.demolition import build_demolition
from ..system.signals import interrupted_afterwards
from .playback import Playing, play_alone
from .recording.recorder import Recording
from .run_summary import RunContext, rest_watch, run_summary


@contextmanager
def motion_run(
    scenario: Scenario, model: Model, folder: Path, after_frame: Callable[[Playing], None] | None = None
) -> Iterator[tuple[Results, dict[str, Any]]]:
    """Simulate a scenario in an otherwise empty Blender file, and return results and summary, which last for the block.

    Motion and breaking have the same bits as in `run_scenario`; loads and work are unknown. Frames are kept in an
    existing folder during the block. `after_frame` looks on after each frame; what it raises ends the run.
    """
    with interrupted_afterwards():
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)  # add-ons stay: this may be one
    scene = bpy.context.scene
    build_demolition(scene, scenario, model)
    context = RunContext.of(scene, scenario.title, scenario)
    rest = rest_watch(scenario, context.ground_motion) if scenario.time.stop_at_rest else None
    recording = Recording(scene, folder, every_substep=scenario.recording.every_substep, loads=False)
    try:
        play_alone(recording, rest, after_frame)
        results = recording.results()
        yield results, run_summary(recording, results, context, completed=True)
    finally:
        recording.forget()


def left_alone_run(scenario: Scenario) -> RunSummary:
    """Return the summary of a run in which nothing is done to the bridge, which is awake; no file of it is kept."""
    alone = left_alone(scenario)
    with TemporaryDirectory(prefix="bda-awake-") as folder, motion_run(alone, build_model(alone), Path(folder)) as run:
        return RunSummary.of(run[1])
