# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of a site: a known one is found again, and its band has as many new events as it says."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.site_law import CONFIDENCE, fitted_law
from bridge_demolition_addon.errors import BlastError

K_M_S, EXPONENT = 0.8, 1.5


def events(generator, count, scatter):
    """Events of a known law at random distances from charges of 1 to 10 kg."""
    distances, sizes = generator.uniform(10.0, 200.0, count), generator.uniform(1.0, 10.0, count)
    median = K_M_S * (distances / np.sqrt(sizes)) ** -EXPONENT
    return distances, sizes, median * np.exp(scatter * generator.standard_normal(count))


def test_a_law_without_scatter_is_found_again():
    law = fitted_law(*events(np.random.default_rng(1), 12, 0.0))
    assert (law.velocity_m_s, law.exponent) == pytest.approx((K_M_S, EXPONENT), rel=1e-10)
    assert law.scatter < 1e-10 and law.events == 12
    assert law.velocity(40.0, 4.0) == pytest.approx(K_M_S * 20.0**-EXPONENT)
    assert law.at_most(40.0, 4.0) == pytest.approx(law.velocity(40.0, 4.0))


def test_new_events_lie_in_the_band_as_often_as_it_says():
    """Each of 2000 sites with 8 events and one that was held out: binomial, 3.3 standard deviations of 0.0049."""
    generator = np.random.default_rng(7)
    inside = 0
    for _ in range(sites := 2000):
        distances, sizes, velocities = events(generator, 9, 0.4)
        law = fitted_law(distances[:8], sizes[:8], velocities[:8])
        inside += bool(law.at_least(distances[8], sizes[8]) <= velocities[8] <= law.at_most(distances[8], sizes[8]))
    assert inside / sites == pytest.approx(CONFIDENCE, abs=3.3 * np.sqrt(CONFIDENCE * (1.0 - CONFIDENCE) / sites))


def test_the_band_is_the_textbook_one():
    """Five events by hand: ln v = 2 - ln x + (1, -1, 0, -1, 1) / 10 at ln x = -2, -1, 0, 1, 2. The residues are square
    to both 1 and x, so that the line is theirs: s² = 0.04 / 3, t of three degrees 3.182, and at x = 2
    1 + 1 / 5 + 4 / 10.
    """
    logs, rest = np.arange(-2.0, 3.0), np.array([1.0, -1.0, 0.0, -1.0, 1.0]) / 10.0
    assert abs(rest @ logs) < 1e-15 and abs(rest.sum()) < 1e-15
    law = fitted_law(np.exp(logs), np.ones(5), np.exp(2.0 - logs + rest))
    width = 3.18245 * np.sqrt(0.04 / 3.0) * np.sqrt(1.6)
    assert np.log(law.at_most(np.exp(2.0), 1.0)) == pytest.approx(0.0 + width, rel=1e-5)
    assert np.log(law.at_least(np.exp(2.0), 1.0)) == pytest.approx(0.0 - width, rel=1e-5)


def test_outside_of_what_was_measured_it_is_extrapolated():
    law = fitted_law([10, 20, 40, 80, 160], [4] * 5, [80, 30, 10, 4, 1])
    assert (law.nearest, law.farthest) == (5.0, 80.0)
    assert [law.covers(distance, 4.0) for distance in (9.9, 10.1, 159.0, 161.0)] == [False, True, True, False]
    assert not law.covers(50.0, 0.0)
    assert law.velocity(50.0, 0.0) < law.at_most(50.0, 0.0) < 1e-100


@pytest.mark.parametrize(
    "distances, sizes, velocities, complaint",
    [
        ([10, 20, 30, 40], [1] * 4, [4, 3, 2, 1], "too few events, 4: expected at least 5"),
        ([10] * 6, [1] * 6, [4, 3, 2, 1, 2, 3], "nearly one scaled distance, 10 to 10"),
        ([10, 20, 30, 40, 50], [1, 4, 9, 16, 25], [4, 3, 2, 1, 0.5], "nearly one scaled distance"),
        ([10, 20, 30, 40, np.nan], [1] * 5, [4, 3, 2, 1, 0.5], "numbers above 0"),
        ([10, 20, 30, 40, 50], [1] * 5, [4, 3, 2, 1, -0.5], "numbers above 0"),
        ([10, 20, 30, 40, 50], [1, 1, 1, 1, 0], [4, 3, 2, 1, 0.5], "numbers above 0"),
        ([10, 20, 30, 40, 50], [1] * 5, [1, 2, 3, 4, 5], "do not fall with the distance"),
    ],
)
def test_what_gives_no_law_is_refused(distances, sizes, velocities, complaint):
    with pytest.raises(BlastError, match=complaint):
        fitted_law(distances, sizes, velocities)
