# SPDX-License-Identifier: GPL-3.0-or-later
"""Bolts against published resistances, and net sections by hand."""

import pytest

from bridge_demolition_addon.engineering.steelwork.bolts import bolts_named
from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.errors import ScenarioError

PARTIAL_FACTOR = 1.25
"""γ_M2, with which resistances are published; the program has none."""


@pytest.mark.parametrize(
    ("bolt", "published_kn"),
    [
        ("1 M16 4.6", 30.1),
        ("1 M20 4.6", 47.0),
        ("1 M24 4.6", 67.8),
        ("1 M30 4.6", 108.0),
        ("1 M16 8.8", 60.3),
        ("1 M20 8.8", 94.1),
        ("1 M24 8.8", 136.0),
        ("1 M30 8.8", 215.0),
        ("1 M20 10.9", 98.0),
        ("1 M24 10.9", 141.0),
        ("1 M20 8.8 in double shear", 188.0),
    ],
)
def test_bolts_resist_in_shear_what_tables_say(bolt, published_kn):
    """SCI P363, Steel building design: design data (the Blue Book), tables of non-preloaded bolts, to three figures."""
    assert bolts_named(bolt).shear_n / PARTIAL_FACTOR / 1e3 == pytest.approx(published_kn, rel=0.005)


def test_the_section_between_holes_is_that_of_a_plate_by_hand():
    """FLAT 150x10 with two holes of 22 mm across: A_net = 1500 - 440 = 1060 mm², 0.9 · 1060 · 360 = 343.4 kN."""
    plate, bolts = section_named("FLAT 150x10"), bolts_named("4 M20 8.8 in 2 lines")
    assert bolts.net_area_m2(plate) == pytest.approx(1060e-6, rel=1e-9)
    assert bolts.net_section_n(plate, 360e6) == pytest.approx(343.44e3, rel=1e-9)
    # Four bolts resist 4 · 117.6 = 470.4 kN, so the plate governs; two of them, 235.2 kN, would.
    assert bolts.resistance_n(plate, 360e6) == pytest.approx(343.44e3, rel=1e-9)
    assert bolts_named("2 M20 8.8").resistance_n(plate, 360e6) == pytest.approx(235.2e3, rel=1e-9)


def test_bolts_lie_in_two_lines_unless_there_is_one():
    assert (bolts_named("8 M20 8.8").lines, bolts_named("1 M20 8.8").lines) == (2, 1)
    assert bolts_named("8 M12 8.8").hole_m == pytest.approx(0.013)
    assert bolts_named("8 M27 8.8").hole_m == pytest.approx(0.030)
    assert bolts_named("welded") is None


@pytest.mark.parametrize(
    ("bolts", "message"),
    [
        ("8x M20 8.8", "expected their number, size and grade"),
        ("8 M21 8.8", "M21: expected one of M12"),
        ("8 M20 9.9", "grade 9.9: expected one of 4.6"),
        ("2 M20 8.8 in 4 lines", "no more lines than bolts"),
        ("0 M20 8.8", "expected their number"),
    ],
)
def test_what_is_no_bolt_is_refused(bolts, message):
    with pytest.raises(ScenarioError, match=message):
        bolts_named(bolts)
