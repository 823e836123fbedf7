# SPDX-License-Identifier: GPL-3.0-or-later
"""A weight that drops on a reinforced strip in irregular shards: what deflection stays, against plastic theory."""

import math
from pathlib import Path

import numpy as np
from case import EXACT, RIGID_BODIES, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from slabs import Slab, sunk_m

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

STRIP = Slab(4.0, 1.0, 0.2, 0.16, 600.0, 500.0, 40.0, 0.0005, 0.05)
MASS_KG, SPEED_M_S, SHARDS, SEEDS = 800.0, 3.5, 60, (1, 2, 3)
SWINGS_S = 0.03, 0.13
"""After its largest deflection the strip swings about what stays, some times in this time."""


def run(folder: Path) -> Found:
    """Drop the weight on strips that are cut by each seed."""
    courses = {seed: course(folder, seed) for seed in SEEDS}
    expected = expected_m()
    comparisons = [
        Comparison(f"deflection that stays, seed {seed}", "mm", 1e3 * expected, 1e3 * stays_m(*found), 0.2)
        for seed, found in courses.items()
    ]
    shares = [stays_m(*found) / expected for found in courses.values()]
    speeds = [float((np.diff(sunk) / np.diff(times)).max()) for times, sunk in courses.values()]
    comparisons += [
        Comparison("the same over that of theory, median", "", (0.3, 1.3), float(np.median(shares))),
        Comparison("speed of the middle after the blow, median", "m/s", speed_m_s(), float(np.median(speeds)), 0.25),
    ]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        for (seed, (times, sunk)), style in zip(courses.items(), ("-", "--", ":"), strict=True):
            axes.plot(times, 1e3 * sunk, color="black", linestyle=style, label=f"seed {seed}")
        axes.axhline(1e3 * expected, color="0.6", linewidth=0.8)
        axes.set(xlabel="time (s)", ylabel="way down of the middle (mm)", xlim=(0.9 * SPEED_M_S / G, None))
        axes.legend()

    return Found(comparisons, draw)


def expected_m() -> float:
    """Deflection by rigid-plastic theory: E M / (M + m / 3) = (P - (M + m / 2) g) δ, P = 4 × moment / L."""
    transmitted_j = 0.5 * MASS_KG * SPEED_M_S**2 * MASS_KG / (MASS_KG + STRIP.mass_kg / 3.0)
    return transmitted_j / (4.0 * STRIP.moment_nm / STRIP.span_m - (MASS_KG + STRIP.mass_kg / 2.0) * G)


def speed_m_s() -> float:
    """Speed of the weight and the middle after a plastic impact, M v / (M + m / 3)."""
    return MASS_KG * SPEED_M_S / (MASS_KG + STRIP.mass_kg / 3.0)


def stays_m(times_s: np.ndarray, sunk_by_m: np.ndarray) -> float:
    """Mean deflection in the swings after the largest."""
    since = times_s - times_s[sunk_by_m.argmax()]
    return float(sunk_by_m[(since > SWINGS_S[0]) & (since <= SWINGS_S[1])].mean())


def course(folder: Path, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Times, and how far the middle has gone down, m."""
    scenario = f"""
[scenario]
title = "{MASS_KG:g} kg drop on a strip in {SHARDS} shards"
seed = {seed}

[time]
duration_s = {SPEED_M_S / G + 0.26:.3f}
frames_per_second = 120
substeps_per_frame = 10
solver_iterations = 50
{STRIP.scenario(SHARDS)}
[ball]
mass_kg = {MASS_KG}
diameter_m = {2.0 * (MASS_KG / 7850.0 * 0.75 / math.pi) ** (1.0 / 3.0):.4f}
target_m = [0.0, 0.0]
drop_height_m = {SPEED_M_S**2 / (2.0 * G):.4f}
release_time_s = 0.0

[contacts.ball]
friction = 0.25
{RIGID_BODIES.format(shards=0.64, ground=0.64)}"""
    return sunk_m(simulated(folder, f"seed_{seed}", scenario, STRIP.solids), STRIP)


CASE = Case(
    name="drop_on_shards",
    title="Weight that drops on a reinforced strip in irregular shards",
    group=EXACT,
    asked=f"A weight of {MASS_KG:g} kg drops with {SPEED_M_S:g} m/s on the middle of a strip of {STRIP.span_m:g} m "
    f"({STRIP.width_m:g} m × {STRIP.height_m:g} m, {STRIP.area_mm2:g} mm² of steel near its bottom), which is cut into "
    f"{SHARDS} irregular shards. It is whole before. Which deflection stays?",
    left_out="Hardening of bars, what they carry more as they are pulled fast, and failure in shear: the concrete "
    f"breaks by bending and tension alone. Bars yield as a crack is open by {1e3 * STRIP.yields_at_m:g} mm.",
    source="Rigid-plastic theory: E M / (M + m / 3) = (P - (M + m / 2) g) δ, a plastic impact on two stiff halves. P "
    "by hand from 4 A f_y (d - a / 2) / L, a = A f_y / (b f_c), EN 1992-1-1:2004, 3.1.7 (3).",
    reason="20 % was wanted, and is missed. Two things take as much: the middle begins by a fifth slower than after a"
    " plastic impact on two stiff halves, as more of the strip moves at first, and both ends lift off; and by "
    "their reactions strips carry 1.3, 1.2 and 1.1 times P while they go down (seeds 1 to 3), as under a load "
    "that grows (the case before). In halves with a crack that is there before, weights go as far as theory "
    "says. From 0.3 to 1.3 times was the least that was asked for. The speed is that in a frame of 8 ms: 25 %.",
    run=run,
)
