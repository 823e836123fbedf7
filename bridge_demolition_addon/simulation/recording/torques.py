"""Torques on bodies, which turn them before Bullet steps: its friction would not see them."""

from __future__ import annotations

import numpy as np

from ...engineering.arithmetic import power


class Torques:
    """Gives bodies (n,) the angular velocities that torques make in a sub-step, in place of the torques.

    Bullet's friction stops what contact points would slip by external forces alone, and leaves torques out
    (`btSequentialImpulseConstraintSolver::setupFrictionConstraint`). Where a connection bends a shard that touches
    something, friction then pushes against a slip that there is not, often along the real one, and makes energy. What
    turns already, it stops. Everything else in Bullet is the same either way.

    `angular_damping` (n,) are the shares of angular velocities that Bullet takes away in a second, before the
    solver: what torques make is larger by that, as Bullet does not damp it. Bodies that lose all keep their torques.
    """

    def __init__(self, angular_damping: np.ndarray):
        self._left_per_second = 1.0 - angular_damping
        self._substep_s, self._times_s = 0.0, np.zeros_like(self._left_per_second)

    def times_s(self, substep_s: float) -> np.ndarray:
        """Return the times (n,) in which torques of a sub-step turn the bodies; once all torques are there."""
        if substep_s != self._substep_s:
            left = power(self._left_per_second, substep_s)
            self._times_s = np.divide(substep_s, left, out=np.full_like(left, np.inf), where=left > 0.0)
            self._substep_s = substep_s
        return self._times_s
