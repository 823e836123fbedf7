# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball swings on its cable as a pendulum does, and hits what stands in its way."""

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks
from support.long_cases import long_but
from support.scenarios import I235
from support.terrain_files import EASTING, NORTHING, write_asc

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.timing.timeline import Timeline
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario import Ball, BallCable, ContactSettings, Ground
from bridge_demolition_addon.model.scenario.contacts import BallContact
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.sequence.ending import last_event_s

CABLE = BallCable(crane_point_m=(1.0, 2.0, 12.0), length_m=8.0, angle_degrees=40.0, azimuth_degrees=90.0)


def swinging(cable):
    return Ball(mass_kg=10_000, diameter_m=1.34, release_time_s=0.5, cable=cable)


def play_swing(cable, folder, seconds):
    from bridge_demolition_addon.scene.tools.ball import create_ball
    from bridge_demolition_addon.scene.tools.build_site import BuildSite

    blocks = Blocks()
    site = BuildSite(blocks.world, Timeline.of(blocks.time.step.frame_s, 10.0), lambda _: 0.0, I235.surface_of)
    create_ball(site, swinging(cable))
    return blocks.play(folder, round(24 * seconds))


@pytest.mark.parametrize("angle_degrees", long_but([40.0], [5.0, 40.0, 75.0]))
def test_swing_has_the_period_of_a_pendulum(blender, tmp_path, angle_degrees):
    cable = replace(CABLE, angle_degrees=angle_degrees)
    results = play_swing(cable, tmp_path, 9.5)
    (ball,) = results.inventory.of_kind("ball")
    aside = results.frames.positions_m[:, ball, 1] - 2.0
    assert np.abs(results.frames.positions_m[:, ball, 0] - 1.0).max() < 1e-3
    before = np.flatnonzero(np.diff(np.sign(aside)))
    crossings = (
        results.frames.time_s[before] - aside[before] * np.diff(results.frames.time_s)[before] / np.diff(aside)[before]
    )
    half = np.radians(angle_degrees) / 2.0
    # The series of the mathematical pendulum, to the ninth power of the angle (C. Huygens; Landau, Mechanics, § 11).
    series = sum(
        (np.prod(np.arange(1, 2 * n, 2)) / np.prod(np.arange(2, 2 * n + 1, 2))) ** 2 * np.sin(half) ** (2 * n)
        for n in range(1, 8)
    )
    period = 2.0 * np.pi * np.sqrt(8.0 / STANDARD_GRAVITY_M_S2) * (1.0 + series)
    assert len(crossings) >= 3
    np.testing.assert_allclose(2.0 * np.diff(crossings), period, rtol=0.01)
    # The solid ball turns with the cable, which is 0.14 % of its moment of inertia.
    assert cable.period_s(1.34) == pytest.approx(period, rel=0.0015)
    # At rest until it is let go, and then through its lowest point with v² = 2 g h, less what the steps cost.
    assert crossings[0] == pytest.approx(0.5 + cable.period_s(1.34) / 4.0, abs=1.5 / 24.0)
    assert np.linalg.norm(results.frames.velocities_m_s[:, ball], axis=1).max() == pytest.approx(
        np.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * 8.0 * (1.0 - np.cos(2.0 * half))), rel=0.01
    )
    lengths = np.linalg.norm(results.frames.positions_m[:, ball] - CABLE.crane_point_m, axis=1)
    assert np.ptp(lengths) < 0.03
    # It is no connection of the structure.
    assert len(results.inventory.connection_names) == 0


