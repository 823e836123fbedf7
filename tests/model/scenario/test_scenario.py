# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenarios made in Python: limits of each value, values that contradict each other, and what follows from them."""

import copy
import pickle
from dataclasses import FrozenInstanceError, fields, replace
from fractions import Fraction

import numpy as np
import pytest

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import (
    Ball,
    Bridge,
    ConnectionSettings,
    Deck,
    FractureSettings,
    Ground,
    PictureSettings,
    PierCaps,
    Piers,
    Scenario,
    ShardSettings,
    TimeSettings,
)
from bridge_demolition_addon.model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from bridge_demolition_addon.model.schema import key_fields, shown, subtable_class, subtable_fields

DECK = Deck(width_m=8.5, thickness_m=0.25, overhang_m=0.5)
PIERS = Piers(columns=2, column_length_m=0.7, column_width_m=0.7, height_m=4.9)
BRIDGE = Bridge(density_kg_m3=2400, span_lengths_m=[13, 10.5], deck=DECK, piers=PIERS)
BALL = Ball(mass_kg=10_000, diameter_m=1.34, target_m=[6.5, 0], drop_height_m=5)
CONNECTIONS = ConnectionSettings(search_radius_m=1, breaking_force_kgf=10_000)
NO_STRENGTH = ConnectionSettings(search_radius_m=1)
SCENARIO = Scenario(
    title="two spans",
    time=TimeSettings(duration_s=5),
    bridge=BRIDGE,
    fracture=FractureSettings(shards=200),
    connections=CONNECTIONS,
    ball=BALL,
)
LARGE = replace(SCENARIO, fracture=FractureSettings(shards=LARGE_MODEL))


def all_tables(table_class):
    yield table_class
    for item in subtable_fields(table_class):
        yield from all_tables(subtable_class(item))


def test_defaults():
    assert SCENARIO.seed == 0
    assert replace(SCENARIO.time, duration_s=1) == TimeSettings(
        duration_s=1,
        frames_per_second=24,
        frames_per_second_base=1.0,
        substeps_per_frame=10,
        solver_iterations=10,
        time_scale=1.0,
    )
    assert SCENARIO.ground == Ground(friction=None, restitution=None)
    assert SCENARIO.shards == ShardSettings(
        friction=None,
        restitution=None,
        collision_margin_m=0.0,
        linear_damping=0.04,
        angular_damping=0.1,
        use_deactivation=True,
        start_deactivated=True,
        deactivation_linear_velocity_m_s=0.4,
        deactivation_angular_velocity_rad_s=0.5,
    )
    assert (CONNECTIONS.type, CONNECTIONS.method, CONNECTIONS.limit_per_shard) == ("HINGE", "vertex", 50)
    assert CONNECTIONS.foundation is True
    assert (BALL.release_time_s, BALL.friction, BALL.restitution) == (0.5, None, None)
    assert SCENARIO.pictures == PictureSettings(width_px=1280, height_px=720)
    assert BRIDGE.pier_caps is None
    assert replace(SCENARIO, ball=None).ball is None


def test_every_key_has_a_meaning():
    for table_class in all_tables(Scenario):
        assert table_class.__doc__.strip().endswith(".")
        for item in key_fields(table_class):
            assert item.metadata["key"].description.endswith(".")


