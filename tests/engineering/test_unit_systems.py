# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion into US customary units, against factors as NIST publishes them, and rounding of written numbers."""

from decimal import Decimal

import pytest

from bridge_demolition_addon.engineering.unit_systems import IMPERIAL, Rounding

NIST = {
    "m": 1.0 / 3.048e-01,  # foot
    "mm": 1e-3 / 2.54e-02,  # inch
    "km": 1e3 / 1.609344e03,  # mile
    "m²": 1.0 / 9.290304e-02,  # square foot
    "mm²": 1e-6 / 6.4516e-04,  # square inch
    "m³": 1.0 / 7.645549e-01,  # cubic yard
    "m⁴": 1.0 / 8.630975e-03,  # foot to the fourth power
    "kg": 1.0 / 4.535924e-01,  # pound
    "t": 1e3 / 9.071847e02,  # ton, short (2000 lb)
    "kg/m": 1.0 / 1.488164e00,  # pound per foot
    "kg/m³": 1.0 / 5.932764e-01,  # pound per cubic yard
    "N": 1.0 / 4.448222e00,  # pound-force
    "kN": 1e3 / 4.448222e03,  # kip
    "kN/m": 1.0 / 1.459390e01,  # pound-force per foot, a thousand of them
    "N·m": 1.0 / 1.355818e00,  # pound-force foot
    "kPa": 1e3 / 6.894757e03,  # pound-force per square inch
    "MPa": 1e6 / 6.894757e06,  # ksi
    "kN/m²": 1.0 / 4.788026e01,  # pound-force per square foot, a thousand of them
    "J": 1.0 / 1.355818e00,  # foot pound-force
    "m/s": 1.0 / 3.048e-01,  # foot per second
    "km/h": (1e3 / 3600.0) / 4.4704e-01,  # mile per hour
    "m/s²": 1.0 / 3.048e-01,  # foot per second squared
}
"""NIST SP 811 (2008), appendix B.8: how many of the unit are one metric unit."""


@pytest.mark.parametrize("unit", NIST)
def test_factors_are_those_of_nist(unit):
    assert IMPERIAL[unit].factor == pytest.approx(NIST[unit], rel=5e-7)  # its tables have seven digits


def test_exact_factors_are_exact():
    """The foot, the pound and the kip, whose sizes are exact by NIST SP 811, footnote 22 and section 4."""
    for unit, size in (("m", "0.3048"), ("kg", "0.45359237"), ("kN", "4448.2216152605")):
        conversion = IMPERIAL[unit]
        assert conversion.own_size == Decimal(size)
        assert conversion.number(str(Decimal(size) / conversion.metric_size)).rstrip("0") == "1."


@pytest.mark.parametrize(
    ("metric", "unit", "imperial"),
    [
        ("12.34", "m", "40.49"),
        ("5", "m", "16.4"),  # what a user chose has three digits, though it was written with one
        ("300", "m", "984"),
        ("0.00", "m", "0.00"),
        ("-3.11", "m", "-10.20"),
        ("1e-06", "m²", "1.08e-5"),
        ("50.8", "mm/s", "2.000"),  # 2 in/s of USBM Bulletin 656
        ("2.07", "kPa", "0.300"),  # 0.3 psi of Clancey's table
        ("6.9", "kPa", "1.00"),  # his 1 psi
        ("907.18474", "kg", "2000.00000"),
        ("63000", "kN", "14163.0"),
    ],
)
def test_written_numbers_keep_about_as_many_digits(metric, unit, imperial):
    assert IMPERIAL[unit].number(metric) == imperial


@pytest.mark.parametrize("distance", ["5", "10.8", "25.41", "300", "0.1", "1234.5", "-8.11"])
def test_distances_to_keep_are_rounded_up_and_hardly_more(distance):
    up = Decimal(IMPERIAL["m"].number(distance, Rounding.UP))
    exact = Decimal(distance) / Decimal("0.3048")
    assert abs(exact) <= abs(up) <= abs(exact) * Decimal("1.001")
    assert abs(Decimal(IMPERIAL["m"].number(distance, Rounding.DOWN))) <= abs(exact)
