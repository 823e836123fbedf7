"""Bearings of a model: the springs in its connections, and the forces that they carry."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ...engineering.geometry.vectors import cross
from ...engineering.mechanics.section_cuts import ConnectionLoads


@dataclass(frozen=True, slots=True, eq=False)
class ModelBearings:
    """The b bearings of a model, and the springs of their pads in its connections."""

    names: tuple[str, ...]
    springs: PadSprings

    def followed_by(self, others: ModelBearings) -> ModelBearings:
        """Return these bearings and others, in connections that come after theirs."""
        counted_on = replace(others.springs, bearings=len(self.names) + others.springs.bearings)
        return ModelBearings((*self.names, *others.names), self.springs.followed_by(counted_on))

    def among(self, kept: np.ndarray, first_row: int) -> ModelBearings:
        """Return them where only some of their connections (c,) are kept, which are counted from a row."""
        springs = self.springs.among(kept)
        return ModelBearings(self.names, replace(springs, rows=first_row + springs.rows))

    def rows_of(self, bearing: int) -> np.ndarray:
        """Return the connections (k,) of a bearing."""
        return self.springs.rows[self.springs.bearings == bearing]

    def forces(self, loads: ConnectionLoads) -> list[BearingForce]:
        """Return the force of each bearing, by the connections' loads on their first bodies."""
        return [self._force(number, loads) for number in range(len(self.names))]

    def utilisations(self, loads: ConnectionLoads, intact: np.ndarray, left: np.ndarray) -> np.ndarray:
        """Return the part (c,) of its breaking force that the bearing of each of its connections carries.

        All connections (m,) are `intact` or not, and have a part `left` of their strength.
        """
        rows = self.springs.rows
        return self.springs.utilisations((loads.forces_n[rows] * intact[rows, None]).T, left[rows])

    def broken_together(self, rows: np.ndarray) -> np.ndarray:
        """Return connections (k,) that break, with all others of the bearings among them."""
        bearings = self.springs.bearings[np.isin(self.springs.rows, rows)]
        return np.union1d(rows, self.springs.rows[np.isin(self.springs.bearings, bearings)])

    def _force(self, number: int, loads: ConnectionLoads) -> BearingForce:
        rows = self.rows_of(number)
        of_springs = np.isin(self.springs.parts, np.flatnonzero(self.springs.bearings == number))
        axis = self.springs.places_m[of_springs].mean(axis=0) if len(rows) else np.zeros(3)
        moments = loads.moments_nm[rows] + cross(loads.points_m[rows] - axis, loads.forces_n[rows])
        return BearingForce(self.names[number], axis, loads.forces_n[rows].sum(axis=0), moments.sum(axis=0))


@dataclass(frozen=True, slots=True, eq=False)
class BearingForce:
    """Force of a bearing on what lies above it, N, and its moment about the middle of its axis, N·m; all (3,)."""

    name: str
    axis_m: np.ndarray
    force_n: np.ndarray
    moment_nm: np.ndarray
