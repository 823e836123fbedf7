# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear across an inclined crack: links as EN 1992-1-1, 6.2.3, has them."""

import sys

import numpy as np
import pytest
from support.checkout import ROOT
from support.long_cases import long_but

sys.path.insert(1, str(ROOT / "validation"))

from case import RIGID_BODIES, simulated
from solids import block

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

LENGTH_M, WIDTH_M, HEIGHT_M, BOTTOM_M = 3.0, 0.3, 0.5, 2.0
DENSITY_KG_M3 = 2400.0
SHEAR_N = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * WIDTH_M * HEIGHT_M * LENGTH_M / 2.0
"""Weight of the right half of the beam, which its left half carries through the crack."""

COT = 1.0
"""Cotangent of the angle of the crack: 45°."""


def sheared_beam(folder, links_share):
    """How far the right half of a beam has gone down, which is free to go up and down alone, across a crack at 45°.

    Links resist so many times the shear, by V = A_sw / s · z f_y cot θ with z the height of the crack. Bars along the
    beam are there in any case.
    """
    solids = {
        "beam": block((0, -WIDTH_M / 2, BOTTOM_M), (LENGTH_M, WIDTH_M / 2, BOTTOM_M + HEIGHT_M)),
        "left": block((-0.5, -WIDTH_M / 2, BOTTOM_M), (0, WIDTH_M / 2, BOTTOM_M + HEIGHT_M)),
        "right": block((LENGTH_M, -WIDTH_M / 2, BOTTOM_M), (LENGTH_M + 0.5, WIDTH_M / 2, BOTTOM_M + HEIGHT_M)),
    }
    members = "".join(
        f'[[geometry]]\nname = "{name}"\nkind = "{kind}"\nfile = "{name}.obj"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
        for name, kind in (("beam", "beam"), ("left", "wall"), ("right", "guide"))
    )
    # The plane half-way between two points rises to the right: the right half hangs below it.
    middle, away = (LENGTH_M / 2, BOTTOM_M + HEIGHT_M / 2), 0.2
    points = "".join(
        f"[[fracture.points]]\nplace_m = [{middle[0] + sign * away}, 0.0, {middle[1] - sign * away * COT}]\n"
        for sign in (-1, 1)
    )
    spread_mm2_m2 = 1e6 * links_share * SHEAR_N / (WIDTH_M * HEIGHT_M * COT * 500e6)
    links = f'[[reinforcement]]\nmembers = ["beam"]\nalong = "z"\nspread_mm2_m2 = {spread_mm2_m2}\n'
    # The dowels of these carry a tenth of the shear.
    along = f'[[reinforcement]]\nmembers = ["beam"]\ndepth_m = 0.05\narea_mm2 = {1e6 * 0.4 * SHEAR_N / 500e6}\n'
    material = "".join(f"{name}_n_mm2 = 0.001\n" for name in ("tension", "shear", "torsion", "bending"))
    strong = "".join(f"{name}_n_mm2 = 1e6\n" for name in ("compression", "tension", "shear", "torsion", "bending"))
    scenario = f"""
[scenario]
title = "links across a crack"

[time]
duration_s = 1.0
substeps_per_frame = 20
solver_iterations = 50

{members}
[[supports]]
member = "wall"

[[supports]]
member = "guide"

[fracture]
shards = 4

{points}
[[materials]]
name = "of the beam"
compression_n_mm2 = 30.0
{material}elastic_modulus_n_mm2 = 30000.0

[[materials]]
name = "of the ends"
{strong}elastic_modulus_n_mm2 = 30000.0

{along}
{links if links_share else ""}
[connections]
type = "FIXED"
method = "face"
material = "of the beam"
stiffness = "elastic"
ductile_hardening = 1.0
ductile_elongation_m = 0.05

[[connections.between]]
members = ["beam", "wall"]
material = "of the ends"

[[connections.between]]
members = ["beam", "guide"]
type = "GENERIC"
free = ["move z"]
material = "of the ends"
{RIGID_BODIES.format(shards=0.25, ground=0.25)}"""
    results = simulated(folder, "beam", scenario, {f"{name}.obj": solid for name, solid in solids.items()})
    inventory, frames = results.inventory, results.frames
    halves = np.flatnonzero((inventory.body_kinds == "shard") & (inventory.body_members == "beam"))
    assert len(halves) == 2
    right = halves[np.argmax(frames.positions_m[0, halves, 0])]
    assert not frames.intact[-1].all()
    return frames.positions_m[0, right, 2] - frames.positions_m[-1, right, 2]


@pytest.mark.parametrize(
    ("links_share", "stands"),
    long_but([(0.95, False), (1.05, True)], [(0.0, False), (0.95, False), (1.05, True)], several=True),
)
def test_a_beam_stands_on_links_as_their_formula_says(blender, tmp_path, links_share, stands):
    """Within 5 %: dowels of the bars along it add less than 1 %, as both are on one ellipse."""
    fallen_m = sheared_beam(tmp_path, links_share)
    assert (fallen_m < 0.04) == stands
