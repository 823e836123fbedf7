"""Areas in plan where one solid lies on another, and lines across them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, FillRule

from ..arrays import FloatArray
from .mesh import TriangleMesh, triangle_areas_and_normals
from .plan_areas import outlines, signed_area, united
from .vectors import cross_2d, dot

_LEVEL = 0.7
"""Least vertical part of the normal of a face that something lies on."""

_OPPOSITE = -1.0 + 1e-6
_TOUCHING_M = 1e-4
_SMALLEST_M2 = 1e-6
_UPRIGHT = 1e-9
"""Skew below which an axis runs straight across the road: what rounding leaves."""


@dataclass(frozen=True, slots=True, eq=False)
class LevelContact:
    """One area in plan where a solid lies on another."""

    rings: tuple[FloatArray, ...]  # (k, 2) each, in m; outer ones run anticlockwise
    middle_m: FloatArray  # (2,), of the area
    area_m2: float
    skew: float  # shift of its axis along x, by y
    planes: FloatArray  # (t, 3, 3), triangles of the upper solid that it is in

    def axis_chords(self, offset_m: float) -> FloatArray:
        """Return the parts of the area's axis that lie in it, (k, 2): begin and end along it, from the middle, m.

        The axis runs through the middle, shifted along x by an offset.
        """
        origin, direction = self.middle_m + np.array([offset_m, 0.0]), self.direction
        crossings = []
        for ring in self.rings:
            ends = np.roll(ring, -1, axis=0)
            heights, next_heights = cross_2d(direction, ring - origin), cross_2d(direction, ends - origin)
            crosses = (heights < 0.0) != (next_heights < 0.0)
            share = (heights / np.where(crosses, heights - next_heights, 1.0))[crosses]
            points = ring[crosses] + share[:, None] * (ends - ring)[crosses]
            crossings.append(dot(points - origin, direction))
        return np.sort(np.concatenate(crossings)).reshape(-1, 2)

    @property
    def direction(self) -> FloatArray:
        """Unit vector (2,) along the axis."""
        along = np.array([self.skew, 1.0])
        unit: FloatArray = along / np.sqrt(dot(along, along))
        return unit

    def at(self, along_m: FloatArray, shift_m: FloatArray) -> FloatArray:
        """Return positions (k, 3) along the axis from the middle, shifted along x."""
        plan = self.middle_m + along_m[:, None] * self.direction
        plan[:, 0] += shift_m
        return np.column_stack((plan, self._heights(plan)))

    @property
    def plane(self) -> tuple[FloatArray, float]:
        """Normal (3,), upwards, and offset of the plane of its largest triangle, m."""
        areas, normals = triangle_areas_and_normals(self.planes)
        largest = int(areas.argmax())
        normal = -normals[largest]
        return normal, float(dot(normal, self.planes[largest, 0]))

    def _heights(self, points: FloatArray) -> FloatArray:
        """Heights (k,) of the area at points (k, 2): of the triangle that is around a point, or nearest to that."""
        corners = self.planes[:, :, :2]
        sides = np.roll(corners, -1, axis=1) - corners
        arms = points[:, None, None] - corners
        outside = (-cross_2d(sides, arms) * np.sign(signed_area(corners))[:, None]).max(axis=2)
        nearest = self.planes[outside.argmin(axis=1)]
        _, normals = triangle_areas_and_normals(nearest)
        off = points - nearest[:, 0, :2]
        heights: FloatArray = nearest[:, 0, 2] - dot(normals[:, :2], off) / normals[:, 2]
        return heights


def level_contacts(above: TriangleMesh, below: TriangleMesh) -> list[LevelContact]:
    """Return the areas where a solid lies on another, in order of x and y; none where it does not."""
    upper, lower = _level_faces(above, -1.0), _level_faces(below, 1.0)
    first, second = _touching(upper, lower)
    if not first:
        return []
    pieces = [_in_plan(upper[one]) ^ _in_plan(lower[other]) for one, other in zip(first, second, strict=True)]
    islands = united([piece for piece in pieces if piece.area() > 0.0]).decompose()
    large = [island for island in islands if island.area() > _SMALLEST_M2]  # of slivers no outline may be left
    contacts = [_contact(outlines(island), upper[np.unique(first)]) for island in large]
    return sorted(contacts, key=lambda contact: contact.middle_m.tolist())


def _level_faces(solid: TriangleMesh, way: float) -> FloatArray:
    """Triangles (t, 3, 3) that look up (1) or down (-1)."""
    corners = solid.corners
    areas, normals = triangle_areas_and_normals(corners)
    return corners[(way * normals[:, 2] > _LEVEL) & (areas > 0.0)]


def _touching(upper: FloatArray, lower: FloatArray) -> tuple[list[int], list[int]]:
    """Rows of triangles that touch, of each of both (t, 3, 3)."""
    meets = np.ones((len(upper), len(lower)), bool)
    for axis in range(3):
        one, other = upper[..., axis], lower[..., axis]
        meets &= one.min(axis=1)[:, None] <= other.max(axis=1) + _TOUCHING_M
        meets &= other.min(axis=1) <= one.max(axis=1)[:, None] + _TOUCHING_M
    first, second = np.nonzero(meets)
    _, looks = triangle_areas_and_normals(upper)
    _, faces = triangle_areas_and_normals(lower)
    gaps = dot(upper[first, 0] - lower[second, 0], faces[second])
    touch = (dot(looks[first], faces[second]) < _OPPOSITE) & (abs(gaps) <= _TOUCHING_M)
    return first[touch].tolist(), second[touch].tolist()


def _in_plan(triangle: FloatArray) -> CrossSection:
    return CrossSection([triangle[:, :2]], FillRule.NonZero if signed_area(triangle[:, :2]) > 0 else FillRule.Negative)


def _contact(rings: list[FloatArray], planes: FloatArray) -> LevelContact:
    """Area within rings; holes run clockwise; its axis follows the middles along the road."""
    base = rings[0][0]
    area, first, second = 0.0, np.zeros(2), np.zeros(2)
    for ring in rings:
        here = ring - base
        there = np.roll(here, -1, axis=0)
        crossed = cross_2d(here, there)
        area += float(crossed.sum()) / 2.0
        first += (crossed[:, None] * (here + there)).sum(axis=0) / 6.0
        # ∫ y² dA and ∫ x y dA of the triangles from the base.
        second[0] += (
            float((crossed * (here[:, 1] * here[:, 1] + there[:, 1] * (here[:, 1] + there[:, 1]))).sum()) / 12.0
        )
        mixed = here[:, 0] * (2.0 * here[:, 1] + there[:, 1]) + there[:, 0] * (here[:, 1] + 2.0 * there[:, 1])
        second[1] += float((crossed * mixed).sum()) / 24.0
    if area <= 0.0:
        return LevelContact(tuple(rings), base, 0.0, 0.0, planes)
    middle = first / area
    spread, mixed_spread = second[0] - area * middle[1] * middle[1], second[1] - area * middle[0] * middle[1]
    skew = mixed_spread / spread
    return LevelContact(tuple(rings), base + middle, area, skew if abs(skew) > _UPRIGHT else 0.0, planes)
