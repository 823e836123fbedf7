# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes of members that are inclined, curved and cambered, against shapes by formula."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.own_axes import lying_axes, standing_axes
from bridge_demolition_addon.engineering.geometry.solids import box

pytestmark = pytest.mark.slow

ROAD = np.array([1.0, 0.0])


def swept(place, parts=40):
    """A deck of 4 m × 0.5 m whose corners at s, t, h a function places."""
    stations = np.linspace(0.0, 20.0, parts + 1)
    ring = [(-2.0, 0.0), (2.0, 0.0), (2.0, 0.5), (-2.0, 0.5)]
    vertices = np.array([place(s, t, h) for s in stations for t, h in ring])
    quads = [
        [4 * p + a, 4 * p + b, 4 * p + 4 + b, 4 * p + 4 + a]
        for p in range(parts)
        for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))
    ]
    quads += [[3, 2, 1, 0], [4 * parts, 4 * parts + 1, 4 * parts + 2, 4 * parts + 3]]
    triangles = np.array([[q[i], q[j], q[k]] for q in quads for i, j, k in ((0, 1, 2), (0, 2, 3))])
    mesh = TriangleMesh(vertices, triangles)
    return mesh if mesh.volume > 0.0 else mesh.flipped()


def inclined(s, t, h):
    """5 % of slope and 3 % of crossfall."""
    return s, t, 3.0 + 0.05 * s + 0.03 * t + h


def curved(s, t, h):
    """On an arc of 40 m, with ends across it: along its chord the deck goes 2 m × sin 0.25 = 0.5 m farther."""
    angle = s / 40.0
    return (40.0 - t) * np.sin(angle), 40.0 - (40.0 - t) * np.cos(angle), 3.0 + h


@pytest.mark.parametrize(("place", "along_m", "across_m"), [(inclined, 1e-6, 1e-6), (curved, 1.1, 0.1)])
def test_axes_follow_a_member(place, along_m, across_m):
    axes = lying_axes(swept(place), ROAD)
    assert axes.length_m == pytest.approx(20.0, abs=along_m)
    assert (axes.width_m, axes.height_m) == pytest.approx((4.0, 0.5), abs=across_m)
    for s, t, h in ((3.0, -1.5, 0.05), (10.0, 0.0, 0.25), (17.0, 1.5, 0.45)):
        world = np.array([place(s, t, h)])
        own = axes.from_world(world)[0]
        assert own[0] == pytest.approx(s, abs=along_m)
        assert own[1:] == pytest.approx((t, h), abs=across_m)
        assert axes.to_world(axes.from_world(world)) == pytest.approx(world, abs=1e-3)
    assert axes.width_at_m(0.25) == pytest.approx(4.0, abs=across_m)


def test_bars_along_an_arc_run_along_its_tangent():
    """At 5 m of the arc, 0.125 from its beginning."""
    axes = lying_axes(swept(curved), ROAD)
    (along,) = axes.directions(np.array([[5.5, 0.0, 0.1]]), 0)
    assert along == pytest.approx((np.cos(0.125), np.sin(0.125), 0.0), abs=0.03)


def test_a_deck_with_overhangs_has_the_underside_of_its_middle():
    """A trapezoid: 10 m at the top, 3 m at the bottom, 0.9 m high, edges 0.2 m thick."""
    ring = [(-1.5, 0.0), (1.5, 0.0), (5.0, 0.7), (5.0, 0.9), (-5.0, 0.9), (-5.0, 0.7)]
    vertices = np.array([(x, t, h) for x in (0.0, 30.0) for t, h in ring])
    caps = [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 5, 4]]
    sides = [[a, b, 6 + b, 6 + a] for a, b in zip(range(6), [1, 2, 3, 4, 5, 0], strict=True)]
    triangles = caps + [[6 + c for c in reversed(cap)] for cap in caps]
    triangles += [[q[i], q[j], q[k]] for q in sides for i, j, k in ((0, 1, 2), (0, 2, 3))]
    mesh = TriangleMesh(vertices, np.array(triangles))
    axes = lying_axes(mesh if mesh.volume > 0.0 else mesh.flipped(), ROAD)
    assert (axes.width_m, axes.height_m) == pytest.approx((10.0, 0.9), rel=1e-6)
    assert axes.width_at_m(0.07) == pytest.approx(3.0 + 2.0 * 0.07 * 3.5 / 0.7, rel=1e-6)
    assert axes.width_at_m(0.85) == pytest.approx(10.0)


def test_a_column_has_the_axes_of_its_plan():
    """0.6 m × 0.4 m, turned by 30°."""
    turned = box((0.6, 0.4, 5.0))
    cosine, sine = np.cos(np.pi / 6.0), np.sin(np.pi / 6.0)
    points = turned.vertices @ np.array(((cosine, sine, 0.0), (-sine, cosine, 0.0), (0.0, 0.0, 1.0)))
    axes = standing_axes(TriangleMesh(points, turned.triangles))
    assert (axes.length_m, axes.width_m, axes.height_m) == pytest.approx((0.6, 0.4, 5.0))
    own = axes.from_world(points)
    assert np.ptp(own, axis=0) == pytest.approx((0.6, 0.4, 5.0))
    assert axes.to_world(own) == pytest.approx(points)


def test_a_member_with_two_arms_has_axes_too():
    """Its line runs from one arm to the middle of the other, where nothing is cut near it."""
    arms = box((10.0, 1.0, 1.0), (0.0, 0.0, 0.0)), box((1.0, 8.0, 1.0), (4.5, 4.0, 0.0))
    count = len(arms[0].vertices)
    both = TriangleMesh(
        np.concatenate([arm.vertices for arm in arms]),
        np.concatenate((arms[0].triangles, arms[1].triangles + count)),
    )
    axes = lying_axes(both)
    assert (axes.width_m, axes.height_m) == pytest.approx((1.0, 1.0))


def test_boxes_anywhere_have_axes():
    """Members of meshes and files are not always what a deck is: axes of such need no meaning, but have to be there."""
    random = np.random.default_rng(7)
    for _ in range(300):
        boxes = [box(random.uniform(0.3, 10.0, 3), random.uniform((-15, -15, -1), (15, 15, 1))) for _ in range(5)]
        counts = np.cumsum([0, *(len(part.vertices) for part in boxes)])
        triangles = [part.triangles + count for part, count in zip(boxes, counts, strict=False)]
        axes = lying_axes(TriangleMesh(np.concatenate([part.vertices for part in boxes]), np.concatenate(triangles)))
        assert np.isfinite(axes.line_m).all() and axes.height_m > 0.0
