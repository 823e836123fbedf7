# SPDX-License-Identifier: GPL-3.0-or-later
"""Steelwork against statics: beams, a frame that sways, and a truss by the method of joints and virtual work."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.steelwork import (
    bar,
    bar_loads,
    blocks_text,
    node,
    pratt_truss,
    rest_under,
    steel_scenario,
    truss_forces,
)

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import DENSITY_KG_M3, lateral_buckling
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.structure.equilibrium import (
    at_rest,
    held_motions,
    inertias_of,
    loads_of,
    model_at_rest,
)
from bridge_demolition_addon.model.structure.facts import connection_facts
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.steel_bars import bar_uses

pytestmark = pytest.mark.slow

YOUNG_PA, SHEAR_PA = 210e9, 210e9 / 2.6

LOAD_KG = 1000.0
"""Mass at each lower node of the truss: small, as statics knows no second-order moments of chords that have bent."""


def cantilever(**keys):
    nodes = [node("wall", 0.0, 5.0, support="fixed"), node("tip", 10.0, 5.0)]
    return steel_scenario(nodes, [bar("beam", "wall", "tip", "IPE 300", **keys)], pieces=20)


def test_bars_and_nodes_have_the_mass_of_the_section_by_the_length():
    model = build_model(cantilever())
    assert len(model.shards) == 22
    assert model.masses_kg.sum() == pytest.approx(DENSITY_KG_M3 * section_named("IPE 300").area_m2 * 10.0)
    of_meshes = sum(shard.volume for shard in model.shards[:20])
    assert of_meshes == pytest.approx(model.masses_kg[:20].sum() / DENSITY_KG_M3)


def test_a_cantilever_bends_as_theory_says():
    """w L² / 2 and w x² / 2, w L⁴ / 8 E I + w L² / 2 G A_v, and 1.875² / 2 π √(E I / m L⁴) of Euler's beam."""
    scenario = cantilever()
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    section = section_named("IPE 300")
    mass = DENSITY_KG_M3 * section.area_m2
    weight, stiffness = mass * STANDARD_GRAVITY_M_S2, YOUNG_PA * section.shape.second_moments_m4[0, 0]
    along, axial, moments = bar_loads(model, rest, "beam")
    np.testing.assert_allclose(moments, weight * np.square(10.0 - along) / 2.0, rtol=0.01, atol=1e-4 * moments.max())
    np.testing.assert_allclose(axial, 0.0, atol=0.01 * weight * 10.0)
    deflection = model.centres_m[-1, 2] - rest.positions_m[2, -2]
    by_theory = weight * 10.0**4 / 8.0 / stiffness + weight * 50.0 / SHEAR_PA / section.shear_areas_m2[1]
    assert deflection == pytest.approx(by_theory, rel=0.005)
    sideways = YOUNG_PA * section.shape.second_moments_m4[1, 1]
    assert rest.frequency_hz == pytest.approx(1.8751**2 / 2.0 / math.pi * math.sqrt(sideways / mass / 1e4), rel=0.01)


def test_a_rolled_bar_bends_about_its_other_axis():
    scenario = cantilever(roll_deg=90.0)
    model = build_model(scenario)
    rest = rest_under(model, scenario, {"tip": (0.0, 0.0, -1000.0)}, weight=False)
    moment = section_named("IPE 300").shape.second_moments_m4[1, 1]
    deflection = model.centres_m[-1, 2] - rest.positions_m[2, -2]
    assert deflection == pytest.approx(1000.0 * 1000.0 / 3.0 / YOUNG_PA / moment, rel=0.01)


def test_a_cantilever_twists_by_its_torsion_constant():
    scenario = cantilever()
    model = build_model(scenario)
    section = section_named("IPE 300")
    loads = np.zeros((6, len(model.shards)))
    loads[[2, 3], -1] = -1.0, 100.0
    held = held_motions(model, scenario.joints)
    of_bodies = model.masses_kg, inertias_of(model), model.centres_m, held
    rest = at_rest(model.connections, model.stiffness, *of_bodies, (0.0, 0.0, 0.0), loads)
    twist = rest.rotations[2, 1, -2]
    assert twist == pytest.approx(100.0 * 10.0 / SHEAR_PA / section.torsion_m4, rel=0.01)


