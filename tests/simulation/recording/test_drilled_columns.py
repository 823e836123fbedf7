# SPDX-License-Identifier: GPL-3.0-or-later
"""A column under 500 kN with drill holes: it stands with little explosive, and falls freely with enough."""

from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks
from support.drilled_columns import ZONE, column_model, column_scenario
from support.long_cases import long_but

from bridge_demolition_addon.bullet import layout
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.changes.zone_firings import ZoneFiring
from bridge_demolition_addon.model.results.energy import throws_of
from bridge_demolition_addon.model.scenario import MemberCut
from bridge_demolition_addon.scene.bodies import mark_member
from bridge_demolition_addon.scene.custom_properties import keep_tables, run_tables_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.removal import remove_demolition

WEIGHT_N = 100.0 * STANDARD_GRAVITY_M_S2
FIRED_S = 0.301
"""A millisecond after the detonation."""


def run(folder, zone, shards=40, duration_s=0.65):
    """Times and heights of the block on the column (k,), and the summary of a run."""
    from bridge_demolition_addon.simulation.motion_run import motion_run

    scenario = column_scenario(folder, zone, shards=shards)
    scenario = replace(scenario, time=replace(scenario.time, duration_s=duration_s))
    with motion_run(scenario, column_model(scenario), folder) as (results, summary):
        block = results.inventory.body_members == "block"
        masses = results.inventory.masses_kg[block]
        heights = (results.frames.positions_m[:, block, 2] * masses).sum(axis=1) / masses.sum()
        return results.frames.time_s.copy(), heights, summary, results


def test_it_stands_with_a_tenth_of_a_kilogram_a_cubic_metre(tmp_path):
    times, heights, summary, _ = run(tmp_path, replace(ZONE, charge_g=7.35))
    assert times[-1] == pytest.approx(0.65, abs=1.0 / 24.0)
    assert abs(heights - heights[0]).max() < 1e-3
    assert summary["events"] == []
    assert summary["connections"]["broken"] == 0


@pytest.mark.parametrize("shards", long_but([6, 40], [6, 40, 120]))
@pytest.mark.parametrize("debris", ["rubble", "thrown"])
def test_it_falls_freely_with_a_kilogram_a_cubic_metre(tmp_path, debris, shards):
    """0.3 m in 0.25 s by g t² / 2, within 10 %, whatever the number of shards: nothing in the zone carries."""
    times, heights, summary, _ = run(tmp_path, replace(ZONE, debris=debris), shards)
    assert abs(heights[times < 0.3] - heights[0]).max() < 1e-3
    falls_s = times - FIRED_S
    during = (falls_s > 0.1) & (falls_s < 0.3)
    expected = STANDARD_GRAVITY_M_S2 * falls_s[during] ** 2 / 2.0
    np.testing.assert_allclose(heights[0] - heights[during], expected, rtol=0.1)
    fallen = np.interp(FIRED_S + 0.25, times, heights[0] - heights)
    assert fallen == pytest.approx(0.3065, rel=0.1)
    (event,) = summary["events"]
    assert (event["kind"], event["zone"], event["effect"]) == ("blast zone", "zone", "thrown out")


LOAD_N = 500e3 + 0.49 * 1.75 * 2400.0 * STANDARD_GRAVITY_M_S2
"""The block, and the column above the zone."""


@pytest.mark.long
@pytest.mark.parametrize("shards", [40, 120])
def test_bars_hold_what_they_resist_twice(tmp_path, shards):
    """8 bars of 25 mm over 0.9 m resist 1.5 MN without a bow; 520 kN that come at once press with 1.04 MN at most."""
    zone = replace(ZONE, height_m=0.9, holes_a_row=3, bars=8, bar_diameter_mm=25.0)
    _, heights, summary, _ = run(tmp_path, zone, shards, duration_s=0.8)
    (event,) = summary["events"]
    assert event["effect"] == "thrown out"
    assert LOAD_N < event["cage_pressed_n"] < 2.05 * LOAD_N
    assert event["cage_folded_m"] < 1e-6
    # N l / (E A) = 0.60 mm, and as much again on the way.
    assert 0.4e-3 < heights[0] - heights[-1] < 1.6e-3


