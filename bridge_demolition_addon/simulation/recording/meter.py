"""What a sub-step did: copies of what Bullet holds after it, and the loads that follow from many of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...bullet.contacts import Contacts
from ...bullet.snapshots import BodyHistory, Snapshot
from ...bullet.world import BulletWorld
from ...engineering.mechanics.frame_loads import Moment, SubstepLoads
from ...engineering.mechanics.section_forces import SectionForces
from ...model.results.inventory import Inventory
from .elastic_connections import ElasticConnections
from .load_reader import LoadReader
from .reinforcement import Reinforcement


@dataclass(frozen=True, slots=True)
class Reading:
    """What was read after a sub-step.

    Attributes
    ----------
    snapshot : Snapshot
        What Bullet holds, with the loads of elastic connections.
    substep_s, end_s : float
        Length of the sub-step, and simulated time at its end.
    reinforcement_n : (m, 3) float or None
        Forces of reinforcement in it, where there is any beside rigid connections.
    """

    snapshot: Snapshot
    substep_s: float
    end_s: float
    reinforcement_n: np.ndarray | None


class Meter:
    """Reads a world that was bound just now, before any time passes.

    Parameters
    ----------
    world : BulletWorld
    inventory : Inventory
        Its bodies and connections.
    elastic : ElasticConnections or None
        The connections, where they are elastic.
    reinforcement : Reinforcement or None
        Of rigid connections that broke.

    Attributes
    ----------
    lever_arms_m : (m,) float
        From the centres of the bodies on which loads are read to the connections.
    """

    def __init__(
        self,
        world: BulletWorld,
        inventory: Inventory,
        elastic: ElasticConnections | None,
        reinforcement: Reinforcement | None,
    ):
        self._reader = LoadReader(world, inventory.pairs, inventory.moves, inventory.points_m, inventory.normals)
        self._elastic, self._reinforcement = elastic, reinforcement
        self.lever_arms_m = self._reader.lever_arms_m

    def read(self, substep_s: float, end_s: float) -> Reading:
        """Return what Bullet holds after a sub-step; of elastic connections it knows only what contacts change."""
        snapshot = self._reader.snapshot()
        if self._elastic:
            snapshot = replace(snapshot, loads=snapshot.loads + self._elastic.loads_on(self._reader.sides))
        forces = self._reinforcement.forces_n.copy() if self._reinforcement else None
        return Reading(snapshot, substep_s, end_s, forces)

    def predicted_loads(self, both_sides: np.ndarray) -> np.ndarray:
        """Return loads (6, m) where they are read, of those (2, 6, m) on Bullet's bodies A and B."""
        return np.where(self._reader.sides == 0, both_sides[0], both_sides[1])

    def predicted(self, loads: np.ndarray, substep_s: float, begin_s: float) -> Reading:
        """Return what Bullet holds before a sub-step, with the loads (6, m) that connections will have in it."""
        return Reading(replace(self._reader.snapshot(), loads=loads), substep_s, begin_s, None)

    def stored_j(self, intact: np.ndarray) -> np.ndarray | None:
        """Return the energy that is now in elastic connections (m,), of those that are intact or reinforced."""
        return self._elastic.stored_j(intact) if self._elastic else None

    def loads(self, readings: Sequence[Reading]) -> tuple[BodyHistory, SubstepLoads]:
        """Return the states of all bodies after sub-steps, and the loads in these."""
        snapshots = [reading.snapshot for reading in readings]
        bodies = BodyHistory.of(snapshots)
        loads = self._reader.loads(snapshots, bodies, np.array([reading.substep_s for reading in readings]))
        for substep, reading in enumerate(readings):
            if reading.reinforcement_n is not None:
                loads.connection_forces_n[substep] += reading.reinforcement_n
        return bodies, loads

    def moment(self, reading: Reading) -> Moment:
        """Return the loads in one sub-step."""
        return self.loads([reading])[1].moment(0)

    def contacts(self, reading: Reading) -> Contacts:
        """Return the contacts after a sub-step."""
        return self._reader.contacts(reading.snapshot)

    def section_axes(self, rotations: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the axes (r, 3, 3) of some connections (r,), turned with their bodies."""
        return self._reader.section_axes(rotations, rows)

    def section_forces(self, loads: Moment, rows: np.ndarray) -> SectionForces:
        """Return the loads of some connections (r,) in their own axes."""
        return self._reader.section_forces(loads, rows)

    def normals(self, rotations: np.ndarray) -> np.ndarray:
        """Return the unit normals (m, 3) of the connections, turned with their bodies."""
        return self._reader.normals(rotations)
