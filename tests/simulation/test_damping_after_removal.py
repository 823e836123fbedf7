# SPDX-License-Identifier: GPL-3.0-or-later
"""The damping ratio holds for what is left of a bridge after a support goes."""

import numpy as np
import pytest

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.simulation.run import run_scenario

RATIO, REMOVED_S = 0.05, 0.1
DECK = f"""
[scenario]
title = "deck that loses its middle support"
seed = 1
[time]
duration_s = 1.5
frames_per_second = 60
substeps_per_frame = 6
[bridge]
density_kg_m3 = 2500
span_lengths_m = [10.0, 10.0]
[bridge.deck]
width_m = 3.0
thickness_m = 0.7
overhang_m = 0.5
[bridge.piers]
kind = "wall"
column_length_m = 0.05
column_width_m = 3.0
height_m = 1.0
[[supports]]
member = "pier 1"
[[supports]]
member = "pier 3"
[fracture]
shards = 23
[[fracture.members]]
member = "pier"
shards = 1
[[materials]]
name = "strong"
compression_n_mm2 = 1e4
tension_n_mm2 = 1e4
shear_n_mm2 = 1e4
torsion_n_mm2 = 1e4
bending_n_mm2 = 1e4
elastic_modulus_n_mm2 = 30000
poisson_ratio = 0.2
[connections]
type = "FIXED"
method = "face"
material = "strong"
stiffness = "elastic"
damping_ratio = {RATIO}
[[connections.between]]
members = ["deck", "pier 1"]
type = "GENERIC"
free = ["turn y"]
[[connections.between]]
members = ["deck", "pier"]
type = "GENERIC"
free = ["move x", "turn y"]
[shards]
use_deactivation = false
start_deactivated = false
[[removals]]
members = ["pier 2"]
time_s = {REMOVED_S}
"""


def test_what_is_left_is_damped_as_is_asked_for(blender, tmp_path):
    """Over 20 m the deck swings four times as slowly as before: β that is kept would damp it by a quarter of the ratio.

    From one turning point to the next the way is less by exp(-π ζ / √(1 - ζ²)): the logarithmic decrement.
    """
    path = tmp_path / "deck.toml"
    path.write_text(DECK, encoding="utf-8")
    scenario = read_scenario(path)
    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run" / "results.npz")
    of_deck = results.inventory.body_members == "deck"
    middle = np.argmin(np.where(of_deck, abs(results.frames.positions_m[0, :, 0] - 10.0), np.inf))
    height = results.frames.positions_m[results.frames.time_s > REMOVED_S, middle, 2]
    turns = np.flatnonzero(np.diff(height[1:]) * np.diff(height[:-1]) < 0.0) + 1
    ways = abs(np.diff(height[turns]))
    swing_s = 2.0 * np.diff(turns).mean() / scenario.time.frames_per_second
    assert summary["elasticity"]["frequency_hz"] * swing_s > 3.5
    ratio = -np.diff(np.log(ways)).mean() / np.pi
    # 22 frames a swing find its turning points within 1 %.
    assert ratio == pytest.approx(RATIO, rel=0.1)
