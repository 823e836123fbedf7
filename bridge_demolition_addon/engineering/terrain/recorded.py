"""The ground that a run was on: its height at a position, and the surfaces on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, FillRule

from ..arrays import FloatArray
from ..geometry.plan_areas import signed_area
from .surface import Surface

_LEVEL_M = 1e-4
"""Heights that differ by less are one: those of a kilometre in single precision do."""


@dataclass(frozen=True, slots=True)
class NamedSurface:
    """A surface on the ground; its kind is a word such as water."""

    name: str
    kind: str
    surface: Surface

    @property
    def level_m(self) -> float | None:
        """Height of its upper side, m; None where that is not level."""
        corners = self.surface.mesh.corners
        up = signed_area(corners[:, :, :2]) > 0.0
        heights = corners[up, :, 2]
        return float(heights.max()) if len(heights) and np.ptp(heights) <= _LEVEL_M else None

    def plan(self) -> CrossSection:
        """Return the area that it covers in plan, above the ground or below it."""
        return _covered(self.surface.mesh.corners[:, :, :2])


@dataclass(frozen=True, slots=True)
class RecordedGround:
    """The ground of a run, and the surfaces on it; without `terrain` it is flat, at height 0."""

    terrain: Surface | None = None
    surfaces: tuple[NamedSurface, ...] = ()

    @property
    def is_flat(self) -> bool:
        """Whether it is at height 0 everywhere."""
        return self.terrain is None and not self.surfaces

    def shown(self, surface: NamedSurface) -> CrossSection:
        """Return the area of a surface in plan where it lies above the terrain: of water, up to its shores.

        Of a surface that is not level it is all of its plan.
        """
        plan, level = surface.plan(), surface.level_m
        if self.terrain is None or level is None:
            return plan
        return plan - _covered_above(self.terrain.mesh.corners, level, np.array(plan.bounds()).reshape(2, 2))

    def heights_at(self, positions_m: FloatArray) -> FloatArray:
        """Heights (...) of ground and surfaces at positions (..., 2), m; beyond its edge, the lowest of the terrain."""
        positions = np.asarray(positions_m, float)
        flat = positions.reshape(-1, 2)
        heights = np.zeros(len(flat))
        if self.terrain is not None:
            heights = self.terrain.heights_at(flat)
            heights = np.where(np.isnan(heights), self.terrain.mesh.vertices[:, 2].min(), heights)
        for surface in self.surfaces:
            heights = np.fmax(heights, surface.surface.heights_at(flat))
        return heights.reshape(positions.shape[:-1])


def _covered(corners: FloatArray) -> CrossSection:
    """Area of triangles (t, 3, 2) in plan, whichever side of them is up."""
    areas = signed_area(corners)
    corners = np.where((areas < 0.0)[:, None, None], corners[:, ::-1], corners)
    return CrossSection(list(corners[areas != 0.0]), FillRule.NonZero)


def _covered_above(corners: FloatArray, level_m: float, bounds_m: FloatArray) -> CrossSection:
    """Area in plan of the parts of triangles (t, 3, 3) above a level, of those that meet a box (2, 2)."""
    plan = corners[:, :, :2]
    meets = (plan.max(axis=1) >= bounds_m[0]).all(axis=1) & (plan.min(axis=1) <= bounds_m[1]).all(axis=1)
    parts = []
    for triangle in corners[meets & (corners[:, :, 2].max(axis=1) > level_m)]:
        above = triangle[:, 2] > level_m
        outline = []
        for row in range(3):
            here, there = triangle[row], triangle[(row + 1) % 3]
            if above[row]:
                outline.append(here[:2])
            if above[row] != above[(row + 1) % 3]:
                share = (level_m - here[2]) / (there[2] - here[2])
                outline.append(here[:2] + share * (there[:2] - here[:2]))
        parts.append(np.array(outline))
    return CrossSection(parts, FillRule.NonZero)
