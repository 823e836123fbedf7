# SPDX-License-Identifier: GPL-3.0-or-later
"""Simply supported reinforced beams in irregular shards under a load in their middle that grows."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from case import RIGID_BODIES, simulated
from matplotlib.axes import Axes
from solids import block

from bridge_demolition_addon.engineering.elasticity.steel_bars import MODULUS_PA, tensile_strength_pa
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

DENSITY_KG_M3, BOTTOM_M, WALL_M, YIELD_N_MM2, DIAMETER_MM = 2400.0, 3.0, 0.2, 500.0, 20.0
CONCRETE_PA = 33e9
FRAMES = 48
SEEDS = (1, 2, 3)
GROWS_S = 1.0
FALLS_M, FAST_M = 0.06, 0.002
"""A beam that has gone down by the first at last is coming down from when it goes down by the second in a frame."""


@dataclass(frozen=True, slots=True)
class LoadedBeam:
    """A beam on two bearings, with bars along it next to its bottom, and with links or without.

    Attributes
    ----------
    span_m, width_m, height_m : float
        Its sizes; half of a wall hangs over at each end.
    depth_m, area_mm2 : float
        Depth of the bars below the top, and their area.
    compression_n_mm2, shear_n_mm2 : float
        Strengths of its concrete.
    links_mm2_m2 : float
        Area of links by that of a level section; 0 without any.
    shards : int
        Number of its shards.
    """

    span_m: float
    width_m: float
    height_m: float
    depth_m: float
    area_mm2: float
    compression_n_mm2: float
    shear_n_mm2: float
    links_mm2_m2: float
    shards: int
    yield_n_mm2: float = YIELD_N_MM2
    hardening: float = 1.0
    diameter_mm: float = DIAMETER_MM
    top_mm2: float = 0.0
    loaded_m: float = 0.4

    @property
    def weight_n_m(self) -> float:
        """Weight by length."""
        return DENSITY_KG_M3 * self.width_m * self.height_m * G

    @property
    def tension_n_mm2(self) -> float:
        """Mean tensile strength of its concrete, EN 1992-1-1, table 3.1."""
        return 1e-6 * tensile_strength_pa(1e6 * self.compression_n_mm2)

    @property
    def moment_nm(self) -> float:
        """Plastic moment by hand: A f_y (d - a / 2), a = A f_y / (b f_c)."""
        pull = self.area_mm2 * self.yield_n_mm2
        return pull * (self.depth_m - 0.5 * pull / (self.width_m * self.compression_n_mm2 * 1e6))

    @property
    def bends_at_n(self) -> float:
        """Load in the middle at which its section there has the plastic moment, with its own weight."""
        return 4.0 * (self.moment_nm - self.weight_n_m * self.span_m**2 / 8.0) / self.span_m

    @property
    def shears_at_n(self) -> float:
        """Load in the middle at which it has V_Rd,c of EN 1992-1-1, 6.2.2, with mean strengths, at d from a support."""
        ratio = min(1e-6 * self.area_mm2 / (self.width_m * self.depth_m), 0.02)
        size = min(1.0 + (0.2 / self.depth_m) ** 0.5, 2.0)
        stress_pa = 0.18e6 * size * (100.0 * ratio * self.compression_n_mm2) ** (1.0 / 3.0)
        resisted = stress_pa * self.width_m * self.depth_m
        return 2.0 * (resisted - self.weight_n_m * (self.span_m / 2.0 - self.depth_m))

    @property
    def cracked_stiffness_nm2(self) -> float:
        """E I of its cracked section: b x² / 2 = n A (d - x)."""
        steel = MODULUS_PA / CONCRETE_PA * 1e-6 * self.area_mm2
        pressed = ((steel**2 + 2.0 * self.width_m * steel * self.depth_m) ** 0.5 - steel) / self.width_m
        return CONCRETE_PA * (self.width_m * pressed**3 / 3.0 + steel * (self.depth_m - pressed) ** 2)

    @property
    def solids(self) -> Mapping[str, TriangleMesh]:
        """The beam, and the walls that it lies on."""
        end, half = (self.span_m + WALL_M) / 2.0, self.width_m / 2.0
        return {
            "beam": block((-end, -half, BOTTOM_M), (end, half, BOTTOM_M + self.height_m)),
            "left": block((-end, -half, BOTTOM_M - 1.0), (WALL_M - end, half, BOTTOM_M)),
            "right": block((end - WALL_M, -half, BOTTOM_M - 1.0), (end, half, BOTTOM_M)),
        }

    def scenario(self, seed: int, most_n: float) -> str:
        """Its scenario, under a load that grows to the largest."""
        members = "".join(
            f'[[geometry]]\nname = "{name}"\nkind = "{kind}"\nfile = "{name}.stl"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
            for name, kind in (("beam", "beam"), ("left", "wall"), ("right", "wall"))
        )
        links = ""
        if self.links_mm2_m2:
            links = f"""
