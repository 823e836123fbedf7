"""Playing a scene's timeline once, from its start frame to its last, and recording it, a frame at a time."""

from __future__ import annotations

import time

import bpy

from ..engineering.timing.time_left import Pace
from ..errors import SimulationError
from ..model.sequence.rest import Rest
from ..scene.world import start_over
from .blender_events import running_recording, start_recording, stop_recording
from .recording.recorder import Recording
from .workload import Workload


class Playing:
    """One pass through a scene's timeline.

    Parameters
    ----------
    recording
        What follows it, not started yet.
    stop_at
        The rest at which to end before the last frame of the scene, or of its simulation where that ends before.
    alone
        Whether nobody can edit the scene meanwhile, so that it need not be guarded against that.

    Attributes
    ----------
    total
        Frames to play, without the start frame.
    done
        Frames played.
    seconds, longest_frame_s
        Wall time of all of them, and of the one that took longest.
    left_s
        Time on the clock that the rest takes, what happens between the frames included; None before the third frame.

    Raises
    ------
    SimulationError
        The scene has no frames to play.
    """

    def __init__(self, recording: Recording, stop_at: Rest | None = None, *, alone: bool = False):
        self.recording = recording
        self._rest = stop_at
        self._scene = recording.scene
        self.total = frames_to_play(self._scene)
        self.done = 0
        self.longest_frame_s = 0.0
        self.seconds = 0.0
        self.left_s: float | None = None
        start_recording(recording, alone=alone)
        start_over(self._scene)
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
        """Whether everything rests as it was waited for."""
        return self._rest is not None and self._rest.is_reached

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
        self.seconds += took
        self.longest_frame_s = max(self.longest_frame_s, took)
        self.done += 1
        self._see_whether_recorded()
        self._judge_time(began, took)
        if self._rest and self.recording.recorded_frames:
            self._rest.observe(*self.recording.motion())

    def _judge_time(self, began_s: float, took_s: float) -> None:
        """Note how long the last frame took, and judge how long those to come take."""
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
        """End the recording, and leave it at its logs."""
        if running_recording() is self.recording:
            stop_recording()

    def _see_whether_recorded(self) -> None:
        if self.recording.error:
            raise self.recording.error
        if running_recording() is not self.recording:
            raise SimulationError("the recording was ended by someone else")


def play_alone(recording: Recording, stop_at: Rest | None = None) -> None:
    """Play all frames of a scene that nobody can edit meanwhile, and end the recording."""
    playing = Playing(recording, stop_at, alone=True)
    try:
        while not playing.finished:
            playing.step()
    finally:
        playing.end()
    if recording.error:
        raise recording.error


def frames_to_play(scene: bpy.types.Scene) -> int:
    """Return how many frames a scene has to play, without the start frame.

    Raises
    ------
    SimulationError
        There are none.
    """
    cache = scene.rigidbody_world.point_cache
    last = min(scene.frame_end, cache.frame_end)
    if last <= cache.frame_start + 1:
        raise SimulationError(f"nothing to play: the last frame, {last}, is not after frame {cache.frame_start + 1}")
    return last - cache.frame_start
