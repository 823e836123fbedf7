# SPDX-License-Identifier: GPL-3.0-or-later
"""Buckling curves against the tables of EN 1993-1-1."""

import pytest

from bridge_demolition_addon.engineering.elasticity.buckling_curves import reduction_factor


@pytest.mark.parametrize(
    ("curve", "at_half", "at_one", "at_two"),
    [
        ("a", 0.924, 0.666, 0.2229),
        ("b", 0.884, 0.597, 0.2095),
        ("c", 0.843, 0.540, 0.1962),
        ("d", 0.779, 0.467, 0.1766),
    ],
)
def test_buckling_curves(curve, at_half, at_one, at_two):
    """Ordinates of the curves as tables of EN 1993-1-1 have them (figure 6.4, ECCS publication 33)."""
    assert reduction_factor([0.0, 0.2, 0.5, 1.0, 2.0], curve) == pytest.approx(
        [1.0, 1.0, at_half, at_one, at_two], abs=1e-3
    )
