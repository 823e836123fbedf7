"""The ground that a run was on: how high it is at a place, and what lies on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, FillRule

from ..geometry.plan_areas import signed_area
from .surface import Surface


@dataclass(frozen=True, slots=True)
class NamedSurface:
    """A surface on the ground.

    Attributes
    ----------
    name, kind : str
        What it is called, and what it is, such as water.
    surface : Surface
        Its triangles.
    """

    name: str
    kind: str
    surface: Surface

    def plan(self) -> CrossSection:
        """What it covers in plan."""
        corners = self.surface.mesh.corners[:, :, :2]
        areas = signed_area(corners)
        corners = np.where((areas < 0.0)[:, None, None], corners[:, ::-1], corners)  # those of undersides as well
        return CrossSection(list(corners[areas != 0.0]), FillRule.NonZero)


@dataclass(frozen=True, slots=True)
class RecordedGround:
    """The ground of a run.

    Attributes
    ----------
    terrain : Surface or None
        The ground; None where it is flat, at height 0.
    surfaces : tuple of NamedSurface
        What lies on it.
    """

    terrain: Surface | None = None
    surfaces: tuple[NamedSurface, ...] = ()

    @property
    def is_flat(self) -> bool:
        """Whether it is at height 0 everywhere."""
        return self.terrain is None and not self.surfaces

    def heights_at(self, places_m: np.ndarray) -> np.ndarray:
        """Heights (...) of ground and surfaces at places (..., 2), m; beyond its edge, that of its lowest place."""
        places = np.asarray(places_m, float)
        flat = places.reshape(-1, 2)
        heights = np.zeros(len(flat))
        if self.terrain is not None:
            heights = self.terrain.heights_at(flat)
            heights = np.where(np.isnan(heights), self.terrain.mesh.vertices[:, 2].min(), heights)
        for each in self.surfaces:
            heights = np.fmax(heights, each.surface.heights_at(flat))
        return heights.reshape(places.shape[:-1])
