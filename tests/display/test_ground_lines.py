# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines on the ground, by lengths, areas and distances known from geometry; and when a flash is seen."""

import math

import numpy as np
import pytest
from manifold3d import CrossSection
from support.sample_results import changed, hanging_chain

from bridge_demolition_addon.display.dust import puffs
from bridge_demolition_addon.display.ground_lines import (
    FLASH_S,
    cross_lines,
    distance_rings,
    draped,
    flash_lines,
    flash_share,
    planned_zone,
    way_lines,
    zone_lines,
)
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.terrain.surface import RecordedGround, Surface
from bridge_demolition_addon.model.scenario import Exclusion, Zone

SQUARE = ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0))


def total_length(lines):
    return float(np.linalg.norm(lines[1::2] - lines[::2], axis=1).sum())


def test_a_zone_is_its_outline_and_with_a_height_a_box():
    flat = zone_lines(Zone(name="road", corners_m=SQUARE))
    assert total_length(flat) == pytest.approx(40.0) and np.ptp(flat[:, 2]) == 0.0
    box = zone_lines(Zone(name="line", corners_m=SQUARE, bottom_m=5.0, top_m=8.0))
    assert total_length(box) == pytest.approx(40.0 + 40.0 + 4 * 3.0)
    assert sorted(set(box[:, 2].tolist())) == [5.0, 8.0]


def test_rings_are_as_far_from_the_plan_as_they_say():
    plan = CrossSection.square((20.0, 10.0))
    rings = distance_rings(plan, 5.0, 3)
    assert [distance for distance, _ in rings] == [5.0, 10.0, 15.0]
    for distance, lines in rings:
        outside = np.maximum(np.maximum(-lines[:, :2], lines[:, :2] - (20.0, 10.0)), 0.0)
        away = np.linalg.norm(outside, axis=1)
        assert (away > distance * (1.0 - 1e-6)).all() and (
            away < distance * 1.0015
        ).all()  # 64 sides instead of a circle


def test_an_exclusion_zone_before_a_run_is_drop_and_buffer():
    plan = CrossSection.square((20.0, 10.0))
    zone = planned_zone(plan, Exclusion(buffer_m=6.0, designed_drop_m=4.0))
    assert zone.debris.is_empty()
    # A rectangle with everything nearer than 10 m: four strips and a circle, of which 64 corners lack 0.2 %.
    assert zone.whole.area() == pytest.approx(200.0 + 2 * (20.0 + 10.0) * 10.0 + math.pi * 100.0, rel=1e-3)


def test_a_way_goes_through_all_places_and_a_cross_is_in_its_middle():
    positions = np.array([(0.0, 0.0, 9.0), (0.0, 0.0, 5.0), (3.0, 0.0, 1.0)])
    assert total_length(way_lines(positions)) == pytest.approx(4.0 + 5.0)
    cross = cross_lines((1.0, 2.0, 3.0), 0.5)
    assert cross.mean(axis=0) == pytest.approx((1.0, 2.0, 3.0)) and total_length(cross) == pytest.approx(3.0)


def test_a_flash_begins_with_the_detonation_fades_and_ends():
    assert flash_share(-0.01) == 0.0 and flash_share(0.0) == 1.0
    shares = [flash_share(time) for time in np.linspace(0.0, FLASH_S, 20)]
    assert (np.diff(shares) < 0.0).all()
    assert flash_share(FLASH_S + 0.01) == 0.0
    rays = flash_lines((1.0, 1.0, 4.0), 2.0)
    assert np.linalg.norm(rays[1::2] - (1.0, 1.0, 4.0), axis=1) == pytest.approx(2.0)


def test_dust_rises_where_and_when_a_connection_breaks():
    # The lower connection, at 16 m of height, holds in frame 5 and not in frame 6; its area is 0.5 m².
    (cloud,) = puffs(hanging_chain())
    assert cloud.frame == 6 and cloud.position_m == pytest.approx((0.0, 0.0, 16.0))
    assert cloud.radius_m == pytest.approx(1.2 * math.sqrt(0.5))


def test_there_is_no_dust_where_nothing_breaks_and_never_too_much():
    results = hanging_chain()
    whole = np.ones_like(results.arrays()["intact"])
    assert puffs(changed(results, intact=whole)) == []
    whole[3:] = False
    both = puffs(changed(results, intact=whole))
    assert len(both) == 2 and len(puffs(changed(results, intact=whole), most=1)) == 1
    assert puffs(changed(results, intact=whole), most=1)[0].radius_m == max(puff.radius_m for puff in both)


def test_steel_that_parts_makes_no_dust():
    results = hanging_chain()
    parted = np.ones_like(results.arrays()["intact"])
    parted[3:] = False
    volumes = results.inventory.volumes_m3
    of_concrete, of_steel = (
        changed(results, intact=parted, masses_kg=density * volumes) for density in (2500.0, 7850.0)
    )
    # The shard that hangs from the ledge parts from it in dust, which is of the ledge, and not from the other shard.
    assert len(puffs(of_concrete)) == 2 and len(puffs(of_steel)) == 1


def test_lines_on_the_ground_follow_a_slope():
    """A zone of 8 m by 4 m on ground that rises by 1 in 10: its sides in parts of 2 m, its top where it was."""
    corners = np.array([[-50, -50, -5], [50, -50, 5], [50, 50, 5], [-50, 50, -5]], float)
    ground = RecordedGround(Surface(TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))))
    zone = Zone(name="road", corners_m=((0, 0), (8, 0), (8, 4), (0, 4)), top_m=6.0)
    lines = draped(zone_lines(zone), ground)
    top = lines[:, 2] == 6.0
    # Four sides at the top and one end of each of four uprights; 4 + 2 + 4 + 2 parts and the other ends at the bottom.
    assert (top.sum(), (~top).sum()) == (8 + 4, 24 + 4)
    np.testing.assert_allclose(lines[~top, 2], 0.02 + 0.1 * lines[~top, 0], atol=1e-12)
    sides = lines.reshape(-1, 2, 3)
    assert np.linalg.norm(np.diff(sides[(sides[..., 2] != 6.0).all(axis=1)], axis=1)[..., :2], axis=-1).max() <= 2.0
    np.testing.assert_array_equal(draped(zone_lines(zone), RecordedGround()), zone_lines(zone))
