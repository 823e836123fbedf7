# SPDX-License-Identifier: GPL-3.0-or-later
"""Utilisation and breaking against sections worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest
from reference import strength as reference

from bridge_demolition_addon.engineering.mechanics.section_cuts import SectionForces
from bridge_demolition_addon.engineering.mechanics.strength import (
    MATERIALS,
    Ductility,
    Strength,
    largest_utilisations,
    rectangular_sections,
    utilisation,
)
from bridge_demolition_addon.errors import ScenarioError

STRENGTH = Strength.in_n_mm2(compression=40.0, tension=4.0, shear=2.0, torsion=2.0, bending=5.0)


def square_sections(areas):
    """Squares of areas in m², two of their sides level."""
    return rectangular_sections(areas, areas[:, None, None] ** 2 / 12.0 * np.eye(2))


# A square of 2 m: area 4 m², W = 8/6 m³.
SQUARE = square_sections(np.array([4.0]))
MODULUS = 8.0 / 6.0


def section_forces(axial=0.0, shear=(0.0, 0.0), torsion=0.0, bending=(0.0, 0.0)):
    return SectionForces(np.array([axial]), np.array([shear]), np.array([torsion]), np.array([bending]))


def used(sections=SQUARE, strength=STRENGTH, **forces):
    return utilisation(section_forces(**forces), sections, strength)[0]


def rectangle(width, depth):
    """Area, and second moments about the level axis and the steep one."""
    return np.array([width * depth]), np.array([np.diag([width * depth**3 / 12, depth * width**3 / 12])])


@pytest.mark.parametrize(
    "forces, expected",
    [
        ({"axial": 4e6}, 1e6 / 4e6),  # 1 N/mm² of 4 in tension
        ({"axial": -4e6}, 1e6 / 40e6),
        ({"shear": (3e6, 4e6)}, 1.25e6 / 2e6),  # 5 MN over 4 m²
        ({"bending": (MODULUS * 1e6, 0)}, 1e6 / 5e6),
        ({"bending": (0, -MODULUS * 1e6)}, 1e6 / 5e6),
        ({"bending": (MODULUS * 1e6, MODULUS * 1e6)}, 2e6 / 5e6),  # at the corner
        # Stretched edge: tension by its strength and bending by its own.
        ({"axial": 4e6, "bending": (MODULUS * 1e6, 0)}, 1 / 4 + 1 / 5),
        # 3 N/mm² of bending less 1 of compression leave 2 at the stretched edge; 4 of 40 at the pressed one are less.
        ({"axial": -4e6, "bending": (MODULUS * 3e6, 0)}, 2 / 5),
        # 9 of compression and 1 of bending: only the pressed edge counts.
        ({"axial": -36e6, "bending": (MODULUS * 1e6, 0)}, 10 / 40),
        # A half of each: √(½² + ½²).
        ({"axial": 8e6, "shear": (4e6, 0)}, np.sqrt(0.5)),
        ({}, 0.0),
    ],
)
def test_square_section(forces, expected):
    # Rounding only.
    assert used(**forces) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("noise", [1e-18, -1e-18, 1e-14])
def test_rounding_does_not_turn_a_square(noise):
    """Principal axes of a square are any: at 45° bending about a side would count √2 times."""
    moments = 16.0 / 12.0 * np.eye(2) + np.array([[0.0, noise], [noise, 0.0]])
    sections = rectangular_sections(np.array([4.0]), moments[None])
    assert used(sections, bending=(MODULUS * 1e6, 0)) == pytest.approx(1e6 / 5e6, rel=1e-12)


@pytest.mark.parametrize("forces", [{"axial": 16e6}, {"axial": -160e6}, {"shear": (8e6, 0)}])
def test_breaks_at_its_strength_and_not_before(forces):
    assert used(**{name: 0.999 * np.asarray(value) for name, value in forces.items()}) < 1.0
    assert used(**{name: 1.001 * np.asarray(value) for name, value in forces.items()}) > 1.0


def test_torsion_of_a_square():
    # Largest shear stress T / (0.208 a³) (Timoshenko 1955, table of section 62); the formula used gives 0.2083.
    assert used(torsion=2e6 * 0.208 * 8.0) == pytest.approx(1.0, rel=0.002)
    # It adds to shear, whichever way it turns.
    assert used(torsion=-1e6, shear=(4e6, 0)) == pytest.approx(used(torsion=1e6) + used(shear=(4e6, 0)))


@pytest.mark.parametrize("ratio, coefficient", [(1.0, 0.208), (1.5, 0.231), (2.0, 0.246), (4.0, 0.282), (10.0, 0.312)])
def test_torsion_of_rectangles(ratio, coefficient):
    """Against the exact T = k b c² (Timoshenko 1955, section 62); the formula is good within 5 %."""
    section = rectangular_sections(*rectangle(ratio * 0.5, 0.5))
    assert section.torsion_moduli_m3[0] == pytest.approx(coefficient * ratio * 0.5**3, rel=0.05)


def test_a_flat_slab_bends_about_its_two_axes():
    width, depth = 6.0, 0.5
    section = rectangular_sections(*rectangle(width, depth))
    assert used(section, bending=(1e6 * width * depth**2 / 6, 0)) == pytest.approx(1 / 5)
    assert used(section, bending=(0, 1e6 * depth * width**2 / 6)) == pytest.approx(1 / 5)


def test_a_turned_slab_bends_like_a_flat_one():
    """The same rectangle, turned by 30° in its plane together with its moment."""
    width, depth, turn = 6.0, 0.5, np.radians(30)
    area, flat = rectangle(width, depth)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    turned = rectangular_sections(area, rotation @ flat @ rotation.T)
    moment = np.array([2e5, 7e5])
    assert used(turned, bending=rotation @ moment) == pytest.approx(
        used(rectangular_sections(area, flat), bending=moment)
    )


@pytest.mark.parametrize("parts", [2, 3, 10])
def test_cutting_a_section_into_parts_changes_nothing_under_axial_force_and_shear(parts):
    whole = {"axial": 5e6, "shear": (2e6, -1e6)}
    part = {name: np.asarray(value) / parts**2 for name, value in whole.items()}
    assert used(square_sections(np.array([4.0 / parts**2])), **part) == pytest.approx(used(**whole), rel=1e-13)


@pytest.mark.parametrize("parts", [1, 2, 5])
def test_cutting_a_section_into_parts_keeps_its_edge_stress_in_bending(parts):
    """A moment on the whole is axial force plus a small moment on each part; the edge has the same stress."""
    edge_stress, depth = 2e6, 2.0
    side = depth / parts
    middle = (depth - side) / 2
    stress_in_middle, stress_over_part = edge_stress * middle / (depth / 2), edge_stress * (side / 2) / (depth / 2)
    strength = Strength.in_n_mm2(compression=40.0, tension=5.0, shear=2.0, torsion=2.0, bending=5.0)
    outermost = used(
        square_sections(np.array([side**2])),
        strength,
        axial=stress_in_middle * side**2,
        bending=(stress_over_part * side**3 / 6, 0),
    )
    assert outermost == pytest.approx(edge_stress / 5e6)


def test_steel_yields_by_von_mises():
    normal, shear = 150e6, 80e6
    expected = np.sqrt(normal**2 + 3 * shear**2) / 235e6
    # 135.7 N/mm² is 235/√3 rounded to 1e-4.
    assert used(strength=MATERIALS["steel"], axial=4 * normal, shear=(4 * shear, 0)) == pytest.approx(
        expected, rel=2e-4
    )


def test_reinforcement_of_the_presets():
    """Their tension, bending and links from the bars they stand for: 5 of 10 mm, links of 6 mm, 150 mm × 250 mm."""
    width, depth, yield_stress = 150.0, 250.0, 500.0
    bars = 5 * np.pi * 10.0**2 / 4
    lever = depth - 2 * 20.0 - 10.0
    column = MATERIALS["reinforced concrete column"]
    # Presets are rounded to two digits, 12.6 to three.
    assert column.tension_pa / 1e6 == pytest.approx(bars * yield_stress / (width * depth), rel=0.01)
    moment = bars / 2 * yield_stress * lever
    assert column.bending_pa / 1e6 == pytest.approx(moment / (width * depth**2 / 6), rel=0.005)
    links = 2 * np.pi * 6.0**2 / 4 / 100.0
    carried = links * 0.9 * (depth - 20.0 - 5.0) * yield_stress
    assert column.shear_pa / 1e6 == pytest.approx(carried / (width * depth), rel=0.02)


@pytest.mark.parametrize("name", MATERIALS)
def test_presets_make_sense(name):
    strength = MATERIALS[name]
    assert strength.compression_pa >= strength.tension_pa
    assert strength.compression_pa > strength.shear_pa
    assert 1e5 <= strength.bending_pa <= 235e6


def test_every_connection_can_have_a_strength_of_its_own():
    forces = SectionForces(np.full(3, 4e6), np.zeros((3, 2)), np.zeros(3), np.zeros((3, 2)))
    sections = square_sections(np.full(3, 4.0))
    strength = replace(STRENGTH, tension_pa=np.array([2e6, 4e6, 2e6]))
    assert utilisation(forces, sections, strength) == pytest.approx([1 / 2, 1 / 4, 1 / 2])


def test_connections_without_an_area_or_with_unknown_forces_have_no_utilisation():
    forces = SectionForces(np.array([1.0, np.nan]), np.zeros((2, 2)), np.zeros(2), np.zeros((2, 2)))
    values = utilisation(forces, square_sections(np.array([0.0, 4.0])), STRENGTH)
    assert np.isnan(values).all()


def test_no_connections():
    none = SectionForces(np.zeros(0), np.zeros((0, 2)), np.zeros(0), np.zeros((0, 2)))
    assert utilisation(none, square_sections(np.zeros(0)), STRENGTH).shape == (0,)


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf, np.array([1.0, 0.0])])
def test_impossible_strengths_are_refused(value):
    with pytest.raises(ScenarioError, match="tension_pa"):
        Strength(1.0, value, 1.0, 1.0, 1.0)


@pytest.mark.parametrize("share, elongation", [(-0.1, 0.1), (1.1, 0.1), (np.nan, 0.1), (0.5, -0.1), (0.5, np.nan)])
def test_impossible_ductility_is_refused(share, elongation):
    with pytest.raises(ScenarioError, match="expected 0"):
        Ductility(share, elongation)


def test_no_force_and_moment_use_more_than_the_bounds():
    """Whatever their directions; and the bounds are no more than twice what the worst along an axis uses."""
    random = np.random.default_rng(5)
    count = 500
    areas, moments = zip(*(rectangle(*sides) for sides in random.uniform(0.1, 3.0, (count, 2))), strict=True)
    sections = rectangular_sections(np.concatenate(areas), np.concatenate(moments))
    strength = Strength(*random.uniform(1e5, 1e8, (5, count)))
    by_force, by_moment = largest_utilisations(sections, strength)

    def used_by(force, moment):
        return utilisation(SectionForces(force[:, 0], force[:, 1:], moment[:, 0], moment[:, 1:]), sections, strength)

    for share in random.uniform(0.0, 1.0, 100):
        directions = random.normal(size=(2, count, 3))
        directions /= np.linalg.norm(directions, axis=-1)[..., None]
        most = share * by_force + (1.0 - share) * by_moment
        assert (used_by(share * directions[0], (1.0 - share) * directions[1]) <= (1.0 + 1e-12) * most).all()
    none, axes = np.zeros((count, 3)), [np.tile(axis, (count, 1)) for axis in (*np.eye(3), *-np.eye(3))]
    assert (by_force <= 2.0 * np.max([used_by(axis, none) for axis in axes], axis=0)).all()
    assert (by_moment <= 2.0 * np.max([used_by(none, axis) for axis in axes], axis=0)).all()


def test_friction_helps_pressed_faces_alone():
    """EN 1992-1-1:2004, equation 6.25: v = c + μ σ. A face of 1 m² with 2 MN of shear and 1 MN/m² of strength."""
    sections = rectangular_sections(np.ones(3), np.tile(np.eye(2) / 12.0, (3, 1, 1)))
    forces = SectionForces(
        axial_n=np.array([-1e6, 1e3, -4e6]),
        shear_n=np.tile((2e6, 0.0), (3, 1)),
        torsion_nm=np.zeros(3),
        bending_nm=np.zeros((3, 2)),
    )
    strength = Strength(1e12, 1e12, 1e6, 1e12, 1e12)
    assert utilisation(forces, sections, strength) == pytest.approx([2.0, 2.0, 2.0], rel=1e-5)
    assert utilisation(forces, sections, strength, np.full(3, 0.7)) == pytest.approx([1.3, 2.0, 0.0], abs=1e-5)


def test_the_core_has_what_numpy_has():
    rng = np.random.default_rng(5)
    count = 5000
    areas = 10.0 ** rng.uniform(-4.0, 2.0, count) * (rng.random(count) > 0.01)
    roots = rng.normal(size=(count, 2, 2)) * np.where(rng.random(count) < 0.2, 1e-6, 1.0)[:, None, None]
    moments = roots @ np.swapaxes(roots, 1, 2)
    moments[:200] = np.eye(2) * rng.uniform(0.1, 9.0, (200, 1, 1))  # squares
    moments[200:400] = [np.diag(pair) for pair in rng.uniform(0.1, 9.0, (200, 2))]
    with np.errstate(all="ignore"):
        own, by_numpy = rectangular_sections(areas, moments), reference.rectangular_sections(areas, moments)
    for name in ("areas_m2", "directions", "bending_moduli_m3", "torsion_moduli_m3"):
        np.testing.assert_array_equal(getattr(own, name), getattr(by_numpy, name), err_msg=name)
    strength = Strength(*(10.0 ** rng.uniform(5.0, 9.0, count) for _ in range(5)))
    forces = SectionForces(*(1e6 * rng.normal(size=shape) for shape in ((count,), (count, 2), (count,), (count, 2))))
    for friction in (None, rng.uniform(0.0, 1.5, count)):
        expected = reference.utilisation(forces, by_numpy, strength, friction)
        np.testing.assert_array_equal(utilisation(forces, own, strength, friction), expected)
