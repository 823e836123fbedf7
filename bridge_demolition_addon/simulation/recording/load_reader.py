"""Loads of sub-steps, read from Bullet as it left them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.contacts import Contacts
from ...bullet.snapshots import BodyHistory, Snapshot
from ...bullet.world import BulletWorld
from ...engineering.geometry.rotations import axes_in_bodies, carried_axes, carried_points
from ...engineering.geometry.vectors import by_component, length, taken, transformed, transformed_back
from ...engineering.mechanics import forces
from ...engineering.mechanics.frame_loads import Moment, SubstepLoads
from ...engineering.mechanics.section_forces import SectionForces, section_axes, section_forces


class LoadReader:
    """Reads the loads of a world that was bound just now, before any time passes.

    Parameters
    ----------
    world : BulletWorld
    pairs : (m, 2) int
        Bodies of the connections.
    can_move : (n,) bool
        Whether each body can move at all.
    points_m, normals : (m, 3) float
        Where the connections are now, and unit vectors from their first to their second bodies.

    Attributes
    ----------
    sides : (m,) int
        Whether loads are read on Bullet's body A, 0, or on its body B, 1, of each connection.
    lever_arms_m : (m,) float
        From the centres of the bodies on which loads are read to the connections, which stay where they are on these.
    """

    def __init__(
        self, world: BulletWorld, pairs: np.ndarray, can_move: np.ndarray, points_m: np.ndarray, normals: np.ndarray
    ):
        # Of a hinge on a fixed body, Bullet leaves out a part of the torque on that body: loads are read on the other.
        side = np.where(can_move[pairs[:, 0]], 0, 1)
        rows = np.arange(len(pairs))
        self.sides = np.where(world.first_is_body_a(), side, 1 - side)
        self._snapshots = world.snapshots(2 * rows + self.sides)
        self._sign = np.where(side == 0, 1.0, -1.0)[:, None]
        self._bodies = pairs[rows, side]
        centres, rotations = world.bodies.positions()
        bodies = self._bodies
        self._local_points = by_component(*transformed_back(rotations[bodies], points_m - centres[bodies]).T)
        self.lever_arms_m = length(self._local_points)
        self._local_axes = axes_in_bodies(section_axes(normals), bodies, rotations)

    def section_axes(self, rotations: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the axes (r, 3, 3) of some connections (r,), turned with their bodies."""
        return carried_axes(self._local_axes[rows], self._bodies[rows], rotations)

    def section_forces(self, loads: Moment, rows: np.ndarray) -> SectionForces:
        """Return the loads of some connections (r,) in their own axes."""
        axes = self.section_axes(loads.rotations, rows)
        return section_forces(axes, loads.connection_forces_n[rows], loads.connection_moments_nm[rows])

    def normals(self, rotations: np.ndarray) -> np.ndarray:
        """Return the unit normals (m, 3) of the connections, turned with their bodies."""
        return transformed(rotations.take(self._bodies, axis=0), self._local_axes[:, :, 0])

    def snapshot(self) -> Snapshot:
        """Return what Bullet holds after the last sub-step."""
        return self._snapshots.take()

    def contacts(self, snapshot: Snapshot) -> Contacts:
        """Return the contacts in a snapshot.

        Raises
        ------
        LayoutError
            Memory was not as expected.
        """
        return self._snapshots.contacts([snapshot])

    def loads(self, snapshots: Sequence[Snapshot], bodies: BodyHistory, substeps_s: np.ndarray) -> SubstepLoads:
        """Return the loads of sub-steps.

        Parameters
        ----------
        snapshots : (s,) Snapshot
            Taken after each of them.
        bodies : BodyHistory
            What is in these.
        substeps_s : (s,) float
            How long each was.

        Raises
        ------
        LayoutError
            Memory was not as expected.
        """
        loads = np.stack([each.loads for each in snapshots], axis=1)
        force, torque = (np.moveaxis(each, 0, -1) for each in (loads[:3], loads[3:]))
        centres = taken(bodies.positions, self._bodies)
        rotations = taken(bodies.rotations.reshape(*bodies.positions.shape[:2], 9), self._bodies)
        points = carried_points(self._local_points, centres, rotations.reshape(*centres.shape, 3))
        moment = forces.moments_at(points, force, torque, centres)
        contacts = self._snapshots.contacts(snapshots)
        return SubstepLoads(
            substeps_s=substeps_s,
            connection_forces_n=self._sign * force,
            connection_moments_nm=self._sign * moment,
            connection_points_m=points,
            signed_2019_ns=np.stack([each.applied_impulses for each in snapshots]),
            contact_substeps=contacts.substeps,
            contact_pairs=contacts.pairs,
            contact_impulses_ns=contacts.impulses_ns,
            contact_points_m=contacts.places_m,
            centres_m=bodies.positions,
            rotations=bodies.rotations,
        )
