# SPDX-License-Identifier: GPL-3.0-or-later
"""Newton's second law for every body, in every sub-step: nothing that acts on it is missed."""

import bpy
import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet.world import BulletWorld
from bridge_demolition_addon.engineering.mechanics.frame_loads import LoadAccumulator
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.breaking import CoreStep
from bridge_demolition_addon.simulation.recording.meter import Meter
from bridge_demolition_addon.simulation.recording.recorder import Recording
from bridge_demolition_addon.simulation.recording.substeps import SubstepRecorder

GRAVITY = np.array([0.0, 0.0, float(np.float32(-STANDARD_GRAVITY_M_S2))])


def largest_impulse(loads, substep_s):
    """Of the impulses that any body gets in a sub-step; the weight of the heaviest where there is none."""
    return max(loads.body_sums_n.max(), 500.0 * STANDARD_GRAVITY_M_S2) * substep_s


def test_change_of_momentum_is_the_sum_of_all_impulses(blender, tmp_path, monkeypatch):
    """A pile of connected and loose blocks that falls over, some of it breaking."""
    blocks = Blocks(frames_per_second=24, substeps_per_frame=10)
    blocks.block((0, 0, -0.5), size_m=(60, 60, 1))
    generator = np.random.default_rng(1)
    bodies = [
        blocks.block((1.02 * x + 0.2 * (z % 2), 1.02 * y, 1.2 + 1.05 * z), float(generator.uniform(50, 500)))
        for z in range(4)
        for y in range(2)
        for x in range(4)
    ]
    for i in range(0, 28, 3):
        kind = ("FIXED", "POINT", "HINGE")[i % 3]
        position = (np.array(bodies[i].location) + np.array(bodies[i + 1].location)) / 2
        blocks.connect(kind, tuple(position), bodies[i], bodies[i + 1], 2e4)
    errors, velocities, meters, read, begin = [], [np.zeros((33, 3))], [], CoreStep.read, Meter.begin
    recording = Recording(blocks.scene, tmp_path)

    def note(meter, tick, *, contacts):
        meters[:] = [meter]
        return begin(meter, tick, contacts=contacts)

    def compare(core, substep_s, end_s, *, loads):
        reading, energy = read(core, substep_s, end_s, loads=loads)
        (meter,) = meters
        bodies, loads = meter.loads([reading])
        before, after, inventory = velocities[-1], bodies.velocities_m_s[0], recording.inventory
        one = LoadAccumulator(inventory.pairs, inventory.volumes_m3, meter.normals)
        one.add(loads)
        masses = inventory.masses_kg[1:, None]
        impulses = one.finish().body_forces_n[1:] * substep_s + masses * GRAVITY * substep_s
        errors.append(abs(masses * (after - before)[1:] - impulses).max() / largest_impulse(one.finish(), substep_s))
        velocities.append(after.copy())
        return reading, energy

    monkeypatch.setattr(Meter, "begin", note)
    monkeypatch.setattr(CoreStep, "read", compare)
    start_recording(recording)
    for frame in range(blocks.scene.frame_start, blocks.scene.frame_start + 62):
        blocks.scene.frame_set(frame)
    stop_recording()
    results = recording.results()
    assert len(errors) == 600
    assert (~results.frames.intact[-1]).any()
    # Bullet works in double precision; masses reach it in single precision, as they do here.
    assert max(errors) < 1e-6


def test_ball_hands_over_its_momentum(blender, tmp_path):
    """J = m·Δv + m·g·t for the whole time of an impact, whatever the sub-step."""
    for substeps in (4, 40):
        blender.ops.wm.read_factory_settings(use_empty=True)
        blocks, mass = Blocks(substeps_per_frame=substeps), 1000.0
        blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
        ball = blocks.block((0, 0, 2.5), mass)
        ball["bda_kind"] = "ball"
        results = blocks.play(tmp_path, 24)
        impulses, times = results.balls.impulses_ns[:, 0, 2], results.balls.times_s
        velocity = results.balls.velocities_m_s[-1, 0, 2]
        assert impulses.sum() == pytest.approx(mass * (velocity - GRAVITY[2] * times[-1]), rel=1e-6)
        np.testing.assert_allclose(
            results.frames.loads.body_contact_impulses_ns[:, 1].sum(axis=0, dtype=float),
            results.balls.impulses_ns[:, 0].sum(axis=0),
            rtol=1e-7,  # frames are kept with seven digits
            atol=1e-7 * impulses.sum(),
        )


