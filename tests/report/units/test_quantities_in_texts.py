# SPDX-License-Identifier: GPL-3.0-or-later
"""Quantities are read in sentences of any language; formulas, lines for files and the user's names are left alone."""

import pytest

from bridge_demolition_addon.engineering.unit_systems import UnitSystem
from bridge_demolition_addon.report.units.quantities import IN_METRIC, ReportUnits

US = ReportUnits(UnitSystem.IMPERIAL, kept=("Span of 13 m", "deck"))


@pytest.mark.parametrize(
    ("metric", "imperial"),
    [
        ("ball of 10.0 t, let go once", "ball of 11.0 short tons, let go once"),
        ("999 kN on Shard 00001 at 0.958 s", "224.6 kip on Shard 00001 at 0.958 s"),
        ("x = -3.11 to 12.76 m, y = 0.5 m", "x = -10.20 to 41.86 ft, y = 1.64 ft"),
        ("von x = -3.11 bis 12.76 m", "von x = -10.20 bis 41.86 ft"),
        ("la mediana está entre 457.5 y 5378 kg", "la mediana está entre 1008.6 y 11856 lb"),
        ("速度达 11.4 m/s\uff08Shard 00020\uff09", "速度达 37.4 ft/s\uff08Shard 00020\uff09"),
        ("11.4 m以内", "37.4 ft以内"),
        ("above (6.5, 0) m", "above (21.3, 0) ft"),
        ("12 345 kg", "27216 lb"),
        ("M_Ed = 5059 kN·m", "M_Ed = 3731 kip·ft"),
        ("a volume of 16.8 m³", "a volume of 22.0 yd³"),
        ("concrete of 30 MPa", "concrete of 4.35 ksi"),
        ("5 kPa at 25.0 m/s²", "0.725 psi at 82.0 ft/s²"),
    ],
)
def test_quantities_are_converted(metric, imperial):
    assert US.text(metric) == imperial
    assert IN_METRIC.text(metric) == metric


@pytest.mark.parametrize(
    "text",
    [
        "v = 1140 mm/s (R/√Q)^-1.6 (free face, average rock)",
        "v = 3.37 cm/s (R / (E / 10 kJ)^(1/3))^-1.66 (Zhou)",
        "  charges.one.position_m.1 = 3.172 m",
        "Report of Span of 13 m",
        "30 CFR 56.6310, of mines; 4 months; in 0.2 s",
        "Ø20 / s, 3 meals, 2 tons, 6 Nm/rad",
    ],
)
def test_the_rest_is_left_alone(text):
    assert US.text(text) == text


def test_distances_that_debris_reaches_are_rounded_up_and_others_are_not():
    assert US.text("debris stayed within 5.0 m of the bridge's plan") == (
        "debris stayed within 16.41 ft of the bridge's plan"
    )
    assert US.text("5.0 m above the ground") == "16.4 ft above the ground"
    assert US.text("bleiben innerhalb von 5.0 m", "debris stayed within 5.0 m") == "bleiben innerhalb von 16.41 ft"


def test_what_a_limit_lies_above_is_rounded_down():
    text = "its limit would lie above 14.9 m and not above 20.0 m"
    assert US.text(text) == "its limit would lie above 48.88 ft and not above 65.62 ft"  # 48.884 and 65.617


def test_headings_have_their_unit_in_brackets_or_are_one():
    assert US.heading("mass (kg)") == "mass (lb)"
    assert US.heading("area of links (mm²/m)") == "area of links (in²/ft)"
    assert US.heading("m²") == "ft²"
    assert US.heading("within 8 ms (kg)") == "within 8 ms (lb)"
    assert US.heading("ball.mass_kg (kg)") == "ball.mass_kg (kg)"  # a key of a file
    assert US.heading("time (s)") == "time (s)"


def test_a_language_may_have_its_own_names_of_units():
    german = ReportUnits(UnitSystem.IMPERIAL, unit_name={"short tons": "US-Tonnen"}.get)
    assert german.text("10.0 t") == "11.0 US-Tonnen"
