# SPDX-License-Identifier: GPL-3.0-or-later
"""Throws that the energy of a fall does not explain, and what a summary says of the solver's energy."""

import numpy as np
import pytest
from support.sample_results import changed, hanging_chain

from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.energy import (
    LARGE_SHARE,
    SMALL_DROP_M,
    counted_share,
    energy_summary,
    flies_on_solver_energy,
    is_known,
    made_share,
    much_made_text,
    throws_of,
)
from bridge_demolition_addon.model.results.motion import MOVED_M


def thrown(distance_m, **arrays):
    """The chain, whose shards begin 12 and 10 m up or so, with the lower one that far off at the end."""
    results = hanging_chain()
    positions = results.frames.positions_m.copy()
    positions[-1, 2] = positions[0, 2] + (distance_m, 0.0, -1.0)
    return changed(results, places_m=positions, **arrays)


def test_share_is_what_was_made_over_what_was_dissipated():
    # 200 J in the last of five frames with 500 J each.
    assert made_share(hanging_chain()) == pytest.approx(200.0 / 2500.0)


def with_work(made_j, dissipated_j):
    """The chain, whose shards of 500 kg have 49.03 J for a fall of 1 cm, and the shares of such work in its frames."""
    frames = np.array([np.nan, 0.0, 0.0, 0.0, 1.0])
    made = np.outer(frames, (0.0, 1.0, 0.0, 0.0)) * made_j
    results = changed(hanging_chain(), made_by_solver_j=made, dissipated_between_bodies_j=frames * dissipated_j)
    return counted_share(results), made_share(results)


def test_a_trifle_is_not_much_beside_the_weight_of_what_stands():
    """2.4 J of 4 J that were dissipated are 60 %, and 4.9 % of what 500 kg lose as they fall by 1 cm."""
    counted, of_dissipated = with_work(2.4, 4.0)
    assert (counted, of_dissipated) == (pytest.approx(2.4 / (500.0 * 9.80665 * 0.01)), pytest.approx(0.6))
    assert much_made_text(counted, of_dissipated) == ""
    assert "60.0 %" in much_made_text(*with_work(2.6, 4.333))


def test_much_beside_what_fell_is_said_whatever_the_weight():
    counted, of_dissipated = with_work(60.0, 1000.0)
    assert counted == of_dissipated == pytest.approx(0.06)
    assert "6.0 %" in much_made_text(counted, of_dissipated)
    assert much_made_text(*with_work(50.0, 1000.0)) == ""


def test_what_counts_as_little_throws_one_of_a_hundred_shards_no_farther_than_debris_begins():
    """v² / g of one that has all of it: 2 · 0.05 · 100 · 1 cm."""
    energy_j = LARGE_SHARE * 100 * 9.80665 * SMALL_DROP_M
    assert 2.0 * energy_j / 9.80665 <= MOVED_M * (1.0 + 1e-12)


def test_summary_adds_up_by_cause_and_names_the_farthest_first():
    energy = energy_summary(thrown(3.0))
    made = energy["made_by_solver"]
    assert made["J"] == made["by_connections_J"] + made["by_contacts_J"] + made["by_lifting_J"] == 200.0
    assert energy["gravity_J"] == 5000.0
    assert [shard["body"] for shard in energy["farthest_shards"]] == ["lower", "upper"]
    assert [shard["made_by_solver_J"] for shard in energy["farthest_shards"]] == [150.0, 50.0]


def test_a_throw_above_twice_the_height_of_fall_is_doubtful():
    height = hanging_chain().frames.positions_m[0, 2, 2]
    assert not with_speeds(1.99 * height).beyond_fall.any()
    assert with_speeds(2.01 * height).beyond_fall.tolist() == [True, False]


