# SPDX-License-Identifier: GPL-3.0-or-later
"""Bolts by their pattern: bearing, block tearing and moments against a published example and by hand."""

import math

import pytest

from bridge_demolition_addon.engineering.steelwork.bolted_ends import bolted_end
from bridge_demolition_addon.engineering.steelwork.bolts import bolts_named
from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.errors import ScenarioError

PARTIAL_FACTOR = 1.25
"""γ_M2, with which resistances are published; the program has none."""

KN = 1e3


def end(bolts, section="FLAT 150x10", grade="S355"):
    return bolted_end(bolts_named(bolts), section_named(section), grade)


SHEAR_CONNECTION = "3 M20 8.8 in 1 line in double shear, p1 100, e1 60, e2 50, gusset 20 S275"
"""thestructuralengineer.info, Shear bolt connection EC3: three M20 8.8 in double shear, plate of 20 mm of S275,
e1 = 60, e2 = 50, p1 = 100 mm, 500 kN at 50 mm from the bolts."""


def test_a_published_connection_bears_what_its_author_found():
    """F_v,Rd = 188.2 kN; F_b,Rd = 2.5 · 0.9 · 430 · 20 · 20 / 1.25 = 309.6 kN, with 60 / 66 rounded to 0.9."""
    joint = end(SHEAR_CONNECTION, "FLAT 120x20", "S275")
    assert joint.bolt_n / PARTIAL_FACTOR == pytest.approx(188.2 * KN, rel=0.001)
    assert joint.bearing_n[-1, 0] / PARTIAL_FACTOR == pytest.approx(309.6 * KN * (60 / 66) / 0.9, rel=1e-6)
    assert joint.bearing_n[-1, 0] / PARTIAL_FACTOR == pytest.approx(309.6 * KN, rel=0.011)


def test_the_farthest_bolt_of_a_published_connection_carries_what_its_author_found():
    """Each bolt has 500 / 3 = 166.6 kN, the outer ones 500 · 0.05 / 0.2 = 125 kN of the moment: √(166.6² + 125²)."""
    joint = end(SHEAR_CONNECTION, "FLAT 120x20", "S275")
    assert joint.farthest_bolt_n(500 * KN, 0.0, 25 * KN) == (
        pytest.approx(166.67 * KN, rel=1e-4),
        pytest.approx(125.0 * KN, rel=1e-9),
    )
    # 208.3 kN, more than 188.2 kN, so the author takes a larger bolt: here 208.3 by 235.2 kN, without partial factor.
    assert joint.farthest_bolt_used(500 * KN, 0.0, 25 * KN) == pytest.approx(208.33 / 235.2, rel=1e-4)
    assert joint.moment_nm == pytest.approx(joint.bolt_n * 0.2, rel=1e-9)


PLATE = "4 M20 8.8 in 2 lines, p1 70, p2 70, e1 40, e2 40, gusset 8"


def test_bearing_of_each_bolt_is_that_by_hand():
    """Gusset of 8 mm of S355. Last row: 40 / 66 = 0.606; first: 70 / 66 - 0.25 = 0.811; k_1 = 2.5, as
    2.8 · 40 / 22 - 1.7 = 3.39 and 1.4 · 70 / 22 - 1.7 = 2.75. 2.5 · 490 · 20 · 8 = 196.0 kN: 118.8 and 158.9 kN, more
    than a bolt in shear, 117.6 kN.
    """
    joint = end(PLATE)
    assert joint.bearing_n.tolist() == [
        [pytest.approx(158.9 * KN, rel=1e-3)] * 2,
        [pytest.approx(118.8 * KN, rel=1e-3)] * 2,
    ]
    assert joint.bolts_n == pytest.approx(4 * 117.6 * KN, rel=1e-9)


