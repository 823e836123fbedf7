"""Snapshots of a world: copies of its state after each sub-step, many evaluated at once.

A simulation waits while a snapshot is taken, so that nothing is done with the copies then. Long arrays are kept
component by component, all x together in memory, then all y: arithmetic takes a third of the time on them. In a
`BodyHistory` that is their order in memory only, vectors are along the last axis as everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..engineering.core.calls import call
from ..engineering.core.structs import Indices
from ..engineering.geometry.vectors import as_vectors
from .bodies import BodyTable
from .constraints import ConstraintTable
from .contacts import ContactCopies, Contacts


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Copies of Bullet's state of n bodies and m connections after one sub-step.

    Attributes
    ----------
    body_components
        (19, n) rotation matrices, positions, velocities, angular velocities and inverse masses.
    load_components
        (6, k) forces and torques of connections about the centres of the bodies that they are read on.
    applied_impulses
        (m,) the one number that Bullet keeps of each connection, the impulse of its last solver row, N·s.
    intact
        (m,) whether each connection exists and has not broken.
    removed
        (n,) bodies that were taken out of the simulation before; None where there is none.
    """

    body_components: np.ndarray
    load_components: np.ndarray
    applied_impulses: np.ndarray
    intact: np.ndarray
    contacts: ContactCopies
    removed: np.ndarray | None

    @property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions (3, n) of the bodies, m, and their rotations (3, 3, n)."""
        return self.body_components[9:12], self.body_components[:9].reshape(3, 3, -1)

    @property
    def size(self) -> int:
        """Its bytes in memory."""
        arrays = (self.body_components, self.load_components, self.applied_impulses)
        return sum(array.nbytes for array in arrays) + self.contacts.size


@dataclass(frozen=True, slots=True, eq=False)
class BodyHistory:
    """States of n bodies after each of s sub-steps: vectors (s, n, 3), rotations (s, n, 3, 3).

    `can_move` (s, n) marks those that are free: neither passive, nor moved by animation, nor taken out of the
    simulation.
    """

    positions_m: np.ndarray
    rotations: np.ndarray
    velocities_m_s: np.ndarray
    angular_velocities_rad_s: np.ndarray
    can_move: np.ndarray

    @classmethod
    def of(cls, snapshots: Sequence[Snapshot]) -> BodyHistory:
        """Return the states in snapshots."""
        values = np.stack([snapshot.body_components for snapshot in snapshots], axis=1)
        rotations = values[:9].reshape(3, 3, *values.shape[1:]).transpose(2, 3, 0, 1)
        positions, velocities, angular = (as_vectors(values[start : start + 3]) for start in (9, 12, 15))
        return cls(positions, rotations, velocities, angular, (values[18] > 0.0) & ~_removed(snapshots))


class SnapshotTaker:
    """Takes snapshots of a world that was checked.

    `sides` (k,) says which loads are in them: 2 c for those of connection c on Bullet's body A, 2 c + 1 on its body B.
    """

    def __init__(self, bodies: BodyTable, constraints: ConstraintTable, sides: np.ndarray):
        self._bodies, self._constraints = bodies, constraints
        self._sides = Indices.checked("sides", sides.astype(np.int64), sides.size)

    def take(self, *, contacts: bool = True) -> Snapshot:
        """Return a snapshot of the last sub-step, with contacts or as if there were none."""
        bodies, constraints, sides, removed = self._bodies, self._constraints, self._sides, self._bodies.removed
        components, loads = np.empty((19, len(bodies))), np.empty((6, len(sides)))
        impulses, intact = np.empty(len(constraints)), np.empty(len(constraints), bool)
        taken = components, loads, impulses, intact
        call("bda_take_snapshot", bodies.core, constraints.core, len(sides), sides, *taken)
        return Snapshot(
            body_components=components,
            load_components=loads,
            applied_impulses=impulses,
            intact=intact,
            contacts=bodies.contacts.copy() if contacts else ContactCopies.none(),
            removed=removed.copy() if removed.any() else None,
        )

    def contacts(self, snapshots: Sequence[Snapshot]) -> Contacts:
        """Return the contacts in s snapshots."""
        contacts = self._bodies.contacts.contacts([snapshot.contacts for snapshot in snapshots])
        if all(snapshot.removed is None for snapshot in snapshots):
            return contacts
        # Two bodies that rest on each other keep their last contact when both are removed.
        return contacts.without(_removed(snapshots))


def _removed(snapshots: Sequence[Snapshot]) -> np.ndarray:
    """Return which bodies (s, n) were taken out of the simulation, which leaves them a velocity that moves nothing."""
    none = np.zeros(snapshots[0].body_components.shape[1], bool)
    return np.stack([none if snapshot.removed is None else snapshot.removed for snapshot in snapshots])
