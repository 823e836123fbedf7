# SPDX-License-Identifier: GPL-3.0-or-later
"""Members that begin tilted, with a velocity or a spin, in Blender's own simulation, against ballistics."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.results.energy import throws_of
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.simulation.run import run_scenario

SCENARIO = """
[scenario]
title = "a block that flies"

[time]
duration_s = {duration_s}
frames_per_second = 24
substeps_per_frame = 20

[[geometry]]
name = "block"
file = "block.obj"
position_m = [0.0, 0.0, {height_m}]
density_kg_m3 = 1000.0
{more}

[fracture]
shards = {shards}

[connections]
type = "FIXED"
breaking_force_n = 1e12
method = "face"

[shards]
linear_damping = 0.0
angular_damping = 0.0
start_deactivated = {deactivated}
use_deactivation = {deactivated}
"""


@pytest.fixture
def write(tmp_path):
    import trimesh

    trimesh.creation.box((4.0, 1.0, 1.0)).export(tmp_path / "block.obj")

    def written(more, *, shards=1, deactivated="false", height_m=20.0, duration_s=0.5):
        path = tmp_path / "scenario.toml"
        values = {"shards": shards, "deactivated": deactivated, "height_m": height_m, "duration_s": duration_s}
        path.write_text(SCENARIO.format(more=more, **values), encoding="utf-8")
        return read_scenario(path)

    return written


def run(scenario, folder):
    run_scenario(scenario, folder / "run", overwrite=True, pictures=False, progress=Silence())
    return load_results(folder / "run" / "results.npz")


def test_a_velocity_carries_a_member_as_far_as_ballistics_say(blender, write, tmp_path):
    """x = v t, z = v t - g t² / 2. Bullet falls by half a sub-step too far: g t Δt / 2, here 5 mm."""
    results = run(write("velocity_m_s = [7.0, -3.0, 4.0]"), tmp_path)
    (shard,) = results.inventory.of_kind("shard")
    time_s = results.frames.time_s[-1]
    moved = results.frames.positions_m[-1, shard] - results.frames.positions_m[0, shard]
    expected = np.array([7.0, -3.0, 4.0]) * time_s - [0.0, 0.0, 0.5 * STANDARD_GRAVITY_M_S2 * time_s**2]
    assert moved == pytest.approx(expected, abs=0.006)


def test_a_block_tossed_as_far_as_its_speed_carries_it_is_no_doubtful_throw(blender, write, tmp_path):
    """At 45° from the ground, v = 10 m/s carries by v² / g = 10.2 m, in 1.44 s; its middle is only 0.51 m up."""
    speed = 10.0 * math.sqrt(0.5)
    thrown = run(write(f"velocity_m_s = [{speed}, 0.0, {speed}]", height_m=0.51, duration_s=1.44), tmp_path)
    throws = throws_of(thrown)
    assert throws.throws_m == pytest.approx([100.0 / STANDARD_GRAVITY_M_S2], abs=0.1)
    assert not throws.doubtful.any()


def test_a_spin_turns_a_member_of_many_shards_as_one(blender, write, tmp_path):
    """About its longest axis, which is a principal one: it turns evenly, and its middle falls straight down."""
    results = run(write("angular_velocity_rad_s = [3.0, 0.0, 0.0]", shards=8), tmp_path)
    shards = results.inventory.of_kind("shard")
    masses = results.inventory.masses_kg[shards]
    middle = np.average(results.frames.positions_m[:, shards], axis=1, weights=masses)
    assert np.abs(middle[:, :2]).max() < 1e-3
    turned = results.frames.rotations[-1, shards]
    angles = np.arctan2(turned[:, 2, 1], turned[:, 1, 1])
    assert angles == pytest.approx(3.0 * results.frames.time_s[-1], abs=0.01)


def test_tilts_turn_about_x_and_then_about_y(write):
    from bridge_demolition_addon.model.bridge.mesh_files import placed_mesh

    mesh = placed_mesh(write("tilt_deg = [90.0, 30.0]").geometry[0])
    # Its long side stays along x by the first turn, and points down by 30° after the second.
    along = np.array([math.cos(math.radians(30.0)), 0.0, -math.sin(math.radians(30.0))])
    assert np.ptp((mesh.vertices - [0.0, 0.0, 20.0]) @ along) == pytest.approx(4.0)


def test_what_starts_deactivated_cannot_begin_with_a_velocity(write):
    with pytest.raises(ScenarioError, match=r'geometry "block" begins with a velocity .*start_deactivated = false'):
        write("velocity_m_s = [1.0, 0.0, 0.0]", deactivated="true")