def test_last_substep_alone_is_an_option_and_says_so(blender, tmp_path):
    blocks = Blocks()
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), 100.0)
    blocks.connect("FIXED", (0, 0, 9.5), ceiling, block)
    start_recording(recording := Recording(blocks.scene, tmp_path, every_substep=False))
    for frame in range(1, 26):
        blocks.scene.frame_set(frame)
    stop_recording()
    results = recording.results()
    assert results.load_sampling == "last sub-step of each frame"
    assert results.frames.loads.body_forces_n[-1, 1, 2] == pytest.approx(-100.0 * GRAVITY[2], rel=1e-6)
    assert results.frames.time_s[-1] == pytest.approx(23 * blocks.time.step.frame_s)


def test_loads_of_the_last_substep_alone_are_written(blender, tmp_path, monkeypatch):
    """m·(Δv / Δt - g) of a pendulum in the last sub-step of each frame, whose force is another one in each."""
    blocks, mass = Blocks(substeps_per_frame=5), 100.0
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((3, 0, 9), mass)
    blocks.connect("POINT", (0, 0, 9), ceiling, block)
    substeps = []
    recording = Recording(blocks.scene, tmp_path, every_substep=False)
    prepare, world = SubstepRecorder.before_substep, recording.world

    def note(recorder, substep_s):
        prepare(recorder, substep_s)
        substeps.append((world.bodies.velocities()[1].copy(), world.constraints.feedback.copy(), substep_s))

    monkeypatch.setattr(SubstepRecorder, "before_substep", note)
    start_recording(recording)
    for frame in range(1, 23):
        blocks.scene.frame_set(frame)
    stop_recording()
    frames = recording.results().frames
    by_frame = [substeps[first : first + 5] for first in range(0, len(substeps), 5)]
    assert len(by_frame) == len(frames.time_s) - 1 == 20
    for impulses, force, velocity in zip(
        by_frame, frames.loads.body_forces_n[1:, 1], frames.velocities_m_s[1:, 1], strict=True
    ):
        before, _, substep_s = impulses[-1]
        # Velocities are kept in single precision, to 0.3 µm/s: m / Δt makes 4 mN of that.
        np.testing.assert_allclose(force, mass * ((velocity - before) / substep_s - GRAVITY), atol=0.02)
        for _, loads, _ in impulses[1:]:
            np.testing.assert_array_equal(loads, impulses[0][1])
    assert np.ptp(frames.loads.body_forces_n[1:, 1, 2]) > 100.0


def test_loads_that_nothing_reads_are_not_written(blender, tmp_path):
    """Without loads, of connections that break by forces; their motion is that of a run that records them."""
    positions = []
    for loads in (True, False):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        blocks = Blocks(substeps_per_frame=5)
        ceiling, block = blocks.block((0, 0, 10)), blocks.block((3, 0, 9), 100.0)
        blocks.connect("POINT", (0, 0, 9), ceiling, block)
        (folder := tmp_path / str(loads)).mkdir()
        start_recording(recording := Recording(blocks.scene, folder, loads=loads))
        for frame in range(1, 10):
            blocks.scene.frame_set(frame)
        assert recording.world.constraints.feedback.any() == loads
        stop_recording()
        positions.append(recording.results().frames.positions_m[:, 1])
    np.testing.assert_array_equal(*positions)


def test_a_last_substep_that_comes_too_soon_is_told_of(blender, tmp_path):
    blocks = Blocks(substeps_per_frame=10)
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), 100.0)
    blocks.connect("FIXED", (0, 0, 9.5), ceiling, block)
    for frame, substeps in ((9, 10), (10, 4)):
        blocks.world.substeps_per_frame = substeps
        blocks.scene.keyframe_insert("rigidbody_world.substeps_per_frame", frame=frame)
    start_recording(recording := Recording(blocks.scene, tmp_path, every_substep=False))
    for frame in range(1, 12):
        blocks.scene.frame_set(frame)
    stop_recording()
    assert "a frame had 4 sub-steps instead of 10: do not animate" in str(recording.error)


def test_nothing_of_ours_is_left_in_the_world(blender, tmp_path):
    blocks = Blocks()
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), 100.0)
    connection = blocks.connect("FIXED", (0, 0, 9.5), ceiling, block)
    blocks.play(tmp_path, 5)
    for frame in range(blocks.scene.frame_current + 1, blocks.scene.frame_current + 5):
        blocks.scene.frame_set(frame)  # would call a hook that is still there
    # A world with a hook, a token or a feedback of ours would be refused as somebody else's.
    fresh = BulletWorld(blocks.scene, [ceiling, block], [connection])
    fresh.bind(blender.context.view_layer.depsgraph)
    fresh.release()
