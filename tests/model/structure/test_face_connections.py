# SPDX-License-Identifier: GPL-3.0-or-later
"""Connections between certain members: which rule counts, and what a model makes of it."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import I235_FILE, ROOT
from support.scenarios import I235

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS, Springs
from bridge_demolition_addon.engineering.structure.connections import GROUND
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import ConnectionBetween, ConnectionSettings
from bridge_demolition_addon.model.scenario.connections import joints_of_connections
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.structure.face_connections import rules_of_pairs
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

SCENARIO = replace(
    I235,
    fracture=replace(I235.fracture, shards=60),
    connections=ConnectionSettings(type="FIXED", method="face", breaking_force_n=1e6),
)


def between(first, second, **settings):
    return ConnectionBetween(members=(first, second), **settings)


def with_rules(*rules, **changes):
    return replace(SCENARIO, connections=replace(SCENARIO.connections, between=rules, **changes))


def kinds_of_pairs(model):
    """Kinds of members, sorted, that each connection holds together."""
    kinds = [*(model.members[row].kind for row in model.member_of_shard), "ground"]
    return [tuple(sorted((kinds[first], kinds[second]))) for first, second in model.connections.pairs]


def as_sets(pairs):
    return {tuple(pair) for pair in pairs.tolist()}


def test_without_rules_all_connections_are_alike():
    assert not build_model(SCENARIO).joint_of_connection.any()


def test_rules_by_kind_take_the_pairs_that_they_name_in_either_order():
    plain = build_model(SCENARIO)
    bearing, inside = ("deck", "pier cap"), ("pier", "pier")
    model = build_model(with_rules(between(*bearing), between(*inside), between("ground", "pier")))
    np.testing.assert_array_equal(model.connections.pairs, plain.connections.pairs)
    kinds = kinds_of_pairs(model)
    assert {tuple(sorted(bearing)), inside, ("ground", "pier"), ("deck", "deck")} <= set(kinds)
    number = {tuple(sorted(bearing)): 1, inside: 2, ("ground", "pier"): 3}
    assert model.joint_of_connection.tolist() == [number.get(kind, 0) for kind in kinds]


def test_rules_by_name_take_one_member_and_the_first_that_fits_counts():
    rules = (between("deck", "pier 1 cap"), between("deck", "pier cap"))
    model = build_model(with_rules(*rules))
    for (first, second), rule in zip(model.connections.pairs, model.joint_of_connection, strict=True):
        names = {model.members[model.member_of_shard[row]].name for row in (first, second) if row != GROUND}
        expected = 1 if names == {"deck", "pier 1 cap"} else 2 if names == {"deck", "pier 2 cap"} else 0
        assert rule == expected


def test_excluded_pairs_are_gone_and_no_others():
    plain, rule = build_model(SCENARIO), between("pier cap", "deck", none=True)
    model = build_model(with_rules(rule, between("ground", "pier", none=True)))
    kinds = kinds_of_pairs(plain)
    gone = {("deck", "pier cap"), ("ground", "pier")}
    assert gone <= set(kinds)
    expected = plain.connections.pairs[[kind not in gone for kind in kinds]]
    np.testing.assert_array_equal(model.connections.pairs, expected)
    assert len(model.connections) == len(model.second_moments_m4) == len(model.joint_of_connection)


def test_excluded_pairs_do_not_count_for_the_limit():
    """A limit is reached by pairs that are connected only, so that another takes the place of an excluded one."""
    limited = build_model(with_rules(between("deck", "deck", none=True), limit_per_shard=3))
    alone = build_model(with_rules(limit_per_shard=3))
    crossing = ("deck", "pier cap")
    assert kinds_of_pairs(limited).count(crossing) > kinds_of_pairs(alone).count(crossing)


def test_members_that_do_not_exist_are_named():
    for name in ("girder", "pier 3"):
        with pytest.raises(ScenarioError, match=rf'number 2: members has "{name}": .* deck, ground, pier, pier cap'):
            build_model(with_rules(between("deck", "pier cap"), between("deck", name)))


def test_rules_of_no_pairs():
    model = build_model(SCENARIO)
    nothing = rules_of_pairs((between("deck", "pier"),), model.members, model.member_of_shard, np.zeros((0, 2), int))
    assert nothing.shape == (0,)


def test_joints_take_over_what_is_not_given():
    settings = ConnectionSettings(
        type="GENERIC",
        free=("turn y",),
        method="face",
        material="concrete",
        between=(
            between("deck", "pier cap", free=("move x", "turn y")),
            between("pier", "pier", type="FIXED"),
            between("deck", "deck", breaking_force_kgf=100.0),
            between("pier", "ground", material="steel"),
        ),
    )
    joints = joints_of_connections(settings)
    assert [joint.type for joint in joints] == ["GENERIC", "GENERIC", "FIXED", "GENERIC", "GENERIC"]
    assert [joint.free for joint in joints] == [("turn y",), ("move x", "turn y"), (), ("turn y",), ("turn y",)]
    assert [joint.breaking_force_n for joint in joints] == [None, None, None, pytest.approx(980.665), None]
    concrete, steel = MATERIALS["concrete"], MATERIALS["steel"]
    assert [joint.strength for joint in joints] == [concrete, concrete, concrete, None, steel]


def test_springs_are_taken_over_together_or_not_at_all():
    settings = ConnectionSettings(
        type="GENERIC_SPRING",
        free=("move z",),
        stiffness_n_m=1e6,
        method="face",
        breaking_force_n=1.0,
        between=(between("deck", "deck", breaking_force_n=2.0), between("pier", "deck", type="FIXED")),
    )
    own, same, fixed = joints_of_connections(settings)
    assert own.springs == same.springs == Springs(stiffness_n_m=1e6)
    assert own.free == same.free == ("move z",)
    assert (fixed.free, fixed.springs) == ((), Springs())


def test_rules_are_written_and_read_without_loss():
    scenario = with_rules(
        between("deck", "pier cap", type="GENERIC", free=("move x", "turn y"), breaking_force_n=5.0),
        between("pier 1", "ground", none=True),
    )
    assert scenario_from_text(scenario_text(scenario)) == scenario
    assert "[[connections.between]]\nmembers = [" in scenario_text(scenario)


@pytest.mark.parametrize(
    "rule, message",
    [
        ({"none": True, "type": "FIXED"}, "between.none is true: expected nothing else but members, found type"),
        ({"breaking_force_n": 1.0, "material": "steel"}, "breaking_force_n and connections.between.material are given"),
        ({"free": ("move up",), "type": "GENERIC"}, "connections.between.free.1 is"),
        ({"type": "SLIDER"}, "connections.between.type is"),
    ],
)
def test_rules_that_contradict_themselves_are_refused(rule, message):
    with pytest.raises(ScenarioError, match=message):
        between("deck", "pier", **rule)


@pytest.mark.parametrize(
    "settings, message",
    [
        (
            {"between": (between("deck", "pier", free=("move x",)),)},
            'between.free is .* expected none with type "FIXED"',
        ),
        ({"free": ("move x",)}, 'connections.free is .* expected none with type "FIXED"'),
        ({"type": "GENERIC", "stiffness_n_m": 5.0}, 'stiffness_n_m is 5.0: expected none with type "GENERIC"'),
        ({"type": "GENERIC_SPRING", "free": ("move x",)}, "stiffness_n_m is missing: expected it or"),
        ({"type": "GENERIC_SPRING", "free": ("turn x",), "stiffness_n_m": 5.0}, 'stiffness_n_m is given: .* a "move"'),
        (
            {
                "type": "GENERIC_SPRING",
                "free": ("turn x", "move y"),
                "stiffness_n_m": 5.0,
                "turning_damping_nms_rad": 1,
            },
            "turning_damping_nms_rad is given: expected connections.turning_stiffness_nm_rad with it",
        ),
        (
            {"between": (between("deck", "pier", material="steel"),), "method": "nearest", "neighbours": 3},
            'between.material is "steel": expected method "face"',
        ),
    ],
)
def test_rules_that_contradict_the_connections_are_refused(settings, message):
    with pytest.raises(ScenarioError, match=message):
        replace(SCENARIO.connections, **settings)


def test_the_example_of_the_documentation_can_be_read_and_built():
    tables = (ROOT / "docs" / "connections.md").read_text(encoding="utf-8").split("```toml")[1].split("```")[0]
    example = I235_FILE.read_text(encoding="utf-8")
    model = build_model(scenario_from_text(example + tables))
    assert set(model.joint_of_connection.tolist()) == {0, 1, 3}


def test_bda_check_lists_the_rules():
    from bridge_demolition_addon.cli.check import scenario_facts

    rules = (
        between("deck", "pier cap", type="GENERIC", free=("move x",), breaking_force_n=2e6),
        between("pier", "ground", none=True),
    )
    found = [" ".join(line.split()) for line in scenario_facts(with_rules(*rules)) if "between" in line]
    assert found == [
        "between deck and pier cap: GENERIC, free: move x, breaking force 2000.00 kN",
        "between pier and ground: none",
    ]
