# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections against tables (ArcelorMittal, Sections and Merchant Bars; EN 10210-2; EN 10365), and by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.steelwork.catalogue import rolled_names, section_named
from bridge_demolition_addon.engineering.steelwork.resistance import DENSITY_KG_M3, strengths_pa
from bridge_demolition_addon.errors import ScenarioError

pytestmark = pytest.mark.slow

CM2, CM3, CM4 = 1e-4, 1e-6, 1e-8

# A (cm²), Iy, Iz, IT (cm⁴), Wel,y, Wpl,y, Wpl,z (cm³), Avz (cm²) of the tables.
TABLES = {
    "IPE 200": (28.48, 1943, 142.4, 6.98, 194.3, 220.6, 44.61, 14.00),
    "IPE 300": (53.81, 8356, 603.8, 20.12, 557.1, 628.4, 125.2, 25.68),
    "IPE 600": (156.0, 92080, 3387, 165.4, 3069, 3512, 485.6, 83.78),
    "HEA 200": (53.83, 3692, 1336, 20.98, 388.6, 429.5, 203.8, 18.08),
    "HEB 200": (78.08, 5696, 2003, 59.28, 569.6, 642.5, 305.8, 24.83),
    "HEB 300": (149.1, 25170, 8563, 185.0, 1678, 1869, 870.1, 47.43),
    "HEM 300": (303.1, 59200, 19400, 1408, 3482, 4078, 1913, 90.53),
}

MASSES_KG_M = {
    "IPE": ("6.0 8.1 10.4 12.9 15.8 18.8 22.4 26.2 30.7 36.1 42.2 49.1 57.1 66.3 77.6 90.7 106 122"),
    "HEA": (
        "16.7 19.9 24.7 30.4 35.5 42.3 50.5 60.3 68.2 76.4 88.3 97.6 105 112 125 140 155 166 178 190 204 224 252 272"
    ),
    "HEB": ("20.4 26.7 33.7 42.6 51.2 61.3 71.5 83.2 93.0 103 117 127 134 142 155 171 187 199 212 225 241 262 291 314"),
    "HEM": ("41.8 52.1 63.2 76.2 88.9 103 117 157 172 189 238 245 248 250 256 263 270 278 285 293 301 317 333 349"),
}
"""Masses by length of EN 10365, in the order of the table."""


@pytest.mark.parametrize("name", TABLES)
def test_rolled_sections_are_those_of_the_tables(name):
    area, strong, weak, torsion, elastic, plastic, plastic_weak, shear = TABLES[name]
    section = section_named(name)
    assert section.area_m2 == pytest.approx(area * CM2, rel=1e-3)
    np.testing.assert_allclose(np.diagonal(section.shape.second_moments_m4), [strong * CM4, weak * CM4], rtol=1e-3)
    assert section.torsion_m4 == pytest.approx(torsion * CM4, rel=2e-3)
    assert section.shape.elastic_moduli_m3[0] == pytest.approx(elastic * CM3, rel=1e-3)
    np.testing.assert_allclose(section.shape.plastic_moduli_m3, [plastic * CM3, plastic_weak * CM3], rtol=2e-3)
    assert section.plastic_shear_areas_m2[1] == pytest.approx(shear * CM2, rel=2e-3)


@pytest.mark.parametrize("series", MASSES_KG_M)
def test_every_rolled_section_has_the_mass_of_the_table(series):
    names = [name for name in rolled_names() if name.startswith(series)]
    masses = list(map(float, MASSES_KG_M[series].split()))
    of_names = [DENSITY_KG_M3 * section_named(name).area_m2 for name in names]
    # 0.5 % of rounding to three digits, and of a density of 7.85.
    np.testing.assert_allclose(of_names, masses, rtol=0.008)


