# SPDX-License-Identifier: GPL-3.0-or-later
"""A pier on soil, in Blender's own simulation: it settles, lifts its heel and sinks as statics says."""

import numpy as np
import pytest

from bridge_demolition_addon.charts.style import blank_figure
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.report.document.blocks import DataTable, Picture
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.ground_motion import motion_section
from bridge_demolition_addon.simulation.run import run_scenario

SIZE_M = np.array([2.0, 3.0, 6.0])
AREA_M2 = 6.0
WEIGHT_N = 2400.0 * SIZE_M.prod() * STANDARD_GRAVITY_M_S2
STIFFNESS_N_M3 = 200e6

PIER = """
[scenario]
title = "a pier on soil"

[time]
duration_s = {duration_s}
frames_per_second = 24
substeps_per_frame = 10

[[geometry]]
name = "pier"
file = "pier.obj"
density_kg_m3 = 2400.0

[fracture]
shards = 2

[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete column"
stiffness = "elastic"

[shards]
linear_damping = 0.0
angular_damping = 0.0
start_deactivated = false
use_deactivation = false

[[foundations]]
member = "pier"
stiffness_mn_m3 = 200.0
friction = 0.9
{more}
"""


@pytest.fixture
def run(blender, tmp_path):
    import trimesh

    mesh = trimesh.creation.box(SIZE_M)
    mesh.apply_translation((0.0, 0.0, SIZE_M[2] / 2.0))
    mesh.export(tmp_path / "pier.obj")

    def ran(duration_s, more=""):
        path = tmp_path / "pier.toml"
        path.write_text(PIER.format(duration_s=duration_s, more=more), encoding="utf-8")
        summary = run_scenario(
            read_scenario(path), tmp_path / "run", overwrite=True, pictures=False, progress=Silence()
        )
        return load_results(tmp_path / "run" / "results.npz"), summary

    return ran


def lowest(results):
    shards = results.inventory.of_kind("shard")
    return shards[results.frames.positions_m[0, shards, 2].argmin()]


def test_a_pier_settles_by_its_weight_over_stiffness_and_is_whole(run):
    """W / (k A); the shard at the bottom is shortened by some micrometres besides. It rests from the first frame on."""
    results, summary = run(0.2)
    shard = lowest(results)
    settled = results.frames.positions_m[0, shard, 2] - results.frames.positions_m[1:, shard, 2]
    assert settled == pytest.approx(np.full(len(settled), WEIGHT_N / (STIFFNESS_N_M3 * AREA_M2)), rel=0.005)
    assert results.frames.intact.all()
    (footing,) = summary["foundations"]
    assert footing["member"] == "pier"
    assert footing["settled_m"] == pytest.approx(WEIGHT_N / (STIFFNESS_N_M3 * AREA_M2), rel=0.005)
    assert abs(footing["tilt_rad"]) < 1e-5


def test_soil_that_bears_less_than_the_weight_lets_it_sink(run):
    """What is not borne accelerates it: a tenth of the weight, g t² / 20 below where the soil yields all over."""
    results, _ = run(0.5, f"capacity_kpa = {0.9 * WEIGHT_N / AREA_M2 / 1e3}")
    shard = lowest(results)
    sunk = results.frames.positions_m[0, shard, 2] - results.frames.positions_m[-1, shard, 2]
    expected = WEIGHT_N / (STIFFNESS_N_M3 * AREA_M2) + 0.05 * STANDARD_GRAVITY_M_S2 * results.frames.time_s[-1] ** 2
    assert sunk == pytest.approx(expected, rel=0.02)


def test_on_ground_that_is_accelerated_the_heel_lifts_off_as_winkler_has_it(run, tmp_path):
    """The ground's acceleration grows slowly to g / 6: the weight acts e = 0.5 m from the middle of a footing of 2 m,
    and c = 3 (1 m - e) of it are pressed, by up to p = 2 W / (c 3 m). The pier turns by p / (k c). 5 %: places in place
    of a continuous bed 1.6 %, its weight that leans 1.5 %, and that it rocks about that."""
    times = np.linspace(0.0, 6.0, 601)
    grows = 0.5 - 0.5 * np.cos(np.pi * np.clip(times / 1.2, 0.0, 1.0))
    rising = grows * np.interp(times, [2.2, 2.5], [1.0, 0.0])
    falling = np.interp(times, [2.5, 2.8, 4.0, 4.3], [0.0, 1.0, 1.0, 0.0])
    values = STANDARD_GRAVITY_M_S2 / 6.0 * (rising - falling * rising.sum() / falling.sum())
    np.savetxt(tmp_path / "ramp.csv", np.column_stack((times, values)), delimiter=",")
    motion = '[ground_motion]\nfile = "ramp.csv"\nunit = "m/s2"\ndirections = ["along"]\nbaseline = "none"\n'
    results, _ = run(1.8, motion)
    turns = -results.frames.rotations[:, lowest(results), 0, 2]
    pressed_m = 1.5
    expected = 2.0 * WEIGHT_N / (pressed_m * 3.0) / (STIFFNESS_N_M3 * pressed_m)
    late = results.frames.time_s > 1.25
    assert turns[late].mean() == pytest.approx(expected, rel=0.05)
    # A footing that is held down would turn by 16 % less.
    section = motion_section(read_run(tmp_path / "run"))
    peaks, settled = (block for block in section.blocks if isinstance(block, DataTable))
    assert [row[0] for row in peaks.rows] == ["along"]
    assert peaks.rows[0][1] == pytest.approx(abs(values).max(), rel=1e-6)
    assert settled.rows[0][0] == "pier" and settled.rows[0][4] == pytest.approx(1e3 * expected, rel=0.2)
    figure = blank_figure(6.0, 8.0)
    for part, block in zip(figure.subfigures(2, 1), (b for b in section.blocks if isinstance(b, Picture)), strict=True):
        block.draw(part)
