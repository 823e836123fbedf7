# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scenario with elastic connections needs, and is told where it lacks that."""

from dataclasses import replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.elasticity.section_stiffness import ELASTIC_MODULI, ElasticModuli
from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.connections import ConnectionSettings, joints_of_connections
from bridge_demolition_addon.model.scenario.joint_settings import ConnectionBetween

ELASTIC = ConnectionSettings(type="FIXED", method="face", material="concrete", stiffness="elastic")

TIED = {"ductile_share": 0.5, "ductile_elongation_m": 0.1}


def test_reinforcement_is_of_class_b_unless_another_is_given():
    """EN 1992-1-1:2004, table C.1: f_yk 500 N/mm² here, k at least 1.08, eps_uk at least 5 %."""
    assert replace(ELASTIC, **TIED).steel == Steel(500e6, 1.08, 0.05)
    own = replace(ELASTIC, **TIED, ductile_yield_n_mm2=240.0, ductile_hardening=1.3, ductile_rupture_strain=0.2)
    assert own.steel == Steel(240e6, 1.3, 0.2)


def test_moduli_are_those_of_the_material_unless_others_are_given():
    settings = replace(
        ELASTIC,
        poisson_ratio=0.1,
        between=(
            ConnectionBetween(members=("girder", "girder"), material="steel"),
            ConnectionBetween(members=("pier", "pier"), elastic_modulus_n_mm2=5000.0),
            ConnectionBetween(members=("deck", "pier"), type="GENERIC", free=("turn y",)),
        ),
    )
    own, steel, soft, bearing = joints_of_connections(settings)
    assert own.moduli == ElasticModuli(34e9, 0.1)
    assert steel.moduli == ELASTIC_MODULI["steel"]
    assert soft.moduli == ElasticModuli(5e9, 0.1)
    assert bearing.moduli == own.moduli


def test_every_material_with_strengths_has_moduli():
    assert ELASTIC_MODULI.keys() == MATERIALS.keys()


def test_rigid_connections_have_no_moduli():
    assert all(joint.moduli is None for joint in joints_of_connections(replace(ELASTIC, stiffness="rigid")))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"type": "HINGE"}, "connections.type is 'HINGE': expected one of FIXED, GENERIC, GENERIC_SPRING"),
        (
            {"method": "vertex", "search_radius_m": 1.0, "material": None, "breaking_force_n": 1.0},
            '"face" with stiffness "elastic"',
        ),
        ({"material": None, "breaking_force_n": 1e6}, "connections.material is missing"),
        (
            {"between": (ConnectionBetween(members=("deck", "pier"), breaking_force_n=1.0),)},
            "connections.between has a breaking force",
        ),
        (
            {"between": (ConnectionBetween(members=("deck", "pier"), type="POINT"),)},
            "connections.between.type is 'POINT': expected one of",
        ),
        ({"stiffness": "soft"}, "connections.stiffness"),
        ({"stiffness": "rigid", "poisson_ratio": 0.2}, 'none where connections.stiffness is "rigid"'),
        ({"stiffness": "rigid", "damping_ratio": 0.2}, 'none where connections.stiffness is "rigid"'),
        ({"poisson_ratio": 0.5}, "connections.poisson_ratio"),
        ({"elastic_modulus_n_mm2": 0.0}, "connections.elastic_modulus_n_mm2"),
        ({"elastic_modulus_n_mm2": 1e8}, "connections.elastic_modulus_n_mm2"),
        ({"damping_ratio": 1.5}, "connections.damping_ratio"),
        (TIED | {"stiffness": "rigid", "ductile_rupture_strain": 0.1}, "none but with connections.stiffness"),
        (TIED | {"ductile_hardening": 0.9}, "connections.ductile_hardening"),
        (TIED | {"ductile_rupture_strain": 0.002}, "more than 0.0025, the strain at which the reinforcement yields"),
        (TIED | {"ductile_yield_n_mm2": 2000.0, "ductile_rupture_strain": 0.009}, "more than 0.01, the strain"),
        (TIED | {"ductile_yield_n_mm2": 0.0}, "connections.ductile_yield_n_mm2"),
    ],
)
def test_what_does_not_go_together_is_refused(changes, message):
    with pytest.raises(ScenarioError) as refused:
        replace(ELASTIC, **changes)
    assert message in str(refused.value).replace('"HINGE"', "'HINGE'").replace('"POINT"', "'POINT'")


@pytest.mark.parametrize("numbers", [(0.0, 0.2), (float("nan"), 0.2), (1e9, -0.1), (1e9, 0.5)])
def test_no_material_has_such_moduli(numbers):
    with pytest.raises(ScenarioError, match="expected"):
        ElasticModuli(*numbers)


def test_bars_between_rigid_bodies_are_refused():
    settings = ConnectionSettings(type="FIXED", method="face", material="concrete", stiffness="rigid", **TIED)
    with pytest.raises(ScenarioError, match=r'connections.stiffness is .*expected "elastic" with a connections'):
        replace(I235, connections=settings)


def test_connections_are_elastic_where_nothing_is_said_and_their_material_says_how():
    by_face = ConnectionSettings(type="FIXED", method="face", material="concrete")
    assert replace(I235, connections=by_face).connections.is_elastic
    for settings in (
        replace(by_face, stiffness="rigid"),
        replace(by_face, type="HINGE"),
        replace(by_face, material=None, breaking_force_n=1e5),
        replace(by_face, between=(ConnectionBetween(members=("deck", "pier"), breaking_force_n=1e5),)),
        replace(I235.connections),
    ):
        assert not replace(I235, connections=settings).connections.is_elastic