def test_every_key_with_a_unit_carries_it_in_its_name():
    in_names = {
        "m": "_m",
        "s": "_s",
        "kg": "_kg",
        "kg/m": "_kg_m",
        "kg/m²": "_kg_m2",
        "kg/m³": "_kg_m3",
        "N": "_n",
        "kgf": "_kgf",
        "px": "_px",
    }
    in_names |= {
        "ms": "_ms",
        "m/s": "_m_s",
        "rad/s": "_rad_s",
        "1/s": "_per_second",
        "1/m": "_per_m",
        "°": "_deg",
        "m³": "_m3",
        "mm": "_mm",
        "mm²": "_mm2",
        "mm²/m²": "_mm2_m2",
        "g": "_g",
        "mm/s": "_mm_s",
        "dB": "_db",
    }
    in_names |= {
        "N/mm²": "_n_mm2",
        "N/m": "_n_m",
        "N/s": "_n_s",
        "N·s/m": "_ns_m",
        "N·m/rad": "_nm_rad",
        "N·m·s/rad": "_nms_rad",
    }
    in_names |= {"MN/m": "_mn_m", "MN·m/rad": "_mnm_rad"}
    in_names |= {"kN/m²": "_kn_m2", "kN": "_kn", "mm": "_mm", "%": "_percent"}
    in_names |= {"MN/m³": "_mn_m3", "kPa": "_kpa", "Hz": "_hz", "h": "_h", "m³/h": "_m3_h", "m/s²": "_m_s2"}
    for table_class in all_tables(Scenario):
        for item in key_fields(table_class):
            unit = item.metadata["key"].unit
            assert not unit or item.name.endswith(in_names[unit])


def test_numbers_become_floats_and_lists_tuples():
    assert BRIDGE.span_lengths_m == (13.0, 10.5)
    assert type(BRIDGE.span_lengths_m[0]) is float
    assert type(BALL.mass_kg) is float
    assert type(Deck(width_m=np.float32(8.5), thickness_m=Fraction(1, 4)).width_m) is float
    assert type(FractureSettings(shards=np.int64(3)).shards) is int


def test_scenarios_cannot_be_changed_and_can_be_compared_hashed_copied_and_pickled():
    with pytest.raises(FrozenInstanceError):
        SCENARIO.seed = 1
    assert not hasattr(SCENARIO, "__dict__")
    assert pickle.loads(pickle.dumps(SCENARIO)) == SCENARIO == copy.deepcopy(SCENARIO)
    assert hash(replace(SCENARIO)) == hash(SCENARIO)
    assert replace(SCENARIO, seed=1) != SCENARIO


def test_breaking_force_in_either_unit():
    assert CONNECTIONS.breaking_force_newton == pytest.approx(98_066.5, rel=1e-15)
    assert ConnectionSettings(method="face", breaking_force_n=7).breaking_force_newton == 7.0


def test_large_model_without_a_strength_breaks_by_that_of_a_material():
    by_face = ConnectionSettings(method="face", type="FIXED")
    expected = replace(by_face, material=MATERIAL_OF_LARGE_MODELS, stiffness="elastic")
    assert replace(LARGE, connections=by_face).connections == expected
    with pytest.raises(ScenarioError, match="give one of them"):
        replace(LARGE, connections=by_face, fracture=FractureSettings(shards=LARGE_MODEL - 1))


@pytest.mark.parametrize("given", [{"breaking_force_kgf": 10_000}, {"breaking_force_n": 1e5}, {"material": "steel"}])
def test_large_model_keeps_the_strength_that_is_given(given):
    connections = ConnectionSettings(method="face", **given)
    assert replace(LARGE, connections=connections).connections == replace(connections, stiffness="rigid")


def test_lengths_of_the_bridge():
    assert BRIDGE.spans_m == 23.5
    assert BRIDGE.length_m == 24.5


def test_free_fall_of_the_ball():
    # From 5 m: v² = 2 g h = 98.0665 m²/s², t = v / g.
    assert BALL.impact_speed_m_s**2 == pytest.approx(98.0665)
    assert BALL.fall_time_s == pytest.approx(98.0665**0.5 / 9.80665)
    assert BALL.density_kg_m3 == pytest.approx(7938, abs=0.5)


def test_frames_cover_the_duration():
    assert TimeSettings(duration_s=5).frames == 120
    assert TimeSettings(duration_s=5.001).frames == 121
    slow = TimeSettings(duration_s=5, frames_per_second=30, frames_per_second_base=1.001, time_scale=0.5)
    assert slow.step.frame_s == pytest.approx(0.5 * 1.001 / 30)
    assert slow.frames == 300  # 299.7 frames