def test_a_portal_that_sways_has_the_moments_of_the_textbook():
    """Fixed feet, force H at the top: feet H h / 2 (3 k + 1) / (6 k + 1), corners H h / 2 · 3 k / (6 k + 1).

    k = I_beam / I_column · h / L (Kleinlogel, Rigid Frame Formulas, frame 16).
    """
    high, wide, force = 5.0, 8.0, 1e4
    nodes = [
        node("A", 0.0, 0.0, support="fixed"),
        node("B", 0.0, high),
        node("C", wide, high),
        node("D", wide, 0.0, support="fixed"),
    ]
    members = [
        bar("left", "A", "B", "HEB 200"),
        bar("beam", "B", "C", "IPE 300"),
        bar("right", "D", "C", "HEB 200"),
    ]
    scenario = steel_scenario(nodes, members, pieces=16)
    model = build_model(scenario)
    rest = rest_under(model, scenario, {"B": (force / 2, 0, 0), "C": (force / 2, 0, 0)}, weight=False)
    beam, column = (section_named(name).shape.second_moments_m4[0, 0] for name in ("IPE 300", "HEB 200"))
    k = beam / column * high / wide
    foot = force * high / 2.0 * (3.0 * k + 1.0) / (6.0 * k + 1.0)
    corner = force * high / 2.0 * 3.0 * k / (6.0 * k + 1.0)
    along, _, moments = bar_loads(model, rest, "left")
    # Moments change evenly along the column; the plates at its ends are 0.14 m long.
    np.testing.assert_allclose(abs(moments), abs(foot - (foot + corner) * along / high), rtol=0.01, atol=0.01 * foot)
    sway = rest.positions_m[0, len(model.shards) - 3] - model.centres_m[-3, 0]
    # Slope-deflection: h³ H / (12 E I_c) (3 k + 2) / (6 k + 1), and H h / 2 G A_v, of both columns.
    by_theory = force * high**3 / 12.0 / (YOUNG_PA * column) * (3.0 * k + 2.0) / (6.0 * k + 1.0)
    by_theory += force * high / 2.0 / SHEAR_PA / section_named("HEB 200").shear_areas_m2[1]
    assert sway == pytest.approx(by_theory, rel=0.01)


def truss_scenario(ends, places, bars, load_kg):
    held = {"L0": "pinned", "L8": "rocker"}
    nodes = [
        node(name, x, 10.0 + z, mass_kg=load_kg if name[0] == "L" else 0.0, **_held(held, name))
        for name, (x, z) in places.items()
    ]
    sections = {"L": "HEB 200", "U": "HEB 240"}
    members = [
        bar(name, *of, sections.get(name[0]) if name[0] == name[3] else "HEA 140", ends=[ends, ends])
        for name, of in bars.items()
    ]
    return steel_scenario(nodes, members, pieces=4)


def _held(held, name):
    return {"support": held[name]} if name in held else {}


@pytest.fixture(scope="module")
def pratt():
    """Places, bars and forces by statics of a truss of 8 panels, with half of each bar's weight at its nodes."""
    places, bars = pratt_truss()
    scenario = truss_scenario("hinged", places, bars, LOAD_KG)
    loads = {name: 0.0 for name in places}
    for member in scenario.steelwork.members:
        one, other = (places[name] for name in member.nodes)
        half = 0.5 * DENSITY_KG_M3 * member.steel_section.area_m2 * math.dist(one, other)
        for name in member.nodes:
            loads[name] += half
    for name in places:
        loads[name] += LOAD_KG * (name[0] == "L")
    forces_n = {name: (0.0, -STANDARD_GRAVITY_M_S2 * mass) for name, mass in loads.items()}
    return scenario, places, bars, truss_forces(places, bars, forces_n, {"L0": "xz", "L8": "z"})


