"""Playing a scene's timeline once, from its start frame to its last, and recording it, a frame at a time."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ..core.errors import SimulationError
from ..core.summary import summarise
from ..scene.world import scene_time_step
from . import handlers
from .output import keep_results
from .recording import Recording


class Playing:
    """One pass through a scene's timeline.

    Parameters
    ----------
    scene
        Scene with a rigid-body world.
    folder
        Existing folder for logs and results.
    title
        Title of the results.
    last_frame
        Frame to end with; the last one of the scene, or of its simulation where that ends before, unless given.

    Attributes
    ----------
    recording
        What is recorded.
    total
        Frames to play, without the start frame.
    done
        Frames played.
    longest_frame_s
        Wall time of the frame that took longest.

    Raises
    ------
    SimulationError
        The scene cannot be recorded, or has no frames to play.
    """

    def __init__(self, scene: bpy.types.Scene, folder: Path, title: str, last_frame: int | None = None):
        cache = scene.rigidbody_world.point_cache if scene.rigidbody_world else None
        self.recording = Recording(scene, folder)
        last = min(scene.frame_end, cache.frame_end) if last_frame is None else last_frame
        if last <= cache.frame_start + 1:
            raise SimulationError(
                f"nothing to play: the last frame, {last}, is not after frame {cache.frame_start + 1}"
            )
        self.total = last - cache.frame_start
        self.done = 0
        self.longest_frame_s = 0.0
        self._scene, self._title = scene, title
        self._gravity = np.array(scene.gravity)
        self._substep_s = scene_time_step(scene).substep_s
        self._seconds = 0.0
        handlers.start(self.recording)
        start_over(scene)

    @property
    def finished(self) -> bool:
        """Whether the last frame has been played."""
        return self.done == self.total

    @property
    def remaining_s(self) -> float:
        """Wall time that the frames still to come take, if they take as long as those so far."""
        return self._seconds / self.done * (self.total - self.done) if self.done else 0.0

    def step(self) -> None:
        """Play the next frame.

        Raises
        ------
        DemolitionError
            The recording has ended, for the reason that is raised.
        """
        self._see_whether_recorded()
        began = time.perf_counter()
        self._scene.frame_set(self._scene.rigidbody_world.point_cache.frame_start + self.done + 1)
        took = time.perf_counter() - began
        self._seconds += took
        self.longest_frame_s = max(self.longest_frame_s, took)
        self.done += 1
        self._see_whether_recorded()

    def end(self) -> dict[str, Any]:
        """End the recording and write what there is of it.

        Returns
        -------
        dict
            The content of ``summary.json``.

        Raises
        ------
        SimulationError
            Nothing was recorded.
        """
        self.abandon()
        results = self.recording.results()
        summary = {
            "title": self._title,
            "completed": self.finished and not self.recording.error,
            "blender": bpy.app.version_string,
            "substep_s": self._substep_s,
            **summarise(results, self._gravity),
        }
        keep_results(self.recording.folder, results, summary)
        return summary

    def abandon(self) -> None:
        """End the recording, and leave it at its logs."""
        if handlers.current() is self.recording:
            handlers.stop()

    def _see_whether_recorded(self) -> None:
        if self.recording.error:
            raise self.recording.error
        if handlers.current() is not self.recording:
            raise SimulationError("the recording was ended by someone else")


def start_over(scene: bpy.types.Scene) -> None:
    """Go to the start frame, and have frames that were played before simulated anew instead of played back."""
    world = scene.rigidbody_world
    world.substeps_per_frame = world.substeps_per_frame  # Blender takes any setting for a change
    scene.frame_set(world.point_cache.frame_start)
