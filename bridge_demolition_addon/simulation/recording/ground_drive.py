"""The moving ground: moved in every sub-step, so that what stands on it feels the velocity of the record.

Bullet takes the velocity of an animated body for what contacts and connections have to follow. Where that body stands
at the beginning of a sub-step decides what touches it. So it is put there with the mean velocity of the sub-step, with
which a body that sticks to it comes along exactly, and is moved to its end afterwards.
"""

from __future__ import annotations

import numpy as np

from ...bullet.bodies import BodyTable
from ...scene.tools.ground_motion import GroundMotionOfScene
from .drivers import Driver


class GroundDrive(Driver):
    """Moves the ground.

    Parameters
    ----------
    bodies : BodyTable
    rows : (r,) int
        Bodies that move with the ground.
    shards : (s,) int
        Bodies that stay awake meanwhile: the ground would not wake what is connected to it.
    motion : GroundMotionOfScene
    """

    def __init__(self, bodies: BodyTable, rows: np.ndarray, shards: np.ndarray, motion: GroundMotionOfScene):
        self._bodies, self._rows, self._shards, self._motion = bodies, rows, shards, motion
        self._positions = bodies.positions()[0][rows]
        self._time_s = 0.0
        self._shift = np.zeros(3)

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Move the ground into a sub-step of a length in s."""
        begins = self._time_s - self._motion.start_s
        now, coming = (self._motion.record.displacement_at(time_s) for time_s in (begins, begins + substep_s))
        self._bodies.move_kinematic(self._rows, self._positions + now, (coming - now) / substep_s)
        if self._motion.start_s < self._time_s + substep_s and self._time_s < self._motion.end_s:
            self._bodies.wake(self._shards)
        self._shift = coming
        self._time_s += substep_s

    def after_substep(self) -> None:
        """Move the ground to where it is at the end of the sub-step."""
        self._bodies.set_positions(self._rows, self._positions + self._shift)
