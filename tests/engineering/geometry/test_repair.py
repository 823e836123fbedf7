# SPDX-License-Identifier: GPL-3.0-or-later
"""Broken meshes whose right shape is known: repaired to its volume, or refused with the reason."""

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold
from support.meshes import mesh, moved, of_trimesh, together, turned

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.repair import first_crossing, repaired_solid
from bridge_demolition_addon.engineering.geometry.solids import bodies, box, from_manifold, to_manifold, union
from bridge_demolition_addon.errors import GeometryError

# Volumes of some m³ from coordinates in double precision.
ROUNDING = 1e-12

L_SHAPE = union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])])
HOLLOW = from_manifold(Manifold.cube([4, 4, 2], True) - Manifold.cube([3, 3, 1], True))


def without_faces(mesh, lost):
    return TriangleMesh(mesh.vertices, mesh.triangles[~lost])


def on_plane(mesh, axis, place):
    """Which faces of a mesh lie in the plane at a place along an axis."""
    return (abs(mesh.corners[:, :, axis] - place) < 1e-9).all(axis=1)


def as_soup(mesh):
    """Every triangle with corners of its own, as in an STL file."""
    return TriangleMesh(mesh.corners.reshape(-1, 3), np.arange(3 * len(mesh.triangles)).reshape(-1, 3))


@pytest.mark.parametrize("mesh", [L_SHAPE, HOLLOW, as_soup(L_SHAPE)], ids=["L", "hollow", "soup"])
def test_a_sound_mesh_needs_no_repair(mesh):
    done = repaired_solid(mesh, "it")
    assert done.repairs == ()
    assert done.solid.volume == pytest.approx(mesh.volume, rel=ROUNDING)


def with_joints(mesh, seed):
    """A mesh with corners on edges of which one face alone is divided there: CAD closes these by faces without area."""
    chance = np.random.default_rng(seed)
    vertices, triangles = mesh.vertices.tolist(), mesh.triangles.tolist()
    for row in chance.choice(len(triangles), 3, replace=False).tolist():
        a, b, c = triangles[row]
        share = chance.uniform(0.2, 0.8)
        vertices.append([(1.0 - share) * x + share * y for x, y in zip(vertices[a], vertices[b], strict=True)])
        new = len(vertices) - 1
        triangles[row] = [a, new, c]
        triangles += [[new, b, c], [a, b, new]]
    return TriangleMesh(np.array(vertices), np.array(triangles))


@pytest.mark.parametrize("digits", [np.float64, np.float32])
@pytest.mark.parametrize("tilt_rad", [0.0, np.pi / 2, 0.4])
def test_triangles_without_area_are_taken_into_their_neighbours(tilt_rad, digits):
    """The L of 7 m³, closed at joints of three faces, keeps its volume, and its shards hold all of it."""
    for seed in range(6):
        joined = turned(turned(with_joints(L_SHAPE, seed), 0.3, [0, 0, 1]), tilt_rad, [1, 0, 0])
        done = repaired_solid(TriangleMesh(joined.vertices.astype(digits).astype(float), joined.triangles), "it")
        assert len(done.repairs) == 1 and done.repairs[0].endswith("triangles without area into their neighbours")
        assert done.solid.volume == pytest.approx(7.0, rel=1e-6)
        assert fracture(done.solid, 9, seed).volumes.sum() == pytest.approx(done.solid.volume, rel=ROUNDING)


def test_a_mesh_inside_out_is_turned():
    assert repaired_solid(L_SHAPE.flipped(), "it").solid.volume == pytest.approx(7)


@pytest.mark.parametrize("turned", [[0], [3, 4, 7], [0, 1, 2, 3, 4, 5]])
def test_faces_that_look_the_wrong_way_are_turned(turned):
    faces = L_SHAPE.triangles.copy()
    faces[turned] = faces[turned][:, ::-1]
    done = repaired_solid(TriangleMesh(L_SHAPE.vertices, faces), "it")
    assert done.repairs == (f"turned {len(turned)} faces",)
    assert done.solid.volume == pytest.approx(7, rel=ROUNDING)


def test_cavities_stay_cavities_when_faces_are_turned():
    faces = HOLLOW.triangles.copy()
    inner = (abs(HOLLOW.corners).max(axis=(1, 2)) < 1.6).nonzero()[0]
    assert len(inner) == 12
    for chosen in ([inner[0]], [*inner[:3], (set(range(len(faces))) - set(inner)).pop()]):
        broken = faces.copy()
        broken[chosen] = broken[chosen][:, ::-1]
        done = repaired_solid(TriangleMesh(HOLLOW.vertices, broken), "it")
        assert done.solid.volume == pytest.approx(4 * 4 * 2 - 3 * 3 * 1, rel=ROUNDING)


@pytest.mark.parametrize("turn", [0.0, 1.1])
@pytest.mark.parametrize("axis, place", [(2, 3.5), (0, 2.0), (1, 0.5), (1, -0.5)])
def test_plane_holes_are_closed_even_where_they_are_concave(axis, place, turn):
    # The side at y = 0.5 is the L itself.
    lost = on_plane(L_SHAPE, axis, place)
    done = repaired_solid(turned(without_faces(L_SHAPE, lost), turn, [1, 2, 3]), "it")
    assert done.repairs == ("closed 1 hole",)
    assert done.solid.volume == pytest.approx(7, rel=ROUNDING)


