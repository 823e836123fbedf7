"""Bodies of a Bullet world that was checked, as arrays over Bullet's own memory."""

from __future__ import annotations

import numpy as np

from ..model.results.removed_shards import OUT_OF_REACH_M
from .body_motion import BodyMotionReader
from .contacts import ContactReader
from .layout import ASLEEP, AWAKE, DISABLED, SLEEPING, WANTS_SLEEP, Layout
from .memory import (
    Places,
    add_vectors,
    gather_doubles,
    gather_integers,
    write_doubles,
    write_integers,
    write_vectors,
)

_TRANSFORM = 8 * np.array([0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14])
"""Rotation matrix and origin in bytes from the start of a btTransform: four vectors of four doubles each."""

_ORIGIN = 96
_TORQUE = 32
"""Bytes from the total force to the total torque."""


class BodyTable:
    """n bodies of a world, as long as it is bound.

    Parameters
    ----------
    layout
        Byte offsets.
    addresses
        (n,) uint64 of the bodies.
    contacts
        Reads their contacts.

    Attributes
    ----------
    removed
        (n,) bodies that `remove` took out of the simulation.
    """

    def __init__(self, layout: Layout, addresses: np.ndarray, contacts: ContactReader):
        self.addresses, self.contacts = addresses, contacts
        self.removed = np.zeros(len(addresses), bool)
        self._layout, self._body = layout, layout.body
        self._transforms = Places(addresses, layout.body.transform + _TRANSFORM)

    def __len__(self) -> int:
        return len(self.addresses)

    def positions(self) -> tuple[np.ndarray, np.ndarray]:
        """Origins (n, 3) in m and rotation matrices (n, 3, 3)."""
        transforms = np.ascontiguousarray(self._transforms.copy().T)
        return transforms[:, 9:], transforms[:, :9].reshape(-1, 3, 3)

    def velocities(self) -> np.ndarray:
        """Linear velocities (n, 3), m/s."""
        return gather_doubles(self._fields(self._body.linear_velocity), 3)

    def angular_velocities(self) -> np.ndarray:
        """Angular velocities (n, 3), rad/s."""
        return gather_doubles(self._fields(self._body.angular_velocity), 3)

    def can_move(self) -> np.ndarray:
        """Whether each body (n,) is free now: neither passive nor moved by animation."""
        return gather_doubles(self._fields(self._body.inverse_mass))[:, 0] > 0.0

    def asleep(self) -> np.ndarray:
        """Whether each body (n,) is asleep; what can never move is not."""
        states = gather_integers(self._fields(self._body.activation))
        return np.isin(states, list(SLEEPING)) & self.can_move()

    def motion(self) -> BodyMotionReader:
        """What reads the motion of all bodies in one go, and moves them."""
        return BodyMotionReader(self._layout, self.addresses)

    def set_velocities(
        self, bodies: np.ndarray, velocities_m_s: np.ndarray, angular_velocities_rad_s: np.ndarray
    ) -> None:
        """Give bodies (k,) velocities and angular velocities (k, 3); those that sleep go on sleeping."""
        for offset, vectors in (
            (self._body.linear_velocity, velocities_m_s),
            (self._body.angular_velocity, angular_velocities_rad_s),
        ):
            write_vectors(self.addresses[bodies] + np.uint64(offset), vectors)

    def set_positions(self, bodies: np.ndarray, positions_m: np.ndarray) -> None:
        """Move bodies (k,) to positions (k, 3)."""
        write_vectors(self.addresses[bodies] + np.uint64(self._body.transform + _ORIGIN), positions_m)

    def move_kinematic(self, bodies: np.ndarray, positions_m: np.ndarray, velocity_m_s: np.ndarray) -> None:
        """Move animated bodies (k,) to positions (k, 3), with one velocity (3,) for the coming sub-step.

        To be called before a sub-step: Bullet has worked out by then how animation would move them.
        """
        self.set_positions(bodies, positions_m)
        resting = np.zeros((len(bodies), 3))
        self.set_velocities(bodies, resting + velocity_m_s, resting)

    def slow_down(self, bodies: np.ndarray, share: float) -> None:
        """Multiply the velocities and angular velocities of bodies (k,) by a share."""
        for offset in (self._body.linear_velocity, self._body.angular_velocity):
            fields = self.addresses[bodies] + np.uint64(offset)
            write_vectors(fields, share * gather_doubles(fields, 3))

    def add_forces(self, bodies: np.ndarray, forces_n: np.ndarray, torques_nm: np.ndarray | None = None) -> None:
        """Add forces (k, 3) and torques (k, 3) on bodies (k,), each as often as it is named, in the coming sub-step.

        To be called before a sub-step: Bullet forgets them after it. A body that sleeps or cannot move is not moved by
        them.
        """
        named = self._each_once(bodies)
        for offset, values in ((0, forces_n), (_TORQUE, torques_nm)):
            if values is None:
                continue
            sums = np.column_stack([np.bincount(bodies, column, len(self)) for column in values.T])[named]
            fields = self.addresses[named] + np.uint64(self._body.total_force + offset)
            write_vectors(fields, gather_doubles(fields, 3) + sums)

    def push(self, bodies: np.ndarray, forces_n: np.ndarray) -> None:
        """Wake bodies (k,), each named once and in order, and add forces (k, 3) on them in the coming sub-step."""
        addresses = self.addresses[bodies]
        states = gather_integers(addresses + np.uint64(self._body.activation))
        if ((states == ASLEEP) | (states == WANTS_SLEEP)).any():
            self.wake(bodies)
        add_vectors(addresses + np.uint64(self._body.total_force), forces_n)

    def wake(self, bodies: np.ndarray) -> None:
        """Wake those of bodies (k,) that sleep or are about to, as Bullet does when something touches them.

        To be called before a sub-step: Bullet has passed the sleeping ones by when it gave all others their weight, so
        they get it here.
        """
        named = self._each_once(bodies)
        states = gather_integers(self.addresses[named] + np.uint64(self._body.activation))
        drowsy = self.addresses[named[(states == ASLEEP) | (states == WANTS_SLEEP)]]
        write_integers(drowsy + np.uint64(self._body.activation), AWAKE)
        write_doubles(drowsy + np.uint64(self._body.deactivation_time), 0.0)
        sleeping = named[states == ASLEEP]
        if not len(sleeping):
            return
        weights = gather_doubles(self.addresses[sleeping] + np.uint64(self._body.gravity), 3)
        self.add_forces(sleeping, weights)

    def remove(self, bodies: np.ndarray) -> None:
        """Take bodies (k,) out of the simulation for good; their connections have to be broken.

        Deleting them would crash Blender, which still points at them. They stay, disabled, out of reach of all others:
        `OUT_OF_REACH_M` below their positions.
        """
        addresses = self.addresses[bodies]
        origins = addresses + np.uint64(self._body.transform + _ORIGIN)
        self.contacts.forget(bodies)
        write_vectors(origins, gather_doubles(origins, 3) - (0.0, 0.0, OUT_OF_REACH_M))
        self.set_velocities(bodies, np.zeros((len(bodies), 3)), np.zeros((len(bodies), 3)))
        write_integers(addresses + np.uint64(self._body.activation), DISABLED)
        self.removed[bodies] = True

    def _each_once(self, bodies: np.ndarray) -> np.ndarray:
        """Those of bodies (k,), each once and in order."""
        return np.flatnonzero(np.bincount(bodies, minlength=len(self)))

    def _fields(self, offset: int) -> np.ndarray:
        """Addresses (n,) of a field of all bodies."""
        return self.addresses + np.uint64(offset)
