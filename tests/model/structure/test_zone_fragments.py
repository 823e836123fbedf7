# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragments of a zone: their sizes, speeds and ranges, and what a cover does."""

from dataclasses import replace

import numpy as np
import pytest
from support.drilled_columns import ZONE, column_members

from bridge_demolition_addon.model.structure.blast_zones import placed_zone
from bridge_demolition_addon.model.structure.zone_fragments import flyrock_of, zone_fragments

pytestmark = pytest.mark.slow

MEMBERS = column_members()


def placed(**values):
    return placed_zone(replace(ZONE, **values), MEMBERS)


def test_fragments_begin_at_the_faces_beside_the_rows_and_leave_outwards():
    fragments = zone_fragments(placed())
    across, speeds = fragments.positions_m[:, 1], fragments.velocities_m_s[:, 1]
    assert np.unique(across).tolist() == pytest.approx([-0.35, 0.35])
    assert (np.sign(speeds) == np.sign(across)).all()
    assert fragments.positions_m[:, 2].min() > 0.75 and fragments.positions_m[:, 2].max() < 2.25


def test_sizes_and_speeds_have_the_laws_means():
    fragments = zone_fragments(placed())
    # Kuz-Ram at 1 kg/m³ and 73.5 g: 5.0 cm; the median of 2000 samples scatters by 3 %.
    assert np.median(fragments.sizes_m) == pytest.approx(0.050, rel=0.1)
    speeds = np.linalg.norm(fragments.velocities_m_s, axis=1)
    assert speeds.mean() == pytest.approx(14.14, rel=0.05)  # standard error 1.2 %
    assert speeds.max() <= np.sqrt(9.80665 * 340.1) * 1.001  # cut at Lundborg's range


def test_ranges_are_in_order_and_below_lundborgs():
    flyrock = flyrock_of(placed())
    ranges = flyrock.sampled
    assert 0.0 < ranges.half_m < ranges.most_m <= ranges.nearly_all_m <= ranges.largest_m < flyrock.lundborg_m
    assert flyrock.lundborg_m == pytest.approx(340.1, abs=0.5)


def test_a_cover_shortens_the_flight():
    """With a third of the speed, a ninth of the range in a vacuum; with drag, more than that."""
    bare, covered = flyrock_of(placed()).sampled, flyrock_of(placed(cover_factor=1.0 / 3.0)).sampled
    assert 1.0 / 9.0 < covered.most_m / bare.most_m < 0.35


def test_the_same_seed_gives_the_same_fragments():
    first, again, other = (zone_fragments(placed(), seed) for seed in (1, 1, 2))
    assert np.array_equal(first.velocities_m_s, again.velocities_m_s)
    assert not np.array_equal(first.velocities_m_s, other.velocities_m_s)


def test_downhill_they_fly_farther():
    zone = placed()
    below = flyrock_of(zone, lambda at: np.full(len(at), -30.0)).sampled
    assert below.half_m > flyrock_of(zone).sampled.half_m