def test_a_pinned_truss_has_the_forces_of_the_method_of_joints(pratt):
    scenario, _, bars, by_statics = pratt
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    largest = max(map(abs, by_statics.values()))
    for name in bars:
        # Upright bars carry more below: the mean of both ends.
        _, axial, _ = bar_loads(model, rest, name)
        assert 0.5 * (axial[0] + axial[-1]) == pytest.approx(by_statics[name], rel=0.005, abs=0.0005 * largest)


def test_a_pinned_truss_deflects_by_virtual_work(pratt):
    scenario, places, bars, by_statics = pratt
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    by_unit = truss_forces(places, bars, {"L4": (0.0, -1.0)}, {"L0": "xz", "L8": "z"})
    sections = {member.name: member.steel_section.area_m2 for member in scenario.steelwork.members}
    deflection = math.fsum(
        by_statics[name] * by_unit[name] * math.dist(places[one], places[other]) / (YOUNG_PA * sections[name])
        for name, (one, other) in bars.items()
    )
    names = [member.name for member in model.members]
    shard = np.flatnonzero(model.member_of_shard == names.index("L4"))[0]
    assert model.centres_m[shard, 2] - rest.positions_m[2, shard] == pytest.approx(deflection, rel=0.01)


def test_rigid_joints_change_the_forces_of_a_truss_little(pratt):
    """Secondary moments: a slender truss carries by axial forces, within a few per cent."""
    _, places, bars, by_statics = pratt
    scenario = truss_scenario("fixed", places, bars, LOAD_KG)
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    largest = max(map(abs, by_statics.values()))
    for name in bars:
        _, axial, _ = bar_loads(model, rest, name)
        assert 0.5 * (axial[0] + axial[-1]) == pytest.approx(by_statics[name], abs=0.03 * largest)


def test_what_cannot_be_built_is_refused():
    with pytest.raises(ScenarioError, match="radius_m"):
        steel_scenario([node("A", 0, 0, radius_m=-1.0), node("B", 1, 0)], [bar("b", "A", "B", "IPE 100")])
    with pytest.raises(ScenarioError, match="expected the name of one of"):
        steel_scenario([node("A", 0, 0)], [bar("b", "A", "B", "IPE 100")])
    with pytest.raises(ScenarioError, match="HEB 300"):
        steel_scenario([node("A", 0, 0), node("B", 1, 0)], [bar("b", "A", "B", "HEB 301")])
    with pytest.raises(ScenarioError, match="name of its own"):
        steel_scenario([node("A", 0, 0), node("B", 1, 0)], [bar("A", "A", "B", "HEB 300")])
    short = steel_scenario(
        [node("A", 0, 5), node("B", 1, 5), node("C", 1, 5.1)],
        [bar("b", "A", "B", "HEB 300"), bar("c", "A", "C", "HEB 300")],
    )
    with pytest.raises(GeometryError, match="b is 1 m long"):
        build_model(short)


def test_bars_are_judged_by_their_sections_and_as_struts(pratt):
    """By statics: N / A f_y of a pinned bar without moment, and χ A f_y of one that is pressed."""
    scenario, _, _, by_statics = pratt
    model = build_model(scenario)
    uses = {use.name: use for use in bar_uses(scenario, model, model_at_rest(model, scenario.joints))}
    pulled, pressed = uses["L3-L4"], uses["U3-U4"]
    plastic_n = 355e6 * section_named("HEB 200").area_m2
    # The own weight of the chord bends it by 4 m · 4 m / 8 · 613 N / m.
    moment = 61.3 * STANDARD_GRAVITY_M_S2 * 2.0 / (355e6 * section_named("HEB 200").shape.plastic_moduli_m3[0])
    assert pulled.section_used == pytest.approx(by_statics["L3-L4"] / plastic_n + moment, rel=0.03)
    assert pulled.buckling_used == 0.0
    assert pressed.buckling_used == pytest.approx(-by_statics["U3-U4"] / pressed.buckling.resistance_n, rel=0.01)
    # HEB 240, 4 m: λ = 400 / 6.08 / 76.4 = 0.861, curve c: χ = 0.62.
    assert (pressed.buckling.axis, pressed.buckling.curve) == ("z", "c")
    assert pressed.buckling.slenderness == pytest.approx(0.861, rel=0.005)
    assert pressed.buckling.reduction == pytest.approx(0.623, rel=0.01)


