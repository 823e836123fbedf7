# SPDX-License-Identifier: GPL-3.0-or-later
"""A beam that cracks under its weight in Blender: bars stretch along its shards, also in a scene that was kept."""

import numpy as np
import pytest
from support.beam_runs import played
from support.cracked_beam import BARS, cracked, cracked_stiffness_nm2
from support.prestressed_beam import Beam, beam_text

from bridge_demolition_addon.scene.connections.constraints import breaking_of, connections_of


@pytest.mark.long
def test_a_beam_that_cracks_swings_about_its_cracked_state(blender, tmp_path):
    """It falls into its cracks, so that more open than by statics: its mean over three swings lies deeper.

    With cracks everywhere it would go down as its uncracked self, times the ratio of both stiffnesses. The scene keeps
    how far bars stretch.
    """
    text = beam_text(BARS, blocks=12, span_m=16.0, duration_s=2.0).replace(
        "damping_ratio = 0.02", "damping_ratio = 0.1"
    )
    beam = Beam(text.replace("[connections]", "[connections]\ncracks_within_shards = true"))
    bridge = cracked(beam)
    bridge.carry(1.0)
    everywhere_m = -beam.middle_rises_m(beam.rest()) * beam.stiffness_nm2 / cracked_stiffness_nm2(beam)
    _, results, rises_m = played(blender, tmp_path, beam)
    mean_m = -rises_m[results.frames.time_s > 1.0].mean()
    assert bridge.deflection_m < mean_m < 1.1 * everywhere_m
    kept = breaking_of(blender.context.scene, connections_of(blender.context.scene)).bars
    assert np.array_equal(kept.yield_shares, beam.model.bars.yield_shares, equal_nan=True)
