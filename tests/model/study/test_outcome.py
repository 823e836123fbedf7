# SPDX-License-Identifier: GPL-3.0-or-later
"""Outcomes of runs whose geometry is known exactly."""

from dataclasses import replace

import numpy as np
import pytest
from support.moving_boxes import moving_boxes, turned_about_z
from support.scenarios import I235

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.receptors import loads_at
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.scenario import Neighbour, Zone
from bridge_demolition_addon.model.study.criteria import Criterion
from bridge_demolition_addon.model.study.outcome import Outlines, evaluate

# Areas are cut to a hundred-millionth of a metre, and sides straightened by a hundredth of a millimetre.
ROUNDING = 2e-5

BARE = replace(I235, zones=(), exclusion=None)
SUMMARY = {"largest_resultant": None, "energy": None, "connections": {"count": 20, "broken": 7}, "came_to_rest_s": 2.5}
DECK = (10.0, 4.0, 1.0)
DECK_PLACE = (0.0, 0.0, 5.0)


def thrown(*places, size=(1.0, 1.0, 1.0), rotations=None, **more):
    """A deck of 10 m by 4 m around the origin that stays, and a box that goes through places."""
    all_places = [[DECK_PLACE, position] for position in places]
    if rotations is not None:
        rotations = np.stack([np.broadcast_to(np.eye(3), (len(places), 3, 3)), rotations], axis=1)
    return moving_boxes(range(len(places)), [DECK, size], all_places, rotations=rotations, **more)


def outputs_of(results, scenario=BARE, summary=SUMMARY, **more):
    return evaluate(results, RunSummary.of(summary), scenario, **more).outputs


def test_the_reach_is_the_farthest_on_the_way_and_not_where_debris_comes_to_rest():
    # It flies to x = 12, beside the deck that ends at 5, and rolls back to 8; half of it lies ahead of its middle.
    outputs = outputs_of(thrown((0, 0, 6), (12, 0, 3), (8, 0, 0.5)))
    assert outputs["reach_m"] == pytest.approx(12.0 + 0.5 - 5.0, abs=ROUNDING)
    assert outputs["resting_reach_m"] == pytest.approx(8.0 + 0.5 - 5.0, abs=ROUNDING)
    assert outputs["largest_throw_m"] == pytest.approx(8.0, abs=1e-12)
    assert outputs["debris_kg"] == pytest.approx(1000.0)
    assert outputs["debris_area_m2"] == pytest.approx(1.0, abs=ROUNDING)


def test_beyond_a_corner_the_reach_is_the_straight_distance():
    # Its nearest corner ends 3 m beyond the deck's end and 4 m beyond its side, its farthest 4 m and 5 m.
    outputs = outputs_of(thrown((0, 0, 6), (5 + 3.5, 2 + 4.5, 0.5)))
    assert outputs["reach_m"] == pytest.approx(np.hypot(4.0, 5.0), abs=ROUNDING)


def test_a_box_that_turns_reaches_as_far_as_its_corner():
    # Turned by 45° about z, a box of 2 m by 2 m by 1 m sticks out by √2 m.
    turn = turned_about_z([0.0, np.pi / 4.0, 0.0])
    outputs = outputs_of(thrown((0, 0, 6), (9, 0, 3), (9, 0, 0.5), size=(2, 2, 1), rotations=turn))
    assert outputs["reach_m"] == pytest.approx(9.0 + 2**0.5 - 5.0, abs=ROUNDING)
    assert outputs["resting_reach_m"] == pytest.approx(9.0 + 1.0 - 5.0, abs=ROUNDING)


def test_nothing_that_moved_reaches_nowhere():
    outcome = evaluate(thrown((0, 0, 6), (0.05, 0, 6)), RunSummary.of(SUMMARY), BARE)
    assert outcome.outputs["reach_m"] == outcome.outputs["largest_throw_m"] == 0.0
    assert outcome.outlines.resting == outcome.outlines.swept == ()
    assert np.ptp(outcome.outlines.bridge[0], axis=0) == pytest.approx(DECK[:2], abs=1e-3)


def test_what_swings_out_and_back_has_moved():
    outputs = outputs_of(thrown((0, 0, 6), (12, 0, 3), (0, 0, 6)))
    assert outputs["reach_m"] == pytest.approx(7.5, abs=ROUNDING)
    assert outputs["largest_throw_m"] == outputs["resting_reach_m"] == 0.0


