# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams of two stiff halves on hinges at their ends, which crack in the middle; bars hold the crack together."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from solids import block

from bridge_demolition_addon.engineering.elasticity.steel_bars import MODULUS_PA
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.model.results.arrays import Results

DENSITY_KG_M3 = 2400.0
RUPTURE_STRAIN = 0.5
"""As large as can be, so that bars do not rupture."""


@dataclass(frozen=True, slots=True)
class Beam:
    """A beam in two halves, from -span / 2 to span / 2, with one layer of bars.

    Attributes
    ----------
    span_m, width_m, height_m, bottom_m : float
        Its sizes, and how high it is.
    side, depth_m, area_mm2, yield_n_mm2 : str and float
        Side next to the bars, distance to them from the other side, their area and yield strength.
    compression_n_mm2, cracks_n_mm2 : float
        Strength of its concrete in compression, and stress by bending at which it cracks.
    yields_at_m : float
        Opening of its crack at the edge at which bars yield. They do not harden.
    """

    span_m: float
    width_m: float
    height_m: float
    bottom_m: float
    side: str
    depth_m: float
    area_mm2: float
    yield_n_mm2: float
    compression_n_mm2: float
    cracks_n_mm2: float
    yields_at_m: float

    @property
    def mass_kg(self) -> float:
        """Mass between the hinges."""
        return DENSITY_KG_M3 * self.span_m * self.width_m * self.height_m

    @property
    def moment_nm(self) -> float:
        """Plastic moment by hand: A f_y (d - a / 2), a = A f_y / (b f_c)."""
        pull = self.area_mm2 * self.yield_n_mm2
        return pull * (self.depth_m - 0.5 * pull / (self.width_m * self.compression_n_mm2 * 1e6))

    @property
    def yields_by_m(self) -> float:
        """Deflection of the middle at which its bars yield: halves turn about the pressed edge."""
        return self.yields_at_m * self.span_m / (4.0 * self.height_m)

    @property
    def solids(self) -> Mapping[str, TriangleMesh]:
        """The beam, and posts beside its ends."""
        end, half, top = self.span_m / 2.0, self.width_m / 2.0, self.bottom_m + self.height_m
        return {
            "beam": block((-end, -half, self.bottom_m), (end, half, top)),
            "left": block((-end - 0.5, -half, self.bottom_m), (-end, half, top)),
            "right": block((end, -half, self.bottom_m), (end + 0.5, half, top)),
        }

    @property
    def scenario(self) -> str:
        """Its tables."""
        members = "".join(
            f'[[geometry]]\nname = "{name}"\nkind = "{kind}"\nfile = "{name}.stl"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
            for name, kind in (("beam", "beam"), ("left", "post"), ("right", "post"))
        )
        ruptures_at_m = self.yields_at_m * RUPTURE_STRAIN * MODULUS_PA / (1e6 * self.yield_n_mm2)
        middle = self.bottom_m + self.height_m / 2.0
        return f"""
{members}
[[supports]]
member = "post"

[fracture]
shards = 4

[[fracture.points]]
position_m = [{-self.span_m / 4.0}, 0.0, {middle}]

[[fracture.points]]
position_m = [{self.span_m / 4.0}, 0.0, {middle}]

[[materials]]
name = "of the beam"
compression_n_mm2 = {self.compression_n_mm2}
tension_n_mm2 = {self.cracks_n_mm2}
shear_n_mm2 = 1000.0
torsion_n_mm2 = 1000.0
bending_n_mm2 = {self.cracks_n_mm2}
elastic_modulus_n_mm2 = 30000.0

[[materials]]
name = "of the hinges"
compression_n_mm2 = 1e6
tension_n_mm2 = 1e6
shear_n_mm2 = 1e6
torsion_n_mm2 = 1e6
bending_n_mm2 = 1e6
elastic_modulus_n_mm2 = 30000.0

[[reinforcement]]
members = ["beam"]
side = "{self.side}"
depth_m = {self.height_m - self.depth_m}
area_mm2 = {self.area_mm2}
yield_n_mm2 = {self.yield_n_mm2}

[connections]
type = "FIXED"
method = "face"
material = "of the beam"
stiffness = "elastic"
ductile_elongation_m = {ruptures_at_m}
ductile_hardening = 1.0
ductile_rupture_strain = {RUPTURE_STRAIN}

[[connections.between]]
members = ["beam", "post"]
type = "GENERIC"
free = ["move x", "turn y"]
material = "of the hinges"
"""


def middle_m(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Times, and how far the middle of a beam has gone up, m: twice as far as the middles of its halves."""
    inventory, frames = results.inventory, results.frames
    halves = np.flatnonzero((inventory.body_kinds == "shard") & (inventory.body_members == "beam"))
    heights = frames.positions_m[:, halves, 2].mean(axis=1)
    return frames.time_s, 2.0 * (heights - heights[0])
