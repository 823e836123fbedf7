# SPDX-License-Identifier: GPL-3.0-or-later
"""Warm-up: nothing breaks while a structure settles, and with damping it is at rest afterwards."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235
from support.shard_scenes import ShardScene

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.results.summary import settling
from bridge_demolition_addon.scene.connections.constraints import Breaking, breaking_of
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

WARM_UP_S = 1.0


def beam(folder, damping):
    """A beam of 12 m that is held at its ends, let go and followed for 2 s."""
    breaking = Breaking(warm_up_s=WARM_UP_S, warm_up_damping=damping)
    scene = ShardScene((12.0, 1.0, 0.4), (0.0, 0.0, 5.0), 60, {"solver_iterations": 20}, breaking=breaking)
    assert breaking_of(scene.scene) == breaking
    ends = np.array([abs(shard.vertices[:, 0]).max() for shard in scene.fracture.shards])
    scene.hold(ends > 6.0 - 1e-6)
    recording = Recording(scene.scene, folder)
    start_recording(recording)
    for frame in range(1, 51):
        scene.scene.frame_set(frame)
    stop_recording()
    assert recording.error is None
    return recording.results()


def test_beam_is_at_rest_after_a_damped_warm_up(blender, tmp_path):
    damped = beam(tmp_path, 0.9999)
    settled = settling(damped, WARM_UP_S)
    assert settled["time_s"] == pytest.approx(WARM_UP_S, abs=1 / 24)
    # Over 20 draws 0.00 to 0.07 m/s: single shards tremble, as the solver does not find its end.
    assert settled["largest_speed_m_s"] < 0.15
    # It has settled where it stays: without damping it sags no further, by 0.2 % over 20 draws.
    end = np.flatnonzero(damped.frames.time_s >= settled["time_s"])[0]
    sag = (damped.frames.positions_m[0] - damped.frames.positions_m)[:, :, 2].max(axis=1)
    assert sag[end] == pytest.approx(sag[-1], rel=0.01)


def test_damping_is_a_share_of_the_velocity_in_a_second(blender, tmp_path):
    """A free fall with v' = g - c v, where 1 - d = exp(-c): v = g / c (1 - exp(-c t)); then with g alone."""
    damping = 0.9
    scene = ShardScene((1, 1, 1), (0, 0, 100), 1, {}, breaking=Breaking(warm_up_s=WARM_UP_S, warm_up_damping=damping))
    scene.shards[0].rigid_body.linear_damping = 0.0
    recording = Recording(scene.scene, tmp_path)
    start_recording(recording)
    for frame in range(1, 51):
        scene.scene.frame_set(frame)
    stop_recording()
    results = recording.results()
    rate = -np.log(1.0 - damping)
    end = int(np.flatnonzero(results.frames.time_s >= WARM_UP_S - 1e-6)[0])
    expected = STANDARD_GRAVITY_M_S2 / rate * (1.0 - np.exp(-rate * WARM_UP_S))
    # One sub-step of 1/240 s and its gravity are the error of steps.
    assert -results.frames.velocities_m_s[end, 0, 2] == pytest.approx(expected, rel=0.01)
    fall = results.frames.velocities_m_s[end, 0, 2] - results.frames.velocities_m_s[-1, 0, 2]
    assert fall == pytest.approx(
        STANDARD_GRAVITY_M_S2 * (results.frames.time_s[-1] - results.frames.time_s[end]), rel=0.01
    )


@pytest.mark.long
def test_summary_says_how_quiet_the_bridge_is_after_its_warm_up(tmp_path):
    from bridge_demolition_addon.simulation.run import run_scenario

    awake = replace(I235.shards, start_deactivated=False, use_deactivation=False)
    connections = replace(I235.connections, warm_up_s=0.5, warm_up_damping=0.999)
    scenario = replace(I235, ball=None, shards=awake, connections=connections, time=replace(I235.time, duration_s=0.6))
    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    assert summary["settled"]["time_s"] == pytest.approx(0.5, abs=1 / 24)
    assert 0.0 < summary["settled"]["largest_speed_m_s"] < 0.5


def test_damping_without_a_warm_up_is_refused():
    with pytest.raises(
        ScenarioError, match=r"connections.warm_up_damping is 0.5: expected 0 where connections.warm_up"
    ):
        replace(I235.connections, warm_up_damping=0.5)
