# SPDX-License-Identifier: GPL-3.0-or-later
"""Masses and volumes of small bodies are shown with as many digits as those of large ones."""

import pytest

from bridge_demolition_addon.engineering.units import kilograms, mass_text, volume_text, with_digits


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (mass_text(0.37), "0.370 kg"),
        (mass_text(0.0004567), "0.000457 kg"),
        (mass_text(47.06), "47.1 kg"),
        (mass_text(999.4), "999 kg"),
        (mass_text(1000.0), "1.000 t"),
        (mass_text(5000.0, 1), "5.00 t"),
        (mass_text(123456.0, 1), "123.5 t"),
        (mass_text(0.0), "0.000 t"),
        (mass_text(0.37, width=10), "     0.370 kg"),
        (volume_text(0.001157625), "0.00116 m³"),  # the cube of 0.105 m that was measured
        (volume_text(12.3456), "12.346 m³"),
        (kilograms(0.37), "0.370 kg"),
        (kilograms(12345.6), "12 346 kg"),
        (with_digits(0.0, 2), "0.00"),
        (with_digits(float("nan"), 2), "nan"),
        (with_digits(-0.0123456, 1), "-0.0123"),
    ],
)
def test_small_amounts_keep_their_digits(text, expected):
    assert text == expected