def test_where_no_bolt_is_sheared_first_bearing_adds_up():
    """Gusset of 5 mm: 74.2 and 99.3 kN, less than 117.6 kN: 3.7 has their sum, 2 · (74.24 + 99.34) = 347.2 kN."""
    joint = end(PLATE.replace("gusset 8", "gusset 5"))
    assert joint.bolts_n == pytest.approx(347.2 * KN, rel=1e-3)


def test_across_the_bar_bearing_is_towards_its_edge():
    """Lines: 40 / 66 and 70 / 66 - 0.25; k_1 by e1 of the last row, 2.5: as along it, as the distances are alike."""
    joint = end(PLATE)
    assert joint.shear_n == pytest.approx(joint.bolts_n, rel=1e-9)
    far = end(PLATE.replace("e2 40", "e2 30"))
    # 2.8 · 40 / 22 - 1.7 = 3.39 > 2.5 of e1 beside; 30 / 66 = 0.4545 towards the edge: 89.1 kN, 4 of them.
    assert far.shear_n == pytest.approx(4 * 89.09 * KN, rel=1e-3)


def test_a_bolt_in_single_shear_bears_no_more_than_one_row_does():
    """3.6.1 (10): 1.5 · 490 · 20 · 10 = 147 kN; gusset and bar of 10 mm, 2.5 · min(60 / 66, 1) would be 222.7 kN."""
    alone = end("1 M20 8.8, e1 60, e2 50, gusset 10", "FLAT 100x10")
    assert alone.bearing_n.tolist() == [[pytest.approx(147.0 * KN, rel=1e-9)]]


def test_blocks_tear_by_hand():
    """FLAT 150x10 of S355. Shear along a line: 40 + 70 - 1.5 · 22 = 77 mm. Between the lines: 48 mm in tension, two in
    shear, 10 · (48 · 490 + 2 · 77 · 355 / √3) = 550.8 kN; from an edge: 48 + 40 - 11 = 77 mm, one in shear,
    10 · (77 · 490 + 77 · 205) = 535.1 kN; the gusset of 8 mm between the lines: 440.7 kN.
    """
    assert end(PLATE).block_n == pytest.approx(440.7 * KN, rel=1e-3)
    assert end(PLATE.replace("gusset 8", "gusset 12")).block_n == pytest.approx(535.1 * KN, rel=1e-3)
    assert end(PLATE.replace("gusset 8", "gusset 12").replace("e2 40", "e2 30"), "HEB 300").block_n == pytest.approx(
        550.8 * 1.1 * KN, rel=1e-3
    )  # a web of 11 mm, without edges; the gusset has 12 mm


def test_an_angle_on_one_leg_by_hand():
    """L 100x10, sharp corners, 1900 mm²; hole of 22 mm. Two bolts, p1 = 70 = 3.18 holes: β_2 = 0.4 + 0.3 · 0.273 =
    0.482; three: β_3 = 0.555. A_net = 1680 mm², f_u = 490: 396.6 and 456.5 kN. One: 2 · (40 - 11) · 10 · 490 =
    284.2 kN. Block from the edge: 29 mm in tension by half, 77 mm in shear:
    10 · (0.5 · 29 · 490 + 77 · 205) = 228.9 kN.
    """
    two, three, one = (
        end(f"{bolts}, e1 40, e2 40, gusset 12", "L 100x100x10")
        for bolts in ("2 M20 8.8 in 1 line, p1 70", "3 M20 8.8 in 1 line, p1 70", "1 M20 8.8")
    )
    assert (two.net_n, three.net_n, one.net_n) == (
        pytest.approx(396.6 * KN, rel=1e-3),
        pytest.approx(456.5 * KN, rel=1e-3),
        pytest.approx(284.2 * KN, rel=1e-3),
    )
    assert two.block_n == pytest.approx(228.9 * KN, rel=1e-3)
    assert two.axial_n == pytest.approx(min(228.9, 2 * 117.6) * KN, rel=1e-3)