def test_tubes_are_those_of_en_10210():
    square, round_tube = section_named("SHS 100x5"), section_named("CHS 168.3x8")
    assert square.area_m2 == pytest.approx(18.7 * CM2, rel=3e-3)
    assert square.shape.second_moments_m4[0, 0] == pytest.approx(279 * CM4, rel=3e-3)
    assert square.shape.plastic_moduli_m3[0] == pytest.approx(66.4 * CM3, rel=3e-3)
    assert square.torsion_m4 == pytest.approx(439 * CM4, rel=5e-3)
    assert round_tube.area_m2 == pytest.approx(40.3 * CM2, rel=1e-3)
    assert round_tube.shape.second_moments_m4[0, 0] == pytest.approx(1297 * CM4, rel=5e-3)
    assert round_tube.shape.plastic_moduli_m3[0] == pytest.approx(206 * CM3, rel=5e-3)
    assert round_tube.torsion_m4 == pytest.approx(2595 * CM4, rel=1e-3)


def test_plates_by_hand():
    """I 1000x300x10x20: W_pl = 300 × 20 × 980 + 10 × 960² / 4; an unsymmetric one by its equal-area axis."""
    girder = section_named("I 1000x300x10x20")
    assert girder.area_m2 == pytest.approx(21600e-6)
    assert girder.shape.plastic_moduli_m3[0] == pytest.approx(8.184e-3)
    assert girder.shape.second_moments_m4[0, 0] == pytest.approx((300 * 1000**3 - 290 * 960**3) / 12 * 1e-12)
    # Flanges of 200 × 20 and 400 × 20, web 10 × 960: half of 21600 mm² is 8000 in the bottom flange and 280 mm of web.
    other = section_named("PG 1000x10x200x20x400x20")
    by_hand = 8000 * 290 + 2800 * 140 + 6800 * 340 + 4000 * 690
    assert other.shape.plastic_moduli_m3[0] == pytest.approx(by_hand * 1e-9)


def test_a_box_an_angle_a_channel_and_a_tee_by_hand():
    box = section_named("BOX 400x300x10x20")
    assert box.area_m2 == pytest.approx((400 * 300 - 280 * 360) * 1e-6)
    assert box.shape.second_moments_m4[0, 0] == pytest.approx((300 * 400**3 - 280 * 360**3) / 12e12)
    # Bredt: 4 A² / Σ (s / t) with the middle line of 380 × 290.
    assert box.torsion_m4 == pytest.approx(4 * (380 * 290) ** 2 / (2 * 380 / 10 + 2 * 290 / 20) * 1e-12)
    corner = section_named("L 100x100x10")
    assert corner.area_m2 == pytest.approx(1900e-6)
    # About the centre at (100 × 10 × 5 + 90 × 10 × 55) / 1900 = 28.68 mm; tables with fillets have 177 cm⁴.
    assert corner.shape.second_moments_m4[0, 0] == pytest.approx(180.0 * CM4, rel=5e-3)
    assert corner.shape.second_moments_m4[0, 1] == pytest.approx(106.6 * CM4, rel=5e-3)
    channel = section_named("U 200x75x8.5x11.5")
    assert channel.shape.second_moments_m4[0, 0] == pytest.approx((75 * 200**3 - 66.5 * 177**3) / 12e12)
    tee = section_named("T 200x200x10x15")
    assert tee.area_m2 == pytest.approx((200 * 15 + 185 * 10) * 1e-6)


def test_names_may_be_written_in_several_ways():
    assert section_named("he 300 b").name == section_named("HEB300").name == "HEB 300"
    assert section_named("IPE300").area_m2 == section_named("ipe 300").area_m2


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("HEB 310", "HEB 300"),
        ("UNP 200", "expected one"),
        ("RHS 200x100", "RHS height x width x thickness"),
        ("I 100x100x10x60", "thinner"),
        ("CHS 0x5", "above 0"),
    ],
)
def test_unknown_sections_are_refused_with_what_is_known(name, message):
    with pytest.raises(ScenarioError, match=message):
        section_named(name)


def test_thick_plates_yield_earlier():
    assert strengths_pa("S355", 0.04) == (355e6, 490e6)
    assert strengths_pa("S355", 0.041) == (335e6, 470e6)
