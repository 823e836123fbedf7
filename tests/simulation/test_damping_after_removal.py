# SPDX-License-Identifier: GPL-3.0-or-later
"""The damping ratio holds for what is left of a bridge after a support goes."""

import numpy as np
import pytest
from support.bearing_decks import deck_text

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.simulation.run import run_scenario

RATIO, REMOVED_S = 0.05, 0.1
OUTER_ARE_HELD_AND_MIDDLE_REMOVED = f"""
[[supports]]
member = "pier 1"
[[supports]]
member = "pier 3"
[[removals]]
members = ["pier 2"]
time_s = {REMOVED_S}
"""


@pytest.mark.long
def test_what_is_left_is_damped_as_is_asked_for(blender, tmp_path):
    """Over 20 m the deck swings four times as slowly as before: β that is kept would damp it by a quarter of the ratio.

    From one turning point to the next the way is less by exp(-π ζ / √(1 - ζ²)): the logarithmic decrement.
    """
    deck = deck_text(
        spans=(10.0, 10.0),
        shards=20,
        support_m=0.05,
        duration_s=1.5,
        damping_ratio=RATIO,
        are_held=False,
        more=OUTER_ARE_HELD_AND_MIDDLE_REMOVED,
    )
    scenario = scenario_from_text(deck)
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
    # 19 frames a swing find its turning points within 1 %.
    assert ratio == pytest.approx(RATIO, rel=0.1)
