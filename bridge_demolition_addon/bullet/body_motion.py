"""Motion of all bodies before a sub-step, with the forces that wait for it, copied in one go."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import LayoutError
from .layout import SLEEPING, Layout
from .memory import Places, gather_integers, write_doubles

_VECTOR = 8 * np.arange(3)

_SYMMETRIC = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class BodyMotion:
    """Motion of n bodies; components come first.

    Attributes
    ----------
    positions_m, rotations
        (3, n) and (3, 3, n).
    velocities
        (6, n) velocities in m/s and angular velocities in rad/s.
    inverse_masses
        (n,) 1/kg; 0 for bodies that do not move freely.
    loads
        (6, n) forces and torques, with the weight, that act in the coming sub-step.
    asleep
        (n,) whether each is not simulated.
    """

    positions_m: np.ndarray
    rotations: np.ndarray
    velocities: np.ndarray
    inverse_masses: np.ndarray
    loads: np.ndarray
    asleep: np.ndarray


class BodyMotionReader:
    """Reads and moves the bodies of a world that was checked.

    Parameters
    ----------
    layout
        Byte offsets.
    bodies
        (n,) addresses.
    """

    def __init__(self, layout: Layout, bodies: np.ndarray):
        body = layout.body
        transform = [body.transform + 32 * row + _VECTOR for row in range(4)]
        vectors = [body.linear_velocity, body.angular_velocity, body.total_force, body.total_force + 32]
        offsets: list[Any] = [*transform, *(start + _VECTOR for start in vectors), [body.inverse_mass]]
        self._bodies, self._body = bodies, body
        self._motion = Places(bodies, np.concatenate(offsets))
        rows = [body.inverse_inertia + 32 * row + _VECTOR for row in range(3)]
        self._inertia = Places(bodies, np.concatenate(rows))

    def read(self) -> BodyMotion:
        """Return how all bodies move."""
        values = self._motion.copy()
        states = gather_integers(self._bodies + np.uint64(self._body.activation))
        return BodyMotion(
            positions_m=values[9:12],
            rotations=values[:9].reshape(3, 3, -1),
            velocities=values[12:18],
            inverse_masses=values[24],
            loads=values[18:24],
            asleep=np.isin(states, list(SLEEPING)),
        )

    def inverse_inertias(self) -> np.ndarray:
        """Return the inverse tensors of inertia (3, 3, n) in the axes of the world, 1/(kg·m²)."""
        tensors = self._inertia.copy().reshape(3, 3, -1)
        largest = abs(tensors).max(axis=(0, 1))
        is_symmetric = abs(tensors - np.swapaxes(tensors, 0, 1)).max(axis=(0, 1)) <= _SYMMETRIC * largest
        if not (is_symmetric & (tensors[[0, 1, 2], [0, 1, 2]] >= 0.0).all(axis=0) & np.isfinite(largest)).all():
            raise LayoutError("the inertia of a body is not as expected")
        return tensors

    def set_loads(self, rows: np.ndarray, loads: np.ndarray) -> None:
        """Set the forces and torques (6, r) that act on bodies (r,) in the coming sub-step."""
        start = self._body.total_force
        fields = (start + np.concatenate((_VECTOR, 32 + _VECTOR))).astype(np.uint64)[:, None] + self._bodies[rows]
        write_doubles(fields, loads)

    def set_positions(self, rows: np.ndarray, positions_m: np.ndarray, rotations: np.ndarray) -> None:
        """Move bodies (r,) to positions (3, r) with rotations (3, 3, r), before any time passes."""
        start = self._bodies[rows] + np.uint64(self._body.transform)
        for row in range(3):
            write_doubles(start + (32 * row + _VECTOR).astype(np.uint64)[:, None], rotations[row])
        write_doubles(start + (96 + _VECTOR).astype(np.uint64)[:, None], positions_m)
