"""Motion of all bodies before a sub-step, with the forces that act in it, copied at once; components come first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import LayoutError
from .layout import SLEEPING, Layout
from .memory import DOUBLES, INTEGERS, Fields, field_loops

_VECTOR = 8 * np.arange(3)
_SLEEPING = tuple(SLEEPING)

SYMMETRIC = 1e-9

_WRONG_INERTIA = "the inertia of a body is not as expected"


@dataclass(frozen=True, slots=True, eq=False)
class BodyMotion:
    """Motion of n bodies: positions (3, n), rotations (3, 3, n), velocities and angular velocities (6, n).

    Attributes
    ----------
    inverse_masses
        (n,) 1/kg; 0 for bodies that do not move freely.
    load_components
        (6, n) forces and torques, with the weight, that act in the coming sub-step.
    asleep
        (n,) whether each is not simulated.
    """

    position_components_m: np.ndarray
    rotation_components: np.ndarray
    velocity_components: np.ndarray
    inverse_masses: np.ndarray
    load_components: np.ndarray
    asleep: np.ndarray


class BodyMotionReader:
    """Reads and moves the bodies (n,) of a world that was checked, by their addresses."""

    def __init__(self, layout: Layout, bodies: np.ndarray):
        body = layout.body
        transform = [body.transform + 32 * row + _VECTOR for row in range(4)]
        vectors = [body.linear_velocity, body.angular_velocity, body.total_force, body.total_torque]
        offsets: list[Any] = [*transform, *(start + _VECTOR for start in vectors), [body.inverse_mass]]
        self._bodies, self._body = bodies, body
        self._motion = Fields(bodies, np.concatenate(offsets))
        self._inertia = Fields(bodies, np.concatenate([body.inverse_inertia + 32 * row + _VECTOR for row in range(3)]))
        self._torques = Fields(bodies, body.total_torque + _VECTOR)
        self._loads = Fields(bodies, np.concatenate((body.total_force + _VECTOR, body.total_torque + _VECTOR)))
        self._spins = Fields(bodies, body.angular_velocity + _VECTOR)
        self._states = Fields(bodies, [body.activation], INTEGERS)
        turning = self._inertia, self._torques, self._spins, self._states
        self._turning = tuple(fields.places for fields in turning)

    def read(self) -> BodyMotion:
        """Return how all bodies move."""
        values = self._motion.copy()
        rotations = values[:9].reshape(3, 3, -1)
        return BodyMotion(values[9:12], rotations, values[12:18], values[24], values[18:24], self._asleep())

    def inverse_inertia_components(self) -> np.ndarray:
        """Return the inverse tensors of inertia (3, 3, n) in the axes of the world, 1/(kg·m²)."""
        tensors = self._inertia.copy().reshape(3, 3, -1)
        loops = field_loops()
        if not (are_inertias(tensors) if loops is None else loops.are_inertias(tensors, SYMMETRIC)):
            raise LayoutError(_WRONG_INERTIA)
        return tensors

    def push(self, motion: BodyMotion, impulses: np.ndarray, substep_s: float) -> None:
        """Give bodies that move freely impulses (6, n) in the coming sub-step, beside the loads of their motion."""
        loops, loads = field_loops(), motion.load_components
        if loops is not None:
            moving = loads, motion.inverse_masses, impulses
            loops.push(DOUBLES.everywhere, *self._loads.places, *moving, substep_s)
            return
        rows, body = np.flatnonzero(impulses.any(axis=0) & (motion.inverse_masses > 0.0)), self._body
        pushed = loads[:, rows] + impulses[:, rows] / substep_s
        self._write([body.total_force + _VECTOR, body.total_torque + _VECTOR], rows, pushed)

    def turn_by_torques(self, times_s: np.ndarray) -> None:
        """Change the angular velocities of bodies that are awake by what torques do in times (n,), and end the torques.

        To be called before a sub-step: Bullet forgets torques after it. Where a time is infinite they stay.
        """
        loops = field_loops()
        if loops is not None:
            everywhere = DOUBLES.everywhere, INTEGERS.everywhere
            if not loops.turn_by_torques(*everywhere, *self._turning, _SLEEPING, times_s, SYMMETRIC):
                raise LayoutError(_WRONG_INERTIA)
            return
        torques = self._torques.copy()
        rows = np.flatnonzero(torques.any(axis=0) & ~self._asleep() & np.isfinite(times_s))
        if not len(rows):
            return
        acting, inverse = torques.take(rows, axis=-1), self.inverse_inertia_components().take(rows, axis=-1)
        changes = inverse[:, 0] * acting[0] + inverse[:, 1] * acting[1] + inverse[:, 2] * acting[2]
        body, spins = self._body, self._spins.copy().take(rows, axis=-1) + times_s[rows] * changes
        fields = [body.angular_velocity + _VECTOR, body.total_torque + _VECTOR]
        self._write(fields, rows, np.concatenate((spins, np.zeros_like(acting))))

    def set_positions(
        self, rows: np.ndarray, position_components_m: np.ndarray, rotation_components: np.ndarray
    ) -> None:
        """Move bodies (r,) to positions (3, r) with rotations (3, 3, r), before any time passes."""
        transform = np.concatenate((rotation_components.reshape(9, -1), position_components_m))
        self._write([self._body.transform + 32 * row + _VECTOR for row in range(4)], rows, transform)

    def _asleep(self) -> np.ndarray:
        """Whether each body (n,) is not simulated."""
        states = self._states.copy()[0]
        one, other = _SLEEPING
        return (states == one) | (states == other)

    def _write(self, offsets: list[np.ndarray], rows: np.ndarray, values: np.ndarray) -> None:
        DOUBLES.write_fields(self._bodies[rows], np.concatenate(offsets), values)


def are_inertias(tensors: np.ndarray) -> bool:
    """Whether all tensors (3, 3, n) are finite, symmetric and not negative on their diagonals."""
    largest = abs(tensors).max(axis=(0, 1))
    is_symmetric = abs(tensors - np.swapaxes(tensors, 0, 1)).max(axis=(0, 1)) <= SYMMETRIC * largest
    return bool((is_symmetric & (tensors[[0, 1, 2], [0, 1, 2]] >= 0.0).all(axis=0) & np.isfinite(largest)).all())
