# SPDX-License-Identifier: GPL-3.0-or-later
"""Ground vibration against the published formula, in its own units and the other way round."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.vibration import (
    CONFINED,
    DAMAGE_LIMIT_M_S,
    FREE_FACE_AVERAGE,
    GROUNDS,
    charge_per_delay,
    distance_for_velocity,
    peak_particle_velocity,
)
from bridge_demolition_addon.errors import BlastError


def test_velocity_at_unit_scaled_distance_is_the_constant():
    for ground in GROUNDS.values():
        assert peak_particle_velocity(3.0, 9.0, ground) == pytest.approx(ground.velocity_m_s)


def test_velocity_by_hand():
    # R/√Q = 100/√25 = 20; 20^1.6 = 120.68; 1140/120.68 = 9.446 mm/s.
    assert 1e3 * peak_particle_velocity(100.0, 25.0) == pytest.approx(9.446, abs=5e-4)
    assert peak_particle_velocity(100.0, 25.0, CONFINED) == pytest.approx(
        peak_particle_velocity(100.0, 25.0) * 5 / 1.14
    )


def test_average_rock_is_160_inches_per_second_at_1_foot_per_root_pound():
    inch, foot, pound = 0.0254, 0.3048, 0.45359237
    metric = 160.0 * inch * (np.sqrt(pound) / foot) ** -FREE_FACE_AVERAGE.exponent
    # 1143 mm/s, which the standard rounds to 1140.
    assert metric == pytest.approx(FREE_FACE_AVERAGE.velocity_m_s, rel=0.003)


def test_charge_and_distance_are_its_inverses():
    distances = np.array([5.0, 14.0, 300.0])
    for ground in GROUNDS.values():
        for limit in (DAMAGE_LIMIT_M_S, 0.007):
            charges = charge_per_delay(distances, limit, ground)
            np.testing.assert_allclose(peak_particle_velocity(distances, charges, ground), limit, rtol=1e-13)
            np.testing.assert_allclose(distance_for_velocity(charges, limit, ground), distances, rtol=1e-13)


def test_less_with_distance_more_with_charge():
    assert (np.diff(peak_particle_velocity(np.arange(1.0, 100.0), 10.0)) < 0.0).all()
    assert (np.diff(peak_particle_velocity(10.0, np.arange(0.0, 100.0))) > 0.0).all()
    assert peak_particle_velocity(10.0, 0.0) == 0.0


def test_impossible_numbers_are_refused():
    with pytest.raises(BlastError, match="distance is 0: expected a number above 0"):
        peak_particle_velocity([1.0, 0.0], 1.0)
    with pytest.raises(BlastError, match="distance is 0"):
        charge_per_delay(0.0)
    for wrong in (-1.0, np.nan, np.inf):
        with pytest.raises(BlastError, match="charge is"):
            peak_particle_velocity(1.0, wrong)
        with pytest.raises(BlastError, match="distance is"):
            peak_particle_velocity(wrong, 1.0)
        with pytest.raises(BlastError, match="limit is"):
            charge_per_delay(1.0, wrong)
    with pytest.raises(BlastError, match="limit is 0"):
        distance_for_velocity(1.0, 0.0)