@pytest.mark.parametrize("least_kg, reach_m", [(0.0, 7.5), (1000.0, 7.5), (1001.0, 0.0)])
def test_lighter_shards_are_no_hazard_but_a_ball_always_is(least_kg, reach_m):
    path = (0, 0, 6), (12, 0, 0.5)
    assert outputs_of(thrown(*path), least_mass_kg=least_kg)["reach_m"] == pytest.approx(reach_m, abs=ROUNDING)
    ball = thrown(*path, kinds=["shard", "ball"])
    assert outputs_of(ball, least_mass_kg=least_kg)["reach_m"] == pytest.approx(7.5, abs=ROUNDING)


def test_shards_that_were_removed_are_no_debris():
    # Removing puts a shard 1000 m below.
    outputs = outputs_of(thrown((20, 0, 6), (20, 0, -994)))
    assert (outputs["reach_m"], outputs["debris_kg"]) == (0.0, 0.0)


def test_outlines_are_those_of_the_boxes():
    outcome = evaluate(thrown((0, 0, 6), (12, 0, 3), (12, 9, 0.5)), RunSummary.of(SUMMARY), BARE)
    (resting,) = outcome.outlines.resting
    np.testing.assert_allclose([resting.min(axis=0), resting.max(axis=0)], [(11.5, 8.5), (12.5, 9.5)], atol=1e-3)
    (swept,) = outcome.outlines.swept
    following = np.roll(swept, -1, axis=0)
    area = np.sum(swept[:, 0] * following[:, 1] - following[:, 0] * swept[:, 1]) / 2.0
    assert area == pytest.approx(13.0 * 1.0 + 9.0 * 1.0, abs=0.05)  # 13 m by 1 m along x, then 9 m more along y


def test_outlines_are_kept_to_a_thousandth_of_a_millimetre_and_read_back():
    outlines = evaluate(thrown((0, 0, 6), (12, 0, 3), (12, 9, 0.5)), RunSummary.of(SUMMARY), BARE).outlines
    again = Outlines.of_arrays(outlines.arrays())
    for name in ("bridge", "resting", "swept"):
        for one, other in zip(getattr(outlines, name), getattr(again, name), strict=True):
            np.testing.assert_allclose(one, other, atol=1e-6)
    empty = Outlines((), (), ())
    assert Outlines.of_arrays(empty.arrays()).swept == ()
    with pytest.raises(ValueError, match="corners: expected"):
        Outlines.of_arrays(outlines.arrays() | {"swept_counts": np.array([3])})


def test_the_course_of_a_run():
    results = thrown((0, 0, 4), (0, 0, 2), (0, 0, 3), masses_kg=[3000.0, 1000.0])
    outputs = outputs_of(results)
    assert (outputs["broken"], outputs["came_to_rest_s"]) == (7, 2.5)
    # Both are the one span here: its centre of mass stands at (3 × 5 + 4) / 4 = 4.75 m, then at 4.25 and at 4.5 m.
    assert outputs["collapsed_share"] == pytest.approx(0.25 / 4.75)
    assert outputs["spans.1.drop_m"] == pytest.approx(0.25)
    assert outputs["spans.1.lost_share"] == pytest.approx(0.25 / 4.75)
    assert outputs["spans.1.most_lost_share"] == pytest.approx(0.5 / 4.75)
    assert outputs["largest_force_N"] is outputs["made_by_solver_share"] is None


def test_a_span_that_lies_on_the_ground_has_no_height_to_lose():
    outputs = outputs_of(moving_boxes([0, 1], [DECK], [[(0, 0, 0)], [(0, 0, -0.1)]]))
    assert outputs["spans.1.drop_m"] == pytest.approx(0.1)
    assert outputs["spans.1.lost_share"] is outputs["spans.1.most_lost_share"] is None


def test_spans_are_told_apart():
    two = replace(BARE, bridge=replace(I235.bridge, span_lengths_m=(10.0, 10.0)))
    positions = [[(5, 0, 4), (15, 0, 4)], [(5, 0, 1), (15, 0, 4)]]
    kinds = np.array(["deck", "deck"])
    results = moving_boxes([0, 1], [(8, 4, 1)] * 2, positions, body_member_kinds=kinds)
    outputs = outputs_of(results, two)
    assert (outputs["spans.1.lost_share"], outputs["spans.2.lost_share"]) == (0.75, 0.0)


