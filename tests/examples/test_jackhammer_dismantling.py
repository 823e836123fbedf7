"""A jackhammer takes the slab between two girders out along its path, and the rest of the bridge stays."""

from dataclasses import replace

import numpy as np
import pytest
from example_runs import example, run_example

WHOLE = example("jackhammer_dismantling")
(HAMMER,) = WHOLE.jackhammers
RADIUS_M = HAMMER.diameter_m / 2.0


@pytest.fixture(scope="module")
def dismantled(tmp_path_factory):
    """The first half of the path."""
    hammer = replace(HAMMER, end_time_s=2.5)
    scenario = replace(WHOLE, jackhammers=[hammer], time=replace(WHOLE.time, duration_s=3.2))
    return run_example(scenario, tmp_path_factory.mktemp("dismantled"))


def from_path(run, bodies):
    """Distance on plan (n,) of bodies from the way that the chisel went."""
    (first, across), (last, _) = run.scenario.jackhammers[0].path_m
    end = min(last, first + HAMMER.speed_m_s * (run.scenario.jackhammers[0].end_time_s - HAMMER.start_time_s))
    places = run.results.frames.positions_m[0, bodies]
    beyond = places[:, 0] - np.clip(places[:, 0], first, end)
    return np.hypot(beyond, places[:, 1] - across)


def test_it_stands_until_the_first_blow(dismantled):
    before = dismantled.at(HAMMER.start_time_s)
    assert dismantled.results.frames.intact[before].all()
    assert dismantled.moved_m(dismantled.shards, before).max() < 0.01


def test_the_deck_is_cut_finer_along_the_path(dismantled):
    deck = dismantled.of_members("deck")
    distances = from_path(dismantled, deck)
    volumes = dismantled.results.inventory.volumes_m3[deck]
    # The density there is more than four times that at the edges, where none of the places reaches.
    assert volumes[distances < 0.5].mean() < volumes[distances > 2.0].mean() / 4.0


def test_the_hammered_region_comes_off(dismantled):
    deck = dismantled.of_members("deck")
    distances = from_path(dismantled, deck)
    fallen = dismantled.fallen_m(deck) > 1.0
    # Of the shards that are wholly or mostly under the chisel hardly one holds on: some are wedged between others.
    assert fallen[distances < RADIUS_M].mean() > 0.7
    assert fallen.sum() >= 15
    # Shards are 0.2 m wide there. What comes off with them reaches three of them to either side.
    assert distances[fallen].max() < RADIUS_M + 3 * 0.2 + 0.1


def test_the_rest_stays(dismantled):
    deck = dismantled.of_members("deck")
    beyond = deck[from_path(dismantled, deck) > RADIUS_M + 3 * 0.2 + 0.1]
    assert len(beyond) > 120
    assert dismantled.moved_m(beyond).max() < 0.05
    assert dismantled.moved_m(dismantled.of_members("girder", "abutment")).max() < 0.01


def test_debris_falls_under_the_hole(dismantled):
    assert dismantled.throws_m(dismantled.shards).max() < 5.0


def test_forces_are_highest_at_the_chisel(dismantled):
    results, deck = dismantled.results, dismantled.of_members("deck")
    first_blow = dismantled.at(HAMMER.start_time_s + 0.5 / HAMMER.blows_per_second)
    forces = results.frames.loads.body_peak_sums_n[: first_blow + 1, deck].max(axis=0)
    start = np.array(HAMMER.path_m[0])
    assert np.linalg.norm(results.frames.positions_m[0, deck[forces.argmax()], :2] - start) < 1.0
