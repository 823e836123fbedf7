# SPDX-License-Identifier: GPL-3.0-or-later
"""Which runs leave a zone that was fixed before them."""

import numpy as np
import pytest
from manifold3d import CrossSection
from scipy.stats import binomtest

from bridge_demolition_addon.engineering.geometry.plan_areas import outlines
from bridge_demolition_addon.model.scenario import Zone
from bridge_demolition_addon.model.study.conclusions import holds, proportion_leaving, zone_area
from bridge_demolition_addon.report.wording.study import harm_sentence

CORNERS = ((0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (0.0, 10.0))
ZONE = Zone(name="drop area", corners_m=CORNERS)


def swept(length_m, start_m=1.0):
    return outlines(CrossSection.square((length_m, 2.0)).translate((start_m, 4.0)))


@pytest.mark.parametrize("corners", [CORNERS, CORNERS[::-1]])
def test_a_zone_covers_the_same_whichever_way_its_corners_run(corners):
    assert zone_area(Zone(name="drop area", corners_m=corners)).area() == pytest.approx(300.0)


def test_what_ends_at_the_edge_does_not_leave_and_what_crosses_it_does():
    runs = [swept(29.0), swept(29.1), swept(5.0, -0.1), swept(30.0, 0.0), swept(3.0, 60.0)]
    left = [proportion_leaving(ZONE, [run], 0.95).count for run in runs]
    assert left == [0, 1, 1, 0, 1]


def test_a_hole_in_what_was_swept_does_not_matter():
    ring = CrossSection.square((40.0, 20.0)).translate((-5.0, -5.0)) - zone_area(ZONE)
    assert proportion_leaving(ZONE, [outlines(ring)], 0.95).count == 1


def test_runs_that_did_not_finish_left_it_and_runs_that_moved_nothing_did_not():
    chance = proportion_leaving(ZONE, [None, (), swept(2.0)], 0.95)
    assert (chance.count, chance.runs) == (1, 3)


def test_the_chance_has_the_limits_of_its_count():
    lengths = np.linspace(20.0, 29.5, 93)
    chance = proportion_leaving(ZONE, [swept(length) for length in lengths], 0.95)
    assert chance.count == (lengths > 29.0).sum()
    expected = binomtest(chance.count, 93, alternative="less").proportion_ci(0.95, method="exact").high
    assert chance.at_most == pytest.approx(expected, abs=1e-10)
    assert harm_sentence(chance).startswith(f"{chance.count} of 93 runs left the zone drop area. ")


def test_a_zone_holds_what_is_within_it():
    assert holds(ZONE, CrossSection.square((30.0, 10.0)))
    assert not holds(ZONE, CrossSection.square((30.01, 10.0)))
    assert holds(ZONE, CrossSection())
