# SPDX-License-Identifier: GPL-3.0-or-later
"""Intact bridges of every kind stand under their own weight by the strength of their material, awake all the time."""

import numpy as np
import pytest
from support.long_cases import long_but

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.simulation.run import run_scenario

COMMON = """
[scenario]
title = "standing"
[time]
duration_s = 2.0
substeps_per_frame = 10
solver_iterations = 100
[fracture]
shards = 80
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
warm_up_s = 0.5
[shards]
use_deactivation = false
start_deactivated = false
"""
PIERS = """
[bridge.piers]
columns = 2
column_length_m = 0.9
column_width_m = 0.9
height_m = 4.0
[bridge.pier_caps]
length_m = 1.2
width_m = 8.0
height_m = 0.8
"""
KINDS = {
    "slab": """
[bridge]
density_kg_m3 = 2400
span_lengths_m = [10.0]
[bridge.deck]
width_m = 8.0
thickness_m = 0.7
overhang_m = 0.6
"""
    + PIERS,
    "skewed slab": """
[bridge]
density_kg_m3 = 2400
span_lengths_m = [10.0]
skew_deg = 20.0
[bridge.deck]
width_m = 8.0
thickness_m = 0.7
overhang_m = 0.6
"""
    + PIERS,
    "slab on girders": """
[bridge]
density_kg_m3 = 2400
span_lengths_m = [10.0]
[bridge.deck]
width_m = 8.0
thickness_m = 0.3
overhang_m = 0.6
[bridge.girders]
number = 4
width_m = 0.5
depth_m = 0.7
"""
    + PIERS,
    "box girder between abutments": """
[bridge]
density_kg_m3 = 2400
span_lengths_m = [12.0]
[bridge.deck]
width_m = 8.0
thickness_m = 0.3
overhang_m = 0.5
[bridge.box_girder]
width_m = 4.5
depth_m = 1.0
web_thickness_m = 0.4
bottom_thickness_m = 0.3
[bridge.abutments]
length_m = 1.6
width_m = 8.0
height_m = 4.0
""",
    "two spans on walls": """
[bridge]
density_kg_m3 = 2400
span_lengths_m = [9.0, 9.0]
[bridge.deck]
width_m = 8.0
thickness_m = 0.6
overhang_m = 0.5
[bridge.piers]
kind = "wall"
column_length_m = 0.8
column_width_m = 7.0
height_m = 4.0
""",
}
MOST_BROKEN = 0.06
"""Of all connections: slivers of faces at edges between members, which carry next to nothing. Draws: up to 3.3 %."""

MOST_SAG_M = 0.005
"""With 100 iterations: Bullet's own sag, up to a millimetre here, and not that of concrete."""


@pytest.mark.parametrize("kind", long_but(["slab on girders"], KINDS))
def test_an_intact_bridge_stands(blender, tmp_path, kind):
    scenario = scenario_from_text(COMMON + KINDS[kind])
    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run" / "results.npz")
    connections = summary["connections"]
    assert connections["broken"] <= MOST_BROKEN * connections["count"]
    moved = np.linalg.norm(results.frames.positions_m[-1] - results.frames.positions_m[0], axis=1)[
        results.inventory.of_kind("shard")
    ]
    assert moved.max() < MOST_SAG_M
    # Nothing goes on breaking or sinking.
    late = results.frames.time_s > 1.0
    assert np.ptp(results.frames.intact[late].sum(axis=1)) == 0
    assert abs(results.frames.velocities_m_s[-1]).max() < 1e-2