[[reinforcement]]
members = ["beam"]
along = "z"
spread_mm2_m2 = {self.links_mm2_m2}
yield_n_mm2 = {self.yield_n_mm2}
"""
        top = ""
        if self.top_mm2:
            top = f"""
[[reinforcement]]
members = ["beam"]
side = "top"
depth_m = {self.height_m - self.depth_m:.3f}
area_mm2 = {self.top_mm2}
yield_n_mm2 = {self.yield_n_mm2}
diameter_mm = {self.diameter_mm}
"""
        return f"""
[scenario]
title = "beam under a load in its middle"
seed = {seed}

[time]
duration_s = {GROWS_S}
frames_per_second = {FRAMES}
substeps_per_frame = 20
{members}
[[supports]]
member = "wall"

[fracture]
shards = {self.shards + 2}

[[fracture.members]]
member = "wall"
shards = 1

[[materials]]
name = "of the beam"
compression_n_mm2 = {self.compression_n_mm2}
tension_n_mm2 = {self.tension_n_mm2:.3f}
shear_n_mm2 = {self.shear_n_mm2}
torsion_n_mm2 = {self.shear_n_mm2}
bending_n_mm2 = {self.tension_n_mm2:.3f}
elastic_modulus_n_mm2 = {1e-6 * CONCRETE_PA}

[[reinforcement]]
members = ["beam"]
side = "bottom"
depth_m = {self.height_m - self.depth_m:.3f}
area_mm2 = {self.area_mm2}
yield_n_mm2 = {self.yield_n_mm2}
diameter_mm = {self.diameter_mm}
{top}{links}
[connections]
type = "FIXED"
method = "face"
material = "of the beam"
stiffness = "elastic"
ductile_hardening = {self.hardening}

[[bearings]]
members = ["beam", "left"]
kind = "pinned"

[[bearings]]
members = ["beam", "right"]
kind = "rocker"

[[loads]]
members = ["beam"]
lowest_corner_m = [{-self.loaded_m / 2.0}, -1.0, 0.0]
highest_corner_m = [{self.loaded_m / 2.0}, 1.0, 9.0]
times_s = [0.1, {GROWS_S}]
forces_n = [0.0, {most_n:.1f}]
{RIGID_BODIES.format(shards=0.64, ground=0.64)}"""


def course(folder: Path, beam: LoadedBeam, seed: int, most_n: float) -> np.ndarray:
    """Loads and deflections of the middle as a load grows, in N and m: (2, frames)."""
    results = simulated(folder, f"seed_{seed}", beam.scenario(seed, most_n), beam.solids)
    inventory, frames = results.inventory, results.frames
    own = (inventory.body_kinds == "shard") & (inventory.body_members == "beam")
    own &= abs(frames.positions_m[0, :, 0]) <= beam.loaded_m / 2.0
    heights = frames.positions_m[:, own, 2].mean(axis=1)
    loads_n = np.interp(frames.time_s, (0.1, GROWS_S), (0.0, most_n))
    return np.stack((loads_n, heights[0] - heights))


def courses(folder: Path, beam: LoadedBeam, most_n: float) -> dict[int, np.ndarray]:
    """The course of a beam of each seed."""
    return {seed: course(folder, beam, seed, most_n) for seed in SEEDS}


def collapse_loads_n(found: Mapping[int, np.ndarray]) -> dict[str, float]:
    """Loads at which beams come down, by what they are called, and their median."""
    loads = {f"seed {seed}": comes_down_at_n(*of_seed) for seed, of_seed in found.items()}
    return loads | {"median": float(np.median(list(loads.values())))}


def draw_courses(axes: Axes, found: Mapping[int, np.ndarray], most_mm: float) -> None:
    """Draw loads over deflections."""
    for (seed, (load, sunk)), style in zip(found.items(), ("-", "--", ":"), strict=True):
        axes.plot(1e3 * sunk, 1e-3 * load, color="black", linestyle=style, label=f"seed {seed}")
    axes.set(xlabel="deflection (mm)", ylabel="load in the middle (kN)", xlim=(0.0, most_mm))


def comes_down_at_n(loads: np.ndarray, sunk: np.ndarray) -> float:
    """Load as the beam last was slow; infinite where it stands."""
    fallen = np.flatnonzero(sunk > FALLS_M)
    if not len(fallen):
        return float("inf")
    slow = np.flatnonzero(np.diff(sunk[: fallen[0] + 1]) < FAST_M)
    return float(loads[slow[-1] + 1])
