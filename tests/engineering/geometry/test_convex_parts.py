# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids around hollows in convex parts: nothing is lost, no part is hollow, and convex solids stay whole."""

import numpy as np
import pytest
from manifold3d import CrossSection, Manifold

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.convex_parts import EMPTY, convex_parts
from bridge_demolition_addon.engineering.geometry.solids import bodies, box, from_manifold, sphere, to_manifold, union


def prism(outline, length_m):
    """A solid with an outline (p, 2) as its section and a length."""
    return from_manifold(Manifold.extrude(CrossSection([np.asarray(outline, float)]), length_m))


T_SECTION = [(-1, 0), (1, 0), (1, 2), (4, 2), (4, 2.5), (-4, 2.5), (-4, 2), (-1, 2)]
U_SECTION = [(-3, 0), (3, 0), (3, 2), (2.5, 2), (2.5, 0.5), (-2.5, 0.5), (-2.5, 2), (-3, 2)]
HAUNCHED = [(-5, 1.0), (-2, 0.75), (-1.5, 0), (1.5, 0), (2, 0.75), (5, 1.0), (5, 1.2), (-5, 1.2)]


def excess(part):
    """By how much the hull of a part is larger than it."""
    return to_manifold(part).hull().volume() / part.volume - 1.0


@pytest.mark.parametrize(
    ("solid", "fewest"),
    [
        (prism(T_SECTION, 20.0), 2),
        (prism(U_SECTION, 20.0), 3),
        (prism(HAUNCHED, 20.0), 2),
        (union([box([4, 4, 0.5]), box([0.5, 4, 3], [1.75, 0, 1.75]), box([0.5, 4, 3], [-1.75, 0, 1.75])]), 3),
    ],
    ids=["T", "U", "haunched", "frame"],
)
def test_hollow_solids_are_cut_into_as_few_convex_parts_as_their_section_has(solid, fewest):
    parts = convex_parts(solid, 20)
    assert fewest <= len(parts) <= fewest + 1
    assert max(map(excess, parts)) < EMPTY
    assert sum(part.volume for part in parts) == pytest.approx(solid.volume, rel=1e-9)
    assert all(len(bodies(to_manifold(part))) == 1 for part in parts)


@pytest.mark.parametrize("solid", [box([30.0, 10.0, 0.6]), sphere(2.0, 24)], ids=["box", "sphere"])
def test_convex_solids_stay_whole(solid):
    (part,) = convex_parts(solid, 20)
    assert part.volume == pytest.approx(solid.volume, rel=1e-12)


def test_no_more_parts_are_made_than_allowed():
    parts = convex_parts(prism(U_SECTION, 20.0), 2)
    assert len(parts) <= 2
    assert sum(part.volume for part in parts) == pytest.approx(prism(U_SECTION, 20.0).volume, rel=1e-9)


def test_a_warped_face_leaves_no_slivers():
    """The underside of the flange twists by 2 cm along the beam: planes of its triangles are not the same."""
    straight = prism(T_SECTION, 20.0)
    vertices = straight.vertices.copy()
    under = np.isclose(vertices[:, 1], 2.0)
    vertices[under, 1] += 0.001 * vertices[under, 2] * np.sign(vertices[under, 0])
    solid = type(straight)(vertices, straight.triangles)
    parts = convex_parts(solid, 20)
    assert min(part.volume for part in parts) > 0.005 * solid.volume
    assert sum(excess(part) * part.volume for part in parts) < 0.03 * solid.volume
    assert sum(part.volume for part in parts) == pytest.approx(solid.volume, rel=1e-9)


def test_shards_of_convex_parts_are_convex():
    parts = convex_parts(prism(T_SECTION, 20.0), 20)
    shards = [shard for part in parts for shard in fracture(part, 8, seed=4).shards]
    assert max(map(excess, shards)) < 0.001


def test_small_parts_alone_do_not_part_a_solid():
    """Two pads of 0.036 m³ on a cap of 2.1 m³, where the least is 0.1 m³; columns of 1.08 m³ instead are parts."""
    cap = box((1.0, 3.5, 0.6), (0.0, 0.0, 0.3))
    for height_m, without, with_least in ((0.1, 3, 1), (3.0, 3, 3)):
        tops = [box((0.6, 0.6, height_m), (0.0, y, 0.599 + height_m / 2.0)) for y in (-1.2, 1.2)]
        solid = union([cap, *tops])
        assert len(convex_parts(solid, 12)) == without
        assert len(convex_parts(solid, 12, 0.1)) == with_least
