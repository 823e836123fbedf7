# SPDX-License-Identifier: GPL-3.0-or-later
"""Removals, saw cuts and weakenings happen when and where they are wanted, with what mechanics says of the rest."""

from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks
from support.shard_scenes import DENSITY_KG_M3, ShardScene

from bridge_demolition_addon.bullet import layout
from bridge_demolition_addon.engineering.mechanics.strength import Strength
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError, SimulationError
from bridge_demolition_addon.model.results.motion import OUT_OF_REACH_M
from bridge_demolition_addon.model.scenario import Removal, SawCut, Weakening
from bridge_demolition_addon.scene.bodies import mark_member
from bridge_demolition_addon.scene.connections.constraints import Breaking
from bridge_demolition_addon.scene.custom_properties import keep_tables, run_tables_of
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

MASS_KG = 100.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2


def play(scene, folder, frames, every_substep=True):
    recording = Recording(scene, folder, every_substep=every_substep)
    start_recording(recording)
    for frame in range(scene.frame_start, scene.frame_start + frames + 2):
        scene.frame_set(frame)
    stop_recording()
    if recording.error:
        raise recording.error
    return recording, recording.results()


def hanging_bar(**options):
    """A bar of 6 m in 12 shards that hangs by those above 5 m."""
    bar = ShardScene((1.0, 1.0, 6.0), (0.0, 0.0, 13.0), 12, {"solver_iterations": 100}, **options)
    bar.hold(bar.fracture.centres[:, 2] > 15.0)
    for shard in bar.shards:
        shard.rigid_body.linear_damping = shard.rigid_body.angular_damping = 0.0
    return bar


@pytest.mark.parametrize("every_substep", (True, False))
def test_bar_falls_freely_below_a_saw_cut_from_its_time_on(blender, tmp_path, every_substep):
    bar, cut_s = hanging_bar(), 0.3
    keep_tables(bar.scene, "changes", [SawCut(time_s=cut_s, point_m=(0, 0, 13), normal=(0, 0, 2))])
    recording, results = play(bar.scene, tmp_path, 24, every_substep)
    below = bar.fracture.centres[:, 2] < 13.0
    order = [results.inventory.body_names.tolist().index(shard.name) for shard in bar.shards]
    velocities = results.frames.velocities_m_s[:, order, 2]
    before = results.frames.time_s < cut_s
    assert results.frames.intact[before].all()
    assert abs(velocities[before]).max() < 0.05
    # The cut comes before the first sub-step at or after its time.
    substep = results.frames.substep_s[-1]
    falling_s = results.frames.time_s[-1] - substep * np.ceil(cut_s / substep - 1e-3)
    np.testing.assert_allclose(velocities[-1, below].mean(), -STANDARD_GRAVITY_M_S2 * falling_s, rtol=5e-3)
    assert abs(velocities[-1, ~below]).max() < 0.05
    sides = results.frames.positions_m[0][results.inventory.pairs][:, :, 2] > 13.0
    np.testing.assert_array_equal(results.frames.intact[-1], sides[:, 0] == sides[:, 1])
    (applied,) = recording.applied_events
    assert applied == {
        "time_s": pytest.approx(cut_s, abs=substep),
        "kind": "saw cut",
        "shards": [],
        "connections": int((sides[:, 0] != sides[:, 1]).sum()),
    }


@pytest.mark.parametrize("asleep", (False, True))
def test_tower_comes_down_by_what_is_taken_from_under_it(blender, tmp_path, asleep):
    blocks = Blocks(solver_iterations=100)
    blocks.block((0, 0, -0.5), size_m=(20, 20, 1))
    lowest, *upper = [blocks.block((0, 0, 0.5 + level), MASS_KG) for level in range(3)]
    aside = blocks.block((1.0, 0, 0.5), MASS_KG)  # face to face with the one that is removed
    blocks.connect("FIXED", (0, 0, 1), lowest, upper[0])
    for block in (lowest, *upper, aside):
        block.rigid_body.use_deactivation = asleep
        block.rigid_body.use_start_deactivated = asleep
    mark_member(lowest, "pier 1", "pier")
    keep_tables(blocks.scene, "changes", [Removal(time_s=0.5, members=["pier"])])
    recording, results = play(blocks.scene, tmp_path, 60)
    height = results.frames.positions_m[:, :, 2]
    assert abs(height[results.frames.time_s < 0.5] - height[0]).max() < 0.01
    np.testing.assert_allclose(height[-1, 2:5], [0.5, 1.5, 0.5], atol=0.01)
    # Nothing is flung: what falls by 1 m is no faster than that, and what stood beside it stays.
    speeds = np.linalg.norm(results.frames.velocities_m_s, axis=2)
    assert speeds.max() <= 1.01 * np.sqrt(2.0 * STANDARD_GRAVITY_M_S2)
    assert speeds[:, 4].max() < 0.05
    assert np.linalg.norm(results.frames.positions_m[-1, 4] - results.frames.positions_m[0, 4]) < 0.01
    # What is gone carries nothing, and what lies where it stood bears on the ground.
    assert not results.frames.loads.body_peak_sums_n[-1, 1]
    assert results.frames.loads.body_forces_n[-1, 0, 2] == pytest.approx(-3 * WEIGHT_N, rel=0.01)
    assert recording.applied_events[0]["shards"] == [lowest.name]
    # It stays where it was put: Bullet does not take its way down for how deep it is in the ground.
    assert height[-1, 1] == pytest.approx(0.5 - OUT_OF_REACH_M, abs=0.01)


