# SPDX-License-Identifier: GPL-3.0-or-later
"""A run ends once everything rests, if it is asked to."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario import Removal

SMALL = replace(
    I235, ball=None, fracture=replace(I235.fracture, shards=12), removals=[Removal(time_s=0.5, members=["pier"])]
)


def run(scenario, folder):
    from bridge_demolition_addon.simulation.run import run_scenario

    return run_scenario(scenario, folder, overwrite=False, pictures=False, progress=Silence())


def test_run_stops_at_rest_and_the_scene_with_it(blender, tmp_path):
    time = replace(I235.time, duration_s=30.0, stop_at_rest=True)
    summary = run(replace(SMALL, time=time), tmp_path / "run")
    results = load_results(tmp_path / "run" / "results.npz")
    rest_s = summary["came_to_rest_s"]
    # The deck falls by about 5 m, for 1 s, and is quiet some time later.
    assert 1.5 < rest_s < 20.0
    assert summary["completed"]
    assert summary["simulated_s"] == pytest.approx(rest_s + 1.0, abs=time.step.frame_s)
    rested = results.frames.time_s > rest_s + 1e-6
    moves_m = np.diff(results.frames.positions_m[results.frames.time_s > rest_s - 1e-6], axis=0)
    speeds = np.linalg.norm(moves_m, axis=2) * ~results.frames.asleep[rested] / time.step.frame_s
    masses_kg = results.inventory.masses_kg
    assert ((speeds**2 * masses_kg).sum(axis=1) / masses_kg.sum()).max() < 1.01 * time.rest_speed_m_s**2
    assert summary["moving_at_end"] is None
    blender.ops.wm.open_mainfile(filepath=str(tmp_path / "run" / "scene.blend"))
    assert blender.context.scene.frame_end == results.frames.number[-1]


def test_run_goes_on_to_its_end_where_it_is_not_asked_to_stop(blender, tmp_path):
    time = replace(I235.time, duration_s=3.0, stop_at_rest=False)
    summary = run(replace(SMALL, time=time, removals=()), tmp_path / "run")
    assert summary["stability"]["verdict"] == "unknown" and summary["stability"]["is_asleep"]
    assert summary["simulated_s"] == pytest.approx(3.0)
    assert summary["came_to_rest_s"] == 0.0  # it sleeps from the beginning
