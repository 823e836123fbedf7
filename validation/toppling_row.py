# SPDX-License-Identifier: GPL-3.0-or-later
"""A row of piers that topple into each other: how fast that goes along the row."""

import math
from pathlib import Path

import numpy as np
from case import LOOSE, RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from solids import block

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

HEIGHT_M, WIDTH_M, COUNT, STEADY = 3.0, 1.5, 18, 12
ROWS = ((0.3, 1.0), (0.3, 1.4), (0.5, 1.2))
"""Thickness and clear gap, m."""

LEANS = math.radians(0.5)
"""Lean from which a pier counts as hit."""

FRICTION, GROUND_FRICTION = 0.0025, 2.0
"""Hardly any between piers, and feet that do not slip."""


def run(folder: Path) -> Found:
    """Topple each row."""
    comparisons, fronts = [], []
    for thickness, gap in ROWS:
        hits = hits_s(folder, thickness, gap)
        expected = theory_m_s(thickness, gap)
        found = speed_m_s(hits, thickness + gap)
        name = f"speed along the row, {thickness:g} m thick, gaps {gap:g} m"
        comparisons.append(Comparison(name, "m/s", expected, found, 0.1))
        fronts.append(((thickness + gap) / np.diff(hits), expected, f"{thickness:g} m, gaps {gap:g} m"))

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        for (speeds, expected, label), mark, style in zip(fronts, "os^", ("-", "--", ":"), strict=True):
            axes.plot(np.arange(2, COUNT + 1), speeds, mark, color="black", markersize=5, label=label)
            axes.plot((STEADY + 1, COUNT), (expected, expected), color="0.5", linestyle=style, linewidth=1.5)
        axes.set(xlabel="pier", ylabel="speed on the way to it (m/s)", ylim=(0, 16))
        axes.legend(fontsize=8)

    return Found(comparisons, draw)


def speed_m_s(hits: np.ndarray, pitch_m: float) -> float:
    """Speed of the front along the later part of the row: the slope of places by times."""
    later = hits[STEADY:-1]
    return float(np.polyfit(later, pitch_m * np.arange(len(later)), 1)[0])


def theory_m_s(thickness: float, gap: float, count: int = 30, steps: int = 400) -> float:
    """Speed of a long row without friction and bouncing (J. van Leeuwen 2010): all that were hit lean on each other.

    Between hits energy stays; at a hit the whole row that leans turns the next one, as impulses balance.
    """
    pitch, height = thickness + gap, HEIGHT_M
    inertia = (height**2 + thickness**2) / 3.0
    hit = math.asin(gap / height)

    def behind(front: float) -> tuple[float, float]:
        """Lean of the one behind, and by how much it changes with that of the one in front."""
        share = (pitch * math.cos(front) - thickness) / height
        slope = pitch * math.sin(front) / (height * math.sqrt(1.0 - share * share))
        return front + math.asin(share), 1.0 - slope

    def row(front: float, standing: int) -> tuple[float, float]:
        """Inertia and height energy by mass of the row, seen from the lean of the one in front."""
        lean, share, moved, raised = front, 1.0, 0.0, 0.0
        for _ in range(standing):
            moved += inertia * share * share
            raised += 0.5 * G * (height * math.cos(lean) + thickness * math.sin(lean))
            lean, slope = behind(lean)
            share *= slope
        return moved, raised

    leans = [hit * (step + 0.5) / steps for step in range(steps)]
    spin, took = 2.0 * math.sqrt(G / height), math.inf
    for standing in range(1, count):
        moved, raised = row(0.0, standing)
        energy = 0.5 * moved * spin * spin + raised
        took = 0.0
        for lean in leans:
            moved, raised = row(lean, standing)
            took += hit / steps / math.sqrt(2.0 * (energy - raised) / moved)
        moved, raised = row(hit, standing)
        before = math.sqrt(2.0 * (energy - raised) / moved)
        share = behind(0.0)[1]
        spin = moved * before * share / (inertia + moved * share * share)
    return pitch / took


def hits_s(folder: Path, thickness: float, gap: float, count: int = COUNT, substeps: int = 20) -> np.ndarray:
    """Return when each pier begins to lean, s."""
    pitch, spin = thickness + gap, 2.0 * math.sqrt(G / HEIGHT_M)
    names = [f"pier {row:02d}" for row in range(count)]
    pushed = (
        f"velocity_m_s = [{spin * HEIGHT_M / 2.0}, 0.0, {spin * thickness / 2.0}]\nspin_rad_s = [0.0, {spin}, 0.0]\n"
    )
    members = "".join(
        f'\n[[geometry]]\nname = "{name}"\nkind = "member"\nfile = "pier.stl"\ndensity_kg_m3 = 2400.0\n'
        f"position_m = [{pitch * row}, 0.0, 0.0]\n{'' if row else pushed}"
        for row, name in enumerate(names)
    )
    scenario = f"""
[scenario]
title = "row of piers that topple, {thickness:g} m thick, gaps of {gap:g} m"

[time]
duration_s = {0.5 + count * pitch / 9.0:.2f}
frames_per_second = 120
substeps_per_frame = {substeps}
solver_iterations = 50
{members}
[fracture]
shards = {count}
{LOOSE}{RIGID_BODIES.format(shards=FRICTION, ground=GROUND_FRICTION)}"""
    solid = block((-thickness, -WIDTH_M / 2.0, 0.0), (0.0, WIDTH_M / 2.0, HEIGHT_M))
    results = simulated(folder, f"thickness_{thickness:g}_gap_{gap:g}", scenario, {"pier": solid})
    inventory, frames = results.inventory, results.frames
    rows = [int(np.flatnonzero(inventory.body_members == name)[0]) for name in names]
    turned = frames.rotations[:, rows]
    leans = np.arctan2(turned[..., 0, 2], turned[..., 0, 0])
    firsts = (leans > LEANS).argmax(axis=0)
    shares = [(LEANS - leans[at - 1, row]) / (leans[at, row] - leans[at - 1, row]) for row, at in enumerate(firsts)]
    return frames.time_s[firsts - 1] + np.array(shares) * (frames.time_s[firsts] - frames.time_s[firsts - 1])


CASE = Case(
    name="toppling_row",
    title="Row of toppling piers",
    group=VERIFICATION,
    asked=f"{COUNT} piers, {HEIGHT_M:g} m high, stand in a row. The first is pushed, and they topple into each other. "
    "How fast does that go along the row, once it is steady?",
    left_out="Friction between piers, which slows a row down, and feet that slip: friction is 0.0025 between piers and "
    "2 under them, as the theory has none and as much as needed. Measured rows of dominoes are slower for both.",
    source="J. M. J. van Leeuwen, *The domino effect*, Am. J. Phys. 78 (2010) 721, without friction, worked out here: "
    "all that were hit lean on each other, keep their energy between hits, and share their impulses at one.",
    reason=f"10 %: the row is nearly steady from pier {STEADY + 1} on, a hit is spread over some sub-steps of 0.4 ms, "
    "and feet sink.",
    run=run,
)
