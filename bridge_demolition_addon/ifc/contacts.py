"""Members that touch each other, and what lies under and over them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from manifold3d import Manifold

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import to_manifold

TOUCHING_M = 1e-4
"""Gap up to which two members touch, as where connections are made."""

NEAR_M = 0.5
"""Gap up to which a member is a neighbour."""


class NearbyMembers:
    """Solids of members, and what is near each of them."""

    def __init__(self, solids: Sequence[TriangleMesh]) -> None:
        self._solids = tuple(solids)

    def solid(self, index: int) -> TriangleMesh:
        """Return the solid of a member."""
        return self._solids[index]

    def near(self, index: int) -> list[tuple[float, int]]:
        """Return gaps in m to all members within `NEAR_M` of a member, and which they are, the nearest first."""
        return [(gap, other) for gap, other in self.near_to(self._solids[index]) if other != index]

    def near_to(self, solid: TriangleMesh) -> list[tuple[float, int]]:
        """Return gaps in m to all members within `NEAR_M` of a solid, and which they are, the nearest first."""
        own, (lowest, highest) = to_manifold(solid), solid.bounds
        may = ((self._lowest <= highest + NEAR_M) & (self._highest >= lowest - NEAR_M)).all(axis=1)
        gaps = [(own.min_gap(self._manifolds[other], NEAR_M), other) for other in np.flatnonzero(may).tolist()]
        return sorted((gap, other) for gap, other in gaps if gap < NEAR_M)

    def reached(self, solid: TriangleMesh, shift_m: float) -> dict[int, float]:
        """Return which members a solid reaches into when it is moved up by so much, and the volume of each, m³."""
        moved = to_manifold(solid).translate((0.0, 0.0, shift_m))
        lowest, highest = solid.bounds + np.array((0.0, 0.0, shift_m))
        may = np.flatnonzero(((self._lowest < highest) & (self._highest > lowest)).all(axis=1))
        shared = {index: (moved ^ self._manifolds[index]).volume() for index in may.tolist()}
        return {index: volume for index, volume in shared.items() if volume > 0.0}

    @cached_property
    def _manifolds(self) -> list[Manifold]:
        return [to_manifold(solid) for solid in self._solids]

    @cached_property
    def _lowest(self) -> np.ndarray:
        return np.array([solid.bounds[0] for solid in self._solids]).reshape(-1, 3)

    @cached_property
    def _highest(self) -> np.ndarray:
        return np.array([solid.bounds[1] for solid in self._solids]).reshape(-1, 3)
