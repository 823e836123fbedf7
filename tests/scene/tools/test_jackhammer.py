# SPDX-License-Identifier: GPL-3.0-or-later
"""A jackhammer goes where it is led, and takes out of a slab what is under it and nothing else."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235
from support.shard_scenes import ShardScene

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.timing.timeline import Timeline
from bridge_demolition_addon.model.bridge import deck_top
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario import Jackhammer
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

HAMMER = Jackhammer(
    start_time_s=0.5,
    end_time_s=2.5,
    path_m=[(1.0, -0.5), (2.0, 0.5)],
    speed_m_s=0.8,
    blows_per_second=6.0,
    stroke_m=0.5,
    depth_m=0.3,
)
SLAB_M = (8.0, 4.0, 0.25)
TOP_M = 5.0


def from_path(points_m):
    """Distance in plan (k,) of points (k, 3) from the path of the hammer."""
    first, last = np.array(HAMMER.path_m)
    way = last - first
    share = np.clip((points_m[:, :2] - first) @ way / (way @ way), 0.0, 1.0)
    return np.linalg.norm(points_m[:, :2] - first - share[:, None] * way, axis=1)


@pytest.fixture(scope="module")
def slab(tmp_path_factory):
    """A slab that is held along its two ends, under a jackhammer: what was recorded."""
    import bpy

    from bridge_demolition_addon.scene.tools.build_site import BuildSite
    from bridge_demolition_addon.scene.tools.jackhammer import create_jackhammer

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = ShardScene(
        SLAB_M,
        (0.0, 0.0, TOP_M - SLAB_M[2] / 2.0),
        200,
        {"solver_iterations": 100},
        breaking_force_newton=float(__import__("os").environ.get("BF", "60e3")),
    )
    scene.hold(abs(scene.fracture.centres[:, 0]) > 3.6)
    world = scene.scene.rigidbody_world
    create_jackhammer(BuildSite(world, Timeline.of(1.0 / 24.0, 8.0), lambda _: TOP_M, I235.surface_of), HAMMER)
    recording = Recording(scene.scene, tmp_path_factory.mktemp("slab"))
    start_recording(recording)
    for frame in range(1, 85):
        scene.scene.frame_set(frame)
    stop_recording()
    assert recording.error is None
    return recording.results()


@pytest.mark.long
def test_jackhammer_removes_material_where_it_is_driven(slab):
    assert slab.frames.intact[slab.frames.time_s < HAMMER.start_time_s].all()
    shards = slab.inventory.of_kind("shard")
    fallen = slab.frames.positions_m[0, shards, 2] - slab.frames.positions_m[-1, shards, 2] > 1.0
    distances = from_path(slab.frames.positions_m[0, shards])
    # Shards are √(8 × 4 / 200) = 0.4 m wide. Of those that the chisel meets within half of that, over 20 draws of the
    # slab 0.33 to 1 fall; some hold on between others, or the slab breaks off beside them.
    assert fallen[distances < HAMMER.diameter_m / 2.0 + 0.2].mean() > 0.2
    # 2.5 m from the path and more, 0.83 to 1 of the connections hold.
    assert slab.frames.intact[-1][slab.inventory.points_m[:, 0] < -1.5].mean() > 0.7


@pytest.mark.long
def test_chisel_is_where_it_is_led(slab):
    (tool,) = slab.inventory.of_kind("tool")
    np.testing.assert_allclose(
        slab.frames.positions_m[:, tool], HAMMER.tip_positions(TOP_M, slab.frames.time_s), atol=1e-4
    )
    heights = slab.frames.positions_m[:, tool, 2]
    assert heights.min() == pytest.approx(TOP_M - HAMMER.depth_m, abs=1e-4)
    # At 24 frames and 6 blows a second, frames are chords of the cosine.
    assert abs(slab.frames.velocities_m_s[:, tool]).max() <= HAMMER.largest_speed_m_s * (1.0 + 1e-3)


def test_scenario_with_a_jackhammer(tmp_path):
    from bridge_demolition_addon.simulation.run import run_scenario

    hammer = replace(HAMMER, path_m=[(6.0, 0.0)], start_time_s=0.2, end_time_s=0.9)
    scenario = replace(I235, ball=None, jackhammers=[hammer], time=replace(I235.time, duration_s=1.0))
    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    assert summary["connections"]["broken"] > 0
    results = load_results(tmp_path / "run" / "results.npz")
    (tool,) = results.inventory.of_kind("tool")
    np.testing.assert_allclose(
        results.frames.positions_m[:, tool],
        hammer.tip_positions(deck_top(scenario.bridge), results.frames.time_s),
        atol=1e-4,
    )
    assert results.frames.intact[results.frames.time_s < 0.19].all()
