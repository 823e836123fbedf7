"""Motion of all bodies before a sub-step, with the forces that act in it, copied at once; components come first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.core.calls import call
from ..engineering.core.structs import Addresses, Count, Doubles, NotFinite, Struct
from ..errors import LayoutError
from .layout import ASLEEP, DISABLED, BodyLayout, Layout
from .memory import write_vectors

SYMMETRIC = 1e-9

_WRONG_INERTIA = "the inertia of a body is not as expected"


@dataclass(frozen=True, slots=True, eq=False)
class BodyMotion:
    """Motion of n bodies: positions (3, n), rotations (3, 3, n), velocities and angular velocities (6, n).

    Attributes
    ----------
    inverse_masses
        (n,) 1/kg; 0 for bodies that do not move freely.
    inverse_inertia_components
        (3, 3, n) inverse tensors of inertia in the axes of the world, 1/(kg·m²).
    load_components
        (6, n) forces and torques, with the weight, that act in the coming sub-step.
    asleep
        (n,) whether each is not simulated.
    """

    position_components_m: np.ndarray
    rotation_components: np.ndarray
    velocity_components: np.ndarray
    inverse_masses: np.ndarray
    inverse_inertia_components: np.ndarray
    load_components: np.ndarray
    asleep: np.ndarray


class BulletBodies(Struct):
    """n bodies: `bda_bullet_bodies`."""

    _OFFSETS = (
        *("transform", "linear_velocity", "angular_velocity", "total_force", "total_torque"),
        *("inverse_mass", "inverse_inertia", "activation"),
    )
    _fields_ = (
        ("count", Count),
        ("addresses", Addresses),
        *((name, Count) for name in _OFFSETS),
        ("asleep", Count),
        ("disabled", Count),
        ("wrong", NotFinite),
    )

    @classmethod
    def of(cls, layout: BodyLayout, addresses: np.ndarray) -> BulletBodies:
        """Return bodies at addresses (n,)."""
        offsets = {name: getattr(layout, name) for name in cls._OFFSETS}
        made = cls(count=len(addresses), asleep=ASLEEP, disabled=DISABLED, **offsets)
        made.point("addresses", addresses, len(addresses))
        return made


class BodyMotionReader:
    """Reads and moves the bodies (n,) of a world that was checked, by their addresses."""

    def __init__(self, layout: Layout, bodies: np.ndarray):
        self._bodies, self._transform, self._core = bodies, layout.body.transform, BulletBodies.of(layout.body, bodies)

    def read(self) -> BodyMotion:
        """Return how all bodies move; a `NotFiniteError` names one whose motion or mass is no number."""
        count = len(self._bodies)
        values, asleep = np.empty((34, count)), np.empty(count, bool)
        try:
            call("bda_read_motion", self._core, SYMMETRIC, values, asleep)
        except ValueError as error:
            raise LayoutError(_WRONG_INERTIA) from error
        rotations, inertias = values[:9].reshape(3, 3, -1), values[25:].reshape(3, 3, -1)
        return BodyMotion(values[9:12], rotations, values[12:18], values[24], inertias, values[18:24], asleep)

    def push(self, motion: BodyMotion, impulses: np.ndarray, substep_s: float) -> None:
        """Give bodies that move freely impulses (6, n) in the coming sub-step, beside the loads of their motion."""
        count = len(self._bodies)
        masses = Doubles.checked("inverse masses", motion.inverse_masses, count)
        loads = Doubles.checked("loads", motion.load_components, 6 * count)
        impulses = Doubles.checked("impulses", np.ascontiguousarray(impulses), 6 * count)
        call("bda_push", self._core, masses, loads, impulses, substep_s)

    def turn_by_torques(self, times_s: np.ndarray) -> None:
        """Change the angular velocities of bodies that are awake by what torques do in times (n,), and end the torques.

        To be called before a sub-step: Bullet forgets torques after it. Where a time is infinite they stay.
        """
        times_s = Doubles.checked("times", times_s, len(self._bodies))
        try:
            call("bda_turn_by_torques", self._core, times_s, SYMMETRIC)
        except ValueError as error:
            raise LayoutError(_WRONG_INERTIA) from error

    def set_positions(
        self, rows: np.ndarray, position_components_m: np.ndarray, rotation_components: np.ndarray
    ) -> None:
        """Move bodies (r,) to positions (3, r) with rotations (3, 3, r), before any time passes."""
        lines = (*np.moveaxis(rotation_components, -1, 1), position_components_m.T)
        for number, vectors in enumerate(lines):
            write_vectors(self._bodies[rows] + np.uint64(self._transform + 32 * number), vectors)
