# SPDX-License-Identifier: GPL-3.0-or-later
"""A strip over two spans that has lost the support between them hangs on its bars, held along at both ends."""

from pathlib import Path
from typing import TypeVar

import numpy as np
from case import RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from solids import block

from bridge_demolition_addon.engineering.elasticity.steel_bars import MODULUS_PA
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

SPAN_M, WIDTH_M, HEIGHT_M, BOTTOM_M, BLOCK_M, HELD_M, DENSITY_KG_M3 = 6.0, 1.0, 0.06, 3.0, 0.5, 0.5, 2400.0
COVER_M, LAYER_MM2, YIELD_N_MM2 = 0.02, 300.0, 500.0
Numbers = TypeVar("Numbers", float, np.ndarray)
YIELDS_AT_M, RUPTURE_STRAIN = 0.001, 0.5
RUPTURES_AT_M = YIELDS_AT_M * RUPTURE_STRAIN * MODULUS_PA / (1e6 * YIELD_N_MM2)
PULL_N = 2.0 * LAYER_MM2 * YIELD_N_MM2
WEIGHT_N = DENSITY_KG_M3 * WIDTH_M * HEIGHT_M * SPAN_M * G
DEFLECTIONS_M = (0.3, 0.4)
DOWELS = 0.9 * (35.0 / 500.0) ** 0.5
"""Force across bars by that along them: fib Model Code 2010, equation 7.3-51."""

STARTS_S, GROWS_S, MOST_N = 0.1, 2.4, 230e3


def run(folder: Path) -> Found:
    """Load the strip."""
    loads, sunk = course(folder)
    found = {deflection: float(loads[np.flatnonzero(sunk <= deflection)[-1]]) for deflection in DEFLECTIONS_M}
    comparisons = [
        Comparison(
            f"load at a deflection of {deflection:g} m, {what}", "kN", 1e-3 * theory(deflection), 1e-3 * load, 0.1
        )
        for what, theory in (("bars that turn, as a rope", load_n), ("bars that do not turn", load_of_straight_bars_n))
        for deflection, load in found.items()
    ]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        along = np.linspace(0.01, 0.7, 50)
        axes.plot(sunk, 1e-3 * loads, color="black", label="run")
        axes.plot(along, 1e-3 * load_n(along), color="0.6", label="bars turn, as a rope")
        axes.plot(along, 1e-3 * load_of_straight_bars_n(along), color="0.6", linestyle="--", label="bars do not turn")
        axes.set(xlabel="deflection (m)", ylabel="load with the weight (kN)", xlim=(0.0, 0.7), ylim=(0.0, None))
        axes.legend()

    return Found(comparisons, draw)


def load_n(deflection_m: Numbers) -> Numbers:
    """Even load of both spans at which a rope hangs so deep: w L² / 8 = H δ, where bars yield at the ends.

    There the rope has the slope 4 δ / L, and H is its pull less that.
    """
    level_n = PULL_N / np.sqrt(1.0 + (4.0 * deflection_m / SPAN_M) ** 2)
    return 8.0 * level_n * deflection_m / SPAN_M


def load_of_straight_bars_n(deflection_m: Numbers) -> Numbers:
    """Even load if bars stay level at the ends: H² + (V / 0.24)² = pull², with V of half of the load across them."""
    return PULL_N / np.sqrt((SPAN_M / (8.0 * deflection_m)) ** 2 + (0.5 / DOWELS) ** 2)


