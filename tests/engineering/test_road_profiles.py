# SPDX-License-Identifier: GPL-3.0-or-later
"""Arches as outlines: on their axis, as thick as they are square to it, level where columns stand, closed."""

import math

import numpy as np
import pytest
from support.meshes import is_closed

from bridge_demolition_addon.engineering.fracture.options import FractureOptions
from bridge_demolition_addon.engineering.fracture.slabs import inclined_fracture
from bridge_demolition_addon.engineering.geometry.arches import ArchAxis, RoadProfile, across_road

PARABOLA = ArchAxis(1.0, 31.0, 2.0, 6.0, 0.5)
CIRCLE = ArchAxis(1.0, 31.0, 2.0, 6.0, 0.5, is_circle=True)


def shoelace(outline_m):
    """Area of a polygon."""
    x, z = np.array(outline_m).T
    return 0.5 * abs(float(np.sum(x * np.roll(z, -1) - np.roll(x, -1) * z)))


@pytest.mark.parametrize("axis", [PARABOLA, CIRCLE])
def test_sections_are_square_to_the_axis_and_as_long_as_it_is_thick(axis):
    x = np.linspace(axis.begin_m, axis.end_m, 201)
    middles, tops, undersides = (axis.points_m(x, side) for side in (0.0, 1.0, -1.0))
    assert np.linalg.norm(tops - undersides, axis=1) == pytest.approx(axis.thickness_m, rel=1e-12)
    assert 0.5 * (tops + undersides) == pytest.approx(middles, rel=1e-12)
    along = middles[2:] - middles[:-2]
    # A chord over two steps is nearly the tangent between.
    assert np.abs(np.sum(along * (tops - undersides)[1:-1], axis=1)).max() < 1e-3
    assert middles[100] == pytest.approx((16.0, 8.0))
    assert middles[[0, -1]].tolist() == [[1.0, 2.0], [31.0, 2.0]]


def test_axes_are_a_parabola_and_a_circle():
    x = np.array([8.5, 16.0, 23.5])
    assert PARABOLA.points_m(x, 0.0)[:, 1] == pytest.approx([2.0 + 0.75 * 6.0, 8.0, 2.0 + 0.75 * 6.0])
    # R = (f² + L²/4) / (2 f) = (36 + 225) / 12.
    assert CIRCLE.radius_m == pytest.approx(21.75)
    assert np.hypot(x - 16.0, CIRCLE.points_m(x, 0.0)[:, 1] - (8.0 - 21.75)) == pytest.approx(21.75)
    # Lengths: L/2 √(1 + s²) + L/(2 s) asinh s with s = 4 f / L; R times the angle.
    slope = 4.0 * 6.0 / 30.0
    assert PARABOLA.length_m == pytest.approx(15.0 * (math.hypot(1.0, slope) + math.asinh(slope) / slope), rel=1e-5)
    assert CIRCLE.length_m == pytest.approx(21.75 * 2.0 * math.asin(15.0 / 21.75), rel=1e-5)


@pytest.mark.parametrize("axis", [PARABOLA, CIRCLE])
def test_columns_stand_level_on_their_arch(axis):
    profile = axis.profile([7.0, 16.0, 25.0], 0.6)
    for column in (7.0, 16.0, 25.0):
        foot = profile.tops_m[np.abs(profile.tops_m[:, 0] - column) < 0.3 + 1e-9]
        assert foot[[0, -1], 0] == pytest.approx([column - 0.3, column + 0.3])
        assert foot[:, 1] == pytest.approx(axis.seat_m(column, 0.6), abs=1e-12 if column != 16.0 else 2e-3)
    assert (np.diff(profile.tops_m[:, 0]) > 0.0).all()


def test_a_profile_is_closed_and_its_pieces_are_it():
    profile = PARABOLA.profile([7.0, 16.0, 25.0], 0.6)
    whole = profile.solid(4.0, 1.5)
    assert is_closed(whole)
    pieces = profile.pieces(4.0, 1.5)
    outline = np.concatenate((profile.undersides_m, profile.tops_m[::-1]))
    assert whole.volume == pytest.approx(4.0 * shoelace(outline), rel=1e-12)
    assert sum(piece.volume for piece in pieces) == pytest.approx(whole.volume, rel=1e-12)
    assert whole.bounds[:, 1].tolist() == [-0.5, 3.5]
    # Arc length times thickness, and the wedges below three columns: half of foot times slope, and of the piece beside.
    assert whole.volume == pytest.approx(4.0 * 0.5 * PARABOLA.length_m, rel=0.05)
    assert whole.volume > 4.0 * 0.5 * PARABOLA.length_m


def test_inclined_plates_are_cut_through_their_thickness():
    along = np.array([3.0, 4.0]) / 5.0
    profile = RoadProfile(np.array([[0.0, 0.0], [6.0, 8.0]]), np.array([[-0.4, 0.3], [5.6, 8.3]]))
    solid = across_road(profile.outlines_m[0], 5.0)
    assert profile.directions[0] == pytest.approx(along)
    cut = inclined_fracture(solid, 12, 3, FractureOptions(through_plates=True), tuple(along.tolist()))
    assert cut.volumes.sum() == pytest.approx(10.0 * 0.5 * 5.0, rel=1e-9)
    across = [shard.vertices @ np.array([-0.8, 0.0, 0.6]) for shard in cut.shards]
    assert min(np.ptp(heights) for heights in across) == pytest.approx(0.5)
    # Faces lie nearly along the thickness, and in them.
    assert np.abs(cut.faces.normals @ np.array([-0.8, 0.0, 0.6])).max() < 0.05
    plain = inclined_fracture(solid, 12, 3, FractureOptions(), tuple(along.tolist()))
    assert np.abs(plain.faces.normals @ np.array([-0.8, 0.0, 0.6])).max() > 0.2