def test_concrete_beside_steelwork_is_as_it_was_and_may_hold_it():
    concrete = blocks_text(deck_width_m=3.0)
    nodes = [
        node("A", 0.0, 2.0, y=2.0, support="pinned", held_by="pier 1"),
        node("B", 6.0, 2.0, y=2.0, support="rocker"),
    ]
    members = [bar("strut", "A", "B", "SHS 100x5")]
    scenario = steel_scenario(nodes, members, concrete, pieces=4)
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=24))
    with_steel, alone = build_model(scenario), build_model(replace(scenario, steelwork=None))
    count = len(alone.shards)
    np.testing.assert_array_equal(with_steel.masses_kg[:count], alone.masses_kg)
    others = np.setdiff1d(np.arange(len(with_steel.connections)), with_steel.steel.rows)
    np.testing.assert_array_equal(with_steel.connections.pairs[others], alone.connections.pairs)
    np.testing.assert_array_equal(with_steel.stiffness.matrices[others], alone.stiffness.matrices)
    support = with_steel.connections.pairs[with_steel.bearings.springs.rows[0]]
    assert with_steel.members[with_steel.member_of_shard[support[1]]].name == "pier 1"
    rest = model_at_rest(with_steel, scenario.joints)
    assert rest.held[:-1].all()
    by_bearing = {
        bearing.name: bearing.force_n[2] for bearing in with_steel.bearings.forces(loads_of(with_steel, rest))
    }
    half = 0.5 * STANDARD_GRAVITY_M_S2 * DENSITY_KG_M3 * section_named("SHS 100x5").area_m2 * 6.0
    assert by_bearing == pytest.approx({"A on pier 1": half, "B on ground": half}, rel=0.01)


@pytest.mark.parametrize(("roll_deg", "turns"), [(0.0, True), (90.0, False)])
def test_a_slender_cantilever_is_judged_in_lateral_buckling_about_its_strong_axis_alone(roll_deg, turns):
    """w L² / 2 by χ_LT M_pl; about its weak axis an I-section does not buckle sideways."""
    scenario = cantilever(roll_deg=roll_deg)
    model = build_model(scenario)
    (use,) = bar_uses(scenario, model, model_at_rest(model, scenario.joints))
    section = section_named("IPE 300")
    moment = DENSITY_KG_M3 * section.area_m2 * STANDARD_GRAVITY_M_S2 * 10.0**2 / 2.0
    resistance = lateral_buckling(section, 355e6, 10.0).resistance_nm
    assert use.lateral_used == pytest.approx(moment / resistance if turns else 0.0, rel=0.03, abs=1e-3)


