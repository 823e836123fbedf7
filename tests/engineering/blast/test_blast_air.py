# SPDX-License-Identifier: GPL-3.0-or-later
"""Shock fronts against the limits of the Rankine-Hugoniot relations and against tests with TNT."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.kingery_bulmash import WaveQuantity, evaluate
from bridge_demolition_addon.engineering.blast.wave import (
    AMBIENT_PRESSURE_PA,
    SOUND_SPEED_M_S,
    reflected_overpressure,
    shock_speed,
)

Z = np.geomspace(1.0, 20.0, 200)


def test_a_weak_front_is_sound():
    assert shock_speed(0.0) == SOUND_SPEED_M_S
    # What is left at 1 Pa is of the order of 1 Pa over ambient pressure, 1e-5.
    assert reflected_overpressure(1.0) == pytest.approx(2.0, rel=1e-5)


def test_a_strong_front_reflects_eightfold():
    # At a million atmospheres what is left is of the order of one in a million.
    assert reflected_overpressure(1e11) / 1e11 == pytest.approx(8.0, rel=1e-5)


def test_one_atmosphere_of_overpressure_by_hand():
    # 2 · 11/8 = 2.75 atmospheres; √(13/7) times the speed of sound.
    assert reflected_overpressure(AMBIENT_PRESSURE_PA) == pytest.approx(2.75 * AMBIENT_PRESSURE_PA)
    assert shock_speed(AMBIENT_PRESSURE_PA) == pytest.approx(SOUND_SPEED_M_S * np.sqrt(13.0 / 7.0))


def test_fronts_of_kingery_and_bulmash_obey_it():
    # 1.1 % is how well the independent fits of pressure and velocity agree with each other.
    speeds = shock_speed(evaluate(WaveQuantity.PEAK_OVERPRESSURE, Z))
    np.testing.assert_allclose(speeds, evaluate(WaveQuantity.SHOCK_FRONT_VELOCITY, Z), rtol=0.011)
