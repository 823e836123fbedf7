"""Bodies of a Bullet world that was checked, as arrays over Bullet's own memory."""

from __future__ import annotations

import numpy as np

from ..errors import LayoutError
from ..model.results.motion import OUT_OF_REACH_M
from .body_motion import BodyMotionReader, BulletBodies
from .contacts import ContactReader
from .layout import ASLEEP, AWAKE, DISABLED, FIXED_FLAGS, NO_CONTACT_RESPONSE, SLEEPING, WANTS_SLEEP, Layout
from .memory import DOUBLES, INTEGERS, add_vectors, gather_doubles, write_vectors

_ORIGIN = 96
"""Bytes from the start of a btTransform, behind three rows of four doubles each."""


class BodyTable:
    """The bodies of a world at addresses (n,), as long as it is bound.

    `removed` (n,) marks those that `remove` took out of the simulation. `core` is what the core gets of them.
    """

    def __init__(self, layout: Layout, addresses: np.ndarray, contacts: ContactReader):
        self.addresses, self.contacts = addresses, contacts
        self.removed = np.zeros(len(addresses), bool)
        self._layout, self._body = layout, layout.body
        self.core = BulletBodies.of(layout.body, addresses)

    def __len__(self) -> int:
        return len(self.addresses)

    def positions(self) -> tuple[np.ndarray, np.ndarray]:
        """Return positions (n, 3) in m and rotation matrices (n, 3, 3)."""
        transforms = gather_doubles(self._fields(self._body.transform), 16).reshape(-1, 4, 4)[..., :3]
        return np.ascontiguousarray(transforms[:, 3]), np.ascontiguousarray(transforms[:, :3])

    def velocities(self) -> np.ndarray:
        """Return velocities (n, 3), m/s."""
        return gather_doubles(self._fields(self._body.linear_velocity), 3)

    def angular_velocities(self) -> np.ndarray:
        """Return angular velocities (n, 3), rad/s."""
        return gather_doubles(self._fields(self._body.angular_velocity), 3)

    def can_move(self) -> np.ndarray:
        """Return whether each body (n,) is free now: neither passive nor moved by animation."""
        return gather_doubles(self._fields(self._body.inverse_mass))[:, 0] > 0.0

    def asleep(self) -> np.ndarray:
        """Return whether each body (n,) is asleep; one that can never move is not."""
        states = INTEGERS.gather(self._fields(self._body.activation))
        one, other = SLEEPING
        return ((states == one) | (states == other)) & self.can_move()

    def motion(self) -> BodyMotionReader:
        """Return the reader of the motion of all bodies, which also moves them."""
        return BodyMotionReader(self._layout, self.addresses)

    def set_velocities(
        self, bodies: np.ndarray, velocities_m_s: np.ndarray, angular_velocities_rad_s: np.ndarray
    ) -> None:
        """Give bodies (k,) velocities and angular velocities (k, 3); those that sleep go on sleeping."""
        addresses = self.addresses[bodies]
        write_vectors(addresses + np.uint64(self._body.linear_velocity), velocities_m_s)
        write_vectors(addresses + np.uint64(self._body.angular_velocity), angular_velocities_rad_s)

    def set_positions(self, bodies: np.ndarray, positions_m: np.ndarray) -> None:
        """Move bodies (k,) to positions (k, 3)."""
        write_vectors(self.addresses[bodies] + np.uint64(self._body.transform + _ORIGIN), positions_m)

    def move_kinematic(self, bodies: np.ndarray, positions_m: np.ndarray, velocity_m_s: np.ndarray) -> None:
        """Move animated bodies (k,) to positions (k, 3), with one velocity (3,) for the coming sub-step.

        To be called before a sub-step: by then Bullet has calculated how animation would move them.
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

        To be called before a sub-step: Bullet forgets them after it. They do not wake a body that sleeps.
        """
        named = self._once(bodies)
        for offset, vectors in ((self._body.total_force, forces_n), (self._body.total_torque, torques_nm)):
            if vectors is not None:
                sums = np.column_stack([np.bincount(bodies, column, len(self)) for column in vectors.T])[named]
                add_vectors(self.addresses[named] + np.uint64(offset), sums)

    def push(self, bodies: np.ndarray, forces_n: np.ndarray) -> None:
        """Wake bodies (k,), each named once and in order, and add forces (k, 3) on them in the coming sub-step."""
        addresses = self.addresses[bodies]
        states = INTEGERS.gather(addresses + np.uint64(self._body.activation))
        if ((states == ASLEEP) | (states == WANTS_SLEEP)).any():
            self.wake(bodies)
        add_vectors(addresses + np.uint64(self._body.total_force), forces_n)

    def wake(self, bodies: np.ndarray) -> None:
        """Wake those of bodies (k,) that sleep or are about to, as Bullet does when something touches them.

        To be called before a sub-step: Bullet gives sleeping bodies no weight, so they get it here.
        """
        named = self._once(bodies)
        states = INTEGERS.gather(self.addresses[named] + np.uint64(self._body.activation))
        drowsy = self.addresses[named[(states == ASLEEP) | (states == WANTS_SLEEP)]]
        INTEGERS.write(drowsy + np.uint64(self._body.activation), AWAKE)
        DOUBLES.write(drowsy + np.uint64(self._body.deactivation_time), 0.0)
        sleeping = self.addresses[named[states == ASLEEP]]
        weights = gather_doubles(sleeping + np.uint64(self._body.gravity), 3)
        add_vectors(sleeping + np.uint64(self._body.total_force), weights)

    def remove(self, bodies: np.ndarray) -> None:
        """Take bodies (k,) out of the simulation for good; their connections have to be broken.

        Deleting them would crash Blender, which still points at them. They stay, disabled, `OUT_OF_REACH_M` below their
        positions.
        """
        addresses = self.addresses[bodies]
        origins = addresses + np.uint64(self._body.transform + _ORIGIN)
        self.contacts.forget(bodies)
        write_vectors(origins, gather_doubles(origins, 3) - (0.0, 0.0, OUT_OF_REACH_M))
        resting = np.zeros((len(bodies), 3))
        self.set_velocities(bodies, resting, resting)
        INTEGERS.write(addresses + np.uint64(self._body.activation), DISABLED)
        self.removed[bodies] = True

    def check_contact_flags(self) -> None:
        """Check that the flags of all bodies are where they are expected: those that never move are marked there."""
        flags = INTEGERS.gather(self._fields(self._body.collision_flags))
        if ((flags & ~FIXED_FLAGS) != 0).any() or ((flags != 0) & self.can_move()).any():
            raise LayoutError("flags of bodies that tell which of them collide are not as expected")

    def let_touch(self, bodies: np.ndarray, *, touch: bool) -> None:
        """Have bodies (k,) pass through all others, or touch them again; `check_contact_flags` comes before."""
        fields = self.addresses[bodies] + np.uint64(self._body.collision_flags)
        flags = INTEGERS.gather(fields)
        INTEGERS.write(fields, flags & ~NO_CONTACT_RESPONSE if touch else flags | NO_CONTACT_RESPONSE)
        self.contacts.forget(bodies)

    def _once(self, bodies: np.ndarray) -> np.ndarray:
        """Return each of bodies (k,) once and in order."""
        return np.flatnonzero(np.bincount(bodies, minlength=len(self)))

    def _fields(self, offset: int) -> np.ndarray:
        """Return addresses (n,) of a field of all bodies."""
        return self.addresses + np.uint64(offset)
