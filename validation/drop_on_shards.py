# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights that drop on reinforced strips in irregular shards: what deflection stays, against a beam in OpenSees."""

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from case import RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from slabs import Slab, sunk_m

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

SHARDS, FRAMES, SUBSTEPS = 60, 120, 10
SUBSTEP_S = 1.0 / (FRAMES * SUBSTEPS)
SWINGS_S = 0.2, 0.5
"""Since the weight hits: the strip swings about what stays, at least twice in this time."""

BY_OPENSEES = Path(__file__).resolve().parents[1] / "docs" / "data" / "drop_by_opensees.csv"


@dataclass(frozen=True, slots=True)
class Drop:
    """A weight that drops on the middle of a strip, in so many seeds."""

    strip: Slab
    mass_kg: float
    speed_m_s: float
    seeds: tuple[int, ...]

    @property
    def rigid_plastic_m(self) -> float:
        """Deflection by rigid-plastic theory: E M / (M + m / 3) = (P - (M + m / 2) g) δ, P = 4 × moment / L."""
        mass, strip = self.mass_kg, self.strip
        transmitted_j = 0.5 * mass * self.speed_m_s**2 * mass / (mass + strip.mass_kg / 3.0)
        return transmitted_j / (4.0 * strip.moment_nm / strip.span_m - (mass + strip.mass_kg / 2.0) * G)


DROPS: Mapping[str, Drop] = {
    "800 kg": Drop(Slab(4.0, 1.0, 0.2, 0.16, 600.0, 500.0, 40.0, 0.0005, 0.05), 800.0, 3.5, (1, 2, 3, 4, 5)),
    "2000 kg": Drop(Slab(4.0, 1.0, 0.2, 0.16, 1200.0, 500.0, 40.0, 0.0005, 0.05), 2000.0, 3.0, (1, 2, 3, 4, 5)),
}


def run(folder: Path) -> Found:
    """Drop each weight on strips that are cut by each seed."""
    courses = {(name, seed): course(folder, drop, seed) for name, drop in DROPS.items() for seed in drop.seeds}
    comparisons = []
    for name, drop in DROPS.items():
        found = [1e3 * stays_m(*courses[name, seed]) for seed in drop.seeds]
        expected = by_opensees_mm(name, "as in the run", "stays")
        median = float(np.median(found))
        comparisons += [
            Comparison(f"{name}: deflection that stays, seed {seed}", "mm", expected, stays, 0.25)
            for seed, stays in zip(drop.seeds, found, strict=True)
        ]
        comparisons += [
            Comparison(f"{name}: the same, median", "mm", expected, median, 0.2),
            Comparison(f"{name}: median over that of rigid-plastic theory", "", (0.3, 1.3), median / rigid_mm(drop)),
        ]

    def draw(figure: Figure) -> None:
        for axes, (name, drop) in zip(figure.subplots(1, len(DROPS), sharey=True), DROPS.items(), strict=True):
            for seed in drop.seeds:
                times, sunk = courses[name, seed]
                axes.plot(times, 1e3 * sunk, color="black", linewidth=0.8, label="runs" if seed == 1 else None)
            for damping, what, style in (("as in the run", "damped as the run", "-"), ("none", "undamped", "--")):
                stays = by_opensees_mm(name, damping, "stays")
                axes.plot(SWINGS_S, [stays, stays], color="0.5", linestyle=style, label=f"OpenSees, {what}")
            axes.axhline(rigid_mm(drop), color="0.5", linestyle=":", label="rigid-plastic theory")
            axes.set(title=f"{name}, {drop.speed_m_s:g} m/s", xlabel="time since the weight hits (s)", xlim=(0.0, None))
        figure.axes[0].set(ylabel="way down of the middle (mm)")
        figure.axes[0].legend(fontsize=7)

    return Found(comparisons, draw)


def rigid_mm(drop: Drop) -> float:
    """Deflection by rigid-plastic theory, mm."""
    return 1e3 * drop.rigid_plastic_m


