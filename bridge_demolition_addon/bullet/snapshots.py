"""Snapshots of a world: after each sub-step copies of what Bullet holds, to be made sense of many at once.

A simulation waits while a snapshot is taken, so that nothing is done with the copies then. Long arrays are kept
component by component, all x together in memory, then all y: arithmetic takes a third of the time on them. That is
their order in memory only, vectors are along the last axis as everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .bodies import BodyTable
from .constraints import ConstraintTable
from .contacts import ContactCopies, Contacts
from .layout import Layout
from .memory import Places

_VECTOR = 8 * np.arange(3)
_FEEDBACK_COLUMNS = np.array([0, 1, 2, 4, 5, 6])
"""Force and torque on one body, among the eight doubles that Bullet gives them."""


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Copies of what Bullet holds of n bodies and m connections after one sub-step, k loads of connections among it.

    Attributes
    ----------
    bodies
        (19, n) rotation matrices, positions, velocities, angular velocities and inverse masses.
    loads
        (6, k) forces and torques of connections on the bodies that they are read on.
    applied_impulses
        (m,) the one number that Bullet keeps of each connection, the impulse of its last solver row, N·s.
    intact
        (m,) whether each connection exists and has not broken.
    contacts
        Contact points.
    removed
        (n,) bodies that were taken out of the simulation before; None where there is none.
    """

    bodies: np.ndarray
    loads: np.ndarray
    applied_impulses: np.ndarray
    intact: np.ndarray
    contacts: ContactCopies
    removed: np.ndarray | None

    @property
    def size(self) -> int:
        """What it takes in memory, in bytes."""
        return self.bodies.nbytes + self.loads.nbytes + self.applied_impulses.nbytes + self.contacts.size

    @property
    def forces_n(self) -> np.ndarray:
        """Forces (k, 3) of connections."""
        return self.loads[:3].T

    @property
    def torques_nm(self) -> np.ndarray:
        """Torques (k, 3) of connections about the centres of the bodies."""
        return self.loads[3:].T


@dataclass(frozen=True, slots=True, eq=False)
class BodyHistory:
    """States of n bodies after each of s sub-steps.

    Attributes
    ----------
    positions, rotations
        (s, n, 3) m and (s, n, 3, 3).
    velocities, angular_velocities
        (s, n, 3) m/s and rad/s.
    can_move
        (s, n) whether each is free: neither passive nor led by animation.
    """

    positions: np.ndarray
    rotations: np.ndarray
    velocities: np.ndarray
    angular_velocities: np.ndarray
    can_move: np.ndarray

    @classmethod
    def of(cls, snapshots: Sequence[Snapshot]) -> BodyHistory:
        """Return the states in snapshots."""
        values = np.stack([snapshot.bodies for snapshot in snapshots], axis=1)
        rotations, *vectors = values[:9], values[9:12], values[12:15], values[15:18]
        positions, velocities, angular_velocities = (np.moveaxis(vector, 0, -1) for vector in vectors)
        rotations = np.moveaxis(rotations.reshape(3, 3, *values.shape[1:]), (0, 1), (-2, -1))
        return cls(positions, rotations, velocities, angular_velocities, values[18] > 0.0)


class SnapshotTaker:
    """Takes snapshots of a world that was checked, with n bodies and m connections.

    Parameters
    ----------
    layout
        Byte offsets.
    bodies, constraints
        What is in it.
    sides
        (k,) which loads: 2 c for those of connection c on Bullet's body A, 2 c + 1 for those on its body B.
    """

    def __init__(self, layout: Layout, bodies: BodyTable, constraints: ConstraintTable, sides: np.ndarray):
        self._constraint, self._connections = layout.constraint, constraints.addresses
        self._exists, self._removed, self._contacts = constraints.exists, bodies.removed, bodies.contacts
        self._feedback = constraints.feedback.reshape(-1)
        self._loads = 8 * np.asarray(sides) + _FEEDBACK_COLUMNS[:, None]
        body = layout.body
        rows = [body.transform + 32 * row for row in range(4)]
        vectors = [start + _VECTOR for start in (*rows, body.linear_velocity, body.angular_velocity)]
        self._bodies = Places(bodies.addresses, np.concatenate([*vectors, [body.inverse_mass]]))
        self._find_existing()

    def take(self) -> Snapshot:
        """Return a snapshot of the last sub-step."""
        if not np.array_equal(self._exists, self._existed):
            self._find_existing()
        applied_impulses, enabled = self._impulses.copy()[0], self._enabled.copy()[0] != 0
        return Snapshot(
            bodies=self._bodies.copy(),
            loads=self._feedback.take(self._loads),
            applied_impulses=self._of_all(applied_impulses),
            intact=self._of_all(enabled),
            contacts=self._contacts.copy(),
            removed=self._removed.copy() if self._removed.any() else None,
        )

    def contacts(self, snapshots: Sequence[Snapshot]) -> Contacts:
        """Return the contacts in s snapshots."""
        contacts = self._contacts.contacts([snapshot.contacts for snapshot in snapshots])
        if all(snapshot.removed is None for snapshot in snapshots):
            return contacts
        # Two bodies that rest on each other keep their last contact when both are removed.
        none = np.zeros(len(self._removed), bool)
        removed = np.stack([none if snapshot.removed is None else snapshot.removed for snapshot in snapshots])
        return contacts.without(removed)

    def _find_existing(self) -> None:
        self._existed = self._exists.copy()
        addresses = self._connections[self._existed]
        self._impulses = Places(addresses, [self._constraint.applied_impulse])
        self._enabled = Places(addresses, [self._constraint.enabled], np.uint8)

    def _of_all(self, values: np.ndarray) -> np.ndarray:
        """Values (m,), 0 for connections that do not exist, from those (e,) of the ones that do."""
        if len(values) == len(self._existed):
            return values
        every = np.zeros(len(self._existed), values.dtype)
        every[self._existed] = values
        return every
