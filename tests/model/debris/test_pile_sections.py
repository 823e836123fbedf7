# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections through a pile against sums by hand, and against the sections of trimesh and the unions of shapely."""

import numpy as np
import pytest
import trimesh
from shapely.geometry import MultiPoint
from shapely.ops import unary_union
from support.exported_runs import corners_m, turning_run, with_ground
from support.sample_results import changed, hanging_chain

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.debris.pile_sections import Direction, pile_section


def test_a_shard_that_fell_and_one_that_stands_are_cut_as_by_hand():
    """*lower*, 0.7071 m wide and deep and 4 m high, ends about (3, 4, 2); *upper*, 1 m wide, hangs about (0, 0, 18)."""
    section = pile_section(hanging_chain(), Direction.ACROSS, 3.1)
    assert section.debris_area_m2 == pytest.approx(4.0 * 0.5**0.5)
    assert section.debris_width_m == pytest.approx(0.5**0.5)
    assert section.debris_height_m == pytest.approx(4.0)
    assert section.standing.is_empty() and not section.is_empty
    assert section.debris.bounds() == pytest.approx((4.0 - 0.5**1.5, 0.0, 4.0 + 0.5**1.5, 4.0))
    assert (section.frame, section.time_s) == (6, pytest.approx(0.16))
    along = pile_section(hanging_chain(), Direction.ALONG, 0.2)
    assert along.debris.is_empty() and along.debris_height_m == along.debris_width_m == 0.0
    assert along.standing.area() == pytest.approx(4.0)
    assert along.standing.bounds() == pytest.approx((-0.5, 16.0, 0.5, 20.0))


def test_points_of_the_plane_are_where_they_are_in_the_world():
    across, along = (pile_section(hanging_chain(), direction, 3.0) for direction in Direction)
    np.testing.assert_allclose(across.in_space(np.array([[4.0, 2.0]])), [[3.0, 4.0, 2.0]])
    np.testing.assert_allclose(along.in_space(np.array([4.0, 2.0])), [4.0, 3.0, 2.0])


@pytest.mark.parametrize("direction", Direction)
@pytest.mark.parametrize("row", [3, -1])
def test_turned_shards_are_cut_as_by_trimesh_and_shapely(direction, row):
    """Flying shards, each cut by trimesh as a mesh, and the cuts united by shapely."""
    results = turning_run(count=40)
    shards = results.inventory.of_kind("shard")
    corners = [corners_m(results, row, body) for body in shards]
    axis = direction.normal_axis
    place = float(np.median([points[:, axis].mean() for points in corners]))
    section = pile_section(results, direction, place, row)
    normal = np.eye(3)[axis]
    cuts = []
    for points in corners:
        lines = trimesh.intersections.mesh_plane(trimesh.convex.convex_hull(points), normal, normal * place)
        if len(lines):
            cuts.append(MultiPoint(lines.reshape(-1, 3)[:, [1 - axis, 2]]).convex_hull)
    assert len(cuts) >= 2
    whole = unary_union(cuts)
    assert section.debris_area_m2 + section.standing.area() == pytest.approx(whole.area, rel=1e-5)
    left, low, right, high = section.debris.bounds()
    assert (left, low, right, high) == pytest.approx(whole.bounds, abs=1e-5)


def test_heights_are_above_the_ground_below():
    """Ground that rises by 2 m to one corner: heights are those above it, where trimesh cuts it."""
    results = with_ground(turning_run(count=40))
    (ground,) = results.inventory.of_kind("ground")
    positions = np.array(results.frames.positions_m, float)
    positions[:, ground] = positions[0, ground]
    positions[:, results.inventory.of_kind("shard"), 2] += 12.0
    results = changed(results, places_m=positions)
    body = int(results.inventory.of_kind("shard")[0])
    place = float(corners_m(results, -1, body)[:, 0].mean())
    section = pile_section(results, Direction.ACROSS, place)
    surface = trimesh.Trimesh(corners_m(results, 0, ground), results.inventory.triangles_of(ground), process=False)
    cut = trimesh.intersections.mesh_plane(surface, [1.0, 0.0, 0.0], [place, 0.0, 0.0]).reshape(-1, 3)
    cut = cut[cut[:, 1].argsort()]
    points = np.concatenate([np.asarray(ring) for ring in section.debris.to_polygons()])
    above = points[:, 1] - np.interp(points[:, 0], cut[:, 1], cut[:, 2])
    assert np.ptp(cut[:, 2]) > 0.5 and above.max() > 0.5
    assert section.debris_height_m == pytest.approx(above.max(), abs=0.02)


def test_what_was_removed_is_not_cut():
    results = hanging_chain()
    positions = np.array(results.frames.positions_m)
    positions[4, 1] -= (0.0, 0.0, 1000.0)
    gone = changed(results, places_m=positions)
    assert pile_section(gone, Direction.ALONG, 0.0).is_empty
    assert pile_section(gone, Direction.ALONG, 0.0, row=3).standing.area() == pytest.approx(4.0 + 4.0 * 0.5**0.5)


def test_without_a_frame_there_is_no_section():
    results = hanging_chain()
    nothing = changed(results, **{name: results.arrays()[name][:0] for name in ("frames", "times_s", "places_m")})
    with pytest.raises(OutputError, match="no recorded frame"):
        pile_section(nothing, Direction.ALONG, 0.0)
