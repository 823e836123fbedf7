# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of the user's own: the same mechanics as those that come with the add-on, from the user's numbers."""

from dataclasses import fields, replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.elasticity.section_stiffness import ELASTIC_MODULI, ElasticModuli
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS, Strength
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import ConnectionBetween, ConnectionSettings, Material
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text

# Stresses of plain concrete, as in `MATERIALS`, and its moduli.
LIKE_CONCRETE = Material(
    name="cores of 2026",
    compression_n_mm2=35.0,
    tension_n_mm2=3.5,
    shear_n_mm2=0.9,
    torsion_n_mm2=3.5,
    bending_n_mm2=3.5,
    elastic_modulus_n_mm2=34_000.0,
    poisson_ratio=0.2,
    density_kg_m3=2390.0,
)
BY_FACE = ConnectionSettings(type="FIXED", method="face", material="cores of 2026")
SCENARIO = replace(I235, materials=(LIKE_CONCRETE,), connections=BY_FACE)


def stresses(strength):
    return [getattr(strength, field.name) for field in fields(Strength)]


def test_own_strengths_and_moduli_are_what_connections_break_and_bend_by():
    (joint,) = replace(SCENARIO, connections=replace(BY_FACE, stiffness="elastic")).joints
    assert stresses(joint.strength) == stresses(MATERIALS["concrete"])
    assert joint.moduli == ELASTIC_MODULI["concrete"]


def test_own_materials_go_between_members_too():
    between = ConnectionBetween(members=("deck", "pier cap"), material="cores of 2026")
    settings = replace(BY_FACE, material="steel", between=(between,))
    own, bearing = replace(SCENARIO, connections=settings).joints
    assert own.strength is MATERIALS["steel"]
    assert stresses(bearing.strength) == stresses(MATERIALS["concrete"])


def test_moduli_that_connections_give_go_before_those_of_the_material():
    materials = (replace(LIKE_CONCRETE, elastic_modulus_n_mm2=None),)
    without = replace(SCENARIO, materials=materials, connections=BY_FACE)
    settings = replace(BY_FACE, stiffness="elastic", elastic_modulus_n_mm2=20_000.0, poisson_ratio=0.1)
    assert replace(without, connections=settings).joints[0].moduli == ElasticModuli(20e9, 0.1)


@pytest.mark.parametrize("factor", [0.5, 1.0, 1.7])
def test_a_factor_is_on_all_strengths_and_on_all_forces(factor):
    between = (
        ConnectionBetween(members=("deck", "pier cap"), breaking_force_n=1000.0),
        ConnectionBetween(members=("pier", "pier"), material="steel"),
        ConnectionBetween(members=("deck", "deck"), type="POINT"),
    )
    settings = replace(BY_FACE, strength_factor=factor, between=between)
    own, force, steel, same = replace(SCENARIO, connections=settings).joints
    assert stresses(own.strength) == [factor * stress for stress in stresses(MATERIALS["concrete"])]
    assert force.breaking_force_n == factor * 1000.0
    assert stresses(steel.strength) == [factor * stress for stress in stresses(MATERIALS["steel"])]
    assert same.strength is own.strength
    by_force = replace(I235.connections, strength_factor=factor)
    assert replace(I235, connections=by_force).joints[0].breaking_force_n == pytest.approx(factor * 98_066.5)


def test_a_bridge_without_density_and_mass_has_the_density_of_its_material():
    given = prepared_members(replace(I235, bridge=replace(I235.bridge, mass_kg=None, density_kg_m3=2390.0)))
    found = prepared_members(replace(SCENARIO, bridge=replace(I235.bridge, mass_kg=None)))
    assert [member.mass_kg for member in found.members] == [member.mass_kg for member in given.members]
    heavy = prepared_members(replace(SCENARIO, bridge=replace(I235.bridge, mass_kg=None, density_kg_m3=3000.0)))
    assert heavy.members[0].density_kg_m3 == 3000.0


def test_materials_are_written_and_read_without_loss():
    assert scenario_from_text(scenario_text(SCENARIO)) == SCENARIO


@pytest.mark.parametrize(
    "changes, message",
    [
        (
            {"materials": ()},
            'connections.material is "cores of 2026": expected one of "concrete", "reinforced concrete column", '
            '"reinforced concrete slab", "reinforced concrete wall", "masonry", "steel", or the name of one of '
            "`[[materials]]`",
        ),
        (
            {"materials": (LIKE_CONCRETE, LIKE_CONCRETE)},
            '[[materials]] number 1 and [[materials]] number 2 have one name, "cores of 2026": expected a name',
        ),
        (
            {"materials": (LIKE_CONCRETE, replace(LIKE_CONCRETE, name="steel"))},
            'materials.name is "steel": expected a name that no other material has',
        ),
        (
            {
                "materials": (replace(LIKE_CONCRETE, elastic_modulus_n_mm2=None),),
                "connections": replace(BY_FACE, stiffness="elastic"),
            },
            'materials.elastic_modulus_n_mm2 is missing: expected it with connections.stiffness "elastic"',
        ),
        (
            {
                "materials": (replace(LIKE_CONCRETE, density_kg_m3=None),),
                "bridge": replace(I235.bridge, mass_kg=None),
            },
            "bridge has no density_kg_m3 or mass_kg: give one of them",
        ),
        (
            {"connections": replace(BY_FACE, between=(ConnectionBetween(members=("a", "b"), material="wood"),))},
            'connections.between.material is "wood": expected one of "concrete"',
        ),
    ],
)
def test_materials_that_are_not_there_or_say_too_little_are_refused(changes, message):
    with pytest.raises(ScenarioError) as refused:
        replace(SCENARIO, **changes)
    assert str(refused.value).startswith(message)


@pytest.mark.parametrize("key", ["compression_n_mm2", "tension_n_mm2", "shear_n_mm2", "torsion_n_mm2", "bending_n_mm2"])
def test_strengths_are_positive_numbers(key):
    with pytest.raises(ScenarioError, match=rf"materials\.{key} is 0\.0: expected a number above 0 \(N/mm²\)"):
        replace(LIKE_CONCRETE, **{key: 0.0})
