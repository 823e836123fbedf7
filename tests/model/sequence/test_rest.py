# SPDX-License-Identifier: GPL-3.0-or-later
"""When everything has come to rest."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import REPORT_2019
from support.scenarios import I235

from bridge_demolition_addon.model.scenario import BallHit, SawCut
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.ending import Rest, last_event_s

STEP_S = 0.1


def watched(places, spins=0.0, asleep=None, not_before_s=0.0, hold_s=0.5, masses_kg=None):
    """Rest of bodies along x whose places are (k, n), and which turn about z at a constant rate."""
    rest = Rest(0.05, 0.1, hold_s, not_before_s)
    reached_s = None
    for step, row in enumerate(np.asarray(places, float)):
        angle = spins * step * STEP_S
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        position = np.column_stack((row, np.zeros((len(row), 2))))
        sleep = np.zeros(len(row), bool) if asleep is None else asleep
        masses = np.ones(len(row)) if masses_kg is None else np.array(masses_kg)
        rest.observe(step * STEP_S, position, np.broadcast_to(turn, (len(row), 3, 3)), sleep, masses)
        if rest.is_reached and reached_s is None:
            reached_s = step * STEP_S
    return rest.came_to_rest_s, reached_s


def stopping(rest_step, speed=1.0, count=21):
    """A body that moves until a step, and one that never does."""
    moving = np.minimum(np.arange(count), rest_step) * STEP_S * speed
    return np.column_stack((moving, np.zeros(count)))


def test_rest_counts_from_when_the_last_body_stopped_and_is_reached_after_the_hold():
    assert watched(stopping(8)) == (pytest.approx(0.8), pytest.approx(1.3))


def test_what_is_slow_rests_and_what_is_not_does_not():
    assert watched(stopping(20, speed=0.049)[:, :1])[0] == 0.0
    assert watched(stopping(20, speed=0.051)[:, :1]) == (None, None)
    assert watched(stopping(0), spins=0.099)[0] == 0.0
    assert watched(stopping(0), spins=0.101) == (None, None)


def test_rest_is_by_the_energy_of_all_by_their_mass():
    """One of 100 t creeps among others: at v it has the energy of all at 0.05 m/s where m v² = M 0.05²."""
    for heavy_kg in (3.0, 24.0, 99.0):
        limit_m_s = 0.05 * np.sqrt((1.0 + heavy_kg) / 1.0)
        masses_kg = (1.0, heavy_kg)
        assert watched(stopping(20, speed=0.99 * limit_m_s), masses_kg=masses_kg)[0] == 0.0
        assert watched(stopping(20, speed=1.01 * limit_m_s), masses_kg=masses_kg) == (None, None)


def test_a_body_that_flies_keeps_a_run_alive_however_light_it_is():
    assert watched(stopping(20, speed=0.49), masses_kg=(1.0, 1e6))[0] == 0.0
    assert watched(stopping(20, speed=0.51), masses_kg=(1.0, 1e6)) == (None, None)
    assert watched(stopping(20, speed=5.0), masses_kg=(0.0, 1.0))[0] == 0.0  # the ground, which something moves


def test_what_sleeps_rests():
    assert watched(stopping(20), asleep=np.array([True, False]))[0] == 0.0


def test_rest_does_not_count_while_something_is_still_to_happen():
    assert watched(stopping(0), not_before_s=1.0) == (pytest.approx(1.0), pytest.approx(1.5))


def test_who_moves_again_did_not_come_to_rest():
    positions = np.concatenate((np.zeros(10), np.linspace(0.0, 5.0, 10)))[:, None]
    assert watched(positions) == (None, pytest.approx(0.5))


def test_last_event():
    # The ball is let go at 0.5 s and falls 5 m, for 1.0098 s.
    assert last_event_s(I235) == pytest.approx(0.5 + np.sqrt(10.0 / 9.80665))
    assert last_event_s(replace(I235, ball=None)) == 0.0
    assert last_event_s(replace(I235, ball=None), motion_end_s=7.0) == 7.0
    assert last_event_s(replace(I235, saw_cuts=[SawCut(time_s=3, point_m=(6, 0, 5), normal=(1, 0, 0))])) == 3.0
    explosive = read_scenario(REPORT_2019 / "single_span_explosives.toml")
    detonations = [explosive.blast.start_s + charge.delay_s for charge in explosive.charges]
    assert last_event_s(replace(explosive, ball=None)) == max(detonations) > 0.0
    quiet = replace(explosive.blast, explosion=False)
    warmed_up = replace(explosive.connections, warm_up_s=0.2)
    assert last_event_s(replace(explosive, ball=None, blast=quiet, connections=warmed_up)) == 0.2
    hit = BallHit(lift_time_s=2, lift_duration_s=1, release_time_s=3.5, target_m=(6, 0), drop_height_m=4.903325)
    assert last_event_s(replace(I235, ball=replace(I235.ball, hits=[hit]))) == pytest.approx(4.5)
