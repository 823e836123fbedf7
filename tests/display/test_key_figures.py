# SPDX-License-Identifier: GPL-3.0-or-later
"""Key figures of a frame against numbers worked out by hand from the hanging chain, and against those of reports."""

import math

import numpy as np
import pytest
import shapely
from support.run_folders import flying_shards
from support.sample_results import G, changed, hanging_chain, without_connections

from bridge_demolition_addon.display.key_figures import RunFigures
from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.results.collapse import ConnectionCounts

LAST = 4
"""Row in which *lower* has moved by 3 m and 4 m."""


@pytest.fixture
def chain():
    return RunFigures(hanging_chain())


def test_nothing_is_down_before_the_chain_comes_apart(chain):
    figures = chain.at(LAST - 1)
    assert (figures.number, figures.time_s) == (5, pytest.approx(0.12))
    assert figures.connections == ConnectionCounts(2, 0)
    assert (figures.debris_kg, figures.bridge_kg, figures.farthest) == (0.0, 500.0, None)
    assert figures.area.is_empty()


def test_what_came_down_counts_with_its_mass_its_area_and_its_distance(chain):
    figures = chain.at(LAST)
    assert (figures.number, figures.time_s) == (6, pytest.approx(0.16))
    assert figures.connections == ConnectionCounts(2, 1)
    assert (figures.debris_kg, figures.bridge_kg) == (200.0, 500.0)
    # Its section of 0.5 m², with its middle at (3, 4); the bridge covers 1 m² around the origin.
    half = math.sqrt(0.5) / 2.0
    assert figures.area.area() == pytest.approx(0.5)
    np.testing.assert_allclose(figures.farthest.position_m, (3.0 + half, 4.0 + half))
    assert figures.farthest.distance_m == pytest.approx(math.hypot(3.0 + half - 0.5, 4.0 + half - 0.5))


def test_at_the_end_debris_is_that_of_reports():
    results = flying_shards()
    debris, figures = debris_of(results), RunFigures(results).at(len(results.frames) - 1)
    assert figures.debris_kg == pytest.approx(debris.masses_kg.sum())
    assert figures.farthest.distance_m == pytest.approx(debris.reaches_m.max())


def test_removed_shards_are_no_debris():
    results = hanging_chain()
    positions = np.array(results.frames.positions_m)
    positions[LAST, 2, 2] = -1000.0
    figures = RunFigures(changed(results, places_m=positions)).at(LAST)
    assert (figures.debris_kg, figures.bridge_kg, figures.farthest) == (0.0, 300.0, None)


def test_rest_is_when_the_last_shard_stops(chain):
    assert (chain.rest.first_motion_s, chain.rest.at_rest_s) == (None, None)
    results = hanging_chain()
    velocities = np.array(results.frames.velocities_m_s)
    velocities[1:3, 2] = (0.0, 0.0, -1.0)
    rest = RunFigures(changed(results, velocities_m_s=velocities)).rest
    assert (rest.first_motion_s, rest.at_rest_s) == (pytest.approx(0.04), pytest.approx(0.12))


def test_force_on_a_shard_is_the_largest_resultant_in_any_sub_step(chain):
    """*Upper* carries 300 kg, and in its fourth frame 1 kN across for a moment; *lower* 200 kg until it comes off."""
    upper, lower = chain.history("upper"), chain.history("lower")
    hangs, pulled = 300 * G, math.hypot(300 * G, 1000.0)
    np.testing.assert_allclose(upper.forces_n, (0.0, hangs, hangs, pulled, hangs))
    np.testing.assert_allclose(lower.forces_n, (0.0, 200 * G, 200 * G, math.hypot(200 * G, 1000.0), 0.0))
    assert (upper.name, upper.peak_row, chain.frame_of(3)) == ("upper", 3, 5)


def test_force_in_a_connection_is_its_own(chain):
    history = chain.history("Connection")
    np.testing.assert_allclose(history.forces_n, (0.0, 500 * G, 500 * G, 500 * G, 300 * G))
    assert history.peak_row == 1


@pytest.mark.parametrize("name", ["", "Ground", "Camera"])
def test_without_a_body_that_moves_it_is_the_largest_on_any_shard(chain, name):
    history = chain.history(name)
    assert history.name == ""
    np.testing.assert_allclose(history.forces_n, chain.history("upper").forces_n)  # of which the ball is none
    assert chain.largest_loaded(3) == "upper"


def test_a_ball_has_a_history_of_its_own(chain):
    assert chain.history("Wrecking ball").forces_n.max() == pytest.approx(6000 * G)


def test_a_run_without_connections_has_none_to_break():
    figures = RunFigures(without_connections(hanging_chain())).at(LAST)
    assert figures.connections == ConnectionCounts(0, 0)


def test_nothing_that_is_broken_off_hides_in_a_bound():
    """With bodies of all sizes the farthest corner is that of a search over all corners by shapely."""
    results = flying_shards(count=60)
    run = RunFigures(results)
    area = shapely.union_all([shapely.Polygon(ring) for ring in run.plan.to_polygons()])  # which has no holes
    for row in (5, 12, 24):
        corners, frame = results.inventory.vertices_by_body(), results.frames.positions_m[row]
        of_debris = np.concatenate([frame[body] + corners[body] for body in run.debris(row)])  # boxes that do not turn
        farthest_m = shapely.distance(area, shapely.points(of_debris[:, :2])).max()
        assert run.at(row).farthest.distance_m == pytest.approx(farthest_m, abs=1e-9)
