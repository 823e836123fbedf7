# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads of an explosion step by step: each adds up to the whole, and follows the bodies."""

from itertools import pairwise

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.hulls import convex_hulls
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.explosion import Explosion, StepLoads, sum_of_loads
from bridge_demolition_addon.model.blast.settings import BlastSettings
from bridge_demolition_addon.scene.blast.force_fields import LONGEST_M, WIDEST_M, isolating_reaches

CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
IMPULSE_AT_5_PA_S = 40.62
"""Incident impulse of 1 kg of TNT in free air at Z = 5; Kingery and Bulmash (1984), as ConWep prints it."""


def explosion(*charges, **options):
    return Explosion(charges, convex_hulls([CUBE, CUBE]), BlastSettings(**({"start_s": 0.0} | options)))


def charge(place, mass=1.0, delay=0.0):
    return Charge(name=str(place), position_m=place, mass_kg=mass, delay_ms=1e3 * delay)


CENTRES = np.array([[5.0, 0.0, 0.0], [0.0, 10.0, 0.0]])
UPRIGHT = np.tile(np.eye(3), (2, 1, 1))
EIGHTH = np.array([[np.sqrt(0.5), -np.sqrt(0.5), 0.0], [np.sqrt(0.5), np.sqrt(0.5), 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize("steps", [1, 7, 400])
def test_steps_of_any_length_add_up_to_the_impulse_of_the_table(steps):
    blast = explosion(charge((0, 0, 0)), start_s=0.02)
    times = np.linspace(0.0, 0.1, steps + 1)
    total = np.zeros((2, 3))
    for start, end in pairwise(times):
        total += blast.loads(start, end, CENTRES, UPRIGHT).vectors(2)
    assert total[0] == pytest.approx([IMPULSE_AT_5_PA_S, 0.0, 0.0], rel=2e-4)


def test_charges_that_touch_and_go_off_together_load_as_one():
    """Half a kilogram of TNT is a ball of 42 mm: two of them 80 mm apart have the impulse of one kilogram."""
    halves = charge((0.04, 0.0, 0.0), 0.5), charge((-0.04, 0.0, 0.0), 0.5)
    once = explosion(*halves).loads(0.0, 0.1, CENTRES, UPRIGHT)
    assert once.vectors(2)[0, 0] == pytest.approx(IMPULSE_AT_5_PA_S, rel=1e-3)
    assert once.impulses_ns[0] == pytest.approx(once.impulses_ns[1], rel=0.02)
    one_later = charge((0.04, 0.0, 0.0), 0.5), charge((-0.04, 0.0, 0.0), 0.5, delay=0.001)
    beside = charge((0.0, 0.0, 0.0), 0.5), charge((0.0, 0.0, 0.1), 0.5)
    for two_waves in (one_later, beside):
        loads = explosion(*two_waves).loads(0.0, 0.1, CENTRES, UPRIGHT)
        assert loads.vectors(2)[0, 0] > 1.2 * IMPULSE_AT_5_PA_S


@pytest.mark.parametrize("options", [{}, {"model": "kinney-graham", "constant_decay": 1.0}, {"loading": "reflected"}])
def test_twice_the_pressure_is_twice_the_impulse_at_the_same_times(options):
    charges = charge((0, 0, 0)), charge((2, 2, 0), 3.0, delay=0.01)
    whole, twice = (explosion(*charges, pressure_factor=factor, **options) for factor in (1.0, 2.0))
    for start, end in pairwise(np.linspace(0.0, 0.1, 20)):
        one, other = (explosion.loads(start, end, CENTRES, UPRIGHT) for explosion in (whole, twice))
        np.testing.assert_array_equal(other.impulses_ns, 2.0 * one.impulses_ns)
        np.testing.assert_array_equal(other.peaks_pa, 2.0 * one.peaks_pa)
        np.testing.assert_array_equal((other.bodies, other.charges), (one.bodies, one.charges))


def test_a_charge_finds_the_bodies_where_they_are_when_it_detonates():
    blast = explosion(charge((0, 0, 0)), charge((0, 0, 0), delay=0.5))
    first = blast.loads(0.0, 0.4, CENTRES, UPRIGHT)
    later = blast.loads(0.4, 1.0, CENTRES[::-1], UPRIGHT)
    assert first.stand_offs_m.tolist() == [5.0, 10.0]
    assert later.stand_offs_m.tolist() == [10.0, 5.0]
    assert first.vectors(2)[0, 0] == pytest.approx(later.vectors(2)[1, 0])


def test_areas_follow_the_turning():
    blast = explosion(charge((0, 0, 0)))
    turned = np.stack((EIGHTH, np.eye(3)))
    assert blast.loads(0.0, 1.0, CENTRES, turned).areas_m2 == pytest.approx([np.sqrt(2.0), 1.0])


def test_quiet_before_between_and_after():
    blast = explosion(charge((0, 0, 0)), charge((0, 0, 0), delay=0.5), start_s=0.1)
    assert blast.is_quiet(0.0, 0.1)
    assert not blast.is_quiet(0.0, 0.11)
    assert not len(blast.loads(0.1, 0.105, CENTRES, UPRIGHT))  # the front takes 9 ms to the nearer body
    assert blast.is_quiet(0.1, 0.105)
    blast.loads(0.105, 0.2, CENTRES, UPRIGHT)
    assert blast.is_quiet(0.2, 0.6)
    assert not blast.is_quiet(0.2, 0.61)
    blast.loads(0.2, 1.0, CENTRES, UPRIGHT)
    assert blast.is_quiet(1.0, 1e6)


def test_no_charges_and_charges_of_nothing_load_nothing():
    assert not len(explosion().loads(0.0, 1.0, CENTRES, UPRIGHT))
    assert not len(explosion(charge((0, 0, 0), mass=0.0)).loads(0.0, 1.0, CENTRES, UPRIGHT))
    assert explosion().is_quiet(0.0, 1.0)


def test_a_body_behind_another_gets_nothing_where_it_is_shielded():
    centres = np.array([[3.0, 0.0, 0.0], [6.0, 0.0, 0.0]])
    open_air = explosion(charge((0, 0, 0))).loads(0.0, 1.0, centres, UPRIGHT)
    shielded = explosion(charge((0, 0, 0)), shielding=True).loads(0.0, 1.0, centres, UPRIGHT)
    assert open_air.impulses_ns[1] > 10.0
    assert shielded.impulses_ns[0] == open_air.impulses_ns[0]
    assert shielded.impulses_ns[1] == 0.0


def test_loads_of_two_steps_become_those_of_one():
    blast = explosion(charge((0, 0, 0)), charge((1, 0, 0), delay=0.001))
    whole = explosion(charge((0, 0, 0)), charge((1, 0, 0), delay=0.001)).loads(0.0, 0.05, CENTRES, UPRIGHT)
    steps = ((0.0, 0.0105), (0.0105, 0.0121), (0.0121, 0.05))
    parts = [blast.loads(start, end, CENTRES, UPRIGHT) for start, end in steps]
    for name in whole.__dataclass_fields__:
        np.testing.assert_allclose(getattr(sum_of_loads(parts), name), getattr(whole, name), rtol=1e-12)
    assert not len(sum_of_loads([]))


def test_steps_that_load_the_same_pairs_add_up_as_those_that_do_not():
    """A last step with one pair fewer takes the other way; its pair must have the bits of the shorter sum."""
    random = np.random.default_rng(8)
    columns = {"bodies": np.array([0, 0, 2]), "charges": np.array([0, 1, 1]), "directions": np.ones((3, 3))}
    steps = []
    for _ in range(10):
        values = {name: random.random(3) for name in StepLoads.__dataclass_fields__ if name not in columns}
        steps.append(StepLoads(**columns, **values))
    last = StepLoads(*(getattr(steps[-1], name)[:2] for name in StepLoads.__dataclass_fields__))
    same, other = sum_of_loads(steps), sum_of_loads([*steps[:-1], last])
    for name in StepLoads.__dataclass_fields__:
        np.testing.assert_array_equal(getattr(same, name)[:2], getattr(other, name)[:2])


def test_no_field_holds_the_centre_of_another_body():
    generator = np.random.default_rng(3)
    centres = generator.uniform(0.0, 10.0, (200, 3))
    directions = generator.normal(size=(200, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    reaches = isolating_reaches(np.arange(200), directions, centres)
    between = centres[None] - centres[:, None]
    along = np.einsum("kni,ki->kn", between, directions)
    across = np.sqrt(np.maximum(np.einsum("kni,kni->kn", between, between) - along**2, 0.0))
    inside = (across < reaches.radii_m[:, None]) & (along < reaches.ahead_m[:, None])
    inside &= along > -reaches.behind_m[:, None]
    np.testing.assert_array_equal(inside, np.eye(200, dtype=bool))
    # Room to move: to the side 0.45 of the way to the nearest, ahead 0.45 of √(1 - 0.9²) of it at the least.
    nearest = np.sort(np.linalg.norm(between, axis=2), axis=1)[:, 1]
    np.testing.assert_allclose(reaches.radii_m, 0.45 * nearest)
    assert (np.minimum(reaches.ahead_m, reaches.behind_m) >= 0.45 * np.sqrt(1.0 - 0.9**2) * nearest).all()


def test_a_body_by_itself_has_all_the_room():
    reaches = isolating_reaches(np.array([0]), np.array([[1.0, 0.0, 0.0]]), np.zeros((1, 3)))
    assert (reaches.radii_m, reaches.ahead_m, reaches.behind_m) == (WIDEST_M, LONGEST_M, WIDEST_M)
    assert reaches.contain(np.array([[19.0, 4.0, 0.0]]), np.array([[1.0, 0.0, 0.0]])).tolist() == [True]
    assert reaches.contain(np.array([[1.0, 6.0, 0.0]]), np.array([[1.0, 0.0, 0.0]])).tolist() == [False]
