"""Debris on surfaces such as water or the carriageway below, and bodies under the ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..results.arrays import Results
from ..results.motion import MOVED_M, relative_to_ground
from .footprint import corners_at
from .throws import Debris

_BELOW_M = 0.1
"""How far all of a body has to be below the ground to have gone through it, and not into a dip between two heights."""


@dataclass(frozen=True, slots=True)
class SurfaceDebris:
    """Debris on a surface: `bodies` (d,) whose centres lie over it in plan in the end, and not below it.

    `covered_m2` is the part of its area that debris covers.
    """

    name: str
    kind: str
    bodies: np.ndarray
    mass_kg: float
    covered_m2: float


def debris_on_surfaces(results: Results, debris: Debris) -> tuple[SurfaceDebris, ...]:
    """Return the debris on each surface of the ground, at the last recorded step."""
    results = relative_to_ground(results)
    positions = results.frames.positions_m[-1, debris.bodies]
    on_surfaces = []
    for surface in debris.ground.surfaces:
        level = surface.surface.heights_at(positions[:, :2])  # nan beside it
        # Water lies below the ground beyond its shores.
        on_it = (positions[:, 2] >= level - MOVED_M) & (level >= debris.ground.heights_at(positions[:, :2]))
        mass = float(debris.masses_kg[on_it].sum())
        covered = float((debris.area ^ debris.ground.shown(surface)).area())
        on_surfaces.append(SurfaceDebris(surface.name, surface.kind, debris.bodies[on_it], mass, covered))
    return tuple(on_surfaces)


def bodies_under_ground(results: Results) -> np.ndarray:
    """Return shards and balls that lie wholly below the ground in the end: they fell through it, or off its edge."""
    results = relative_to_ground(results)
    inventory, ground = results.inventory, results.ground()
    bodies = np.concatenate([inventory.of_kind("shard"), inventory.of_kind("ball")])
    positions = results.frames.positions_m[-1, bodies]
    bodies = bodies[positions[:, 2] < ground.heights_at(positions[:, :2])]  # of all others a part is above it
    under = [
        (corners[:, 2] < ground.heights_at(corners[:, :2]) - _BELOW_M).all()
        for corners in corners_at(results, -1, bodies)
    ]
    return bodies[np.array(under, bool)]
