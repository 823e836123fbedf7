# SPDX-License-Identifier: GPL-3.0-or-later
"""A shaft that lands, held against balances by hand and against its motion by small steps."""

from dataclasses import replace

import numpy as np
import pytest

from bridge_demolition_addon.engineering.drilled_charges.landing import LandingShaft

G = 9.80665
SHAFT = LandingShaft(7.3, 1.5, 1.5, 4.06e6, 0.387e6, 35e6)


def test_what_is_crushed_takes_the_energy_of_the_whole_fall():
    """4.06 MN fall 3 m, and 0.163 m on against 78.75 MN, 0.345 m against half of that."""
    for crushed_m, force_n in zip(SHAFT.crushed_m(3.0), (78.75e6, 39.375e6), strict=True):
        assert force_n * crushed_m == pytest.approx(4.06e6 * (3.0 + crushed_m))
    assert SHAFT.crushed_m(3.0) == pytest.approx((0.163, 0.345), abs=1e-3)
    assert replace(SHAFT, load_n=50e6).crushed_m(0.1)[1] == np.inf
    assert replace(SHAFT, load_n=80e6).crushed_m(0.1) == (np.inf, np.inf)


def test_it_stands_while_its_load_is_within_the_strip_that_it_crushes():
    """At the limit 4.06 MN press on a strip of 4.06 / (17.5 · 1.5) = 0.155 m at the edge, whose middle is the arm."""
    assert SHAFT.lean_m == pytest.approx(0.75 - 0.155 / 2.0, abs=1e-3)
    assert replace(SHAFT, load_n=50e6).lean_m == 0.0


def test_slender_shafts_buckle_as_they_land():
    """π² E I / l² = f A of a square where l / b = π √(E / 12 f) = 28.3, with 34 GPa."""
    assert not replace(SHAFT, length_m=1.5 * 28.2).buckles
    assert replace(SHAFT, length_m=1.5 * 28.3).buckles


def test_half_the_length_of_a_slender_shaft_tips_it_and_a_third_of_one_without_a_load():
    slender = LandingShaft(100.0, 1.0, 1.0, 1e6, 0.0, 35e6)
    assert slender.tips_from_m == pytest.approx(50.0, rel=1e-3)
    assert replace(slender, weight_n=1e6).tips_from_m == pytest.approx(100.0 / 3.0, rel=1e-3)


def tips(shaft, falls_m):
    """Whether it goes over, by its motion: plastic impacts on both edges one after the other, then steps of 0.2 ms.

    Its mass is that of a block and of a point at its head.
    """
    head, own = (shaft.load_n - shaft.weight_n) / G, shaft.weight_n / G
    half, length = shaft.side_m / 2.0, shaft.length_m
    places = np.array([[0.0, length], [0.0, length / 2.0]])
    masses, spin = np.array([head, own]), own * (shaft.side_m**2 + length**2) / 12.0
    # The block turns about its right edge until it is flat: vertical speed before, turned to the left after.
    arms = places - [half, 0.0]
    about = spin + masses @ (arms**2).sum(axis=1)
    turning = masses @ -arms[:, 0] * np.sqrt(2.0 * G * falls_m) / about
    # Then about its left edge: momentum about it of what turns about the right one.
    velocities = turning * np.column_stack([-arms[:, 1], arms[:, 0]])
    arms = places - [-half, 0.0]
    turning = (spin * turning + masses @ (arms[:, 0] * velocities[:, 1] - arms[:, 1] * velocities[:, 0])) / about
    angle, step_s = 0.0, 2e-4
    while turning > 0.0:
        cosine, sine = np.cos(angle), np.sin(angle)
        levers = arms[:, 0] * cosine - arms[:, 1] * sine
        turning -= step_s * G * (masses @ levers) / about
        angle += step_s * turning
        if angle > 0.5:
            return True
    return False


@pytest.mark.parametrize("weight_n", [0.0, 0.387e6, 2e6, 4.06e6])
@pytest.mark.parametrize(("side_m", "length_m"), [(1.5, 7.3), (0.8, 12.0), (1.0, 3.0)])
def test_the_fall_that_tips_it_is_that_of_its_motion(side_m, length_m, weight_n):
    shaft = replace(SHAFT, side_m=side_m, length_m=length_m, weight_n=weight_n)
    assert not tips(shaft, 0.98 * shaft.tips_from_m)
    assert tips(shaft, 1.02 * shaft.tips_from_m)
    assert replace(shaft, length_m=0.2).tips_from_m > 0.0