def course(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Loads with the weight of the strip, N, and deflections of the middle, m, as the load grows."""
    end, half, top = SPAN_M / 2.0 + HELD_M, WIDTH_M / 2.0, BOTTOM_M + HEIGHT_M
    middles = np.arange(-end + BLOCK_M / 2.0, end, BLOCK_M)
    points = "".join(f"\n[[fracture.points]]\nplace_m = [{x:.3f}, 0.0, {BOTTOM_M + HEIGHT_M / 2.0}]\n" for x in middles)
    layers = "".join(
        f'\n[[reinforcement]]\nmembers = ["strip"]\nside = "{side}"\ndepth_m = {COVER_M}\narea_mm2 = {LAYER_MM2}\n'
        f"yield_n_mm2 = {YIELD_N_MM2}\n"
        for side in ("top", "bottom")
    )
    scenario = f"""
[scenario]
title = "strip that hangs on its bars"

[time]
duration_s = {GROWS_S}
frames_per_second = 60
substeps_per_frame = 20

[[geometry]]
name = "strip"
file = "strip.stl"
density_kg_m3 = {DENSITY_KG_M3}

[[supports]]
member = "strip"
face = "start"

[[supports]]
member = "strip"
face = "end"

[fracture]
shards = {len(middles)}
stretch = [1.0, 1.0, 1.0]
{points}
[[materials]]
name = "cracked"
compression_n_mm2 = 40.0
tension_n_mm2 = 0.05
shear_n_mm2 = 1000.0
torsion_n_mm2 = 1000.0
bending_n_mm2 = 0.05
elastic_modulus_n_mm2 = 30000.0
{layers}
[connections]
type = "FIXED"
method = "face"
material = "cracked"
stiffness = "elastic"
ductile_elongation_m = {RUPTURES_AT_M}
ductile_hardening = 1.0
ductile_rupture_strain = {RUPTURE_STRAIN}

[[loads]]
lowest_corner_m = [{-SPAN_M / 2.0}, -1.0, 0.0]
highest_corner_m = [{SPAN_M / 2.0}, 1.0, 9.0]
times_s = [{STARTS_S}, {GROWS_S}]
forces_n = [0.0, {MOST_N}]
{RIGID_BODIES.format(shards=0.64, ground=0.64)}"""
    strip = block((-end, -half, BOTTOM_M), (end, half, top))
    results = simulated(folder, "strip", scenario, {"strip": strip})
    inventory, frames = results.inventory, results.frames
    own = (inventory.body_kinds == "shard") & (abs(frames.positions_m[0, :, 0]) < BLOCK_M)
    heights = frames.positions_m[:, own, 2].mean(axis=1)
    loads = WEIGHT_N + np.interp(frames.time_s, (STARTS_S, GROWS_S), (0.0, MOST_N))
    return loads, heights[0] - heights


CASE = Case(
    name="catenary",
    title="Strip that hangs on its bars",
    group=VERIFICATION,
    asked=f"A strip of {SPAN_M:g} m, {HEIGHT_M:g} m thick and {WIDTH_M:g} m wide, is what two spans are once the "
    f"support between them is lost. Both ends are held, also along. It has {LAYER_MM2:g} mm² near its top and "
    "as much near its bottom, and cracks everywhere. An even load grows: first it stands as an arch, snaps "
    "through, and then hangs on its bars. Under which load has it which deflection then?",
    left_out="Hardening of bars, their rupture, and concrete that is crushed. Blocks are stiff, with cracks 0.5 m "
    "apart.",
    source="A rope, w L² / 8 = H δ with H = A f_y / √(1 + (4 δ / L)²): bars yield at the ends, where the rope is "
    "inclined most. And the same where bars stay level at the ends, and carry V = w L / 2 as dowels: H² + (V "
    "/ 0.24)² = (A f_y)².",
    reason="10 %: a frame is 2 %, and the strip snaps through before, which leaves it swinging. As a rope it is "
    "missed, by a quarter to more than a third. A real bar bends in a crack, and turns to where it is pulled. "
    "In the model it keeps the direction of its member, and across itself is a dowel with 0.24 of its force. "
    "The second comparison has that, and [connections.md](connections.md#reinforcement) says it. What hangs "
    "on bars falls earlier than it would: on the safe side for what must stay, on the unsafe side for what "
    "must fall.",
    run=run,
)
