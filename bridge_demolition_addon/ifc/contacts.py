"""Members that touch each other, and what lies under and over them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import to_manifold

TOUCHING_M = 1e-4
"""Gap up to which two members touch, as where connections are made."""

NEAR_M = 0.5
"""Gap up to which a member is a neighbour."""


class NearbyMembers:
    """Solids of members, each replaceable, and what is near each."""

    def __init__(self, solids: Sequence[TriangleMesh]) -> None:
        self._solids = list(solids)
        self._bounds = np.array([solid.bounds for solid in solids]).reshape(-1, 2, 3)
        self._manifolds: dict[int, Manifold] = {}

    def solid(self, index: int) -> TriangleMesh:
        """Return the solid of a member."""
        return self._solids[index]

    def replace(self, index: int, solid: TriangleMesh) -> None:
        """Replace the solid of a member."""
        self._solids[index], self._bounds[index] = solid, solid.bounds
        self._manifolds.pop(index, None)

    def near(self, index: int) -> list[tuple[float, int]]:
        """Return gaps in m to all members within `NEAR_M` of a member, and which they are, the nearest first."""
        return [(gap, other) for gap, other in self.near_to(self._solids[index]) if other != index]

    def near_to(self, solid: TriangleMesh) -> list[tuple[float, int]]:
        """Return gaps in m to all members within `NEAR_M` of a solid, and which they are, the nearest first."""
        own, (lowest, highest) = to_manifold(solid), solid.bounds
        may = ((self._bounds[:, 0] <= highest + NEAR_M) & (self._bounds[:, 1] >= lowest - NEAR_M)).all(axis=1)
        gaps = [(own.min_gap(self._manifold(other), NEAR_M), other) for other in np.flatnonzero(may).tolist()]
        return sorted((gap, other) for gap, other in gaps if gap < NEAR_M)

    def reached(self, solid: TriangleMesh, shift_m: float, but: int | None = None) -> dict[int, float]:
        """Return which members a solid reaches into when it is moved up by so much, and the volume of each, m³.

        One of them may be left out, such as the solid itself.
        """
        moved = to_manifold(solid).translate((0.0, 0.0, shift_m))
        lowest, highest = solid.bounds + np.array((0.0, 0.0, shift_m))
        may = np.flatnonzero(((self._bounds[:, 0] < highest) & (self._bounds[:, 1] > lowest)).all(axis=1))
        shared = {index: (moved ^ self._manifold(index)).volume() for index in may.tolist() if index != but}
        return {index: volume for index, volume in shared.items() if volume > 0.0}

    def _manifold(self, index: int) -> Manifold:
        if index not in self._manifolds:
            self._manifolds[index] = to_manifold(self._solids[index])
        return self._manifolds[index]