def test_a_bar_that_stands_on_concrete_is_held_by_its_support_alone():
    """A girder on the tops of two piers: it touches these, and its supports leave it to turn there and to move.

    Their forces are half of its weight each. Were it joined to the piers where it touches them, too, it would press
    these apart as it is fixed at its ends.
    """
    blocks = blocks_text(deck_width_m=1.0)
    # IPE 300 is 0.3 m high, so that its underside lies on the piers beside the deck.
    nodes = [
        node("A", 0.0, 4.15, y=1.0, support="pinned", held_by="pier 1"),
        node("B", 8.0, 4.15, y=1.0, support="rocker", held_by="pier 2"),
    ]
    girder = bar("girder", "A", "B", "IPE 300", pieces=8)
    scenario = steel_scenario(nodes, [girder], blocks)
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=24))
    model = build_model(scenario)
    names = [model.members[index].name for index in model.member_of_shard] + ["ground"]
    with_piers = [pair for pair in model.connections.pairs.tolist() if names[pair[0]] in ("A", "B", "girder")]
    with_piers = [pair for pair in with_piers if names[pair[1]].startswith("pier")]
    with_piers += [
        pair
        for pair in model.connections.pairs.tolist()
        if names[pair[1]] in ("A", "B", "girder") and names[pair[0]].startswith("pier")
    ]
    assert len(with_piers) == 2
    rest = model_at_rest(model, scenario.joints)
    by_bearing = {row.name: row.force_n for row in model.bearings.forces(loads_of(model, rest))}
    said = dict.fromkeys(value for name, value in connection_facts(scenario, model) if name == "support")
    assert list(said) == ["A on pier 1: pinned", "B on pier 2: rocker"]
    half = 0.5 * STANDARD_GRAVITY_M_S2 * DENSITY_KG_M3 * section_named("IPE 300").area_m2 * 8.0
    assert by_bearing["A on pier 1"] == pytest.approx((0.0, 0.0, half), rel=0.02, abs=1.0)
    assert by_bearing["B on pier 2"] == pytest.approx((0.0, 0.0, half), rel=0.02, abs=1.0)


@pytest.mark.parametrize("beside", [0.0, 0.3])
def test_a_bar_that_ends_beside_its_node_bends_by_the_force_times_that(beside):
    """A column of 4 m, HEB 200, fixed at its foot: 1 kN on a node beside its axis bends it by 300 N·m all along."""
    nodes = [node("foot", 0.0, 0.0, support="fixed"), node("top", beside, 4.0)]
    column = bar("column", "foot", "top", "HEB 200", eccentricities_m=[[0.0, 0.0, 0.0], [-beside, 0.0, 0.0]])
    scenario = steel_scenario(nodes, [column], pieces=8)
    model = build_model(scenario)
    assert model.members[0].steel.bar.begin_m == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert model.members[0].steel.bar.end_m == pytest.approx((0.0, 0.0, 4.0), abs=1e-12)
    rest = rest_under(model, scenario, {"top": (0.0, 0.0, -1e3)}, weight=False)
    _, axial, bending = bar_loads(model, rest, "column")
    # Sways by 0.2 mm, which moves the load by a thousandth of its arm.
    assert axial == pytest.approx(np.full(9, -1e3), rel=1e-3)
    assert abs(bending) == pytest.approx(np.full(9, 1e3 * beside), rel=1e-3, abs=0.01)


def test_eccentricities_are_one_for_each_node():
    column = bar("column", "foot", "top", "HEB 200", eccentricities_m=[[0.0, 0.0, 0.1]])
    with pytest.raises(ScenarioError, match=r"eccentricities_m is .* expected two, one for each node"):
        steel_scenario([node("foot", 0.0, 0.0, support="fixed"), node("top", 0.0, 4.0)], [column])


@pytest.mark.parametrize(("section", "yields"), [("IPE 300", "355"), ("HEM 1000", "355"), ("FLAT 300x60", "335")])
def test_what_bars_of_steel_break_by_is_their_grade_and_no_material(section, yields):
    """EN 1993-1-1, table 3.1, S355: 355 N/mm² up to 40 mm, 335 above."""
    nodes = [node("A", 0.0, 4.0, support="fixed"), node("B", 8.0, 4.0, support="fixed")]
    scenario = steel_scenario(nodes, [bar("girder", "A", "B", section)])
    facts = dict(connection_facts(scenario, build_model(scenario)))
    assert facts["bars of steel"] == f"S355, yield strength {yields} N/mm²"
    assert "strength of" not in facts and "in tension" not in facts
