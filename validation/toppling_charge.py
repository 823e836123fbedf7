# SPDX-License-Identifier: GPL-3.0-or-later
"""A loose pier beside a charge: from which mass of explosive on it topples."""

import math
from pathlib import Path

import numpy as np
from case import LOOSE, RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from solids import block

from bridge_demolition_addon.engineering.blast.pulses import blast_pulses
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

WIDTH_M, HEIGHT_M, DEPTH_M, DENSITY_KG_M3 = 1.0, 4.0, 2.0, 2400.0
MASS_KG = DENSITY_KG_M3 * WIDTH_M * HEIGHT_M * DEPTH_M
STAND_OFF_M = 12.0
SLENDERNESS = math.atan(WIDTH_M / HEIGHT_M)
RADIUS_M = math.hypot(WIDTH_M, HEIGHT_M) / 2.0
TOPPLES_RAD_S = math.sqrt(1.5 * G / RADIUS_M * (1.0 - math.cos(SLENDERNESS)))
TOPPLES_NS = MASS_KG * (WIDTH_M**2 + HEIGHT_M**2) / 3.0 * TOPPLES_RAD_S / (HEIGHT_M / 2.0)
"""Impulse at half its height that turns it about its edge so fast."""

SHARES = (0.90, 0.95, 0.97, 1.03, 1.05, 1.10)


def run(folder: Path) -> Found:
    """Let charges go off that give the pier less and more than it needs."""
    courses = {share: leans(folder, share) for share in SHARES}
    toppled = [share for share, (_, angles) in courses.items() if angles[-1] > SLENDERNESS]
    stood = [share for share in SHARES if share not in toppled]
    comparisons = [
        Comparison("least impulse that topples it, over Housner's", "", (0.95, 1.05), min(toppled, default=math.inf)),
        Comparison("largest that does not", "", (0.95, 1.05), max(stood, default=0.0)),
    ]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        styles = ("-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 3)))
        for (share, (times, angles)), style in zip(courses.items(), styles, strict=True):
            label = f"{share:g}, {charge_kg(share):.1f} kg"
            axes.plot(times, np.degrees(angles), color="black", linestyle=style, label=label)
        axes.axhline(math.degrees(SLENDERNESS), color="0.6", linewidth=0.8)
        axes.set(xlabel="time (s)", ylabel="lean (°)", ylim=(-5, 60))
        axes.legend(title="impulse over Housner's", fontsize=8)

    return Found(comparisons, draw)


def charge_kg(share: float) -> float:
    """Mass of TNT whose impulse on the pier is so many times that which topples it."""
    wanted = share * TOPPLES_NS / (HEIGHT_M * DEPTH_M)
    low, high = 0.0, 1000.0
    for _ in range(60):
        mass = 0.5 * (low + high)
        pulses = blast_pulses(np.array([[STAND_OFF_M]]), np.array([mass]), np.zeros(1), ["air"], loading="reflected")
        low, high = (mass, high) if float(pulses.impulses_pa_s[0, 0]) < wanted else (low, mass)
    return high


def leans(folder: Path, share: float, duration_s: float = 5.0, substeps: int = 40) -> tuple[np.ndarray, np.ndarray]:
    """Times, and angles by which the pier leans away from the charge."""
    scenario = f"""
[scenario]
title = "pier beside a charge, {share:g} times the impulse that topples it"

[time]
duration_s = {duration_s}
frames_per_second = 48
substeps_per_frame = {substeps}
solver_iterations = 100

[[geometry]]
name = "pier"
kind = "member"
file = "pier.stl"
density_kg_m3 = {DENSITY_KG_M3}

[fracture]
shards = 1
{LOOSE}{RIGID_BODIES.format(shards=4.0, ground=4.0)}
[blast]
start_s = 0.1
loading = "reflected"
apply = "direct"

[[charges]]
position_m = [{-STAND_OFF_M - WIDTH_M / 2.0}, 0.0, {HEIGHT_M / 2.0}]
mass_kg = {charge_kg(share)}
"""
    solid = block((-WIDTH_M, -DEPTH_M / 2.0, 0.0), (0.0, DEPTH_M / 2.0, HEIGHT_M))
    results = simulated(folder, f"impulse_{share:g}", scenario, {"pier": solid})
    (shard,) = results.inventory.of_kind("shard")
    turned = results.frames.rotations[:, shard]
    return results.frames.time_s, np.arctan2(turned[:, 0, 2], turned[:, 0, 0])


CASE = Case(
    name="toppling_charge",
    title="Pier that a charge topples",
    group=VERIFICATION,
    asked=f"A charge goes off {STAND_OFF_M:g} m beside the middle of a loose pier, {WIDTH_M:g} m thick and "
    f"{HEIGHT_M:g} m high. From which impulse on does it topple?",
    left_out="Feet that slip: to turn a pier about its edge at once takes friction of 1.7, and it has 4 here. "
    "Stand-offs to the pier's middle, as the add-on takes them; the wave that goes round it.",
    source="G. W. Housner, *Bull. Seismol. Soc. Am.* 53 (1963) 403-417: ω² = (3 g / 2 R)(1 - cos α). The impulse "
    "at half the height is m (b² + h²) ω / (1.5 h); the mass of the charge follows by Kingery and Bulmash.",
    reason="5 %, steps of 2 to 5 % between the runs: 3 % as of the rocking block, and the length of the pulse.",
    run=run,
)
