# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames with as many sub-steps as their bodies are fast: a block that falls, in Blender's own simulation."""

import bpy
import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.engineering.timing.timeline import MOST_SUBSTEPS, TimeStep
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

FRAMES, FARTHEST_M, HEIGHT_M = 30, 0.05, 30.0


def fallen(folder, *, every_substep=True, farthest_m=FARTHEST_M):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blocks = Blocks(frames_per_second=24, substeps_per_frame=4)
    blocks.block((0, 0, HEIGHT_M), 100.0)
    if farthest_m is not None:
        blocks.scene["bda_farthest_per_substep_m"] = farthest_m
    recording = Recording(blocks.scene, folder, every_substep=every_substep)
    start_recording(recording)
    for frame in range(blocks.scene.frame_start, blocks.scene.frame_start + FRAMES):
        blocks.scene.frame_set(frame)
    stop_recording()
    assert recording.error is None
    assert blocks.scene.rigidbody_world.substeps_per_frame == 4
    return recording.results()


def test_no_body_goes_farther_than_it_may_in_a_substep(blender, tmp_path):
    frames = fallen(tmp_path).frames
    speeds, substeps_s = np.abs(frames.velocities_m_s[:, 0, 2]), frames.substep_s
    assert speeds[-1] * (1 / 24) / 4 > 2.0 * FARTHEST_M  # or four sub-steps would do
    assert (speeds * substeps_s <= FARTHEST_M * (1.0 + 1e-6)).all()
    assert substeps_s[substeps_s > 0.0][0] == pytest.approx(1 / 96)
    assert substeps_s[-1] == pytest.approx(1 / 240)
    # Time passes as it does with sub-steps of one length.
    assert frames.time_s[-1] == pytest.approx((FRAMES - 2) / 24, rel=1e-6)


def test_the_fall_is_as_much_too_far_as_its_substeps_are_long(blender, tmp_path):
    """In a sub-step Bullet falls by v Δt + g Δt² instead of v Δt + g Δt² / 2."""
    frames = fallen(tmp_path).frames
    fall_m = frames.positions_m[0, 0, 2] - frames.positions_m[-1, 0, 2]
    lengths_s = np.diff(frames.time_s)
    too_far_m = fall_m - 0.5 * STANDARD_GRAVITY_M_S2 * frames.time_s[-1] ** 2
    assert too_far_m == pytest.approx(0.5 * STANDARD_GRAVITY_M_S2 * (lengths_s * frames.substep_s[1:]).sum(), rel=0.01)
    assert too_far_m < 0.8 * 0.5 * STANDARD_GRAVITY_M_S2 * lengths_s.sum() / 96  # as it is with four in each frame


def test_loads_of_the_last_substep_alone_come_to_the_same(blender, tmp_path):
    found = []
    for every_substep in (True, False):
        (tmp_path / str(every_substep)).mkdir()
        found.append(fallen(tmp_path / str(every_substep), every_substep=every_substep).frames)
    assert (found[0].positions_m == found[1].positions_m).all()
    assert found[0].substep_s.tolist() == found[1].substep_s.tolist()
    assert found[0].time_s == pytest.approx(found[1].time_s, rel=1e-6)


def test_a_frame_has_no_more_substeps_than_blender_takes():
    step = TimeStep(24, 1.0, 10, 1.0)
    assert step.substeps_within(0.01, 0.0, 0.0) == 10
    assert step.substeps_within(0.01, 24.0, 0.0) == 100
    assert step.substeps_within(1e-6, 1e6, 9.81) == MOST_SUBSTEPS