def test_blocks_removed_together_bear_on_each_other_no_more(blender, tmp_path):
    """Bullet keeps the last contact of two bodies that it simulates no more."""
    blocks = Blocks()
    blocks.block((0, 0, -0.5), size_m=(20, 20, 1))
    for level in range(3):
        blocks.block((0, 0, 0.5 + level), MASS_KG)
    keep_tables(
        blocks.scene, "changes", [Removal(time_s=0.5, lowest_corner_m=(-1, -1, 0), highest_corner_m=(1, 1, 2.2))]
    )
    _, results = play(blocks.scene, tmp_path, 60)
    assert not results.frames.loads.body_peak_sums_n[-1, 1:3].any()
    assert not results.frames.velocities_m_s[-1, 1:3].any()
    assert results.frames.positions_m[-1, 3, 2] == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize(
    ("factors", "holds"), (([0.55], True), ([0.45], False), ([0.8, 0.8], True), ([0.7, 0.7], False))
)
def test_weakened_connection_bears_what_is_left_of_its_breaking_force(blender, tmp_path, factors, holds):
    blocks = Blocks()
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG)
    blocks.connect("FIXED", (0, 0, 9.5), ceiling, block, 2.0 * WEIGHT_N)
    keep_tables(
        blocks.scene,
        "changes",
        [Weakening(time_s=0.2 + 0.1 * number, factor=factor) for number, factor in enumerate(factors)],
    )
    _, results = play(blocks.scene, tmp_path, 24)
    assert results.frames.intact[results.frames.time_s < 0.19].all()
    assert bool(results.frames.intact[-1, 0]) is holds


@pytest.mark.parametrize(("factor", "holds"), ((0.55, True), (0.45, False)))
def test_weakened_section_bears_what_is_left_of_its_strength(blender, tmp_path, factor, holds):
    """A bar of two halves: the joint carries the weight of 3 m of concrete by area, with twice the strength."""
    weight_pa = 3.0 * DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2
    strength = Strength(compression_pa=1e9, tension_pa=2.0 * weight_pa, shear_pa=1e9, bending_pa=1e9, torsion_pa=1e9)
    bar = ShardScene((1, 1, 6), (0, 0, 13), 2, {}, breaking=Breaking(strength))
    # The two shards are unequal; what hangs on the upper is scaled to the lower one's weight over the joint.
    lower = int(bar.fracture.centres[:, 2].argmin())
    bar.hold(np.arange(2) != lower)
    area = bar.scene.rigidbody_world.constraints.objects[0]["bda_area_m2"]
    bar.shards[lower].rigid_body.mass = 3.0 * DENSITY_KG_M3 * area
    keep_tables(bar.scene, "changes", [Weakening(time_s=0.3, factor=factor)])
    _, results = play(bar.scene, tmp_path, 24)
    assert results.frames.intact[results.frames.time_s < 0.29].all()
    assert bool(results.frames.intact[-1, 0]) is holds


def test_several_changes_happen_in_order_of_time(blender, tmp_path):
    bar = hanging_bar()
    changes = [
        Removal(time_s=0.6, lowest_corner_m=(-1, -1, 10), highest_corner_m=(1, 1, 12)),
        Weakening(time_s=0.2, factor=0.5),
        SawCut(time_s=0.4, point_m=(0, 0, 14), normal=(0, 0, 1)),
    ]
    keep_tables(bar.scene, "changes", changes)
    assert run_tables_of(bar.scene, "changes") == tuple(changes)
    recording, _ = play(bar.scene, tmp_path, 24)
    applied = recording.applied_events
    assert [change["kind"] for change in applied] == ["weakening", "saw cut", "removal"]
    assert [change["time_s"] for change in applied] == pytest.approx([0.2, 0.4, 0.6], abs=1.0 / 240.0)
    keep_tables(bar.scene, "changes", [])
    assert run_tables_of(bar.scene, "changes") == ()


def test_changes_start_anew_with_the_simulation(blender, tmp_path):
    bar = hanging_bar()
    keep_tables(bar.scene, "changes", [SawCut(time_s=0.3, point_m=(0, 0, 13), normal=(0, 0, 1))])
    recording = Recording(bar.scene, tmp_path)
    start_recording(recording)
    for _ in range(2):
        bar.scene.rigidbody_world.substeps_per_frame = 10  # has Blender simulate again
        for frame in range(1, 16):
            bar.scene.frame_set(frame)
    stop_recording()
    assert recording.error is None
    assert len(recording.applied_events) == 1
    results = recording.results()
    assert results.frames.intact[results.frames.time_s < 0.3].all()
    assert not results.frames.intact[-1].all()


def test_change_that_concerns_nothing_is_refused(blender, tmp_path):
    bar = hanging_bar()
    keep_tables(bar.scene, "changes", [Removal(time_s=0.1, members=["pier 7"])])
    with pytest.raises(ScenarioError, match=r'removals\.members names "pier 7"'):
        play(bar.scene, tmp_path, 4)


def test_changes_are_not_left_out_in_silence_where_memory_is_not_trusted(blender, tmp_path, monkeypatch):
    right = layout.platform_layout()
    monkeypatch.setattr(layout, "SYSTEM_V", replace(right, body=replace(right.body, friction=right.body.friction + 8)))
    monkeypatch.setattr(layout, "MICROSOFT", layout.SYSTEM_V)
    bar = hanging_bar()
    keep_tables(bar.scene, "changes", [SawCut(time_s=0.3, point_m=(0, 0, 13), normal=(0, 0, 1))])
    with pytest.raises(SimulationError, match="removals, saw cuts, weakenings and blast zones need Blender's memory"):
        play(bar.scene, tmp_path, 4)
