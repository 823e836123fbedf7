# SPDX-License-Identifier: GPL-3.0-or-later
"""Anchorage of straight bars, held against EN 1992-1-1 worked by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.steel_bars import anchorage_length_m, anchored_shares


def test_length_by_hand():
    """f_b = 2.25 × 2.9 N/mm² = 6.525 N/mm² of C30/37; φ 20 mm at 500 N/mm²: 20 / 4 × 500 / 6.525 = 383 mm."""
    assert anchorage_length_m(0.020, 500e6, 2.9e6) == pytest.approx(0.3831, abs=1e-4)


def test_bond_is_even_along_that_length():
    np.testing.assert_allclose(anchored_shares(np.array([-0.1, 0.0, 0.1, 0.4, 9.0]), 0.4), [0.0, 0.0, 0.25, 1.0, 1.0])