@pytest.mark.parametrize(
    "table, values, text",
    [
        (BALL, {"mass_kg": -5}, "ball.mass_kg is -5: expected a number above 0 (kg)"),
        (BALL, {"mass_kg": 0}, "ball.mass_kg is 0: expected a number above 0 (kg)"),
        (BALL, {"mass_kg": float("nan")}, "ball.mass_kg is nan: expected a number above 0 (kg)"),
        (BALL, {"mass_kg": float("inf")}, "ball.mass_kg is inf: expected a number above 0 (kg)"),
        (BALL, {"mass_kg": True}, "ball.mass_kg is true: expected a number above 0 (kg)"),
        (BALL, {"mass_kg": None}, "ball.mass_kg is missing: expected a number above 0 (kg)"),
        (BALL, {"mass_kg": 1e39}, "ball.mass_kg is 1e+39: expected at most 1000000000 (kg)"),
        (BALL, {"mass_kg": 5e9}, "ball.mass_kg is 5000000000.0: expected at most 1000000000 (kg); is this in grams?"),
        (BALL, {"mass_kg": 1e-39}, "ball.mass_kg is 1e-39: expected a number that single precision can hold"),
        (
            BALL,
            {"mass_kg": 10**400},
            "ball.mass_kg is a whole number of more than 64 bits: expected a number above 0 (kg)",
        ),
        (BALL, {"diameter_m": "1.34"}, 'ball.diameter_m is "1.34": expected a number from 0.001 to 10000.0 (m)'),
        (BALL, {"drop_height_m": 0}, "ball.drop_height_m is 0: expected a number above 0 and up to 10000.0 (m)"),
        (BALL, {"release_time_s": -0.1}, "ball.release_time_s is -0.1: expected a number of at least 0 (s)"),
        (BALL, {"restitution": 1.1}, "ball.restitution is 1.1: expected a number from 0 to 1"),
        (BALL, {"target_m": [1]}, "ball.target_m is a list of length 1: expected a list of 2 numbers (m)"),
        (BALL, {"target_m": 6.5}, "ball.target_m is 6.5: expected a list of 2 numbers (m)"),
        (BALL, {"target_m": [1, "0"]}, 'ball.target_m.2 is "0": expected a list of 2 numbers (m)'),
        (
            BRIDGE,
            {"span_lengths_m": []},
            "bridge.span_lengths_m is a list of length 0: expected a list of one or more numbers from 0.001 to 10000.0",
        ),
        (BRIDGE, {"span_lengths_m": [13, -1]}, "bridge.span_lengths_m.2 is -1: expected a list of one or more "),
        (BRIDGE, {"deck": 5}, "bridge.deck is 5: expected a table"),
        (BRIDGE, {"deck": PIERS}, "expected a table"),
        (DECK, {"width_m": 0}, "bridge.deck.width_m is 0: expected a number from 0.001 to 10000.0 (m)"),
        (
            DECK,
            {"width_m": 12000},
            "bridge.deck.width_m is 12000: expected a number from 0.001 to 10000.0 (m); is this in millimetres?",
        ),
        (DECK, {"width_m": 5500}, "width_m is 5500: expected at most 1000 (m); is this in millimetres?"),
        (DECK, {"thickness_m": 250}, "thickness_m is 250: expected at most 100 (m); is this in millimetres?"),
        (DECK, {"density_kg_m3": 2.5}, "density_kg_m3 is 2.5: expected a number of at least 10 (kg/m³); is this in t"),
        (DECK, {"density_kg_m3": 1e30}, "density_kg_m3 is 1e+30: expected at most 100000 (kg/m³)"),
        (SCENARIO.ground, {"friction": 1e30}, "ground.friction is 1e+30: expected at most 100"),
        (DECK, {"overhang_m": -1}, "bridge.deck.overhang_m is -1: expected a number from 0 to 10000.0 (m)"),
        (DECK, {"overhang_m": 1e9}, "bridge.deck.overhang_m is 1000000000.0: expected a number from 0 to 10000.0 (m)"),
        (BALL, {"drop_height_m": 3e38}, "ball.drop_height_m is 3e+38: expected a number above 0 and up to 10000.0 (m)"),
        (PIERS, {"columns": 0}, "bridge.piers.columns is 0: expected a whole number from 1 to 1000"),
        (PIERS, {"columns": 2.0}, "bridge.piers.columns is 2.0: expected a whole number from 1 to 1000"),
        (PIERS, {"columns": True}, "bridge.piers.columns is true: expected a whole number from 1 to 1000"),
        (SCENARIO, {"title": "  "}, 'scenario.title is "  ": expected a text on one line, not blank'),
        (SCENARIO, {"title": "a\nb"}, r'scenario.title is "a\nb": expected a text on one line, not blank'),
        (SCENARIO, {"title": "x" * 1001}, "this one has 1001 letters, more than 1000"),
        (SCENARIO, {"title": "gpj.\u202eexe"}, "; U+202E in it turns the direction of what is written"),
        (SCENARIO, {"title": 3}, "scenario.title is 3: expected a text on one line, not blank"),
        (SCENARIO, {"seed": -1}, "scenario.seed is -1: expected a whole number from 0 to 2147483647"),
        (SCENARIO, {"time": None}, "time is missing: expected a table"),
        (SCENARIO.fracture, {"shards": 0}, "fracture.shards is 0: expected a whole number from 1 to 1000000"),
        (SCENARIO.time, {"duration_s": 0}, "time.duration_s is 0: expected a number above 0 (s)"),
        (SCENARIO.time, {"time_scale": 101}, "time.time_scale is 101: expected a number above 0 and up to 100"),
        (SCENARIO.time, {"substeps_per_frame": 1001}, "expected a whole number from 1 to 1000"),
        (SCENARIO.time, {"substeps_per_frame": 10**400}, "expected a whole number from 1 to 1000"),
        (SCENARIO.shards, {"linear_damping": 2}, "shards.linear_damping is 2: expected a number from 0 to 1"),
        (SCENARIO.shards, {"use_deactivation": 1}, "shards.use_deactivation is 1: expected true or false"),
        (SCENARIO.ground, {"friction": -1}, "ground.friction is -1: expected a number of at least 0"),
        (SCENARIO.pictures, {"width_px": 15}, "pictures.width_px is 15: expected a whole number from 16 to 8192 (px)"),
        (
            CONNECTIONS,
            {"type": "hinge"},
            'connections.type is "hinge": expected one of "FIXED", "POINT", "HINGE"',
        ),
        (CONNECTIONS, {"limit_per_shard": 0}, "connections.limit_per_shard is 0: expected a whole number from 1"),
    ],
)
def test_values_outside_their_limits_are_refused(table, values, text):
    with pytest.raises(ScenarioError) as refusal:
        replace(table, **values)
    assert text in str(refusal.value)
    assert len(str(refusal.value).splitlines()) == 1


