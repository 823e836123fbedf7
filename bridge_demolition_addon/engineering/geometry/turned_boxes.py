"""Boxes that are turned about the vertical, as parts of skewed bridges are given by."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray
from .mesh import TriangleMesh
from .vectors import turn_by_degrees

_Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class TurnedBox:
    """A box between two corners, turned about the vertical through its middle: with a skew above 0 its sides across the
    road have their ends towards positive y further along the road, clockwise seen from above.

    Its own axes are those in which its sides lie along the axes, and its corners are where they are given.
    """

    lowest_m: _Corner
    highest_m: _Corner
    skew_deg: float = 0.0

    @property
    def corners_m(self) -> FloatArray:
        """Lowest and highest corner (2, 3), in its own axes."""
        return np.array((self.lowest_m, self.highest_m))

    def contains(self, points_m: FloatArray) -> BoolArray:
        """Return whether points (k, 3) are in it."""
        own = self.in_own_axes(points_m)
        return np.asarray(((own >= self.lowest_m) & (own <= self.highest_m)).all(axis=1))

    def in_own_axes(self, points_m: FloatArray) -> FloatArray:
        """Return points (k, 3) in its own axes."""
        return self._turned(points_m, self.skew_deg, about_middle=True)

    def direction_in_own_axes(self, direction: FloatArray) -> FloatArray:
        """Return a direction (3,) in its own axes."""
        turned: FloatArray = self._turned(direction[None], self.skew_deg, about_middle=False)[0]
        return turned

    def solid_in_own_axes(self, solid: TriangleMesh) -> TriangleMesh:
        """Return a solid in its own axes."""
        return TriangleMesh(self.in_own_axes(solid.vertices), solid.triangles) if self.skew_deg else solid

    def solid_in_world(self, solid: TriangleMesh) -> TriangleMesh:
        """Return a solid that is given in its own axes."""
        if not self.skew_deg:
            return solid
        return TriangleMesh(self._turned(solid.vertices, -self.skew_deg, about_middle=True), solid.triangles)

    def _turned(self, points_m: FloatArray, angle_deg: float, *, about_middle: bool) -> FloatArray:
        """Turn points anticlockwise."""
        if not angle_deg:
            return points_m
        middle = self.corners_m.mean(axis=0)[:2] if about_middle else np.zeros(2)
        (a, b), (c, d) = turn_by_degrees(angle_deg)
        x, y = (points_m[:, :2] - middle).T
        return np.column_stack((a * x + b * y + middle[0], c * x + d * y + middle[1], points_m[:, 2]))
