# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections that are recognised by their sizes or outline: what was drawn has to come back, wherever it lies."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.named_sections import (
    moved,
    placed_by_sizes,
    rolled_name,
    section_of_outline,
)
from bridge_demolition_addon.errors import ScenarioError

SHAPES = (
    *("I 900x300x12x25", "PG 1200x12x400x25x500x40", "BOX 400x300x10x20", "L 100x100x10", "L 150x90x12"),
    *("U 200x75x8.5x11.5", "T 200x150x10x15", "FLAT 100x20", "SHS 100x5", "RHS 200x100x8", "IPE 300"),
    *("HEA 200", "HEB 1000", "HEM 300"),
)


def turned(points, degrees, shift=(0.0, 0.0)):
    angle = math.radians(degrees)
    return points @ np.array([(math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))]) + shift


def covered(section, placed):
    """Outline of a recognised section where it was found."""
    y = placed.y_axis
    axes = np.array([y, (-y[1], y[0])])
    return np.concatenate(section.rings) @ axes + placed.centre_m


def same_points(one, other, within_m):
    apart = np.linalg.norm(one[:, None] - other[None], axis=2)
    return apart.min(axis=0).max() < within_m and apart.min(axis=1).max() < within_m


@pytest.mark.parametrize("degrees", [0.0, 30.0, 90.0, -135.0, 180.0])
@pytest.mark.parametrize("name", SHAPES)
def test_an_outline_is_that_of_its_section_however_it_is_turned(name, degrees):
    rings = [turned(ring, degrees, (0.3, -1.2)) for ring in section_named(name).rings]
    found = section_of_outline(rings)
    assert found is not None
    assert found.section.area_m2 == pytest.approx(section_named(name).area_m2, rel=1e-6)
    assert same_points(covered(found.section, found), np.concatenate(rings), 1e-5)


def test_a_round_tube_has_its_corners_on_two_circles():
    """CHS 168.3 x 8 of 36 chords."""
    angles = np.linspace(0.0, 2.0 * math.pi, 36, endpoint=False)
    circle = np.column_stack((np.cos(angles), np.sin(angles)))
    found = section_of_outline([0.08415 * circle + (0.3, 1.0), 0.07615 * circle[::-1] + (0.3, 1.0)])
    assert found.name == "CHS 168.3x8"
    assert found.centre_m == pytest.approx((0.3, 1.0), abs=1e-9)


def test_a_rounded_outline_with_many_corners_is_rolled():
    """IPE 200 by EN 10365, with arcs of 6 chords at its roots."""
    height, width, web, flange, radius = 0.200, 0.100, 0.0056, 0.0085, 0.012
    arc = [
        (web / 2 + radius * (1 - math.sin(a)), height / 2 - flange - radius * (1 - math.cos(a)))
        for a in np.linspace(0.0, math.pi / 2, 7)
    ]
    quarter = [(width / 2, height / 2), (width / 2, height / 2 - flange), *arc]
    right = [*quarter, *[(x, -z) for x, z in reversed(quarter)]]
    ring = np.array([*right, *[(-x, -z) for x, z in right]])
    found = section_of_outline([ring])
    assert found.name == "IPE 200"
    assert found.centre_m == pytest.approx((0.0, 0.0), abs=1e-9)


def test_older_channels_with_sloping_flanges_have_their_mean_thickness():
    """UPN 200 by DIN 1026-1: 75 mm wide, web 8.5 mm, flange 11.5 mm in the middle, sloping by 8 %."""
    inner = [(0.0085, 0.1 - 0.0115 - 0.08 * 0.029), (0.075, 0.1 - 0.0115 + 0.08 * 0.0375)]
    ring = np.array(
        [(0.0, -0.1), (0.075, -0.1), *[(x, -z) for x, z in reversed(inner)], *inner, (0.075, 0.1), (0.0, 0.1)]
    )
    shape, sizes = section_of_outline([ring]).name.split()
    assert shape == "U"
    assert [float(size) for size in sizes.split("x")] == pytest.approx([200.0, 75.0, 8.5, 11.5], abs=0.5)


def test_what_is_no_section_is_none():
    triangle = np.array([(0.0, 0.0), (0.1, 0.0), (0.0, 0.1)])
    cross = np.array([(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)])
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    assert section_of_outline([triangle]) is None
    assert section_of_outline([cross * 0.1]) is None
    assert section_of_outline([square, square * 0.1 + 0.1]) is None  # a hole in one corner
    assert section_of_outline([square, square * 0.1 + 0.2, square * 0.1 + 0.6]) is None


@pytest.mark.parametrize(
    ("sizes_mm", "name"),
    [
        ((300.0, 150.0, 7.1, 10.7), "IPE 300"),
        ((190.0, 200.0, 6.5, 10.0), "HEA 200"),
        ((200.0, 200.0, 9.0, 15.0), "HEB 200"),
        ((190.4, 200.0, 6.5, 10.0), "HEA 200"),  # rounded to mm
        ((300.0, 150.0, 7.1, 11.0), None),
        ((304.0, 165.0, 6.1, 10.2), None),  # UB 305 x 165 x 40
    ],
)
def test_rolled_sections_are_known_by_their_sizes(sizes_mm, name):
    """EN 10365:2017; the last is of BS 4-1, which the table does not have."""
    assert rolled_name([1e-3 * size for size in sizes_mm]) == name


def test_an_i_section_with_another_root_radius_than_the_rolled_one_is_welded():
    sizes = [0.300, 0.150, 0.0071, 0.0107]
    assert placed_by_sizes("I", sizes, 0.015).name == "IPE 300"
    assert placed_by_sizes("I", sizes).name == "IPE 300"
    assert placed_by_sizes("I", sizes, 0.005).name == "I 300x150x7.1x10.7"


def test_the_middle_of_the_box_is_not_the_centre_of_an_angle():
    """L 100 x 100 x 10, sharp: its centre is (100·10·50 + 90·10·5) / 1900 = 28.7 mm from both outer sides."""
    placed = placed_by_sizes("L", [0.1, 0.1, 0.01])
    assert placed.centre_m == pytest.approx((-0.05 + 0.0286842,) * 2, abs=1e-6)


@pytest.mark.parametrize("name", ["L 150x90x12", "U 200x75x8.5x11.5", "T 200x150x10x15", "PG 1200x12x400x25x500x40"])
def test_a_mirrored_section_is_one_that_is_turned(name):
    shape, sizes = name.split()
    placed = placed_by_sizes(shape, [1e-3 * float(size) for size in sizes.split("x")])
    angle = math.radians(20.0)
    found = moved(placed, np.array([math.cos(angle), math.sin(angle)]), np.array([0.2, 0.1]), mirrored=True)
    drawn = covered(placed.section, placed) * (-1.0, 1.0)
    assert same_points(covered(found.section, found), turned(drawn, 20.0, (0.2, 0.1)), 1e-9)


def test_sizes_that_are_no_section_are_refused():
    with pytest.raises(ScenarioError, match="plates thinner"):
        placed_by_sizes("I", [0.1, 0.1, 0.01, 0.06])
