# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Bullet's memory is not as expected, motion is recorded and said to be all there is."""

from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet import layout
from bridge_demolition_addon.engineering.ground_motion import integrated
from bridge_demolition_addon.engineering.timing.timeline import Timeline
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.results.summary import summarise
from bridge_demolition_addon.scene.tools.ground_motion import keep_ground_motion, move_with_ground
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording


@pytest.fixture
def strange_blender(blender, monkeypatch):
    """A Blender that keeps its bodies elsewhere than any known one."""
    right = layout.platform_layout()
    monkeypatch.setattr(layout, "SYSTEM_V", replace(right, body=replace(right.body, friction=right.body.friction + 8)))
    monkeypatch.setattr(layout, "MICROSOFT", layout.SYSTEM_V)
    return blender


def test_net_force_comes_from_the_change_of_momentum(strange_blender, tmp_path):
    blocks, mass = Blocks(frames_per_second=240, substeps_per_frame=1), 100.0
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    blocks.block((0, 0, 1.0), mass)
    ceiling, hanging = blocks.block((5, 0, 10)), blocks.block((5, 0, 9), mass)
    blocks.connect("FIXED", (5, 0, 9.5), ceiling, hanging)
    start_recording(recording := Recording(blocks.scene, tmp_path))
    for frame in range(1, 241):
        blocks.scene.frame_set(frame)
    stop_recording()
    assert recording.error is None
    assert "friction" in str(recording.layout_error)
    results = recording.results()
    assert results.load_sampling == "change of momentum between frames"
    weight = mass * STANDARD_GRAVITY_M_S2
    assert results.frames.loads.body_forces_n[-1, 3, 2] == pytest.approx(weight, rel=0.01)
    # Over the fall, the impact and the rest, the ground has given the block all the momentum that gravity did.
    impulse = np.nansum(results.frames.loads.body_forces_n[:, 1, 2]) / 240.0
    assert impulse == pytest.approx(weight * results.frames.time_s[-1], rel=0.02)
    assert np.isnan(results.frames.loads.body_sums_n).all()
    summary = summarise(results, np.array(blocks.scene.gravity))
    assert summary["reading"] == "change of momentum between frames"
    assert summary["largest_force_sum"] is None
    assert summary["connections"]["count"] == 0


def test_spin_comes_from_the_change_of_direction(strange_blender, tmp_path):
    """A plank that lies with its middle beside an edge tips over: its end falls, so that it turns about the edge."""
    blocks = Blocks(frames_per_second=240, substeps_per_frame=1)
    blocks.block((0, 0, -0.5), size_m=(2, 10, 1))
    blocks.block((1.5, 0, 0.1), 50.0, (4, 1, 0.2))
    start_recording(recording := Recording(blocks.scene, tmp_path))
    for frame in range(1, 121):
        blocks.scene.frame_set(frame)
    stop_recording()
    results = recording.results()
    spins = results.frames.angular_velocities_rad_s[:, 1]
    # The end at larger x goes down: positive about y.
    assert spins[-1, 1] > 1.0
    turned = results.frames.rotations[-1, 1]
    angle = np.arctan2(-turned[2, 0], turned[0, 0])
    steps = np.diff(results.frames.time_s)
    assert np.sum(spins[1:, 1] * steps) == pytest.approx(angle, rel=1e-3)
    np.testing.assert_allclose(spins[:, [0, 2]], 0.0, atol=0.05)


def test_scene_is_left_as_it_was(strange_blender, tmp_path):
    blocks = Blocks()
    blocks.block((0, 0, 1.0), 10.0)
    start_recording(Recording(blocks.scene, tmp_path))
    for frame in range(1, 5):
        blocks.scene.frame_set(frame)
    stop_recording()
    assert blocks.world.time_scale == 1.0
    graph = strange_blender.context.view_layer.depsgraph
    assert graph.scene_eval.rigidbody_world.time_scale == 1.0


def test_ground_that_moves_is_refused(strange_blender, tmp_path):
    blocks = Blocks()
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    blocks.block((0, 0, 0.5), 10.0)
    record = integrated(np.array([0.0, 1.0, 2.0]), np.ones((3, 3)))
    keep_ground_motion(blocks.scene, record)
    move_with_ground(blocks.scene, record, 0.0, 2, Timeline.of(1.0 / 24.0, 1.0, ()))
    with pytest.raises(SimulationError, match="a ground that moves needs Blender's memory"):
        blocks.play(tmp_path, 3)