@pytest.mark.parametrize(
    "table, values, text",
    [
        (BRIDGE, {"mass_kg": 1}, "bridge.density_kg_m3 and bridge.mass_kg are given together: give only one of them"),
        (
            SCENARIO,
            {"bridge": replace(BRIDGE, density_kg_m3=None)},
            "bridge has no density_kg_m3 or mass_kg: give one of them",
        ),
        (CONNECTIONS, {"breaking_force_n": 1}, "breaking_force_kgf are given together: give only one of them"),
        (SCENARIO, {"connections": NO_STRENGTH}, "breaking_force_kgf or material: give one of them"),
        (LARGE, {"connections": NO_STRENGTH}, "breaking_force_kgf or material: give one of them"),
        (
            CONNECTIONS,
            {"search_radius_m": None},
            'search_radius_m is missing: expected a number above 0 (m) with method "vertex"',
        ),
        (CONNECTIONS, {"method": "face"}, 'connections.search_radius_m is 1.0: expected none with method "face"'),
        (CONNECTIONS, {"neighbours": 4}, 'connections.neighbours is 4: expected none with method "vertex"'),
        (
            CONNECTIONS,
            {"method": "nearest", "search_radius_m": None},
            "connections.neighbours is missing: expected a whole number of at least 1 with method",
        ),
        (
            SCENARIO.shards,
            {"use_deactivation": False},
            "shards.start_deactivated is true: expected false where shards.use_deactivation is false",
        ),
        (
            BRIDGE,
            {"piers": replace(PIERS, column_length_m=10.5)},
            "bridge.piers.column_length_m is 10.5: expected less than the shortest span, 10.5 (m)",
        ),
        (
            BRIDGE,
            {"pier_caps": PierCaps(length_m=11, width_m=8, height_m=1)},
            "bridge.pier_caps.length_m is 11.0: expected less than the shortest span, 10.5 (m)",
        ),
        (
            BRIDGE,
            {"piers": replace(PIERS, columns=13)},
            "bridge.piers.column_width_m is 0.7: expected at most 0.653846 (m), "
            "so that the columns fit into bridge.deck.width_m",
        ),
        (
            BRIDGE,
            {"pier_caps": PierCaps(length_m=1, width_m=1.3, height_m=1)},
            "expected at most 0.65 (m), so that the columns fit into bridge.pier_caps.width_m",
        ),
        (
            SCENARIO,
            {"ball": replace(BALL, release_time_s=5)},
            "ball.release_time_s is 5.0: expected less than time.duration_s, 5.0 (s)",
        ),
        (
            SCENARIO,
            {"ball": replace(BALL, target_m=(24.1, 0))},
            "ball.target_m.1 is 24.1: expected a position on the deck, from -0.5 to 24 (m)",
        ),
        (SCENARIO, {"ball": replace(BALL, target_m=(-0.6, 0))}, "ball.target_m.1 is -0.6"),
        (
            SCENARIO,
            {"ball": replace(BALL, target_m=(0, 4.3))},
            "ball.target_m.2 is 4.3: expected a position on the deck, from -4.25 to 4.25 (m)",
        ),
        (SCENARIO.time, {"duration_s": 1e6}, "time.duration_s is 1000000.0: expected 1 to 1000000 frames"),
        (SCENARIO.time, {"duration_s": 1e-9}, "time.duration_s is 1e-09: expected 1 to 1000000 frames"),
        (SCENARIO.time, {"duration_s": 1e6, "time_scale": 1e-37}, "expected 1 to 1000000 frames"),
    ],
)
def test_values_that_contradict_each_other_are_refused(table, values, text):
    with pytest.raises(ScenarioError) as refusal:
        replace(table, **values)
    assert text in str(refusal.value)
    assert len(str(refusal.value).splitlines()) == 1