@pytest.mark.long
def test_ball_on_a_cable_knocks_a_pier_out(tmp_path):
    from bridge_demolition_addon.simulation.run import run_scenario

    # The first pier's columns are 0.7 m wide, at y = ±2.125 m: the ball comes along the road from x = -4 m.
    cable = BallCable(crane_point_m=(-1.3, 2.125, 13.0), length_m=10.5, angle_degrees=25.0, azimuth_degrees=180.0)
    ball = replace(I235.ball, target_m=None, drop_height_m=None, cable=cable)
    # Without friction on the ball, as its approach counts along the impulse.
    smooth = ContactSettings(ball=BallContact(friction=0.0))
    scenario = replace(I235, ball=ball, contacts=smooth, time=replace(I235.time, duration_s=3.0))
    assert scenario_from_text(scenario_text(scenario)) == scenario
    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run" / "results.npz")
    (row,) = results.inventory.of_kind("ball")
    # The ball's edge meets the column's face at x = -0.35 m, some way past its lowest point.
    met = results.frames.positions_m[np.flatnonzero(results.frames.number == summary["impact"]["frame"])[0], row]
    assert met[0] + 0.67 == pytest.approx(-0.35, abs=0.15)
    assert met[1] == pytest.approx(2.125, abs=0.05)
    hit = summary["hits_of_the_ball"][0]
    assert hit["approach_m_s"] == pytest.approx(cable.largest_speed_m_s, rel=0.05)
    assert results.frames.intact[results.frames.time_s < hit["time_s"] - 0.05].all()
    assert summary["connections"]["broken"] > 0
    assert summary["bodies"]["shard"] == 200


def test_facts_and_events_of_a_swing():
    ball = replace(I235.ball, target_m=None, drop_height_m=None, cable=CABLE)
    facts = dict(
        line.strip().split("  ", 1) for line in scenario_facts(replace(I235, ball=ball)) if "  " in line.strip()
    )
    # T₀ = 2 π √(8 m / g) = 5.675 s, for 40° 3.13 % more, for the ball's own size 0.14 % more.
    assert facts["swing to and fro"].strip().startswith("5.861 s, at its lowest (1.00, 2.00, 4.00) m at 1.965 s")
    # 8 m (1 - cos 40°) = 1.872 m: √(2 g h) = 6.06 m/s.
    assert facts["largest speed"].strip() == "6.06 m/s"
    assert last_event_s(replace(I235, ball=ball)) == 0.5


@pytest.mark.parametrize(
    "values, text",
    [
        ({}, r"ball.target_m is given together with ball.cable: expected one of the two"),
        ({"target_m": None}, r"ball.drop_height_m is given together with ball.cable"),
        (
            {"target_m": None, "cable": None},
            r"ball.target_m is missing: expected a list of 2 numbers \(m\), or a table",
        ),
        (
            {"drop_height_m": None, "cable": None},
            r"ball.drop_height_m is missing: expected a number above 0 and up to 10000.0 \(m\), or a",
        ),
    ],
)
def test_wrong_cables_are_refused(values, text):
    with pytest.raises(ScenarioError, match=text):
        replace(I235.ball, **{"cable": CABLE, **values})


def test_a_ball_swings_above_the_ground_and_may_swing_into_a_valley(tmp_path):
    """11.5 m of cable take the ball 17 cm below height 0, where flat ground is; it does not reach a valley below."""
    low = replace(I235.ball, target_m=None, drop_height_m=None, cable=replace(CABLE, length_m=11.5))
    message = r"ball.cable.length_m is 11.5: expected a ball that swings above the ground, its lowest point is at -0.17"
    with pytest.raises(ScenarioError, match=message):
        replace(I235, ball=low)
    for height, reached in ((-0.3, False), (-0.1, True)):
        path = write_asc(tmp_path / "level.asc", lambda x, _, level=height: level + 0.0 * x, count=121)
        ground = Ground(file=str(path), origin=(EASTING + 150.0, NORTHING + 150.0, 0.0))
        scenario = replace(I235, ball=low, ground=ground, fracture=replace(I235.fracture, shards=10))
        with pytest.raises(ScenarioError, match=message) if reached else nullcontext():
            checked_model(scenario)


def test_cables_that_do_not_hang_are_refused():
    with pytest.raises(ScenarioError, match=r"ball.cable.angle_degrees is 120: expected a number above 0 and up to 90"):
        replace(CABLE, angle_degrees=120)
