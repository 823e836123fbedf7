# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces of contacts at rest, against statics."""

import math

import numpy as np
import pytest
from reference import bullet_fields as reference
from support.blocks import Blocks

from bridge_demolition_addon.bullet.contacts import ContactReader
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))

# Bullet keeps pressing out the last of a penetration while a block rests; what is left of that after two seconds.
RESTING = 1e-4


def test_block_rests_on_the_ground_with_its_weight(blender, tmp_path):
    blocks = Blocks()
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    blocks.block((0, 0, 0.5), 250.0)
    results = blocks.play(tmp_path, 48)
    weight = 250.0 * GRAVITY
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, 1], (0, 0, weight), atol=RESTING * weight)
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, 0], (0, 0, -weight), atol=RESTING * weight)
    frame_s = blocks.time.step.frame_s
    assert results.frames.loads.body_contact_impulses_ns[-1, 1, 2] == pytest.approx(weight * frame_s, rel=RESTING)


def test_each_level_of_a_stack_carries_all_above_it(blender, tmp_path):
    blocks, masses = Blocks(solver_iterations=100), (100.0, 50.0, 200.0)
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    for level, mass in enumerate(masses):
        blocks.block((0, 0, 0.5 + level), mass)
    results = blocks.play(tmp_path, 96)
    weights = np.array(masses) * GRAVITY
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, 1:, 2], weights, rtol=RESTING)
    above = np.cumsum(weights[::-1])[::-1]
    # Every block is pressed by what is on it and by what it stands on.
    np.testing.assert_allclose(
        results.frames.loads.body_sums_n[-1, 1:], above + np.append(above[1:], 0.0), rtol=2 * RESTING
    )


def test_block_on_a_slope_is_held_by_friction(blender, tmp_path):
    blocks, slope, mass = Blocks(solver_iterations=100), math.radians(20.0), 100.0
    normal = np.array([-math.sin(slope), 0.0, math.cos(slope)])
    ramp = blocks.block(tuple(-0.5 * normal), size_m=(20, 20, 1))
    block = blocks.block(tuple(0.5 * normal), mass)
    for body in (ramp, block):
        body.rotation_euler = (0.0, -slope, 0.0)
        body.rigid_body.friction = 1.0  # tan 20° would do
    results = blocks.play(tmp_path, 96)
    weight = mass * GRAVITY
    force = results.frames.loads.body_forces_n[-1, 1]
    assert force @ normal == pytest.approx(weight * math.cos(slope), rel=RESTING)
    np.testing.assert_allclose(
        force - (force @ normal) * normal, (0, 0, weight) - weight * math.cos(slope) * normal, atol=RESTING * weight
    )


def test_points_are_copied_by_the_core_as_by_numpy(blender, tmp_path, monkeypatch):
    blocks, copied, dispatchers = Blocks(), [], {}
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    for level in range(3):
        blocks.block((0.1 * level, 0, 0.52 + 1.02 * level), 100.0)
    made, of_core = ContactReader.__init__, ContactReader.copied

    def note(reader, layout, dispatcher, bodies):
        dispatchers[reader] = layout, dispatcher
        made(reader, layout, dispatcher, bodies)

    def both_ways(reader):
        found, (components, bodies) = of_core(reader), reference.contact_points(*dispatchers[reader])
        np.testing.assert_array_equal(found.components, components)
        np.testing.assert_array_equal(found.bodies, bodies)
        assert found.bodies.dtype == bodies.dtype
        copied.append(found.components.shape[1])
        return found

    monkeypatch.setattr(ContactReader, "__init__", note)
    monkeypatch.setattr(ContactReader, "copied", both_ways)
    blocks.play(tmp_path, 12)
    assert 0 in copied and max(copied) >= 12


@pytest.mark.long
def test_more_contacts_than_fit_into_the_pool_of_bullet(blender, tmp_path):
    """Bullet has room for 4096 contacts in its pool, and takes the rest from the heap."""
    blocks, side, mass = Blocks(substeps_per_frame=2), 66, 10.0
    blocks.block((0, 0, -0.5), size_m=(400, 400, 1))
    for row in range(side):
        for column in range(side):
            blocks.block((3.0 * row - 99.0, 3.0 * column - 99.0, 0.5), mass)
    results = blocks.play(tmp_path, 10)
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, 1:, 2], mass * GRAVITY, rtol=1e-2)
    assert results.frames.loads.body_forces_n[-1, 0, 2] == pytest.approx(-(side**2) * mass * GRAVITY, rel=RESTING)


def test_sleeping_block_keeps_its_resting_load_and_is_marked(blender, tmp_path):
    blocks = Blocks()
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    sleeper = blocks.block((0, 0, 0.5), 100.0)
    sleeper.rigid_body.use_deactivation = True
    results = blocks.play(tmp_path, 24 * 6)
    assert not results.frames.asleep[1, 1]
    assert results.frames.asleep[-1, 1]
    assert results.frames.loads.body_forces_n[-1, 1, 2] == pytest.approx(100.0 * GRAVITY, rel=1e-2)


def test_frames_played_back_are_not_recorded_again(blender, tmp_path):
    from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
    from bridge_demolition_addon.simulation.recording.recorder import Recording

    blocks = Blocks()
    blocks.block((0, 0, 10), 100.0)
    start_recording(recording := Recording(blocks.scene, tmp_path))
    for frame in (*range(1, 11), 5, 6, 4, 10):
        blocks.scene.frame_set(frame)
    stop_recording()
    assert recording.error is None
    assert recording.results().frames.number.tolist() == list(range(2, 11))
