"""The moving ground: moved in every sub-step, so that the bridge on it feels the velocity of the record.

Contacts and connections follow the velocity of an animated body in Bullet, and its position at the beginning of a
sub-step decides what touches it. So it is put there with the mean velocity of the sub-step, with which a body that
sticks to it follows exactly, and is moved to its end afterwards.
"""

from __future__ import annotations

import numpy as np

from ...bullet.bodies import BodyTable
from ...scene.tools.ground_motion import GroundMotionOfScene
from .drivers import Driver


class GroundDrive(Driver):
    """Moves the bodies (r,) of the ground, and keeps shards (s,) awake: it would not wake those connected to it."""

    def __init__(self, bodies: BodyTable, rows: np.ndarray, shards: np.ndarray, motion: GroundMotionOfScene):
        self._bodies, self._rows, self._shards, self._motion = bodies, rows, shards, motion
        self._positions_m = bodies.positions()[0][rows]
        self._time_s = 0.0
        self._displacement_m = np.zeros(3)

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Move the ground into a sub-step of a length in s."""
        begins = self._time_s - self._motion.start_s
        now, coming = (self._motion.record.displacement_at(time_s) for time_s in (begins, begins + substep_s))
        self._bodies.move_kinematic(self._rows, self._positions_m + now, (coming - now) / substep_s)
        if self._motion.start_s < self._time_s + substep_s and self._time_s < self._motion.end_s:
            self._bodies.wake(self._shards)
        self._displacement_m = coming
        self._time_s += substep_s

    def after_substep(self) -> None:
        """Move the ground to where it is at the end of the sub-step."""
        self._bodies.set_positions(self._rows, self._positions_m + self._displacement_m)
