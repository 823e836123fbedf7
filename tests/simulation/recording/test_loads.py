# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads that grow with time, in Blender's own simulation, against statics and Newton's second law."""

from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet import layout
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError, SimulationError
from bridge_demolition_addon.model.scenario import Load, Removal
from bridge_demolition_addon.scene.bodies import mark_member
from bridge_demolition_addon.scene.custom_properties import keep_tables, run_tables_of

MASS_KG = 100.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2


def test_a_block_slides_once_its_load_is_more_than_friction(blender, tmp_path):
    """From 0 to 2 μ m g in a second: it slides from 0.5 s on, and has v = μ g (t - 0.5 s)² / (1 s) after it."""
    friction = 0.5
    blocks = Blocks(substeps_per_frame=20, solver_iterations=50)
    ground, block = blocks.block((0, 0, -0.5), size_m=(20, 20, 1)), blocks.block((0, 0, 0.1), MASS_KG, (1, 1, 0.2))
    for body, value in ((ground, 1.0), (block, friction)):
        body.rigid_body.friction = value
    # At the foot, so that it does not lean.
    most_n = 2.0 * friction * WEIGHT_N
    keep_tables(
        blocks.scene, "loads", [Load(point_m=(0, 0, 0.05), direction=(2, 0, 0), times_s=(0, 1), forces_n=(0, most_n))]
    )
    results = blocks.play(tmp_path, 24)
    speeds, times = results.frames.velocities_m_s[:, 1, 0], results.frames.time_s
    assert abs(speeds[times < 0.49]).max() < 1e-3
    slid = np.clip(times - 0.5, 0.0, None)
    # 1 %: contacts are where they are found once in a sub-step.
    np.testing.assert_allclose(speeds, friction * STANDARD_GRAVITY_M_S2 * slid**2, atol=0.01 * speeds[-1])


@pytest.mark.parametrize("every_substep", [True, False])
def test_a_cantilever_holds_what_hangs_at_a_point_of_it(blender, tmp_path, every_substep):
    """Force m g + F(t), and moment F(t) times the arm to the wall, also where loads are read once a frame."""
    blocks = Blocks(substeps_per_frame=20, solver_iterations=200)
    wall, arm = blocks.block((0, 0, 10)), blocks.block((1, 0, 10), MASS_KG)
    blocks.connect("FIXED", (0.5, 0, 10), wall, arm)
    keep_tables(
        blocks.scene, "loads", [Load(point_m=(1.5, 0.25, 10.5), times_s=(0.25, 0.75), forces_n=(0, 10.0 * WEIGHT_N))]
    )
    results = blocks.play(tmp_path, 24, every_substep=every_substep)
    loads, times = results.frames.loads, results.frames.time_s
    # Mean of a frame, or of its last sub-step.
    frame_s, substep_s = times[-1] - times[-2], results.frames.substep_s[-1]
    middles = times - (frame_s if every_substep else substep_s) / 2.0
    forces = 10.0 * WEIGHT_N * np.clip((middles - 0.25) / 0.5, 0.0, 1.0)
    frames = slice(2, None)
    growing = abs(times[frames] - 0.25) > frame_s  # its corners are within frames
    growing &= abs(times[frames] - 0.75) > frame_s
    sign = 1.0 if results.inventory.body_names[results.inventory.pairs[0, 0]] == arm.name else -1.0
    force = sign * loads.connection_forces_n[frames, 0][growing]
    moment = sign * loads.connection_moments_nm[frames, 0][growing]
    forces = forces[frames][growing]
    assert force[:, 2] == pytest.approx(WEIGHT_N + forces, rel=1e-3)
    assert moment[:, 1] == pytest.approx(-(0.5 * WEIGHT_N + 1.0 * forces), rel=1e-3)
    assert moment[:, 0] == pytest.approx(0.25 * forces, rel=1e-3, abs=1e-3 * WEIGHT_N)


def test_a_load_wakes_what_sleeps_and_is_shared_out_by_mass(blender, tmp_path):
    """Two blocks in the air that start deactivated fall from when the load begins, as one: a = g + F / (m₁ + m₂)."""
    blocks = Blocks()
    pair = [blocks.block((2.0 * number, 0, 100), MASS_KG * (number + 1)) for number in range(2)]
    for block in pair:
        mark_member(block, "pair", "pair")
        block.rigid_body.use_deactivation = block.rigid_body.use_start_deactivated = True
    keep_tables(blocks.scene, "loads", [Load(members=("pair",), times_s=(0.5,), forces_n=(3.0 * WEIGHT_N,))])
    frames = blocks.play(tmp_path, 24).frames
    assert not frames.velocities_m_s[frames.time_s < 0.49].any()
    fallen_s = frames.time_s[-1] - 0.5
    assert frames.velocities_m_s[-1, :, 2] == pytest.approx(-2.0 * STANDARD_GRAVITY_M_S2 * fallen_s, rel=0.01)


def test_what_is_removed_takes_its_part_of_the_load_along(blender, tmp_path):
    blocks = Blocks()
    blocks.block((0, 0, -0.5), size_m=(20, 20, 1))
    for number in range(2):
        mark_member(blocks.block((3.0 * number, 0, 0.5), MASS_KG), f"block {number}", "block")
    keep_tables(blocks.scene, "loads", [Load(members=("block",), times_s=(0,), forces_n=(2.0 * WEIGHT_N,))])
    keep_tables(blocks.scene, "changes", [Removal(time_s=0.5, members=("block 1",))])
    frames = blocks.play(tmp_path, 24).frames
    for row, borne_n in ((np.flatnonzero(frames.time_s < 0.49)[-1], 4.0 * WEIGHT_N), (-1, 2.0 * WEIGHT_N)):
        assert frames.loads.body_forces_n[row, 0, 2] == pytest.approx(-borne_n, rel=0.01)


def test_loads_are_kept_with_the_scene_and_refused_where_nothing_bears_them(blender, tmp_path):
    blocks = Blocks()
    blocks.block((0, 0, 5), MASS_KG)
    load = Load(members=("pier",), times_s=(0, 1), forces_n=(0, 1))
    keep_tables(blocks.scene, "loads", [load])
    assert run_tables_of(blocks.scene, "loads") == (load,)
    with pytest.raises(ScenarioError, match=r'loads\.members names "pier"'):
        blocks.play(tmp_path, 2)
    keep_tables(blocks.scene, "loads", [])
    assert run_tables_of(blocks.scene, "loads") == ()


def test_a_run_with_loads_is_refused_where_memory_is_not_as_expected(blender, tmp_path, monkeypatch):
    blocks = Blocks()
    blocks.block((0, 0, 5), MASS_KG)
    keep_tables(blocks.scene, "loads", [Load(point_m=(0, 0, 5), times_s=(0,), forces_n=(1,))])
    right = layout.platform_layout()
    monkeypatch.setattr(layout, "SYSTEM_V", replace(right, body=replace(right.body, friction=right.body.friction + 8)))
    monkeypatch.setattr(layout, "MICROSOFT", layout.SYSTEM_V)
    with pytest.raises(SimulationError, match="loads need Blender's memory"):
        blocks.play(tmp_path, 2)