def test_limits_themselves_are_taken():
    side = 0.1  # three times 0.1 is more than 0.3 in binary, but not to the user
    replace(BRIDGE, deck=replace(DECK, width_m=0.3), piers=replace(PIERS, columns=3, column_width_m=side))
    replace(SCENARIO, ball=replace(BALL, target_m=(24, -4.25)))
    replace(SCENARIO, ball=replace(BALL, target_m=(-0.5, 4.25)))
    replace(SCENARIO.shards, use_deactivation=False, start_deactivated=False)


def test_extreme_values_overflow_nothing():
    for size in (0.001, 1000.0):
        ball = replace(BALL, mass_kg=1e9, diameter_m=size, drop_height_m=10_000.0)
        assert np.isfinite([ball.density_kg_m3, ball.fall_time_s, ball.impact_speed_m_s]).all()
    assert np.isfinite(replace(CONNECTIONS, breaking_force_kgf=1e12).breaking_force_newton)


def test_fields_are_named_not_counted():
    with pytest.raises(TypeError):
        Deck(8.5, 0.25)
    assert [item.name for item in fields(Deck)] == [
        "width_m",
        "thickness_m",
        "overhang_m",
        "per_span",
        "joint_gap_m",
        "density_kg_m3",
    ]


@pytest.mark.parametrize(
    "value, text",
    [
        (False, "false"),
        (10**5000, "a whole number of more than 64 bits"),
        ("x" * 100, '"' + "x" * 60 + '…"'),
        ({"a": 1}, "a table"),
        (np.zeros((2, 2)), "[[0. 0.] [0. 0.]]"),
    ],
    ids=["switch", "huge number", "long text", "table", "array"],
)
def test_any_value_is_shown_on_one_short_line(value, text):
    assert shown(value) == text
