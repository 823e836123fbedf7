"""Forces of bearings over one frame, gathered from its sub-steps: sums over the connections at their pads."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.vectors import cross_by_component, length, transformed, transformed_back
from .frame_loads import SubstepLoads

_NOTHING = 1e-4
"""A part of a bearing that carries no more than this, of what the part that carries most does then, is open: Bullet
leaves the rounding of its solver in all of them."""


@dataclass(frozen=True, slots=True, eq=False)
class BearingPads:
    """The c connections at the pads of b bearings, in the order of these, as the bridge was built.

    Vectors are in the axes of the body that they begin in.
    """

    rows: IntArray  # (c,), connections
    starts: IntArray  # (b,), where each bearing's begin
    bodies: IntArray  # (2, c), above and below
    anchors_m: FloatArray  # (2, c, 3), from the centres of these to the middle of what carries
    levers_m: FloatArray  # (c, 3), from the middle of the bearing's axis to there, in the body above
    shares: FloatArray  # (c,), of the area of the bearing
    sideways_n_m: FloatArray  # (c, 2), stiffness along x and y; 0 where it moves freely, infinite where it is rigid
    lifts_off: BoolArray  # (c,), whether it does not hold what is lifted

    @classmethod
    def as_built(
        cls,
        rows: IntArray,
        bearings: IntArray,
        pairs: IntArray,
        points_m: FloatArray,
        areas_m2: FloatArray,
        sideways_n_m: FloatArray,
        lifts_off: BoolArray,
        positions_m: FloatArray,
        rotations: FloatArray,
    ) -> BearingPads:
        """Return the pads of connections (c,), each of one of the bearings 0 to b - 1.

        Each connection has its pair (c, 2) of bodies, the upper one first, its point (c, 3), area (c,), stiffness (c,
        2) and whether it lifts off (c,). Positions (n, 3) and rotations (n, 3, 3) are of the bodies as built.
        """
        order = np.argsort(bearings, kind="stable")
        of, points = bearings[order], points_m[order]
        starts = np.flatnonzero(np.diff(of, prepend=-1))
        areas = np.where(np.add.reduceat(areas_m2[order], starts)[of] > 0.0, areas_m2[order], 1.0)
        shares = areas / np.add.reduceat(areas, starts)[of]
        middles = np.add.reduceat(shares[:, None] * points, starts)
        bodies = pairs[order].T
        anchors = [transformed_back(rotations[side], points - positions_m[side]) for side in bodies]
        levers = transformed_back(rotations[bodies[0]], points - middles[of])
        return cls(
            rows[order], starts, bodies, np.stack(anchors), levers, shares, sideways_n_m[order], lifts_off[order]
        )


@dataclass(frozen=True, slots=True, eq=False)
class BearingLoads:
    """Forces of b bearings on what lies above them in one frame, and how that has moved against what lies below.

    Moments are about the middle of each bearing's axis, which moves with what lies above it.
    """

    forces_n: FloatArray  # (b, 3), mean
    moments_nm: FloatArray  # (b, 3), mean
    largest_up_n: FloatArray  # (b,), largest vertical force in a sub-step
    least_up_n: FloatArray  # (b,), smallest; below 0 it holds against uplift
    largest_horizontal_n: FloatArray  # (b,), in a sub-step
    largest_moment_y_nm: FloatArray  # (b,), largest magnitude about the axis across the road in a sub-step
    open_shares: FloatArray  # (b,), largest share of its area that had lifted off in a sub-step
    displacements_m: FloatArray  # (b, 3), at the end of the frame, from where they were built
    slips_m: FloatArray  # (b,), horizontal displacement there that no elastic deformation explains; nan if not known

    @property
    def carry_nothing(self) -> BoolArray:
        """Bearings (b,) on which no force acted in any sub-step."""
        nothing: BoolArray = (self.largest_up_n == 0.0) & (self.least_up_n == 0.0) & (self.largest_horizontal_n == 0.0)
        return nothing

    def unknown_at(self, bearings: BoolArray) -> BearingLoads:
        """Return them with nan for the forces of some bearings (b,), and for what follows from these."""
        of_forces = {item.name: getattr(self, item.name).copy() for item in fields(self)}
        for name, values in of_forces.items():
            if name != "displacements_m":
                values[bearings] = np.nan
        return BearingLoads(**of_forces)


class BearingAccumulator:
    """Adds up the forces of bearings in a frame, some sub-steps at a time."""

    def __init__(self, pads: BearingPads):
        self._pads = pads
        self.begin()

    def begin(self) -> None:
        """Begin a new frame."""
        count = len(self._pads.starts)
        self._duration_s = 0.0
        self._impulses, self._angular_impulses = np.zeros((2, count, 3))
        self._largest_up, self._least_up = np.full(count, -np.inf), np.full(count, np.inf)
        self._horizontal, self._moment, self._open = np.zeros((3, count))
        self._displacements, self._slips = np.zeros((count, 3)), np.zeros(count)

    def add(self, loads: SubstepLoads) -> None:
        """Add the loads of some sub-steps."""
        pads = self._pads
        of_pads = loads.connection_forces_n[:, pads.rows]
        levers = transformed(loads.rotations.take(pads.bodies[0], axis=1), pads.levers_m)
        moments = self._summed(loads.connection_moments_nm[:, pads.rows] + cross_by_component(levers, of_pads))
        forces = self._summed(of_pads)
        for substep, substep_s in enumerate(loads.substeps_s.tolist()):
            self._impulses += substep_s * forces[substep]
            self._angular_impulses += substep_s * moments[substep]
            self._duration_s += substep_s
        self._largest_up = np.maximum(self._largest_up, forces[..., 2].max(axis=0))
        self._least_up = np.minimum(self._least_up, forces[..., 2].min(axis=0))
        self._horizontal = np.maximum(self._horizontal, length(forces[..., :2]).max(axis=0))
        self._moment = np.maximum(self._moment, abs(moments[..., 1]).max(axis=0))
        vertical = abs(of_pads[..., 2])
        is_open = vertical <= _NOTHING * vertical.max(axis=1, keepdims=True)
        self._open = np.maximum(self._open, self._summed(pads.shares * (is_open & pads.lifts_off)).max(axis=0))
        self._note_displacements(loads.centres_m[-1], loads.rotations[-1], of_pads[-1])

    def finish(self) -> BearingLoads | None:
        """Return the forces of the frame so far; None where no time passed."""
        if not self._duration_s:
            return None
        return BearingLoads(
            forces_n=self._impulses / self._duration_s,
            moments_nm=self._angular_impulses / self._duration_s,
            largest_up_n=self._largest_up,
            least_up_n=self._least_up,
            largest_horizontal_n=self._horizontal,
            largest_moment_y_nm=self._moment,
            open_shares=np.minimum(self._open, 1.0),
            displacements_m=self._displacements,
            slips_m=self._slips,
        )

    def _note_displacements(self, centres_m: FloatArray, rotations: FloatArray, forces_n: FloatArray) -> None:
        pads = self._pads
        above, below = (
            centres_m[bodies] + transformed(rotations[bodies], anchors)
            for bodies, anchors in zip(pads.bodies, pads.anchors_m, strict=True)
        )
        moved = above - below
        self._displacements = np.add.reduceat(pads.shares[:, None] * moved, pads.starts)
        holds = pads.sideways_n_m > 0.0
        deformed = np.divide(-forces_n[:, :2], pads.sideways_n_m, out=moved[:, :2].copy(), where=holds)
        self._slips = np.maximum.reduceat(length(moved[:, :2] - deformed), pads.starts)
        is_rigid = np.logical_or.reduceat(np.isinf(pads.sideways_n_m).any(axis=1), pads.starts)
        self._slips = np.where(is_rigid, np.nan, self._slips)

    def _summed(self, values: FloatArray) -> FloatArray:
        """Sums (s, b, …) over the connections (s, c, …) of each bearing."""
        sums: FloatArray = np.add.reduceat(values, self._pads.starts, axis=1)
        return sums
