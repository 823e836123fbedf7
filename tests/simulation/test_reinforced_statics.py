# SPDX-License-Identifier: GPL-3.0-or-later
"""A slab on its bars: what stands by statics stands in a run in Blender, and what does not comes down."""

import pytest
from support.growing_weight import animate_gravity
from support.reinforced_slab import Slab, slab_text

from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.simulation.playback import Playing
from bridge_demolition_addon.simulation.recording.recorder import Recording

pytestmark = pytest.mark.long

DURATION_S = 3.0
GROWN_S = 1.5
"""Time after which the slab is as heavy as it gets: it cracks little by little, without a jerk."""


def largest_drop_m(blender, folder, slab, factor):
    """How far a shard has fallen at the end of a run in which gravity grows to a load factor."""
    scene = blender.context.scene
    build_demolition(scene, slab.scenario, slab.model)
    shares = {0.0: 0.3, 0.1: 0.3, GROWN_S: factor}
    animate_gravity(scene, {scene.frame_start + 24 * time_s: share for time_s, share in shares.items()})
    playing = Playing(Recording(scene, folder))
    while not playing.finished:
        playing.step()
    playing.end()
    results = playing.recording.results()
    heights = results.frames.positions_m[:, results.inventory.moves, 2]
    return float((heights[0] - heights[-1]).max())


def test_statics_and_a_run_agree_on_what_stands(blender, tmp_path):
    """At 0.95 times the collapse load factor its bars yield and hold, at 1.3 times it is down."""
    slab = Slab(slab_text(8, blocks=True, hardening=1.08, duration_s=DURATION_S))
    factor = slab.collapse_factor()
    (tmp_path / "stands").mkdir()
    drop_m = largest_drop_m(blender, tmp_path / "stands", slab, 0.95 * factor)
    # Bars have yielded then, and are stretched further by what little it swings: twice as far as at rest, about 25 mm.
    assert slab.rest(0.95 * factor).sag_m < drop_m < 0.04
    blender.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    (tmp_path / "falls").mkdir()
    assert largest_drop_m(blender, tmp_path / "falls", slab, 1.3 * factor) > 0.5
