# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks that fall into beds, in Blender's own simulation, against the formula of ASTRA 12006 and its energy."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.debris.touchdown import landings, shaking_at
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.fall_beds import FallBed
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.simulation.run import run_scenario

SCENARIO = """
[scenario]
title = "a block that falls into gravel"
[time]
duration_s = 3.0
frames_per_second = 48
substeps_per_frame = 40
[[geometry]]
name = "block"
file = "block.obj"
position_m = [0.0, 0.0, {height_m}]
density_kg_m3 = 2500.0
velocity_m_s = [{along_m_s}, 0.0, 0.0]
[fracture]
shards = 1
[connections]
type = "FIXED"
breaking_force_n = 1e12
method = "face"
[shards]
linear_damping = 0.0
angular_damping = 0.0
start_deactivated = false
{bed}
"""
GRAVEL = """
[[fall_beds]]
name = "gravel"
corners_m = [[-9, -9], [30, -9], [30, 9], [-9, 9]]
thickness_m = {thickness_m}
modulus_kpa = {modulus_kpa}
vibration_factor = 0.4
"""
SIDES_M = (2.0, 1.6, 1.0)


@pytest.fixture
def fall(blender, tmp_path):
    import trimesh

    def fallen(bed=GRAVEL, *, thickness_m=2.0, modulus_kpa=10000, height_m=6.5, along_m_s=0.0, is_ball=False):
        shape = trimesh.creation.icosphere(4, 0.5) if is_ball else trimesh.creation.box(SIDES_M)
        shape.export(tmp_path / "block.obj")
        path = tmp_path / "scenario.toml"
        filled = bed.format(thickness_m=thickness_m, modulus_kpa=modulus_kpa)
        path.write_text(SCENARIO.format(bed=filled, height_m=height_m, along_m_s=along_m_s), encoding="utf-8")
        scenario = read_scenario(path)
        run_scenario(scenario, tmp_path / "run", overwrite=True, pictures=False, progress=Silence())
        return load_results(tmp_path / "run" / "results.npz"), scenario

    return fallen


def by_hand(fall_m, thickness_m, modulus_kpa=10000):
    """Depth and largest force of a block of 8 t: F = 2.8 t^-0.5 r^0.7 M_E^0.4 tan φ E^0.6 in kN, and d = m v² / F."""
    volume = math.prod(SIDES_M)
    energy_kj = 2.5 * volume * STANDARD_GRAVITY_M_S2 * fall_m
    radius = (3 * volume / (4 * math.pi)) ** (1 / 3)
    force_kn = 2.8 * thickness_m**-0.5 * radius**0.7 * modulus_kpa**0.4 * math.tan(math.radians(35)) * energy_kj**0.6
    return 2 * energy_kj / force_kn, 1e3 * force_kn


def test_it_sinks_as_deep_as_the_formula_says_and_stays(fall):
    results, _ = fall()
    heights = results.frames.positions_m[:, results.inventory.of_kind("shard")[0], 2]
    depth, _ = by_hand(6.0 - 2.0, 2.0)
    # Its underside was 6 m high. A sub-step of 0.5 ms in which it moves by 5 mm decides where its resistance begins.
    assert 2.0 - (heights[-1] - 0.5) == pytest.approx(depth, abs=0.02)
    assert np.ptp(heights[-24:]) < 1e-3


def test_what_a_thin_bed_cannot_stop_lands_below_it_with_what_is_left(fall):
    """Of the energy m g h the bed takes half of its force over its thickness: v² = 2 g h - F t / m at its base."""
    results, _ = fall(thickness_m=0.25, modulus_kpa=1000, height_m=8.5)
    shard = results.inventory.of_kind("shard")[0]
    heights, speeds = results.frames.positions_m[:, shard, 2] - 0.5, -results.frames.velocities_m_s[:, shard, 2]
    _, force = by_hand(8.0 - 0.25, 0.25, 1000)
    left = 2 * STANDARD_GRAVITY_M_S2 * (8.0 - 0.25) - force * 0.25 / 8000
    assert left > 0.0
    inside = np.flatnonzero((heights < 0.25) & (heights > 0.01) & (speeds > 1.0))
    for row in inside:
        sunk = 0.25 - heights[row]
        expected = 2 * STANDARD_GRAVITY_M_S2 * (8.0 - 0.25) - force * sunk / 8000
        assert speeds[row] ** 2 == pytest.approx(expected, rel=0.03)
    assert len(inside)
    assert heights[-1] == pytest.approx(0.0, abs=0.02)


def test_a_ball_that_rolls_on_over_bare_ground_stays_where_it_falls_into_a_bed(fall):
    moving = {"height_m": 3.5, "along_m_s": 6.0, "is_ball": True}
    (in_bed, _), (bare, _) = fall(thickness_m=1.0, **moving), fall("", **moving)
    places = [run.frames.positions_m[:, run.inventory.of_kind("shard")[0], 0] for run in (in_bed, bare)]
    flight = 6.0 * math.sqrt(2 * 2.0 / STANDARD_GRAVITY_M_S2)
    assert places[0][-1] == pytest.approx(flight, abs=0.5)
    assert np.ptp(places[0][-24:]) < 1e-3
    assert places[1][-1] > flight + 6.0


def test_the_ground_shakes_less_by_the_factor_that_is_given(fall):
    results, scenario = fall()
    with_bed = shaking_at((60.0, 0.0, 0.0), landings(results, scenario.fall_beds))
    without = shaking_at((60.0, 0.0, 0.0), landings(results))
    assert with_bed.velocity_m_s == pytest.approx(0.4 * without.velocity_m_s, rel=1e-12)
    assert with_bed.at_most_m_s == pytest.approx(0.4 * without.at_most_m_s, rel=1e-12)


def test_what_cannot_be_a_bed_is_refused():
    bed = {"name": "gravel", "corners_m": [[0, 0], [5, 0], [5, 5]], "thickness_m": 1.0, "modulus_kpa": 1e4}
    with pytest.raises(ScenarioError, match=r"fall_beds\.corners_m"):
        FallBed(**bed | {"corners_m": [[0, 0], [5, 0]]})
    with pytest.raises(ScenarioError, match=r"fall_beds\.vibration_factor is 1.5"):
        FallBed(**bed, vibration_factor=1.5)
    with pytest.raises(ScenarioError, match=r"fall_beds\.modulus_kpa is 0.0"):
        FallBed(**bed | {"modulus_kpa": 0.0})
