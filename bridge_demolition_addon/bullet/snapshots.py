"""Snapshots of a world: copies of its state after each sub-step, many evaluated at once.

A simulation waits while a snapshot is taken, so that nothing is done with the copies then. Long arrays are kept
component by component, all x together in memory, then all y: arithmetic takes a third of the time on them. In a
`BodyHistory` that is their order in memory only, vectors are along the last axis as everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..engineering.core.calls import call
from ..engineering.core.structs import Indices
from ..engineering.geometry.vectors import as_vectors
from .bodies import BodyTable
from .constraints import ConstraintTable
from .contacts import ContactCopies, Contacts
from .tick import Tick


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

    def take(self) -> Snapshot:
        """Return a snapshot of now, as if there were no contacts."""
        taken, bodies, constraints = self.room(), self._bodies, self._constraints
        arrays = taken.body_components, taken.load_components, taken.applied_impulses, taken.intact
        call("bda_take_snapshot", bodies.core, constraints.core, len(self._sides), self._sides, *arrays)
        return taken

    def room(self) -> Snapshot:
        """Return room for a snapshot."""
        count, removed = len(self._constraints), self._bodies.removed
        return Snapshot(
            body_components=np.empty((19, len(self._bodies))),
            load_components=np.empty((6, len(self._sides))),
            applied_impulses=np.empty(count),
            intact=np.empty(count, bool),
            contacts=ContactCopies.none(),
            removed=removed.copy() if removed.any() else None,
        )

    def begin(self, tick: Tick, *, contacts: bool) -> Snapshot:
        """Have a sub-step take a snapshot at its end, with contacts or as if there were none; return room for it."""
        taken, count = self.room(), len(self._constraints)
        tick.point("sides", self._sides, count)
        tick.point("components", taken.body_components, 19 * len(self._bodies))
        tick.point("taken", taken.load_components, 6 * count)
        tick.point("impulses", taken.applied_impulses, count)
        tick.point("left_intact", taken.intact, count)
        tick.refer(contacts=self._bodies.contacts.core() if contacts else None)
        tick.body_of_contact = self._bodies.contacts.wrong_body
        return taken

    def make_room(self) -> None:
        """Make room for all contacts of now."""
        self._bodies.contacts.make_room()

    def with_contacts(self, snapshot: Snapshot) -> Snapshot:
        """Return a snapshot with the contacts that were copied last."""
        return replace(snapshot, contacts=self._bodies.contacts.copied())

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
