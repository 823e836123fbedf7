"""Loads of sub-steps: copies of Bullet's state after each, and the loads that follow from many of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...bullet.contacts import Contacts
from ...bullet.snapshots import BodyHistory, Snapshot
from ...bullet.tick import Tick
from ...bullet.world import BulletWorld
from ...engineering.geometry.vectors import axes_in_bodies, carried_axes, transformed, transformed_back
from ...engineering.mechanics.carried_sections import CarriedSections
from ...engineering.mechanics.frame_loads import Moment, SubstepLoads
from ...engineering.mechanics.section_cuts import SectionForces, section_axes, section_forces
from ...model.results.frames import Inventory
from .elastic_connections import ElasticConnections


@dataclass(frozen=True, slots=True)
class Reading:
    """Bullet's state after a sub-step, with the loads of elastic connections, and simulated time at its end."""

    snapshot: Snapshot
    substep_s: float
    end_s: float


class Meter:
    """Reads a world that was bound just now, before any time passes.

    `sections` are those of the connections, which turn with the bodies on which loads are read.
    """

    def __init__(self, world: BulletWorld, inventory: Inventory, elastic: ElasticConnections | None):
        pairs = inventory.pairs
        # On a fixed body Bullet leaves out a part of a hinge's torque: loads are read on the other.
        side = np.where(inventory.moves[pairs[:, 0]], 0, 1)
        rows = np.arange(len(pairs))
        sides = np.where(world.first_is_body_a(), side, 1 - side)
        self._snapshots = world.snapshots(2 * rows + sides)
        if elastic:
            elastic.read_on(sides)
        self._bodies = pairs[rows, side]
        # Positions of connections are those of the bridge as it was built, not as it rests under its weight.
        positions_m, rotations = elastic.built_positions if elastic else world.bodies.positions()
        bodies = self._bodies
        signs = np.where(side == 0, 1.0, -1.0)
        levers = transformed_back(rotations[bodies], inventory.points_m - positions_m[bodies])
        self._local_axes = axes_in_bodies(section_axes(inventory.normals), bodies, rotations)
        self.sections = CarriedSections(
            bodies, signs, np.ascontiguousarray(levers), np.ascontiguousarray(self._local_axes)
        )

    def begin(self, tick: Tick, *, contacts: bool) -> Snapshot:
        """Have a sub-step copy Bullet's state at its end, and return room for it.

        Of elastic connections Bullet knows only what contacts change: their loads are added. Without contacts the loads
        of bodies are not known.
        """
        snapshot = self._snapshots.begin(tick, contacts=contacts)
        tick.refer(carried=self.sections.carrying(snapshot.load_components, *snapshot.places))
        return snapshot

    def make_room(self) -> None:
        """Make room for all contacts of now."""
        self._snapshots.make_room()

    def with_contacts(self, snapshot: Snapshot) -> Snapshot:
        """Return a snapshot with the contacts that were copied last."""
        return self._snapshots.with_contacts(snapshot)

    def predicted(self, loads: np.ndarray, substep_s: float, begin_s: float) -> Reading:
        """Return Bullet's state before a sub-step, with the loads (6, m) that connections will have in it."""
        snapshot = self._snapshots.take()
        return Reading(replace(snapshot, load_components=loads), substep_s, begin_s)

    def loads(self, readings: Sequence[Reading]) -> tuple[BodyHistory, SubstepLoads]:
        """Return the states of all bodies after sub-steps, and the loads in these."""
        snapshots = [reading.snapshot for reading in readings]
        bodies = BodyHistory.of(snapshots)
        return bodies, self._substep_loads(snapshots, bodies, np.array([reading.substep_s for reading in readings]))

    def moment(self, reading: Reading) -> Moment:
        """Return the loads in one sub-step."""
        return self.loads([reading])[1].moment(0)

    def contacts(self, reading: Reading) -> Contacts:
        """Return the contacts after a sub-step."""
        return self._snapshots.contacts([reading.snapshot])

    def section_axes(self, rotations: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the section axes (r, 3, 3) of connections (r,), rotated with their bodies."""
        return carried_axes(self._local_axes[rows], self._bodies[rows], rotations)

    def section_forces(self, loads: Moment, rows: np.ndarray) -> SectionForces:
        """Return the loads of connections (r,) in their own axes."""
        axes = self.section_axes(loads.rotations, rows)
        return section_forces(axes, loads.connection_forces_n[rows], loads.connection_moments_nm[rows])

    def normals(self, rotations: np.ndarray) -> np.ndarray:
        """Return the unit normals (m, 3) of the connections, rotated with their bodies."""
        return transformed(rotations.take(self._bodies, axis=0), self._local_axes[:, :, 0])

    def _substep_loads(
        self, snapshots: Sequence[Snapshot], bodies: BodyHistory, substeps_s: np.ndarray
    ) -> SubstepLoads:
        """Loads of sub-steps (s,) after which snapshots were taken."""
        loads = np.stack([snapshot.load_components for snapshot in snapshots], axis=1)
        positions_m, rotations = bodies.positions_m.transpose(2, 0, 1), bodies.rotations.transpose(2, 3, 0, 1)
        carried = self.sections.loads(loads, positions_m, rotations)
        contacts = self._snapshots.contacts(snapshots)
        return SubstepLoads(
            substeps_s=substeps_s,
            connection_forces_n=carried.forces_n,
            connection_moments_nm=carried.moments_nm,
            connection_points_m=carried.points_m,
            signed_2019_ns=np.stack([snapshot.applied_impulses for snapshot in snapshots]),
            contact_substeps=contacts.substeps,
            contact_pairs=contacts.pairs,
            contact_impulses_ns=contacts.impulses_ns,
            contact_points_m=contacts.positions_m,
            centres_m=bodies.positions_m,
            rotations=bodies.rotations,
        )