def fall_on_bars_m(mass_kg, count, diameter_m, bared_m, until_s):
    """Fall of a mass on bars that were bared at once, by a step of 10 µs: they are elastic, buckle, and fold.

    A bar of length l in three hinges, whose ends are closer by u, has a bow w = √(u (2 l - u)) / 2, and N w = 2 M_p
    with M_p = f_y d³ / 6, less by the force itself.
    """
    modulus_pa, yield_pa, area_m2 = 200e9, 500e6, np.pi * diameter_m**2 / 4.0
    euler_n = np.pi**2 * modulus_pa * np.pi * diameter_m**4 / 64.0 / (0.5 * bared_m) ** 2
    plastic_nm, squash_n, stiffness = yield_pa * diameter_m**3 / 6.0, yield_pa * area_m2, modulus_pa * area_m2 / bared_m
    fallen, speed, folded, step_s = 0.0, 0.0, 0.0, 1e-5
    for _ in range(round(until_s / step_s)):
        bow = np.sqrt(folded * (2.0 * bared_m - folded)) / 2.0
        # 2 M_p (1 - n²) = n N_p w
        arm = 2.0 * plastic_nm / squash_n
        share = (np.sqrt(bow**2 + 4.0 * arm**2) - bow) / (2.0 * arm)
        most = min(euler_n, share * squash_n)
        folded = max(folded, fallen - most / stiffness)
        force = count * min(stiffness * (fallen - folded), most)
        speed += step_s * (STANDARD_GRAVITY_M_S2 - force / mass_kg)
        fallen += step_s * speed
    return fallen


@pytest.mark.long
@pytest.mark.parametrize("shards", [40, 120])
def test_bars_that_hold_the_column_at_rest_fold_where_it_comes_upon_them_at_once(tmp_path, shards):
    """Over 1.5 m they resist 538 kN without a bow: more than 520 kN, and less than twice that."""
    times, heights, summary, _ = run(tmp_path, replace(ZONE, bars=8, bar_diameter_mm=25.0), shards, 0.85)
    (event,) = summary["events"]
    assert event["cage_pressed_n"] == pytest.approx(538.3e3, rel=0.01)
    assert event["cage_folded_m"] > 0.5
    for after_s in (0.3, 0.4, 0.5):
        fallen = np.interp(event["time_s"] + after_s, times, heights[0] - heights)
        expected = fall_on_bars_m(LOAD_N / STANDARD_GRAVITY_M_S2, 8, 0.025, 1.5, after_s)
        assert fallen == pytest.approx(expected, rel=0.12)


def test_thin_bars_hardly_slow_it_down(tmp_path):
    """4 bars of 12 mm resist 14 kN of 520 kN without a bow: 0.3 m in 0.25 s within 10 %.

    By curve c, λ 3.979 and χ 0.0562, they may be counted on for 12.7 kN.
    """
    times, heights, summary, _ = run(tmp_path, replace(ZONE, bars=4, bar_diameter_mm=12.0))
    assert summary["events"][0]["cage_compression_n"] == pytest.approx(12.7e3, rel=0.01)
    assert np.interp(FIRED_S + 0.25, times, heights[0] - heights) == pytest.approx(0.3065, rel=0.1)


def test_bars_carry_nothing_between_rigid_connections(tmp_path):
    from bridge_demolition_addon.simulation.motion_run import motion_run

    zone = replace(ZONE, height_m=0.9, holes_a_row=3, bars=8, bar_diameter_mm=25.0)
    scenario = column_scenario(tmp_path, zone)
    scenario = replace(scenario, connections=replace(scenario.connections, stiffness="rigid"))
    with motion_run(scenario, column_model(scenario), tmp_path) as (results, summary):
        block = results.inventory.body_members == "block"
        heights = results.frames.positions_m[:, block, 2].mean(axis=1)
    assert heights[0] - heights[-1] > 0.5
    assert "cage_pressed_n" not in summary["events"][0]


