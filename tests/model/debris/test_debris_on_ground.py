# SPDX-License-Identifier: GPL-3.0-or-later
"""Debris on slopes and surfaces: heights above the ground below, who lies on the water, who went through the ground."""

from dataclasses import replace

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.debris.throws import bodies_under_ground, debris_of, debris_on_surfaces, height_map
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.checks import check_arrays
from bridge_demolition_addon.model.results.collapse import collapse_progress, spans_of
from bridge_demolition_addon.model.results.energy import throws_of

SLOPE = 0.5
"""The ground falls by 1 in 2 along x, and is at height 10 where x is 0."""


def slope_at(x):
    return 10.0 - SLOPE * np.asarray(x, float)


# A plane of two triangles, 80 m by 80 m, and water at height 2 from x = 10 to 30: shore where the ground is at 2.
GROUND = np.array([[-40, -40, 30], [40, -40, -10], [40, 40, -10], [-40, 40, 30]], float)
WATER = box((20.0, 30.0, 1.0), (20.0, 0.0, 1.5))


def fallen(starts_m, ends_m, *, with_water=True):
    """Cubes of 1 m that are at their starts at first and at their ends after it, on the slope."""
    count = len(starts_m)
    positions = np.array([np.vstack([shard_m, np.zeros((2, 3))]) for shard_m in (starts_m, ends_m)])
    arrays = moving_boxes(
        [0.0, 1.0], [(1.0, 1.0, 1.0)] * (count + 2), positions, kinds=["shard"] * count + ["ground"] * 2
    ).arrays()
    vertices = [np.asarray(arrays["vertices_m"])[: 8 * count], GROUND, WATER.vertices]
    triangles = [np.array([[0, 1, 2], [0, 2, 3]]), WATER.triangles]
    arrays |= {
        "vertices_m": np.concatenate(vertices),
        "vertex_counts": np.array([8] * count + [4, len(WATER.vertices)]),
        "triangles": np.concatenate(triangles),
        "triangle_counts": np.array([0] * count + [2, len(WATER.triangles)]),
        "body_members": np.array([""] * (count + 1) + ["river"]),
        "body_member_kinds": np.array([""] * (count + 1) + ["water"]),
        "masses_kg": np.array([1000.0 * (row + 1) for row in range(count)] + [0.0, 0.0]),
    }
    results = Results.of_arrays(arrays)
    if with_water:
        return results
    kinds = np.array(["shard"] * count + ["ground", "other"])
    return replace(results, inventory=replace(results.inventory, body_kinds=kinds))


def on_slope(x, above):
    return (x, 0.0, float(slope_at(x)) + above)


def test_heights_are_those_above_the_ground_below():
    """A cube that slides down the slope from x = 0 to 6 loses 3 m of height, and none above the ground."""
    results = fallen([on_slope(0.0, 0.5), on_slope(-5.0, 8.0)], [on_slope(6.0, 0.5), on_slope(-4.0, 2.0)])
    (whole,) = spans_of(results)
    # By mass, 1 t and 2 t: (0.5 + 2 × 8) / 3 at first, (0.5 + 2 × 2) / 3 in the end.
    assert whole.heights_m == pytest.approx([16.5 / 3, 4.5 / 3])
    assert collapse_progress(results)[-1] == pytest.approx(1.0 - 4.5 / 16.5)
    # They come down by 3 m and by 6.5 m: the ground at x = -4 is half a metre lower than at -5.
    assert whole.drop_m == pytest.approx((3.0 + 2 * 6.5) / 3)
    debris = debris_of(results)
    # The highest corner of the second is half a metre above its middle, and over the downhill edge 0.25 m more.
    assert debris.highest_m == pytest.approx(2.0 + 0.5 + 0.25)
    assert debris.throws_m == pytest.approx([6.0, 1.0])
    heights = height_map(results, debris.bodies)
    # Of cubes with their middles 0.5 m and 2 m above the slope: the mean over each is 1 m and 2.5 m above it.
    assert heights.volume_m3 == pytest.approx(1.0 + 2.5, rel=0.02)  # cells of 1/200 of the plan


def test_a_way_down_a_slope_is_no_throw_on_the_solver_s_energy():
    """From 1 m above the slope a body that rolls on for 6 m falls by 4 m: 2 × 1 m would not carry it so far."""
    start, end = on_slope(0.0, 1.0), on_slope(6.0, 0.5)
    assert not throws_of(fallen([start], [end])).beyond_fall.any()
    level = fallen([start], [(9.0, 0.0, start[2])])
    assert throws_of(level).beyond_fall.all()  # 9 m along, and nothing fallen: twice the metre to the ground is 2 m


def test_debris_on_the_water_is_counted_apart():
    starts = [on_slope(0.0, 6.0)] * 3
    ends = [(20.0, 3.0, 2.5), (18.0, 0.0, 3.5), on_slope(4.0, 0.5)]
    results = fallen(starts, ends)
    (river,) = debris_on_surfaces(results, debris_of(results))
    assert (river.name, river.kind, river.bodies.tolist()) == ("river", "water", [0, 1])
    assert river.mass_kg == 3000.0
    assert river.covered_m2 == pytest.approx(2.0)
    # The ground is at the water's height of 2 m where x is 16: there is the shore, and of its 20 m by 30 m it has 14.
    ground = results.ground()
    assert ground.shown(ground.surfaces[0]).area() == pytest.approx(14.0 * 30.0, rel=1e-6)
    on_the_bank = fallen([on_slope(0.0, 6.0)], [on_slope(12.0, 0.5)])  # over the outline of the water, above its shore
    assert not len(debris_on_surfaces(on_the_bank, debris_of(on_the_bank))[0].bodies)
    # On the water and on what floats on it: heights above the water, not above its bottom.
    assert debris_of(results).highest_m == pytest.approx(2.0)


def test_what_went_through_the_ground_is_told():
    starts = [on_slope(0.0, 6.0)] * 4
    ends = [on_slope(5.0, -3.0), on_slope(5.0, 0.3), on_slope(-8.0, 0.5), (60.0, 0.0, -50.0)]
    assert bodies_under_ground(fallen(starts, ends)).tolist() == [0, 3]
    flat = moving_boxes([0.0, 1.0], [(1.0, 1.0, 1.0)] * 2, [[(0, 0, 5), (3, 0, 5)], [(0, 0, -4), (3, 0, 0.5)]])
    assert bodies_under_ground(flat).tolist() == [0]


def test_without_surfaces_there_is_nothing_to_count():
    results = fallen([on_slope(0.0, 6.0)], [on_slope(4.0, 0.5)], with_water=False)
    assert debris_on_surfaces(results, debris_of(results)) == ()


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"triangle_counts": None}, "triangle_counts: is missing"),
        ({"triangles": np.array([[0, 1, 2], [0, 2, 9]])}, "triangle_counts: add up to 14, expected 2"),
        ({"triangle_counts": np.array([0, 14, -12])}, "triangle_counts: expected no negative numbers"),
        ({"triangles": np.full((14, 3), 8)}, "triangles: expected rows of the vertices of their bodies"),
        ({"triangles": np.zeros((14, 2), int)}, "triangles: expected a length of 3"),
    ],
)
def test_triangles_that_no_run_writes_are_refused(changes, message):
    from bridge_demolition_addon.errors import OutputError

    arrays = fallen([on_slope(0.0, 6.0)], [on_slope(4.0, 0.5)]).arrays()
    arrays["reading"] = np.array(arrays["reading"])
    check_arrays(arrays)
    arrays |= changes
    with pytest.raises(OutputError, match=message):
        check_arrays({name: values for name, values in arrays.items() if values is not None})
