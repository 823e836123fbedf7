# SPDX-License-Identifier: GPL-3.0-or-later
"""Lorry and person are as large as they are said to be, and of few triangles."""

import numpy as np
import pytest

from bridge_demolition_addon.display.approaches import LORRY_M, PERSON_M, lorry, person
from bridge_demolition_addon.engineering.geometry.mesh import joined_meshes


def test_a_person_of_175_cm_stands_at_height_0():
    solid = joined_meshes([part.solid for part in person(3.0, -2.0)])
    low, high = solid.bounds
    assert PERSON_M == 1.75
    assert (low[2], high[2]) == pytest.approx((0.0, 1.75))
    assert (low + high)[:2] / 2.0 == pytest.approx((3.0, -2.0), abs=0.05)
    assert 0.4 < high[0] - low[0] < 0.9
    assert len(solid.triangles) < 400


def test_a_lorry_of_8_m_stands_on_its_wheels():
    parts = lorry(3.0, -2.0)
    solid = joined_meshes([part.solid for part in parts])
    low, high = solid.bounds
    assert high - low == pytest.approx(LORRY_M, abs=0.05)
    assert low[0] == pytest.approx(3.0, abs=0.05) and low[2] == pytest.approx(0.0, abs=1e-6)
    assert len(solid.triangles) < 800
    assert all(np.isfinite(part.solid.vertices).all() and part.solid.volume > 0.0 for part in parts)
