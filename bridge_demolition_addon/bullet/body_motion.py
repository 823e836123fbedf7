"""Motion of all bodies before a sub-step, with the forces that act in it, copied at once; components come first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.core.calls import call
from ..engineering.core.structs import Addresses, Count, NotFinite, Struct
from ..errors import LayoutError
from .layout import ASLEEP, DISABLED, BodyLayout, Layout
from .memory import write_vectors

SYMMETRIC = 1e-9

WRONG_INERTIA = "the inertia of a body is not as expected"


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
    components: np.ndarray  # (34, n), all of it but that

    @classmethod
    def room_for(cls, count: int) -> BodyMotion:
        """Return room for the motion of so many bodies."""
        values, asleep = np.empty((34, count)), np.empty(count, bool)
        rotations, inertias = values[:9].reshape(3, 3, -1), values[25:].reshape(3, 3, -1)
        return cls(values[9:12], rotations, values[12:18], values[24], inertias, values[18:24], asleep, values)


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
        motion = BodyMotion.room_for(len(self._bodies))
        self.read_into(motion)
        return motion

    def read_into(self, motion: BodyMotion) -> None:
        """Read how all bodies move now into what `read` or `BodyMotion.room_for` returned."""
        try:
            call("bda_read_motion", self._core, SYMMETRIC, motion.components, motion.asleep)
        except ValueError as error:
            raise LayoutError(WRONG_INERTIA) from error

    def set_positions(
        self, rows: np.ndarray, position_components_m: np.ndarray, rotation_components: np.ndarray
    ) -> None:
        """Move bodies (r,) to positions (3, r) with rotations (3, 3, r), before any time passes."""
        lines = (*np.moveaxis(rotation_components, -1, 1), position_components_m.T)
        for number, vectors in enumerate(lines):
            write_vectors(self._bodies[rows] + np.uint64(self._transform + 32 * number), vectors)
