"""When everything has come to rest."""

from __future__ import annotations

import math

import numpy as np

from ...engineering.geometry.vectors import distance
from ..scenario import Scenario

FASTEST = 10.0
"""A single body may be so many times as fast as the limit for all: at the usual 0.5 m/s what slides with a friction of
0.5 comes to rest within v² / 2μg = 25 mm, and what falls is faster within 0.05 s."""


class Rest:
    """Find frame by frame whether everything rests, and since when.

    By energy: everything rests while its kinetic energy per mass is below that of bodies which all move at the speed
    limit, v² / 2, and no body is `FASTEST` times as fast. So one that creeps on a contact does not keep a run alive,
    and one that flies does. A rotation at the limit of angular velocity counts as much as that speed; what sleeps rests
    anyway. Everything has to rest for `hold_s`; before `not_before_s` no rest counts, as something is still to happen.
    Speeds come from positions and rotations of two frames, so that a solver's trembling within a frame is not motion.
    """

    def __init__(self, speed_m_s: float, angular_velocity_rad_s: float, hold_s: float, not_before_s: float):
        self.since_s: float | None = None  # None while anything moves
        self._limits = speed_m_s, angular_velocity_rad_s
        self._hold_s, self._not_before_s = hold_s, not_before_s
        self._last: tuple[float, np.ndarray, np.ndarray] | None = None
        self._time_s = 0.0

    def observe(
        self,
        time_s: float,
        positions_m: np.ndarray,
        rotations: np.ndarray,
        asleep: np.ndarray,
        masses_kg: np.ndarray,
    ) -> None:
        """Look at a frame: its time, and positions (n, 3), rotations (n, 3, 3), sleep (n,) and masses of all bodies."""
        if self._last and time_s > self._last[0]:
            before_s, before_m, before = self._last
            step_s = time_s - before_s
            speeds = distance(positions_m, before_m) / step_s
            # A rotation by a small angle φ changes the matrix by √2 φ in the Frobenius norm.
            angular_velocities = distance(rotations.reshape(-1, 9), before.reshape(-1, 9)) / (np.sqrt(2.0) * step_s)
            shares = speeds / self._limits[0], angular_velocities / self._limits[1]
            squares = shares[0] * shares[0] + shares[1] * shares[1]
            if not _rest(np.where(asleep, 0.0, squares), masses_kg) or before_s < self._not_before_s:
                self.since_s = None
            elif self.since_s is None:
                self.since_s = before_s
        self._last = time_s, positions_m, rotations
        self._time_s = time_s

    @property
    def is_reached(self) -> bool:
        """Return whether everything has been at rest for long enough."""
        return self.came_to_rest_s is not None

    @property
    def came_to_rest_s(self) -> float | None:
        """Return since when everything rests, where it has for long enough; None where it has not."""
        if self.since_s is None or self._time_s - self.since_s < self._hold_s * (1.0 - 1e-6):
            return None
        return self.since_s


def _rest(squares: np.ndarray, masses_kg: np.ndarray) -> bool:
    """Return whether bodies rest, by the squares (n,) of their speeds over the limit; what has no mass is not moved."""
    moved = masses_kg > 0.0
    if (squares[moved] >= FASTEST * FASTEST).any():
        return False
    return bool((masses_kg[moved] * squares[moved]).sum() < masses_kg[moved].sum() or not moved.any())


def last_event_s(scenario: Scenario, motion_end_s: float = 0.0) -> float:
    """Return the time after which a scenario plans nothing more, s; the ground stops moving at `motion_end_s`."""
    ends_s = (action.ends_s(scenario) for action in scenario.actions)
    return max(motion_end_s, scenario.connections.warm_up_s, *filter(math.isfinite, ends_s))
