"""Solids of one outline along the road all across it, in pieces between sections, such as an arch or a deck with
haunches."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh
from .vectors import unit


@dataclass(frozen=True, slots=True, eq=False)
class RoadProfile:
    """Corners of a solid of n - 1 straight pieces, whose sections between them go from underside to top.

    `undersides_m` and `tops_m` are (n, 2), positions along the road and heights.
    """

    undersides_m: FloatArray
    tops_m: FloatArray

    @property
    def outlines_m(self) -> list[FloatArray]:
        """Return the outline (4, 2) of each piece, counter-clockwise."""
        sides = list(zip(self.undersides_m, self.tops_m, strict=True))
        return [
            np.array((under, next_under, next_top, top)) for (under, top), (next_under, next_top) in pairwise(sides)
        ]

    @property
    def directions(self) -> FloatArray:
        """Return the directions (n - 1, 2), of length 1, of the middle lines of the pieces."""
        return unit(np.diff(0.5 * (self.undersides_m + self.tops_m), axis=0))

    def pieces(self, width_m: float, across_m: float = 0.0) -> tuple[TriangleMesh, ...]:
        """Return the pieces, convex where their outlines are."""
        return tuple(across_road(outline, width_m, across_m) for outline in self.outlines_m)

    def solid(self, width_m: float, across_m: float = 0.0) -> TriangleMesh:
        """Return the whole, as wide to either side of a position across the road."""
        count = len(self.undersides_m)
        under = np.arange(count - 1)
        top = 2 * count - 1 - under
        halves = np.column_stack((under, under + 1, top - 1, under, top - 1, top))
        outline = np.concatenate((self.undersides_m, self.tops_m[::-1]))
        return across_road(outline, width_m, across_m, halves.reshape(-1, 3))


def across_road(
    outline_m: FloatArray, width_m: float, across_m: float = 0.0, triangles: IntArray | None = None
) -> TriangleMesh:
    """Return the solid of an outline upright along the road, as wide to either side of a position across it.

    Parameters
    ----------
    outline_m : (n, 2) float
        Corners by position along x and height, counter-clockwise.
    width_m
        Width along y.
    across_m
        Position of its middle along y.
    triangles : (t, 3) int, optional
        Corners of triangles that fill it, counter-clockwise; by default those of a convex one.
    """
    count = len(outline_m)
    corner = np.arange(count)
    if triangles is None:
        triangles = np.column_stack((np.zeros(count - 2, np.int64), corner[1:-1], corner[2:]))
    right, left = (np.insert(outline_m, 1, across_m + side * width_m, axis=1) for side in (-0.5, 0.5))
    after = np.roll(corner, -1)
    around = np.column_stack((corner, corner + count, after + count, corner, after + count, after)).reshape(-1, 3)
    return TriangleMesh(np.concatenate((right, left)), np.concatenate((triangles, triangles[:, ::-1] + count, around)))