@pytest.mark.long
def test_what_is_thrown_flies_and_rubble_stays_at_the_foot(tmp_path):
    reached = {}
    for debris in ("rubble", "thrown"):
        folder = tmp_path / debris
        folder.mkdir()
        *_, summary, results = run(folder, replace(ZONE, debris=debris), duration_s=1.0)
        names = summary["events"][0]["shards"]
        rows = np.isin(results.inventory.body_names, names)
        reached[debris] = np.hypot(*results.frames.positions_m[-1, rows, :2].T)
    # From 2.25 m at 1 m/s rubble flies 0.7 m once it is 0.35 m out of the section at most; 14 m/s are 7 at least.
    assert reached["rubble"].max() < 3.0
    assert reached["thrown"].min() > 3.0
    assert not throws_of(results).beyond_fall.any()  # the explosive threw them


def test_rubble_in_the_cage_stays_stacked(tmp_path):
    """Concrete that is broken but not thrown out goes on carrying by contact: no connection of it is left."""
    _, heights, summary, _ = run(tmp_path, replace(ZONE, charge_g=40.0), duration_s=1.0)
    assert heights[0] - heights[-1] < 0.3
    (event,) = summary["events"]
    assert event["effect"] == "rubble in the cage" and event["shards"] == [] and event["connections"] > 0


@pytest.mark.long
def test_loosened_concrete_carries_what_is_left(tmp_path):
    """Half of its strength in compression is far above 520 kN on 0.49 m²: 1.06 N/mm².

    With 34.1 g q is 0.464 kg/m³ of 0.465 that break it: hardly anything is left in tension, and of 35 N/mm² in
    compression half. As little as in tension would not carry it.
    """
    for charge_g in (25.0, 34.1):
        _, heights, summary, _ = run(tmp_path, replace(ZONE, charge_g=charge_g))
        assert abs(heights - heights[0]).max() < 2e-3
        (event,) = summary["events"]
        assert event["effect"] == "loosened" and event["shards"] == []


def test_a_misfire_does_nothing(tmp_path):
    _, heights, summary, _ = run(tmp_path, replace(ZONE, fires=False))
    assert summary["events"] == []
    assert abs(heights - heights[0]).max() < 1e-3


def firing(**values):
    """A zone of the height of a block, between two others."""
    return ZoneFiring(
        **{
            "time_s": 0.3,
            "members": ("pier",),
            "lowest_corner_m": (-0.5, -0.5, 1.0),
            "highest_corner_m": (0.5, 0.5, 2.0),
            "name": "zone",
            "along": "z",
            "effect": "thrown out",
            "left": 0.0,
            "speed_m_s": 0.0,
            "cage_tension_n": 0.0,
            "cage_compression_n": 0.0,
        }
        | values
    )


def tower(*, asleep=False):
    blocks = Blocks(solver_iterations=100)
    blocks.block((0, 0, -0.5), size_m=(40, 40, 1))
    stack = [blocks.block((0, 0, 0.5 + level), 100.0) for level in range(3)]
    for block in stack:
        mark_member(block, "pier", "pier")
        block.rigid_body.use_deactivation = block.rigid_body.use_start_deactivated = asleep
    return blocks, stack


