# SPDX-License-Identifier: GPL-3.0-or-later
"""Poisson's effect on members of rigid shards, against sums done by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.member_shapes import (
    contraction_ratios,
    contraction_shares,
    member_shapes,
    plate_turning,
    ratios_in_lattices,
    shifting_moduli,
)
from bridge_demolition_addon.engineering.geometry.solids import box

YOUNG, SHEAR = np.array([30e9]), np.array([12.5e9])  # Poisson's ratio 0.2
BAR, PLATE = member_shapes([box((12.0, 1.0, 1.0))]), member_shapes([box((12.0, 6.0, 0.6))])
NONE = contraction_ratios(np.zeros(1), SHEAR / YOUNG)


def test_faces_across_and_along_a_bar_yield_together_as_the_shear_modulus_says():
    along, aside = np.array([(1.0, 0.0, 0.0)]), np.array([(0.0, 1.0, 0.0)])
    across = shifting_moduli(BAR, NONE, along, YOUNG, SHEAR)[0]
    lengthwise = shifting_moduli(BAR, NONE, aside, YOUNG, SHEAR)[0]
    assert 1.0 / across[1, 1] + 1.0 / lengthwise[0, 0] == pytest.approx(1.0 / SHEAR[0])
    assert across[0, 0] == pytest.approx(YOUNG[0])


def test_a_plate_resists_bending_more_and_twist_less():
    """a = 1.25 and b = 0.4167 for a ratio of 0.2; irregular shards have 0.65 of what differs from 1."""
    normal, one = np.array([(0.6, 0.8, 0.0)]), np.ones(1)
    beside = np.array((-0.8, 0.6, 0.0))
    ratios = contraction_ratios(one, SHEAR / YOUNG)
    turning = plate_turning(np.eye(3)[None], PLATE, ratios, normal)[0]
    assert beside @ turning @ beside == pytest.approx(1.0 + 0.65 * 0.25)
    assert normal[0] @ turning @ normal[0] == pytest.approx(1.0 - 0.65 * 0.58333, rel=1e-5)
    moduli = shifting_moduli(PLATE, ratios, normal, YOUNG, SHEAR)[0] / YOUNG[0]
    assert normal[0] @ moduli @ normal[0] == pytest.approx(1.0 + 0.65 * 0.25)
    assert beside @ moduli @ beside == pytest.approx(1.0 - 0.65 * 0.58333, rel=1e-5)


def test_a_face_in_the_plane_of_a_plate_is_as_stiff_as_before_across():
    flat = np.array([(0.0, 0.0, 1.0)])
    moduli = shifting_moduli(PLATE, contraction_ratios(np.ones(1), SHEAR / YOUNG), flat, YOUNG, SHEAR)[0]
    assert np.isfinite(moduli).all()
    assert moduli[2, 2] == pytest.approx(30e9 / 1.4)


@pytest.mark.parametrize(("shards", "share"), [(2, 0.0), (8, 0.5), (18, 1.0), (600, 1.0)])
def test_rows_of_shards_beside_each_other_contract_a_plate(shards, share):
    """Square cells in 12 m × 6 m: 2 in one row, 8 in two rows, 18 in three rows."""
    assert contraction_shares(PLATE, np.array([shards])) == pytest.approx(share)
    assert contraction_shares(BAR, np.array([shards])) == pytest.approx(0.0)


@pytest.mark.parametrize("aside", [0.5, 0.4])
@pytest.mark.parametrize("row_m", [0.8, 0.5 * 3.0**0.5, 0.95])
def test_lattices_bend_and_twist_as_a_plate_does(aside, row_m):
    """Energy of one triangle of points, evenly curved: Kirchhoff's (κx² + κy² + 2 ν κx κy + 2 (1 - ν) κxy²) / (1 - ν²).

    A face has the length beside its edge that the triangle's circumcentre is away from it, so cot γ / 2 of the edge.
    """
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (aside, row_m)])
    pairs, poisson = np.array([(0, 1), (1, 2), (2, 0)]), 0.2
    across, along = ratios_in_lattices(pairs, corners, np.full(3, 1.0 / 2.4))
    for curved in (np.diag([1.0, 0.0]), np.diag([0.0, 1.0]), np.eye(2), np.diag([1.0, -1.0]), np.eye(2)[::-1]):
        energy = 0.0
        for row, (one, other) in enumerate(pairs):
            edge = corners[other] - corners[one]
            legs = corners[[one, other]] - corners[3 - one - other]
            cotangent = float(legs[0] @ legs[1]) / abs(float(np.linalg.det(legs)))
            normal = edge / np.linalg.norm(edge)
            beside = np.array([-normal[1], normal[0]])
            bent, twisted = normal @ curved @ normal, normal @ curved @ beside
            energy += 0.5 * cotangent * (edge @ edge) * (across[row] * bent**2 + along[row] * twisted**2)
        (x, xy), (_, y) = curved
        plate = (x**2 + y**2 + 2.0 * poisson * x * y + 2.0 * (1.0 - poisson) * xy**2) / (1.0 - poisson**2)
        assert energy == pytest.approx(plate * 0.5 * row_m)


def test_obtuse_triangles_have_the_ratio_of_regular_ones():
    _, along = ratios_in_lattices(
        np.array([(0, 1), (1, 2), (2, 0)]), np.array([(0, 0), (1, 0), (2, 0.3)]), np.full(3, 1 / 2.4)
    )
    assert along == pytest.approx((1.0 - 3.0 * 0.2) / (1.0 - 0.2**2))
