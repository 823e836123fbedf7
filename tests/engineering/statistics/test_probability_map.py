# SPDX-License-Identifier: GPL-3.0-or-later
"""The probability of debris on a plan, where it can be worked out by hand."""

import numpy as np
import pytest
from manifold3d import CrossSection
from scipy.stats import beta, norm

from bridge_demolition_addon.engineering.geometry.plan_areas import outlines
from bridge_demolition_addon.engineering.statistics.binomial import upper_limit
from bridge_demolition_addon.engineering.statistics.probability_map import probability_map

RUNS = 400
CONFIDENCE = 0.95


def strip(length_m):
    """Debris that slides along x from 0 to a distance."""
    return outlines(CrossSection.square((length_m, 1.0)))


@pytest.fixture(scope="module")
def reaches_m():
    return np.random.default_rng(1).normal(10.0, 2.0, RUNS)


@pytest.fixture(scope="module")
def strips(reaches_m):
    return probability_map([strip(reach_m) for reach_m in reaches_m], CONFIDENCE)


def test_a_cell_is_hit_as_often_as_debris_slides_as_far(strips, reaches_m):
    left = strips.cells.xs_m[:-1]
    expected = (reaches_m[:, None] > left + 1e-9).mean(axis=0)
    assert np.array_equal(strips.shares, np.broadcast_to(expected, strips.shares.shape))


def test_limits_of_cells_are_those_of_scipy(strips):
    counts = strips.hits[0]
    exact = np.where(counts == RUNS, 1.0, beta.ppf(CONFIDENCE, counts + 1, np.maximum(RUNS - counts, 1e-9)))
    np.testing.assert_allclose(strips.upper_limits[0], exact, rtol=1e-10)


@pytest.mark.slow
def test_the_limit_at_a_place_holds_in_as_many_studies_as_promised():
    position_m, studies = 12.0, 120
    generator = np.random.default_rng(9)
    maps = [
        probability_map([strip(length_m) for length_m in generator.normal(10.0, 2.0, 59)], CONFIDENCE)
        for _ in range(studies)
    ]
    hits = [chances.hits[0, round(position_m / chances.cells.side_m)] for chances in maps]
    limits = upper_limit(np.arange(59 + 1), 59, CONFIDENCE)[hits]  # as the limits of cells are, see above
    tolerance = 3.3 * np.sqrt(CONFIDENCE * (1.0 - CONFIDENCE) / studies)
    assert np.mean(limits >= norm.sf(position_m, 10.0, 2.0)) >= CONFIDENCE - tolerance


def test_a_level_is_left_where_debris_is_rarer(strips, reaches_m):
    _, _, farthest, _ = strips.area_above(0.05).bounds()
    # So many runs, of 400, have an upper limit of just over 5 %.
    few = min(count for count in range(RUNS) if beta.ppf(CONFIDENCE, count + 1, RUNS - count) > 0.05)
    assert farthest == pytest.approx(np.ceil(np.sort(reaches_m)[-few] * 10.0) / 10.0)
    assert farthest > norm.isf(0.05, 10.0, 2.0)


def test_a_run_that_did_not_finish_hits_everything():
    both = probability_map([strip(4.0), None, strip(2.0), []], CONFIDENCE)
    assert both.runs == 4
    assert np.array_equal(both.hits[0], np.where(both.cells.xs_m[:-1] < 2.0, 3, 2))


def test_few_runs_do_not_resolve_what_is_rare(strips):
    assert strips.runs_for(0.01) == 299 and strips.runs_for(0.05) == 59
    assert strips.resolves(0.01) and not strips.resolves(0.005)
    few = probability_map([strip(1.0)] * 298, CONFIDENCE)
    assert not few.resolves(0.01)
    (low_x, low_y, high_x, high_y), cells = few.area_above(0.01).bounds(), few.cells
    assert (low_x, low_y, high_x, high_y) == (cells.xs_m[0], cells.ys_m[0], cells.xs_m[-1], cells.ys_m[-1])


def test_the_map_shows_what_it_is_drawn_around():
    bridge = outlines(CrossSection.square((30.0, 8.0)).translate((-5.0, -4.0)))
    shown = probability_map([strip(4.0)], CONFIDENCE, bridge)
    assert (shown.cells.xs_m[0], shown.cells.xs_m[-1]) == (-5.0, 25.0)
    assert shown.hits.sum() == 5 * 20 * shown.hits.max()


def test_there_is_no_map_of_nothing():
    assert probability_map([[], None], CONFIDENCE) is None