def test_the_moment_of_a_pattern_is_by_its_polar_moment():
    """Six bolts, 3 · 2: I_p = 4 · 70² + 6 · 35² = 26 950 mm², the farthest at √(70² + 35²) = 78.3 mm."""
    joint = end("6 M20 8.8 in 2 lines, p1 70, p2 70, e1 40, e2 40, gusset 12")
    assert joint.pattern.polar_m2 == pytest.approx(26950e-6, rel=1e-12)
    assert joint.moment_nm == pytest.approx(117.6 * KN * 26950e-6 / 78.262e-3, rel=1e-4)
    # 60 kN along, 30 kN across and 3 kN·m: 10 + 3.896 kN and 5 + 7.792 kN on a corner.
    along_n, across_n = 10e3 + 3e3 * 35e-3 / 26950e-6, 5e3 + 3e3 * 70e-3 / 26950e-6
    assert joint.farthest_bolt_n(-60 * KN, 30 * KN, -3 * KN) == (
        pytest.approx(along_n, rel=1e-9),
        pytest.approx(across_n, rel=1e-9),
    )
    assert joint.farthest_bolt_used(-60 * KN, 30 * KN, -3 * KN) == pytest.approx(
        math.hypot(along_n, across_n) / 117.6e3, rel=1e-9
    )


def test_in_thin_plates_bearing_both_ways_counts_together():
    """Gusset of 4 mm: 2.5 · 490 · 20 · 4 = 98.0 kN, 59.4 kN along and across, less than a bolt in shear."""
    joint = end(PLATE.replace("gusset 8", "gusset 4"))
    assert joint.farthest_bolt_used(4 * 30e3, 4 * 20e3, 0.0) == pytest.approx(math.hypot(30, 20) / 59.39, rel=1e-3)


def test_long_joints_resist_less():
    """6 rows at 70 mm: 350 mm is 50 beyond 15 · 20: 1 - 50 / (200 · 20) = 0.9875 (3.8)."""
    assert end("6 M20 8.8 in 1 line, p1 70, e1 40, e2 50, gusset 12").bolt_n == pytest.approx(
        0.9875 * 117.6 * KN, rel=1e-9
    )


def test_webs_legs_and_flat_bars_lie_on_a_gusset():
    assert [
        end(PLATE.replace("e2 40", "e2 30"), name).part.thickness_m for name in ("IPE 300", "U 200x75x8.5x11.5")
    ] == [
        pytest.approx(0.0071),
        pytest.approx(0.0085),
    ]
    assert (end(PLATE, "FLAT 150x10").bending_axis, end(PLATE, "FLAT 10x150").bending_axis) == (0, 1)
    assert end("4 M20 8.8") is None


@pytest.mark.parametrize(
    ("bolts", "section", "message"),
    [
        ("4 M20 8.8, p1 70, e1 40, e2 40, gusset 8", "FLAT 150x10", '"p1 70, p2 70, e1 40, e2 40, gusset 12 S355"'),
        ("2 M20 8.8 in 1 line, p1 70, p2 70, e1 40, e2 40, gusset 8", "FLAT 150x10", '"p1 70, e1 40, e2 40, gusset'),
        ("5 M20 8.8 in 2 lines, p1 70, p2 70, e1 40, e2 40, gusset 8", "FLAT 150x10", "as many in each line"),
        (PLATE.replace("p1 70", "p1 40"), "FLAT 150x10", "p1 is 40 mm: expected at least 48.4 mm, 2.2 times"),
        (PLATE.replace("e2 40", "e2 45"), "FLAT 150x10", "needs 160 mm.*has 150 mm: expected fewer lines"),
        (PLATE + " S999", "FLAT 150x10", "the gusset is of S999: expected one of S235"),
        (PLATE, "RHS 200x100x8", "RHS 200x100x8 has not: expected a flat bar"),
    ],
)
def test_what_is_no_pattern_is_refused(bolts, section, message):
    with pytest.raises(ScenarioError, match=message):
        end(bolts, section)