@pytest.mark.parametrize("asleep", [False, True])
def test_a_block_that_is_thrown_carries_nothing_on_its_way_out(blender, tmp_path, asleep):
    """Loose blocks: the upper one falls through the middle one while that leaves, and none is flung."""
    blocks, _ = tower(asleep=asleep)
    keep_tables(blocks.scene, "changes", [firing()])
    results = blocks.play(tmp_path, 30)
    times, heights = results.frames.time_s, results.frames.positions_m[:, 1:, 2]
    substep = results.frames.substep_s[-1]
    # Frames after the one in which it happens; 1 m at 5 m/s.
    leaving = (times > 0.3 + 1.0 / 24.0) & (times < 0.3 + 1.0 / 5.0 - 0.02)
    assert leaving.any()
    np.testing.assert_allclose(heights[leaving, 1], 1.5, atol=0.01)
    falls_s = times[leaving] - 0.3 + substep
    np.testing.assert_allclose(heights[leaving, 2], 2.5 - STANDARD_GRAVITY_M_S2 * falls_s**2 / 2.0, atol=0.03)
    assert not results.frames.loads.body_peak_sums_n[leaving, 2].any()
    # At the end the upper one stands on the lowest, and the middle one lies beside them.
    assert heights[-1, 2] == pytest.approx(1.5, abs=0.02)
    assert heights[-1, 1] == pytest.approx(0.5, abs=0.05)
    assert np.hypot(*results.frames.positions_m[-1, 2, :2]) > 1.0
    speeds = np.linalg.norm(results.frames.velocities_m_s, axis=2)
    assert speeds.max() < 1.05 * np.hypot(5.0, np.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * 1.0))
    # The zone gave it 1 m/s sideways in all, and held it up against its weight for 0.2 s.
    impulse = results.frames.blast_impulses_ns.sum(axis=0)
    assert np.hypot(*impulse[2, :2]) == pytest.approx(100.0 * 1.0, rel=0.01)
    assert impulse[2, 2] == pytest.approx(WEIGHT_N * 0.2, rel=0.05)  # by a sub-step of 1/240 s
    assert not impulse[[0, 1, 3]].any()


def test_zones_are_kept_with_the_scene(blender):
    blocks, _ = tower()
    changes = [firing(), firing(name="other", effect="loosened", left=0.4, cage_compression_n=1.5e6)]
    keep_tables(blocks.scene, "changes", changes)
    assert run_tables_of(blocks.scene, "changes") == tuple(changes)


def test_zones_need_the_memory_of_blender(blender, tmp_path, monkeypatch):
    right = layout.platform_layout()
    monkeypatch.setattr(layout, "SYSTEM_V", replace(right, body=replace(right.body, friction=right.body.friction + 8)))
    monkeypatch.setattr(layout, "MICROSOFT", layout.SYSTEM_V)
    blocks, _ = tower()
    keep_tables(blocks.scene, "changes", [firing()])
    with pytest.raises(SimulationError, match="removals, saw cuts, weakenings and blast zones need Blender's memory"):
        blocks.play(tmp_path, 4)


def test_a_scene_that_is_built_keeps_its_zones_and_forgets_them_with_its_bodies(blender, tmp_path):
    scenario = column_scenario(tmp_path, replace(ZONE, bars=8, bar_diameter_mm=25.0))
    scene = blender.context.scene
    build_demolition(scene, scenario, column_model(scenario))
    (kept,) = run_tables_of(scene, "changes")
    assert (kept.name, kept.members, kept.time_s) == ("zone", ("column",), pytest.approx(FIRED_S))
    assert kept.cage_compression_n == pytest.approx(416.7e3, rel=1e-3)  # 8 × 0.2122 × 245.4 kN
    remove_demolition(scene)
    assert run_tables_of(scene, "changes") == ()


def test_a_severed_column_loses_its_bars_and_stands_on_its_cut_face(tmp_path):
    """Cut across a level plane, it goes on carrying by contact; all of its connections there are gone."""
    from bridge_demolition_addon.simulation.motion_run import motion_run

    scenario = column_scenario(tmp_path)
    scenario = replace(scenario, cuts=(MemberCut(member="column", position_m=3.0, mass_kg=2.0),))
    with motion_run(scenario, column_model(scenario), tmp_path) as (results, summary):
        block = results.inventory.body_members == "block"
        heights = results.frames.positions_m[:, block, 2].mean(axis=1)
    (event,) = summary["events"]
    assert event["kind"] == "severed member" and event["connections"] > 0 and event["shards"] == []
    assert heights[0] - heights[-1] < 0.05