def by_opensees_mm(drop: str, damping: str, deflection: str) -> float:
    """Deflection of a beam in OpenSees, mm, as `scripts/experiments/drop_by_opensees.py` wrote it."""
    with BY_OPENSEES.open(newline="", encoding="utf-8") as file:
        rows = {(row["drop"], row["damping"], row["deflection"]): float(row["mm"]) for row in csv.DictReader(file)}
    return rows[drop, damping, deflection]


def stays_m(times_s: np.ndarray, sunk_by_m: np.ndarray) -> float:
    """Mean deflection in the swings after the largest."""
    return float(sunk_by_m[(times_s > SWINGS_S[0]) & (times_s <= SWINGS_S[1])].mean())


def course(folder: Path, drop: Drop, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Times since the weight hits, and how far the middle has gone down, m."""
    mass, falls_s = drop.mass_kg, drop.speed_m_s / G
    scenario = f"""
[scenario]
title = "{mass:g} kg drop on a strip in {SHARDS} shards"
seed = {seed}

[time]
duration_s = {falls_s + SWINGS_S[1] + 0.02:.3f}
frames_per_second = {FRAMES}
substeps_per_frame = {SUBSTEPS}
solver_iterations = 50
{drop.strip.scenario(SHARDS)}
[ball]
mass_kg = {mass}
diameter_m = {2.0 * (mass / 7850.0 * 0.75 / math.pi) ** (1.0 / 3.0):.4f}
target_m = [0.0, 0.0]
drop_height_m = {drop.speed_m_s**2 / (2.0 * G):.4f}
release_time_s = 0.0

[contacts.ball]
friction = 0.25
{RIGID_BODIES.format(shards=0.64, ground=0.64)}"""
    times, sunk = sunk_m(simulated(folder, f"{mass:g}_kg_seed_{seed}", scenario, drop.strip.solids))
    return times - falls_s, sunk


CASE = Case(
    name="drop_on_shards",
    title="Weight that drops on a reinforced strip in irregular shards",
    group=VERIFICATION,
    asked="Weights drop on the middle of strips of 4 m (1 m × 0.2 m): 800 kg with 3.5 m/s where 600 mm² of steel "
    f"are near the bottom, and 2000 kg with 3 m/s where there are 1200. Strips are cut into {SHARDS} irregular "
    "shards, and whole before. Which deflection stays, with seeds 1 to 5?",
    left_out="Hardening of bars, what they carry more as they are pulled fast, and failure in shear: the concrete "
    "breaks by bending and tension alone. Bars yield as a crack is open by 0.5 mm.",
    source="A beam of 80 elements in OpenSees, whose sections crack once and for all, then have the stiffness of the "
    "cracked section (b x² / 2 = n A (d - x)), and yield at the moments by hand, A f_y (d - a / 2), a = A f_y "
    "/ (b f_c). It lies on supports that do not pull, the weight is a point mass, and damping is by stiffness "
    "times sub-step, as that of implicit steps: `scripts/experiments/drop_by_opensees.py`, [its "
    "results](data/drop_by_opensees.csv). Rigid-plastic theory: E M / (M + m / 3) = (P - (M + m / 2) g) δ, a "
    "plastic impact on two stiff halves.",
    reason="20 % of the median, as was asked for, and 25 % of single seeds, which scatter by 10 %. Runs stay below: "
    "under a slow load such slabs carry 1.07 times the load of theory "
    "([above](#reinforced-slab-in-irregular-shards)). With so much, the net force against the fall, P less "
    "weights, is 11 and 10 % larger, and OpenSees would have 68 and 82 mm. Rigid-plastic theory has 92 and "
    "109 mm, OpenSees 87 and 92 without damping, and 75 and 90 with that of the run: the elastic deflection "
    "is a third of what stays, and the impact is not one on two stiff halves. So that theory is no measure "
    "for 20 % here; 0.3 to 1.3 times it was the least that was asked for.",
    run=run,
)