def test_two_holes_are_closed():
    tube = without_faces(box([3, 1, 1]), on_plane(box([3, 1, 1]), 0, 1.5) | on_plane(box([3, 1, 1]), 0, -1.5))
    done = repaired_solid(tube, "it")
    assert done.repairs == ("closed 2 holes",)
    assert done.solid.volume == pytest.approx(3, rel=ROUNDING)


def test_corners_that_nearly_coincide_are_merged():
    # As if rounded to single precision, each face by itself.
    soup = as_soup(L_SHAPE)
    done = repaired_solid(moved(soup, np.random.default_rng(1).uniform(-2e-7, 2e-7, soup.vertices.shape)), "it")
    assert len(done.repairs) == 1 and done.repairs[0].startswith("merged")
    # Corners moved by 2e-7 of some metres.
    assert done.solid.volume == pytest.approx(7, rel=1e-6)


def test_doubled_faces_are_dropped():
    doubled = TriangleMesh(L_SHAPE.vertices, np.concatenate([L_SHAPE.triangles, L_SHAPE.triangles[2:4]]))
    done = repaired_solid(doubled, "it")
    assert done.repairs == ("dropped 2 doubled faces",)
    assert done.solid.volume == pytest.approx(7, rel=ROUNDING)


def test_overlapping_bodies_are_united():
    done = repaired_solid(together(box([4, 1, 1]), box([1, 1, 4], [-1.25, 0.2, 1.5])), "it")
    assert done.repairs == ("united 2 overlapping bodies",)
    # The second is 1 x 0.8 x 1 m deep in the first.
    assert done.solid.volume == pytest.approx(4 + 4 - 0.8, rel=ROUNDING)


def test_bodies_apart_stay_apart():
    done = repaired_solid(together(box([1, 1, 1]), box([1, 1, 1], [5, 0, 0])), "it")
    assert done.repairs == ()
    assert len(bodies(to_manifold(done.solid))) == 2


def twisted():
    """A bar of which one end is turned by half a turn about its axis: its sides cross each other half-way."""
    bar = box([4, 1, 1])
    end = bar.vertices[:, 0] > 0
    vertices = np.array(bar.vertices)
    vertices[end, 1:] *= -1
    vertices[end, 1] *= 0.5
    return TriangleMesh(vertices, bar.triangles)


def bowl():
    """Half a sphere without lid, whose rim leaves its plane."""
    ball = of_trimesh(trimesh.creation.icosphere(2))
    upper = without_faces(ball, (ball.corners[:, :, 2] > 0.3).any(axis=1))
    wavy = np.array(upper.vertices)
    wavy[:, 2] += 0.3 * wavy[:, 0] ** 2 * (wavy[:, 2] > -0.2)
    return TriangleMesh(wavy, upper.triangles)


@pytest.mark.parametrize(
    "mesh, reason",
    [
        (mesh(np.zeros((3, 3)), []), "has no faces"),
        (mesh([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]], [[0, 1, 2]]), "not finite"),
        (mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "encloses no volume"),
        (mesh(box([2, 2, 1]).vertices * (1, 1, 0), box([2, 2, 1]).triangles), "encloses no volume"),
        (box([2, 2, 1e-5]), "is thinner than 0.1 mm; give it a thickness, in metres"),
        (together(box([2, 2, 1]), box([2, 2, 1e-5], [0, 0, 2])), "one of its bodies is thinner than 0.1 mm"),
        (twisted(), "its surface crosses itself near"),
        (bowl(), "is not plane"),
    ],
    ids=["nothing", "not a number", "one triangle", "flat box", "sheet", "box and sheet", "twisted", "bowl"],
)
def test_what_cannot_be_repaired_is_refused_with_the_reason(mesh, reason):
    with pytest.raises(GeometryError, match=f"^it: .*{reason}"):
        repaired_solid(mesh, "it")


def test_crossings_of_triangles_worked_out_by_hand():
    flat = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], dtype=float)
    through = np.array([[1, 1, -1], [1, 1, 1], [9, 9, 0]], dtype=float)
    beside = through + np.array([5, 0, 0])
    resting = np.array([[1, 1, 0], [1, 1, 2], [2, 1, 2]], dtype=float)
    np.testing.assert_allclose(first_crossing(np.stack([flat, through])), [1, 1, 0], atol=1e-12)
    np.testing.assert_allclose(first_crossing(np.stack([through, flat])), [1, 1, 0], atol=1e-12)
    for other in (beside, resting, flat, flat + np.array([4, 0, 0])):
        assert first_crossing(np.stack([flat, other])) is None


@pytest.mark.parametrize(
    "solid", [L_SHAPE, HOLLOW, of_trimesh(trimesh.creation.icosphere(3))], ids=["L", "hollow", "ball"]
)
def test_sound_surfaces_do_not_cross_themselves(solid):
    assert first_crossing(solid.corners) is None
