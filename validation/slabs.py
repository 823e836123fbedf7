# SPDX-License-Identifier: GPL-3.0-or-later
"""Slabs on bearings at their two ends, with one layer of bars, cut into irregular shards."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from solids import block

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.vectors import transformed, transformed_back
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G
from bridge_demolition_addon.model.results.arrays import Results

DENSITY_KG_M3, BOTTOM_M, WALL_M, CONCRETE_PA = 2400.0, 3.0, 0.1, 30e9
NEAREST = 4
"""So many shards, those nearest to its middle, say where the middle of a slab is."""


@dataclass(frozen=True, slots=True)
class Slab:
    """A slab with one layer of bars along it, next to its bottom.

    Attributes
    ----------
    span_m, width_m, height_m : float
        Its sizes; half of a wall hangs over at each end.
    depth_m, area_mm2, yield_n_mm2 : float
        Depth of the bars below the top, their area and yield strength. They do not harden.
    compression_n_mm2 : float
        Strength of its concrete in compression.
    yields_at_m, ruptures_at_m : float
        Openings of a crack at which bars yield and rupture.
    """

    span_m: float
    width_m: float
    height_m: float
    depth_m: float
    area_mm2: float
    yield_n_mm2: float
    compression_n_mm2: float
    yields_at_m: float
    ruptures_at_m: float

    @property
    def length_m(self) -> float:
        """Length with what hangs over."""
        return self.span_m + WALL_M

    @property
    def mass_kg(self) -> float:
        """Mass of all of it."""
        return DENSITY_KG_M3 * self.length_m * self.width_m * self.height_m

    @property
    def moment_nm(self) -> float:
        """Plastic moment by hand: A f_y (d - a / 2), a = A f_y / (b f_c)."""
        pull = self.area_mm2 * self.yield_n_mm2
        return pull * (self.depth_m - 0.5 * pull / (self.width_m * self.compression_n_mm2 * 1e6))

    @property
    def load_n(self) -> float:
        """Even load of the whole length at which the middle has the plastic moment, w (L² - l²) / 8 with l beyond."""
        return 8.0 * self.moment_nm * self.length_m / (self.span_m**2 - WALL_M**2)

    @property
    def weight_n(self) -> float:
        """Weight of all of it."""
        return self.mass_kg * G

    @property
    def solids(self) -> Mapping[str, TriangleMesh]:
        """The slab, and the walls that it lies on."""
        end, half, wall = self.length_m / 2.0, self.width_m / 2.0, WALL_M
        return {
            "slab": block((-end, -half, BOTTOM_M), (end, half, BOTTOM_M + self.height_m)),
            "left": block((-end, -half, BOTTOM_M - 1.0), (wall - end, half, BOTTOM_M)),
            "right": block((end - wall, -half, BOTTOM_M - 1.0), (end, half, BOTTOM_M)),
        }

    def scenario(self, shards: int) -> str:
        """Its tables, cut into so many shards, besides one for each wall."""
        members = "".join(
            f'[[geometry]]\nname = "{name}"\nkind = "{kind}"\nfile = "{name}.stl"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
            for name, kind in (("slab", "slab"), ("left", "wall"), ("right", "wall"))
        )
        strain = self.yield_n_mm2 / 2e5 * self.ruptures_at_m / self.yields_at_m
        return f"""
{members}
[[supports]]
member = "wall"

[fracture]
shards = {shards}

[[materials]]
name = "of the slab"
compression_n_mm2 = {self.compression_n_mm2}
tension_n_mm2 = 2.9
shear_n_mm2 = 1000.0
torsion_n_mm2 = 1000.0
bending_n_mm2 = 2.9
elastic_modulus_n_mm2 = {1e-6 * CONCRETE_PA}

[[reinforcement]]
members = ["slab"]
side = "bottom"
depth_m = {self.height_m - self.depth_m:.3f}
area_mm2 = {self.area_mm2}
yield_n_mm2 = {self.yield_n_mm2}

[connections]
type = "FIXED"
method = "face"
material = "of the slab"
stiffness = "elastic"
ductile_elongation_m = {self.ruptures_at_m}
ductile_hardening = 1.0
ductile_rupture_strain = {strain:.6f}

[[bearings]]
members = ["slab", "left"]
kind = "pinned"

[[bearings]]
members = ["slab", "right"]
kind = "rocker"
"""


def sunk_m(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Times, and how far the middle of a slab has gone down, m: as the shards next to it carry it with them."""
    inventory, frames = results.inventory, results.frames
    own = np.flatnonzero((inventory.body_kinds == "shard") & (inventory.body_members == "slab"))
    own = own[np.argsort(abs(frames.positions_m[0, own, 0]))[:NEAREST]]
    to_middle = -frames.positions_m[0, own] * (1.0, 0.0, 0.0)
    levers = transformed(frames.rotations[:, own], transformed_back(frames.rotations[0, own], to_middle))
    heights = (frames.positions_m[:, own, 2] + levers[..., 2]).mean(axis=1)
    return frames.time_s, heights[0] - heights