def test_columns_and_cap_of_a_pier_come_down_together():
    positions = [[(0, 0, 2), (0, 3, 2), (0, 0, 5), (9, 0, 2)], [(0, 0, 0.5), (0, 3, 2), (0, 0, 2.5), (9, 0, 2)]]
    members = np.array(["pier 2 column 1", "pier 2 column 2", "pier 2 cap", "pier 10"])
    outputs = outputs_of(moving_boxes([0, 1], [(1, 1, 1)] * 4, positions, body_members=members))
    # All weigh as much: the middle of pier 2 comes from 3 m to 5/3 m.
    assert outputs["piers.2.lost_share"] == pytest.approx(4.0 / 9.0)
    assert outputs["piers.10.lost_share"] == 0.0


def test_forces_are_those_of_the_summary():
    energy = {"made_by_solver": {"share_of_dissipated": 0.3, "share_that_counts": 0.03}}
    known = SUMMARY | {"largest_resultant": {"force_N": 5e6}, "energy": energy}
    outputs = outputs_of(thrown((0, 0, 6), (0, 0, 6)), summary=known)
    assert (outputs["largest_force_N"], outputs["made_by_solver_share"]) == (5e6, 0.03)


def test_a_throw_beyond_twice_the_height_of_fall_is_doubtful_and_the_distance_is_told_without_it():
    """From 6 m a shard gets 12 m far at most: here one goes 9 m, and one 20 m."""
    near, far = ((0, 0, 6), (9, 0, 0.5)), ((0, 0, 6), (20, 0, 0.5))
    results = moving_boxes([0, 1], [DECK, DECK], [[near[0], far[0]], [near[1], far[1]]])
    outputs = outputs_of(results)
    assert (outputs["doubtful_throws"], outputs["reach_m"]) == (1, pytest.approx(20.0))
    assert outputs["reach_without_doubtful_m"] == pytest.approx(9.0)


def test_zones_that_are_crossed_on_the_way_are_entered():
    zone = Zone(name="Side road", corners_m=((9, -5), (10, -5), (10, 5), (9, 5)))
    far = replace(zone, name="Track", corners_m=((30, -5), (31, -5), (31, 5), (30, 5)))
    scenario = replace(BARE, zones=(zone, far))
    outputs = outputs_of(thrown((0, 0, 6), (12, 0, 3), (12, 0, 0.5)), scenario)
    assert (outputs['zones."Side road".entered'], outputs['zones."Side road".bodies_entered']) == (True, 1)
    assert (outputs["zones.Track.entered"], outputs["zones.Track.bodies_entered"]) == (False, 0)


def test_what_reaches_neighbours_is_what_the_report_says():
    charge = Charge(name="one", position_m=(0, 0, 1), mass_kg=10.0)
    house = Neighbour(name="house", position_m=(30.0, 0.0, 2.0))
    scenario = replace(BARE, charges=(charge,), neighbours=(house,))
    loads = loads_at(house.position_m, [charge])
    outputs = outputs_of(thrown((0, 0, 6), (0, 0, 6)), scenario)
    assert outputs["neighbours.house.pressure_kPa"] == loads.peak_pa / 1000.0
    assert outputs["neighbours.house.vibration_mm_s"] == loads.peak_velocity_m_s * 1000.0
    assert outputs["neighbours.house.touchdown_mm_s"] == 0.0  # nothing fell
    silent = replace(scenario, blast=replace(BARE.blast, explosion=False))
    assert outputs_of(thrown((0, 0, 6), (0, 0, 6)), silent)["neighbours.house.pressure_kPa"] == 0.0


def test_a_body_that_blender_lost_is_no_outcome():
    with pytest.raises(OutputError, match="a body was lost"):
        outputs_of(thrown((0, 0, 6), (np.nan, 0, 6)))


def test_a_bridge_without_area_is_no_outcome():
    flat = moving_boxes([0, 1], [(10, 0, 1)], [[(0, 0, 5)], [(0, 0, 5)]])
    with pytest.raises(OutputError, match="covers no area in plan"):
        outputs_of(flat)


def test_criteria_are_judged_with_the_outcome():
    down = Criterion(name="Span 1 down", kind="span down", span=1, share=0.05)
    more = replace(down, name="deep", share=0.06)
    results = thrown((0, 0, 4), (0, 0, 2), (0, 0, 3), masses_kg=[3000.0, 1000.0])
    outputs = outputs_of(results, criteria=[down, more])
    assert (outputs['criteria."Span 1 down"'], outputs["criteria.deep"], outputs["success"]) == (True, False, False)
    assert outputs_of(results, criteria=[down])["success"] is True
    assert "success" not in outputs_of(results)
