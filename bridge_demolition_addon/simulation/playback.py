"""Playing a scene's timeline once, from its start frame to its last, and recording it, a frame at a time."""

from __future__ import annotations

import time
from collections.abc import Callable

import bpy
import numpy as np

from ..engineering.geometry.vectors import length
from ..engineering.timing.time_left import Pace, speeds_to_come
from ..engineering.timing.timeline import substeps_within
from ..errors import SimulationError
from ..model.results.frames import Frame
from ..model.sequence.ending import Rest
from ..scene.world import farthest_per_substep_of, start_over, time_step_at
from .blender_events import running_recording, start_recording, stop_recording
from .recording.recorder import Recording


class Workload:
    """Sub-steps that are still to come in a run, as its bodies move now: they all take equally long, frames do not.

    The run is from the first to the last frame, without the start frame.
    """

    def __init__(self, scene: bpy.types.Scene, first: int, last: int) -> None:
        self._first = first
        steps = [time_step_at(scene, frame) for frame in range(first, last + 1)]
        self._frames_s = np.array([step.frame_s for step in steps])
        self._fewest = np.array([step.substeps_per_frame for step in steps])
        self._ends_s = np.cumsum(self._frames_s)
        self._farthest_m = farthest_per_substep_of(scene)
        gravity = np.array(scene.gravity, float) if scene.use_gravity else np.zeros(3)
        self._gravity_m_s2 = float(length(gravity))

    def to_come(self, frame: Frame) -> float:
        """Return how many sub-steps follow after a frame."""
        rows = slice(frame.number + 1 - self._first, None)
        frames_s, fewest, ends_s = self._frames_s[rows], self._fewest[rows], self._ends_s[rows]
        if self._farthest_m is None or not len(fewest) or not self._gravity_m_s2:
            return float(fewest.sum())
        after_s = ends_s - ends_s[0]
        speeds = speeds_to_come(frame.positions_m[:, 2], frame.velocities_m_s, self._gravity_m_s2, after_s)
        return float(substeps_within(frames_s, fewest, self._farthest_m, speeds, self._gravity_m_s2).sum())


class Playing:
    """One pass through a scene's timeline, with a recording that is not started yet.

    Parameters
    ----------
    stop_at
        The rest at which to end before the last frame of the scene, or of its simulation where that ends before.
    alone
        Whether the scene cannot be edited meanwhile, so that it need not be guarded.

    Attributes
    ----------
    total, done
        Frames to play, without the start frame, and frames played.
    seconds, longest_frame_s
        Wall time of the frames with the start frame, and of the longest after it.
    left_s
        Wall time that the remaining frames take, with the time between frames; None before the third frame.
    """

    def __init__(self, recording: Recording, stop_at: Rest | None = None, *, alone: bool = False):
        self.recording = recording
        self._rest = stop_at
        self._scene = recording.scene
        self.total, self.done = frames_to_play(self._scene), 0
        self.longest_frame_s, began = 0.0, time.perf_counter()
        self.left_s: float | None = None
        start_recording(recording, alone=alone)
        start_over(self._scene)
        self.seconds = time.perf_counter() - began
        first = self._scene.rigidbody_world.point_cache.frame_start + 1
        self._workload = Workload(self._scene, first, first + self.total - 1)
        self._stepping, self._between = Pace(), Pace()
        self._stepped_at_s: float | None = None

    @property
    def finished(self) -> bool:
        """Whether the last frame has been played, or everything rests."""
        return self.done == self.total or self.at_rest

    @property
    def at_rest(self) -> bool:
        """Whether everything rests as the scenario waits for."""
        return self._rest is not None and self._rest.is_reached

    def step(self) -> None:
        """Play the next frame, or raise the error for which the recording has ended."""
        self._check_recording()
        began = time.perf_counter()
        self._scene.frame_set(self._scene.rigidbody_world.point_cache.frame_start + self.done + 1)
        took = time.perf_counter() - began
        self.seconds += took
        self.longest_frame_s = max(self.longest_frame_s, took)
        self.done += 1
        self._check_recording()
        self._judge_time(began, took)
        if self._rest and self.recording.recorded_frames:
            self._rest.observe(*self.recording.motion())

    def _judge_time(self, began_s: float, took_s: float) -> None:
        """Note how long the last frame took, and estimate how long those to come take."""
        if self._stepped_at_s is not None:  # not the first frame, in which Blender makes its world
            self._stepping.note(took_s, self.recording.substeps)
            self._between.note(began_s - self._stepped_at_s)
            if last := self.recording.last:
                substeps, frames = self._workload.to_come(last), self.total - self.done
                in_steps_s, between_s = self._stepping.left_s(substeps), self._between.left_s(frames)
                if in_steps_s is not None and between_s is not None:
                    self.left_s = in_steps_s + between_s
        self._stepped_at_s = began_s + took_s

    def end(self) -> None:
        """End the recording."""
        if running_recording() is self.recording:
            stop_recording()

    def _check_recording(self) -> None:
        if self.recording.error:
            raise self.recording.error
        if running_recording() is not self.recording:
            raise SimulationError("another program ended the recording")


def play_alone(
    recording: Recording, stop_at: Rest | None = None, after_frame: Callable[[Playing], None] | None = None
) -> None:
    """Play all frames of a scene that cannot be edited meanwhile, and end the recording.

    `after_frame` looks on after each; what it raises ends the run.
    """
    playing = Playing(recording, stop_at, alone=True)
    try:
        while not playing.finished:
            playing.step()
            if after_frame:
                after_frame(playing)
    finally:
        playing.end()
    if recording.error:
        raise recording.error


def frames_to_play(scene: bpy.types.Scene) -> int:
    """Return how many frames a scene has to play, at least one, without the start frame."""
    cache = scene.rigidbody_world.point_cache
    last = min(scene.frame_end, cache.frame_end)
    if last <= cache.frame_start + 1:
        raise SimulationError(f"nothing to play: the last frame, {last}, is not after frame {cache.frame_start + 1}")
    return last - cache.frame_start
