# SPDX-License-Identifier: GPL-3.0-or-later
"""A shaft that falls upright and lands on an edge: from which height it tips over."""

import math
from pathlib import Path

import numpy as np
from case import LOOSE, RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from solids import prism

DENSITY_KG_M3, DEPTH_M = 2400.0, 2.0
SIZES_M = ((1.0, 4.0), (1.0, 8.0), (1.5, 7.3))
TILT = math.radians(0.5)
SHARES = (0.9, 1.1)


def tips_from_m(width_m: float, length_m: float) -> float:
    """Fall that takes a block from a plastic impact on one edge, over one on the other edge, to its balance on that.

    ω = v (b / 2) / k² about the first edge with k² = (b² + l²) / 3, and 1 - b² / 2 k² of that about the second one.
    """
    k2, half_diagonal = (width_m**2 + length_m**2) / 3.0, math.hypot(width_m, length_m) / 2.0
    kept = 1.0 - width_m**2 / (2.0 * k2)
    return 4.0 * k2 * (half_diagonal - length_m / 2.0) / (width_m * kept) ** 2


def run(folder: Path) -> Found:
    """Drop shafts from a little less and a little more."""
    courses, comparisons = {}, []
    for width_m, length_m in SIZES_M:
        balance = math.atan(width_m / length_m)
        ends = {}
        for share in SHARES:
            courses[width_m, length_m, share] = found = course(folder, width_m, length_m, share)
            ends[share] = abs(found[1][-1]) > balance
        name = f"{width_m:g} m wide, {length_m:g} m long"
        tipped = [share for share in SHARES if ends[share]]
        stood = [share for share in SHARES if not ends[share]]
        comparisons += [
            Comparison(f"{name}: least fall that tips it, over theory", "", (0.9, 1.1), min(tipped, default=math.inf)),
            Comparison(f"{name}: largest that does not", "", (0.9, 1.1), max(stood, default=0.0)),
        ]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        for (width_m, length_m, share), (times, leans) in courses.items():
            style = {4.0: "-", 8.0: "--", 7.3: ":"}[length_m]
            label = f"{width_m:g} × {length_m:g} m, {share * tips_from_m(width_m, length_m):.2f} m"
            axes.plot(times, np.degrees(leans), color="black", linestyle=style, label=label)
        axes.set(xlabel="time (s)", ylabel="lean (°)", ylim=(-20, 20))
        axes.legend(title="shaft, fall", fontsize=8)

    return Found(comparisons, draw)


def course(folder: Path, width_m: float, length_m: float, share: float, substeps: int = 40) -> tuple[np.ndarray, ...]:
    """Times, and by how much a shaft leans that fell by so many times what tips it."""
    along = np.array([[math.cos(TILT), -math.sin(TILT)], [math.sin(TILT), math.cos(TILT)]])
    profile = np.array([(0.0, 0.0), (width_m, 0.0), (width_m, length_m), (0.0, length_m)]) @ along
    profile[:, 1] += share * tips_from_m(width_m, length_m) - profile[:, 1].min()
    scenario = f"""
[scenario]
title = "shaft of {width_m:g} x {length_m:g} m that falls by {share:g} times what tips it"

[time]
duration_s = 5.0
frames_per_second = 24
substeps_per_frame = {substeps}
solver_iterations = 100

[[geometry]]
name = "shaft"
kind = "member"
file = "shaft.stl"
density_kg_m3 = {DENSITY_KG_M3}

[fracture]
shards = 1
{LOOSE}{RIGID_BODIES.format(shards=4.0, ground=4.0)}"""
    solid = prism(profile, -DEPTH_M / 2.0, DEPTH_M / 2.0)
    results = simulated(folder, f"shaft_{width_m:g}_{length_m:g}_{share:g}", scenario, {"shaft": solid})
    (shard,) = results.inventory.of_kind("shard")
    turned = results.frames.rotations[:, shard]
    return results.frames.time_s, np.arctan2(turned[:, 0, 2], turned[:, 0, 0])


CASE = Case(
    name="landing_shaft",
    title="Shaft that lands on an edge",
    group=VERIFICATION,
    asked="A shaft falls upright, 0.5° off, as one of a blasted column does, and lands on an edge: from which fall on "
    "does it tip over the other one?",
    left_out="A load on its head, with which it takes up to half its length in the place of a third. Crushing: in a "
    "run contacts are rigid. Feet that slip: they have a friction of 4.",
    source="Angular momentum about one edge and then about the other, as G. W. Housner, *Bull. Seismol. Soc. Am.* 53 "
    "(1963) 403-417, has it for blocks that rock: ω = v (b / 2) / k² with k² = (b² + l²) / 3, 1 - b² / 2 k² of that, "
    "and ½ k² ω² = g (R - l / 2).",
    reason="10 %, steps of 20 % between the runs: half a degree, and sub-steps of 1 ms.",
    run=run,
)
