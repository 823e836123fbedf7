# SPDX-License-Identifier: GPL-3.0-or-later
"""Second moments of shared faces, against the formulas for rectangles."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.shards import fracture, voronoi_cells
from bridge_demolition_addon.engineering.fracture.shared_faces import touching_faces
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.structure.connections import second_moments


def moments_of(shards, faces):
    return second_moments(shards, faces.pairs[:, 0], faces.areas, faces.centres, faces.normals)


def test_upright_rectangle():
    beam = voronoi_cells(box((2.0, 0.3, 0.8)), np.array([[-0.5, 0.01, 0.02], [0.5, 0.01, 0.02]]))
    # About the level axis b h³/12, about the upright one h b³/12; the cut is across.
    expected = np.diag([0.3 * 0.8**3, 0.8 * 0.3**3]) / 12.0
    np.testing.assert_allclose(moments_of(beam.shards, beam.faces)[0], expected, rtol=1e-9, atol=1e-12)


def test_level_cut_has_z_along_the_road():
    column = voronoi_cells(box((0.5, 0.2, 4.0)), np.array([[0, 0, -1.0], [0, 0, 1.0]]))
    # z runs along x, where the section is 0.5 m deep: ∫ z² dA = 0.2 × 0.5³/12.
    expected = np.diag([0.2 * 0.5**3, 0.5 * 0.2**3]) / 12.0
    np.testing.assert_allclose(moments_of(column.shards, column.faces)[0], expected, rtol=1e-9, atol=1e-12)


def test_every_face_of_a_fracture_is_found():
    deck = fracture(box((6.0, 2.0, 0.5)), 80, seed=3)
    moments = moments_of(deck.shards, deck.faces)
    squares = deck.faces.areas**2 / 12.0
    # No shape of that area has a smaller polar moment than a circle: A²/(2 π), 5 % less than a square's A²/6.
    polar = moments[:, 0, 0] + moments[:, 1, 1]
    assert (polar >= deck.faces.areas**2 / (2 * np.pi) * (1 - 1e-9)).all()
    assert (np.linalg.eigvalsh(moments) > 0.0).all()
    # A square would be the mark of a face that was not found.
    assert not np.isclose(moments[:, 0, 0], squares, rtol=1e-9, atol=0.0).any()


def test_face_that_is_part_of_a_larger_one_is_taken_for_a_square():
    solids = [box((4.0, 4.0, 1.0), (0, 0, 2.5)), box((1.0, 2.0, 2.0), (0, 0, 1.0))]
    shards = [part for solid in solids for part in fracture(solid, 1, seed=0).shards]
    faces = touching_faces(shards, member=np.arange(2))
    assert faces.areas == pytest.approx([2.0])
    np.testing.assert_allclose(moments_of(shards, faces)[0], np.eye(2) * 4.0 / 12.0, rtol=1e-9)


def test_no_faces():
    nothing = np.zeros((0, 3))
    assert second_moments([], np.zeros(0, int), np.zeros(0), nothing, nothing).shape == (0, 2, 2)
