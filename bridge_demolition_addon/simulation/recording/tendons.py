"""Tendons of a world: put into Bullet as forces before each sub-step, until they are cut or rupture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.elasticity.tendons import LEAST_RELEASED_J, CutTendon, TendonForces
from ...model.structure.tendons import ModelTendons
from .drivers import Driver

CUT, RUPTURED = "cut", "ruptured"


@dataclass(frozen=True, slots=True)
class Release:
    """Energy that a tendon lets go at a time, as it is cut or ruptures."""

    tendon: int
    time_s: float
    how: str
    energy_j: float


class Tendons(Driver):
    """Presses bodies together by their tendons, as they are now."""

    def __init__(self, bodies: BodyTable, tendons: ModelTendons, forces: TendonForces):
        self.tendons, self.forces = tendons, forces
        self._table, self._reader = bodies, bodies.motion()
        self._stored_j = forces.stored_j()
        self._bodies = np.unique(np.concatenate((tendons.passages.first, tendons.passages.second)))
        self.releases: list[Release] = []
        self._begins_s = 0.0

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Let tendons rupture across cracks that are too wide, and push with the others.

        They do not wake what sleeps: its connections carry them already.
        """
        self._begins_s = max(self._begins_s, elapsed_s)
        motion = self._reader.read()
        positions_m, rotations = motion.position_components_m, motion.rotation_components
        self._note(self.forces.update_plastic_state(positions_m, rotations), RUPTURED)
        self._begins_s += substep_s
        loads = self.forces.loads(positions_m, rotations)[:, self._bodies].T
        self._table.add_forces(self._bodies, loads[:, :3], loads[:, 3:])

    def cut(self, cuts: Sequence[CutTendon], time_s: float) -> None:
        """Cut tendons at a time, and wake what they are in."""
        self._begins_s = max(self._begins_s, time_s)
        self._note(self.forces.cut(cuts), CUT)
        concerned = np.isin(self.tendons.passages.tendons, [cut.tendon for cut in cuts])
        passages = self.tendons.passages.only(concerned)
        bodies = np.unique(np.concatenate((passages.first, passages.second)))
        self._table.wake(bodies[~self._table.removed[bodies]])

    def summary(self) -> list[dict[str, Any]]:
        """Return what each tendon stored at first and let go so far, ready for JSON."""
        return [
            {
                "name": name,
                "member": member,
                "force_N": float(force_n),
                "stored_J": float(stored_j),
                "released": [
                    {"time_s": release.time_s, "how": release.how, "energy_J": release.energy_j}
                    for release in self.releases
                    if release.tendon == number
                ],
            }
            for number, (name, member, force_n, stored_j) in enumerate(
                zip(
                    self.tendons.names,
                    self.tendons.members,
                    self.tendons.steel.forces_n,
                    self._stored_j,
                    strict=True,
                )
            )
        ]

    def _note(self, released_j: np.ndarray, how: str) -> None:
        for tendon in np.flatnonzero(released_j > LEAST_RELEASED_J).tolist():
            self.releases.append(Release(tendon, self._begins_s, how, float(released_j[tendon])))
