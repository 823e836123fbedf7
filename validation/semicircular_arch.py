# SPDX-License-Identifier: GPL-3.0-or-later
"""The thinnest semicircular arch that stands under its own weight: voussoirs that only touch (Couplet, Heyman)."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
from arches import LOOSE_JOINTS
from case import RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from solids import block, prism

RADIUS_M, DEPTH_M, COUNT, SPRINGING_M = 10.0, 2.0, 20, 2.0
THICKNESSES = (0.095, 0.100, 0.105, 0.110, 0.115, 0.120)
FALLEN_M = 1.0


def run(folder: Path) -> Found:
    """Let arches of all thicknesses stand or fall."""
    courses = {thickness: _course(folder, thickness) for thickness in THICKNESSES}
    standing = [ratio for ratio, (_, sag) in courses.items() if sag[-1] < FALLEN_M]
    falling = [ratio for ratio, (_, sag) in courses.items() if sag[-1] >= FALLEN_M]
    comparisons = [
        Comparison("thinnest that stands, t/R", "", (0.107, 0.115), min(standing, default=math.inf)),
        Comparison("thickest that falls, t/R", "", (0.100, 0.110), max(falling, default=0.0)),
    ]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        for (ratio, (times, sag)), shade in zip(courses.items(), np.linspace(0.0, 0.7, len(courses)), strict=True):
            axes.plot(times, sag, color=str(shade), label=f"t/R = {ratio:.3f}")
        axes.set(xlabel="time (s)", ylabel="deflection of the crown (m)", ylim=(-0.1, 3.0))
        axes.legend(fontsize=8)

    return Found(comparisons, draw)


def _course(folder: Path, thickness: float) -> tuple[np.ndarray, np.ndarray]:
    """Times, and how far the lowest of the two voussoirs at the crown has come down."""
    inner, outer = RADIUS_M * (1.0 - thickness / 2.0), RADIUS_M * (1.0 + thickness / 2.0)
    angles = np.linspace(0.0, math.pi, COUNT + 1)
    meshes = {
        f"voussoir_{row:02d}": prism(
            np.array(
                [
                    (r * math.cos(a), r * math.sin(a))
                    for r, a in ((inner, low), (outer, low), (outer, high), (inner, high))
                ]
            ),
            -DEPTH_M / 2.0,
            DEPTH_M / 2.0,
        )
        for row, (low, high) in enumerate(pairwise(angles))
    }
    for side, sign in (("left", -1.0), ("right", 1.0)):
        low, high = sorted((sign * (inner - 0.5), sign * (outer + 0.5)))
        meshes[f"springer_{side}"] = block((low, -DEPTH_M / 2.0, -SPRINGING_M), (high, DEPTH_M / 2.0, 0.0))
    members = "".join(
        f"""
[[geometry]]
name = "{name.replace("_", " ")}"
kind = "{name.split("_")[0]}"
file = "{name}.stl"
position_m = [0.0, 0.0, {SPRINGING_M}]
density_kg_m3 = 2400.0
"""
        for name in meshes
    )
    scenario = f"""
[scenario]
title = "semicircular arch, t/R = {thickness}"

[time]
duration_s = 6.0
frames_per_second = 24
substeps_per_frame = 160
solver_iterations = 200
{members}
[[supports]]
member = "springer"

[fracture]
shards = {COUNT + 2}
{LOOSE_JOINTS}{RIGID_BODIES.format(shards=0.81, ground=0.81)}"""
    results = simulated(folder, f"thickness_{thickness:.3f}", scenario, meshes)
    names = results.inventory.body_members
    crown = [int(np.flatnonzero(names == f"voussoir {row:02d}")[0]) for row in (COUNT // 2 - 1, COUNT // 2)]
    heights = results.frames.positions_m[:, crown, 2]
    return results.frames.time_s, (heights[0] - heights).max(axis=1)


CASE = Case(
    name="semicircular_arch",
    title="Thinnest semicircular arch",
    group=VERIFICATION,
    asked=f"{COUNT} voussoirs that only touch each other stand as a semicircle, if it is thick enough: t/R at least "
    "0.1075.",
    left_out="Crushing of the edges. Bullet's contacts creep: arches that stand sink by 2 cm in a second with "
    "sub-steps of 0.26 ms, and by four times that with 1 ms.",
    source="M. Milankovitch 1904 and 1907, 0.10746; 0.1075 for 20 voussoirs by a linear program, without sliding.",
    reason="The thicknesses are 0.005 apart; the threshold may be up to 7 % too large, as contacts sink.",
    run=run,
)