def test_no_throw_is_doubtful_whose_energy_the_solver_did_not_make():
    """A shard that slid 1 m beyond twice its height lacks half a metre of fall."""
    results = hanging_chain()
    height, mass_kg = results.frames.positions_m[0, 2, 2], results.inventory.masses_kg[2]
    lacking_j = mass_kg * 9.80665 * 0.5
    assert not with_speeds(2.0 * height + 1.0, made_j=0.0).doubtful.any()
    assert not with_speeds(2.0 * height + 1.0, made_j=0.99 * lacking_j).doubtful.any()
    assert with_speeds(2.0 * height + 1.0, made_j=1.01 * lacking_j).beyond_fall.tolist() == [True, False]
    assert with_speeds(2.0 * height + 1.0, made_j=np.nan).beyond_fall.tolist() == [True, False]


def with_speeds(distance_m, *, shard_m_s=0.0, ball_m_s=0.0, made_j=1e9):
    """A throw of the lower shard, which begins with a speed, in a run in which a ball has one; nothing else moves.

    The solver made so much energy, at the upper shard; nan where that is not known.
    """
    velocities = np.zeros_like(hanging_chain().frames.velocities_m_s)
    velocities[0, 2] = np.array([0.6, 0.0, 0.8]) * shard_m_s
    velocities[3, 3, 2] = -ball_m_s
    made = np.zeros_like(hanging_chain().arrays()["made_by_solver_j"])
    made[3, 1] = made_j
    gravity = np.full(len(made), made_j if np.isnan(made_j) else 0.0)
    return throws_of(thrown(distance_m, velocities_m_s=velocities, made_by_solver_j=made, work_of_gravity_j=gravity))


def test_the_longest_toss_with_a_speed_is_not_doubtful_and_one_a_half_longer_is():
    """Ballistics: from a height h, a speed v carries at most v √(v² + 2 g h) / g, at the best of all angles."""
    height, speed = hanging_chain().frames.positions_m[0, 2, 2], 20.0
    longest = speed * np.sqrt(speed**2 + 2.0 * 9.80665 * height) / 9.80665
    assert longest > 2.0 * height  # so that the height alone does not explain it
    assert with_speeds(longest).beyond_fall.tolist() == [True, False]
    assert not with_speeds(longest, shard_m_s=speed).beyond_fall.any()
    assert with_speeds(1.5 * longest, shard_m_s=speed).beyond_fall.tolist() == [True, False]


def test_a_ball_gives_its_speed_to_what_it_strikes():
    """One that fell 10 m has v² / 2g = 10 m: a shard 14 m up is doubtful beyond 48 m."""
    height, speed = hanging_chain().frames.positions_m[0, 2, 2], np.sqrt(2.0 * 9.80665 * 10.0)
    assert not with_speeds(1.99 * (height + 10.0), ball_m_s=speed).beyond_fall.any()
    assert with_speeds(2.01 * (height + 10.0), ball_m_s=speed).beyond_fall.tolist() == [True, False]


def test_charges_throw_as_far_as_they_like():
    blast = np.zeros_like(hanging_chain().frames.positions_m)
    blast[2, 2] = 5.0
    assert not throws_of(thrown(1000.0, blast_impulses_ns=blast)).beyond_fall.any()


def test_half_of_the_kinetic_energy_marks_a_shard_that_was_thrown():
    throws, made, kinetic = np.array([5.0, 5.0, 0.05]), np.array([49.0, 50.0, 90.0]), np.full(3, 100.0)
    assert flies_on_solver_energy(throws, made, kinetic).tolist() == [False, True, False]


def test_work_in_cracks_is_summed_over_frames_and_none_where_it_was_not_known():
    """40 J of bars and 10 J of friction in each of five frames; a run from before has neither."""
    energy = energy_summary(hanging_chain())
    assert energy["dissipated_by_bars_J"] == 200.0 and energy["dissipated_by_crack_friction_J"] == 50.0
    earlier = hanging_chain().arrays()
    del earlier["dissipated_by_bars_j"], earlier["dissipated_by_crack_friction_j"]
    energy = energy_summary(Results.of_arrays(earlier))
    assert energy["dissipated_by_bars_J"] is energy["dissipated_by_crack_friction_J"] is None
    assert energy["dissipated_J"] == 2500.0


def test_energy_that_was_not_recorded_is_not_made_up():
    unknown = np.full(5, np.nan)
    results = changed(hanging_chain(), work_of_gravity_j=unknown)
    assert not is_known(results)
    assert energy_summary(results) is None
