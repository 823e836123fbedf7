# SPDX-License-Identifier: GPL-3.0-or-later
"""Girders with a deck on studs, or on friction alone, against transformed sections, elastic slip and plastic theory."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.composite import (
    BOTTOM_M,
    CONCRETE_PA,
    GIRDERS,
    HEIGHT_M,
    SECTION,
    STIFF_STUDS,
    STUDS,
    THICKNESS_M,
    WIDTH_M,
    Composed,
    composite_scenario,
    deck_loads,
    deck_section,
    deflection_of,
    rest_of,
    shards_of,
    steel_alone,
)
from support.long_cases import long_but
from support.steelwork import bar_loads

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import DENSITY_KG_M3
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.scenario import studs_of
from bridge_demolition_addon.model.structure.cracking import CrackedBridge
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.utilisation import Utilisations

pytestmark = pytest.mark.slow

SPAN_M, LOAD_N_M = 24.0, 20e3
STEEL = section_named(SECTION)
CENTRE_M = -float(np.concatenate(STEEL.rings)[:, 1].min())
BARS = """
[[reinforcement]]
members = ["deck"]
side = "top"
depth_m = 0.05
area_mm2 = 8000.0
diameter_mm = 16.0

[[reinforcement]]
members = ["deck"]
side = "bottom"
depth_m = 0.05
area_mm2 = 4000.0
diameter_mm = 16.0
"""


def steel_section(model, loads, bar, joint):
    """Position along the road of a joint of a bar, and its axial force and moment there; this pulls above."""

    class Rest:
        pass

    rest = Rest()
    rest.loads = loads
    along, axial, moments = bar_loads(model, rest, bar)
    (member,) = (member for member in model.members if member.name == bar)
    return float(member.steel.bar.begin_m[0] + along[joint]), float(axial[joint]), float(moments[joint])


def steel_stresses(model, loads, bar, joint):
    """Position along the road of a joint of a bar, and stresses of the bottom and the top of its section there."""
    along, axial, moment = steel_section(model, loads, bar, joint)
    second = float(STEEL.shape.second_moments_m4[0, 0])
    bottom, top = (axial / STEEL.area_m2 + moment * height / second for height in (-CENTRE_M, HEIGHT_M - CENTRE_M))
    return along, bottom, top


def test_contacts_cover_the_flanges_and_have_all_studs():
    """A deck of 0.2 m × 4 m × 24 m, and 10 studs/m on two girders: 480 studs."""
    scenario = composite_scenario(shards=80)
    model = build_model(scenario)
    deck = shards_of(model, "span deck")
    assert model.masses_kg[deck].sum() == pytest.approx(2500.0 * WIDTH_M * THICKNESS_M * SPAN_M)
    by_girder = np.bincount(model.decks.girders, model.decks.studded_m)
    assert by_girder == pytest.approx([SPAN_M, SPAN_M])
    assert 10.0 * by_girder.sum() == pytest.approx(480.0)
    bars = model.bars.yield_n[model.decks.rows]
    assert bars.sum() == pytest.approx(480.0 * 9e4)
    # No shard lies across two pieces of a girder.
    ends = {round(float(end), 6) for shard in deck for end in model.shards[shard].bounds[:, 0]}
    own = [member for member in model.members if member.steel and member.name.startswith("span G1 ")]
    joints = {round(float(end), 6) for member in own for end in member.solid.bounds[:, 0] if member.steel.bar}
    assert {0.0, SPAN_M} | joints <= ends


@pytest.mark.parametrize(("pieces", "shards", "seed"), [(3, 1, 1), (4, 1, 1), (4, 120, 1), (4, 120, 2), (8, 1, 1)])
def test_a_simple_span_deflects_with_the_slip_of_its_studs(pieces, shards, seed):
    """N. M. Newmark, C. P. Siess, I. M. Viest (1951), as U. A. Girhammar and V. K. A. Gopu (1993) write it, and shear.

    With α² = K E I / (E A)_r (E I)_0 of a beam with slip, w (1 / (E I)_0 - 1 / E I) / α⁴ (α² L² / 8 - 1 + 1 / cosh (α
    L / 2)) comes to 5 w L⁴ / 384 E I; it is 4 % here. Within 2 %: pieces have the weight of their length in their
    middles.
    """
    scenario = composite_scenario(pieces=pieces, shards=shards, seed=seed, tables=BARS)
    model = build_model(scenario)
    rest = rest_of(model, scenario, deck_loads(model, LOAD_N_M))
    whole = Composed()
    steel_nm2, _ = steel_alone()
    area = WIDTH_M / GIRDERS * THICKNESS_M
    loose = steel_nm2 + CONCRETE_PA * area * THICKNESS_M**2 / 12.0
    lever = HEIGHT_M + 0.5 * THICKNESS_M - CENTRE_M
    together = (whole.bending_nm2 - loose) / lever**2
    slip = 10.0 * 100e6
    alpha2 = slip * whole.bending_nm2 / (together * loose)
    softer = LOAD_N_M * (1.0 / loose - 1.0 / whole.bending_nm2) / alpha2**2
    by_slip = softer * (alpha2 * SPAN_M**2 / 8.0 - 1.0 + 1.0 / math.cosh(math.sqrt(alpha2) * SPAN_M / 2.0))
    by_theory = 5.0 * LOAD_N_M * SPAN_M**4 / 384.0 / whole.bending_nm2 + by_slip
    by_theory += LOAD_N_M * SPAN_M**2 / 8.0 / whole.shear_n
    assert by_slip / by_theory == pytest.approx(0.04, abs=0.01)
    for girder in ("span G1 2", "span G2 2"):
        assert deflection_of(model, rest, girder) == pytest.approx(by_theory, rel=0.02)


@pytest.mark.parametrize(("pieces", "shards"), [(4, 1), (4, 120)])
def test_a_deck_without_studs_shares_by_both_stiffnesses(pieces, shards):
    """5 w L⁴ / 384 ((E I)_steel + (E I)_deck) and w L² / 8 G A: no friction to speak of."""
    scenario = composite_scenario(
        pieces=pieces, shards=shards, studs="studs_per_m = 0\ndeck_friction = 0.01", tables=BARS
    )
    model = build_model(scenario)
    rest = rest_of(model, scenario, deck_loads(model, LOAD_N_M))
    assert rest.held[:-1].all()
    steel_nm2, shear_n = steel_alone()
    both = steel_nm2 + CONCRETE_PA * WIDTH_M / GIRDERS * THICKNESS_M**3 / 12.0
    by_theory = 5.0 * LOAD_N_M * SPAN_M**4 / 384.0 / both + LOAD_N_M * SPAN_M**2 / 8.0 / shear_n
    assert deflection_of(model, rest, "span G1 2") == pytest.approx(by_theory, rel=0.05)


def test_a_deck_without_studs_lies_on_its_girders_by_its_weight():
    """Each girder carries half of it, and friction of 0.5 makes the girders deflect less."""
    deflections = []
    for friction in (0.01, 0.5):
        studs = f"studs_per_m = 0\ndeck_friction = {friction}"
        scenario = composite_scenario(pieces=4, shards=80, studs=studs, tables=BARS)
        model = build_model(scenario)
        rest = model_at_rest(model, scenario.joints)
        assert rest.held[:-1].all()
        deflections.append(deflection_of(model, rest, "span G1 2"))
        springs = model.bearings.springs
        names = [name for name in model.bearings.names if name.startswith("span deck")]
        assert names == ["span deck on span G1", "span deck on span G2"]
        on_girders = [
            rest.loads[2, springs.rows[springs.bearings == model.bearings.names.index(name)]].sum() for name in names
        ]
        half = 0.5 * 2500.0 * WIDTH_M * THICKNESS_M * SPAN_M * STANDARD_GRAVITY_M_S2
        assert on_girders == pytest.approx([half, half], rel=0.01)
    assert deflections[1] < 0.98 * deflections[0]


@pytest.fixture(scope="module")
def continuous():
    """Two spans under an even load, with studs that hardly slip, and the moment of theory: of two spans with shear.

    The moment over the inner support is w L² / 8 by 1 + 3 E I / (G A L²).
    """
    scenario = composite_scenario((SPAN_M, SPAN_M), pieces=4, shards=160, studs=STIFF_STUDS, tables=BARS)
    model = build_model(scenario)
    whole = Composed()
    over = LOAD_N_M * SPAN_M**2 / 8.0 / (1.0 + 3.0 * whole.bending_nm2 / (whole.shear_n * SPAN_M**2))
    end_n = 0.5 * LOAD_N_M * SPAN_M - over / SPAN_M
    rest = rest_of(model, scenario, deck_loads(model, LOAD_N_M))
    return model, rest, whole, lambda along: end_n * along - 0.5 * LOAD_N_M * along * along


@pytest.mark.parametrize(
    ("bar", "joint"),
    [("span G1 1-2", 0), ("span G2 1-2", 2), ("span G1 2-3", 1), ("span G1 3-4", 2), ("span G2 3-4", 3)],
)
def test_stresses_are_those_of_transformed_sections(continuous, bar, joint):
    """Steel below and above, and the deck above, within 3 % of the largest stress of steel, or of concrete, there.

    From the first end to 1.4 m from the inner support.
    """
    model, rest, whole, moment = continuous
    along, bottom, top = steel_stresses(model, rest.loads, bar, joint)
    expected = [whole.stress_pa(moment(along), height) for height in (0.0, HEIGHT_M)]
    assert [bottom, top] == pytest.approx(expected, abs=0.03 * abs(expected[0]))
    pull, bends = deck_section(model, rest.loads, along)
    area, modulus = WIDTH_M * THICKNESS_M, WIDTH_M * THICKNESS_M**2 / 6.0
    in_middle = whole.stress_pa(moment(along), HEIGHT_M + 0.5 * THICKNESS_M, CONCRETE_PA)
    assert pull / area == pytest.approx(in_middle, rel=0.03)
    at_top = whole.stress_pa(moment(along), HEIGHT_M + THICKNESS_M, CONCRETE_PA)
    assert pull / area - bends / modulus == pytest.approx(at_top, rel=0.06)


def test_beside_the_inner_support_the_deck_bends_by_itself(continuous):
    """Where the plates of the node end, 0.3 m from its axis: the bottom and the mean of the deck within 4 %.

    The web yields to shear, and leaves a kink over the support that the deck does not have: as the faces of a sandwich,
    it takes more moment than by transformed sections, and the top flange less.
    """
    model, rest, whole, moment = continuous
    along, bottom, top = steel_stresses(model, rest.loads, "span G1 3-4", -1)
    assert bottom == pytest.approx(whole.stress_pa(moment(along), 0.0), rel=0.04)
    assert top == pytest.approx(whole.stress_pa(moment(along), HEIGHT_M), abs=0.1 * abs(bottom))
    pull, bends = deck_section(model, rest.loads, along)
    in_middle = whole.stress_pa(moment(along), HEIGHT_M + 0.5 * THICKNESS_M, CONCRETE_PA)
    assert pull / (WIDTH_M * THICKNESS_M) == pytest.approx(in_middle, rel=0.04)
    by_curvature = CONCRETE_PA * WIDTH_M * THICKNESS_M**3 / 12.0 * moment(along) / whole.bending_nm2
    assert bends / by_curvature > 2.0


def test_studs_at_the_end_have_the_shear_flow_of_the_section():
    """V S / I in the middle of each contact of the first 5 m, within 3 %, as the mean over both girders."""
    scenario = composite_scenario(pieces=6, shards=1, studs=STIFF_STUDS)
    model = build_model(scenario)
    rest = rest_of(model, scenario, deck_loads(model, LOAD_N_M))
    whole, decks = Composed(), model.decks
    along = model.connections.points[decks.rows, 0]
    for place in np.unique(along.round(6))[1:6]:
        rows = np.flatnonzero(abs(along - place) < 1e-5)
        flow = rest.loads[0, decks.rows[rows]].sum() / decks.lengths_m[rows].sum()
        shear = LOAD_N_M * (0.5 * SPAN_M - place)
        assert abs(flow) == pytest.approx(shear * whole.flow_1_m, rel=0.03)


def cracked(scenario):
    model = build_model(scenario)
    whole, rest = np.ones(len(model.connections)), model_at_rest(model, scenario.joints)
    judged = Utilisations(model, scenario.joints)
    return model, CrackedBridge(model, scenario.joints, judged, whole > 0.0, whole, rest)


def own_weight_n_m(model):
    """Weight by length of each girder, without nodes and cross frames."""
    deck = 2500.0 * WIDTH_M / GIRDERS * THICKNESS_M
    return STANDARD_GRAVITY_M_S2 * (deck + DENSITY_KG_M3 * STEEL.area_m2)


@pytest.mark.parametrize("shards", long_but([1], [1, 80]))
def test_a_composite_span_comes_down_at_its_plastic_load(shards):
    """8 M / L² with M = N_pl (h - z + t): all of the steel yields, and concrete presses at the top of the deck.

    By EN 1994-1-1, 6.2.1.2, it presses in a block of N_pl / (0.85 f_c b) = 0.175 m, and M is 0.89 times of that:
    shards do not crush in their depth.
    """
    studs = STUDS.replace("studs_per_m = 10", "studs_per_m = 20")
    model, bridge = cracked(composite_scenario(pieces=4, shards=shards, studs=studs, tables=BARS))
    plastic_n = 355e6 * STEEL.area_m2
    at_edge = plastic_n * (HEIGHT_M - CENTRE_M + THICKNESS_M)
    block = plastic_n / (0.85 * 35e6 * WIDTH_M / GIRDERS)
    assert (at_edge - 0.5 * block * plastic_n) / at_edge == pytest.approx(0.89, abs=0.005)
    load = 8.0 * at_edge / SPAN_M**2
    for share in (0.5, 0.8, 0.9, 0.96):
        bridge.carry(1.0, deck_loads(model, share * load - own_weight_n_m(model)))
    assert not bridge.fallen.any()
    bridge.carry(1.0, deck_loads(model, 1.05 * load - own_weight_n_m(model)))
    assert bridge.fallen.any()


@pytest.mark.long
def test_few_studs_slip_and_make_the_span_weaker():
    """Partial shear connection: with n P = 0.4 N_c,f, M = M_a + 0.4 (M - M_a) by EN 1994-1-1, 6.2.1.3 (5), at least.

    The line is the safe side of what equilibrium gives, so that the model lies between it and the whole.
    """
    plastic_n = 355e6 * STEEL.area_m2
    per_m = 0.4 * plastic_n / (0.5 * SPAN_M) / 9e4
    studs = STUDS.replace("studs_per_m = 10", f"studs_per_m = {per_m:.4f}").replace("4e4", "8e4")
    studs += "\nstud_slip_mm = 100"
    model, bridge = cracked(composite_scenario(pieces=4, shards=1, studs=studs, tables=BARS))
    at_edge = plastic_n * (HEIGHT_M - CENTRE_M + THICKNESS_M)
    steel_nm = 355e6 * float(STEEL.shape.plastic_moduli_m3[0])
    by_line = steel_nm + 0.4 * (at_edge - steel_nm)
    whole_n_m, line_n_m = (8.0 * moment / SPAN_M**2 for moment in (at_edge, by_line))
    for share in (0.5, 0.7, 0.85, 0.95):
        bridge.carry(1.0, deck_loads(model, share * line_n_m - own_weight_n_m(model)))
    assert not bridge.fallen.any()
    assert bridge.cracked[model.decks.rows].any()
    bridge.carry(1.0, deck_loads(model, 0.95 * whole_n_m - own_weight_n_m(model)))
    assert bridge.fallen.any()


class CrackedSpans:
    """Two spans whose deck has cracked over the inner support, under an even load and their weight."""

    def __init__(self, load_n_m, *, pieces, within):
        scenario = composite_scenario((SPAN_M, SPAN_M), pieces=pieces, shards=1, studs=STIFF_STUDS, tables=BARS)
        connections = replace(scenario.connections, cracks_within_shards=within)
        self.model, bridge = cracked(replace(scenario, connections=connections))
        bridge.carry(1.0, deck_loads(self.model, load_n_m))
        deck = shards_of(self.model, "span deck")
        faces = bridge.cracked & np.isin(self.model.connections.pairs, deck).all(axis=1)
        self.away_m = abs(self.model.connections.points[faces, 0] - SPAN_M)
        self.loads = np.concatenate((bridge.loads.forces_n.T, bridge.loads.moments_nm.T))
        self.weight_n_m = load_n_m + own_weight_n_m(self.model)
        self.along_m, _, of_steel = steel_section(self.model, self.loads, "span G1 3-4", -1)
        pull, bends = deck_section(self.model, self.loads, self.along_m)
        self.moment_nm = of_steel + (pull * (HEIGHT_M + 0.5 * THICKNESS_M - CENTRE_M) - bends) / GIRDERS


def steel_with_bars():
    """Centre and E I of a girder with its bars, by the modulus of steel."""
    bars = [(4000e-6 * 200 / 210, 1.15), (2000e-6 * 200 / 210, 1.05)]
    parts = [(STEEL.area_m2, CENTRE_M, float(STEEL.shape.second_moments_m4[0, 0])), *((*bar, 0.0) for bar in bars)]
    centre = math.fsum(area * z for area, z, _ in parts) / math.fsum(area for area, _, _ in parts)
    return centre, 210e9 * math.fsum(area * (z - centre) ** 2 + own for area, z, own in parts)


def test_the_deck_cracks_over_the_inner_support():
    """The moment there falls, but not to that with steel and bars alone over 15 % of the spans (EN 1994-1-1, 5.4.2.3).

    Bars stretch at cracks alone, so that they are stiffer than along all of that length.
    """
    spans, whole, (_, bending_nm2) = CrackedSpans(40e3, pieces=4, within=False), Composed(), steel_with_bars()
    assert len(spans.away_m) and (spans.away_m < 0.15 * SPAN_M).all()
    by_code = hogging_nm(whole, spans.weight_n_m, bending_nm2, 0.15 * SPAN_M, spans.along_m)
    uncracked = hogging_nm(whole, spans.weight_n_m, whole.bending_nm2, 0.0, spans.along_m)
    assert 1.1 * by_code < spans.moment_nm < 0.98 * uncracked


@pytest.mark.parametrize(("pieces", "load_n_m"), [(4, 40e3), (8, 40e3), (6, 60e3)])
def test_cracks_in_shards_move_the_moment_into_the_spans(pieces, load_n_m):
    """Moment at the support, and stresses of steel below there and in the span, within 3 % of cracked theory.

    That is a beam with steel and bars alone where the deck has cracked, by Mohr's integral, and with both elsewhere.
    The moment is also within 5 % of EN 1994-1-1, 5.4.2.3, which has cracks over 15 % of the spans.
    """
    spans, whole, (centre, bending_nm2) = (
        CrackedSpans(load_n_m, pieces=pieces, within=True),
        Composed(),
        steel_with_bars(),
    )
    cracked_m = float(spans.away_m.max())
    given = spans.weight_n_m, bending_nm2
    by_theory = hogging_nm(whole, *given, cracked_m, spans.along_m)
    assert spans.moment_nm == pytest.approx(by_theory, rel=0.03)
    assert spans.moment_nm == pytest.approx(hogging_nm(whole, *given, 0.15 * SPAN_M, spans.along_m), rel=0.05)
    _, bottom, _ = steel_stresses(spans.model, spans.loads, "span G1 3-4", -1)
    at_support_pa = -210e9 * by_theory * centre / bending_nm2
    assert bottom == pytest.approx(at_support_pa, rel=0.03)
    along, bottom, top = steel_stresses(spans.model, spans.loads, "span G1 2-3", 0)
    in_span_nm = -hogging_nm(whole, *given, cracked_m, along)
    expected = [whole.stress_pa(in_span_nm, height) for height in (0.0, HEIGHT_M)]
    assert [bottom, top] == pytest.approx(expected, abs=0.03 * abs(at_support_pa))


def hogging_nm(whole, weight, over_support_nm2, length_m, along_m):
    """Moment of a beam over two spans that is softer beside its support, by Mohr's integral, with shear."""
    x = (np.arange(4000) + 0.5) * SPAN_M / 4000
    bending = np.where(x > SPAN_M - length_m, over_support_nm2, whole.bending_nm2)
    by_load = (0.5 * weight * x**3 / bending + weight * x / whole.shear_n).sum()
    reaction = by_load / (x**2 / bending + 1.0 / whole.shear_n).sum()
    return 0.5 * weight * along_m**2 - reaction * along_m


def test_studs_that_would_fail_before_they_yield_are_refused():
    """90 kN by 100 kN/mm are 0.9 mm."""
    with pytest.raises(ScenarioError, match=r"stud_slip_mm is 0.5: expected more than 0.9 \(mm\)"):
        composite_scenario(studs=f"{STUDS}\nstud_slip_mm = 0.5")


def test_studs_by_diameter_have_the_strength_of_the_code():
    """19 mm in C35 of the material concrete: 0.8 · 450 · π 19² / 4 = 102.1 kN; per area of the flange in the joint."""
    studs = "studs_per_m = 6\nstud_diameter_mm = 19"
    scenario = composite_scenario(studs=studs)
    row = studs_of(scenario.steelwork.girders[0], scenario)
    assert row.shear_n == pytest.approx(102.1e3, rel=1e-3)
    weaker = replace(scenario, connections=replace(scenario.connections, strength_factor=0.5))
    assert studs_of(weaker.steelwork.girders[0], weaker).shear_n == pytest.approx(row.shear_n)
    of_contact, of_weaker = scenario.joints[-2].strength, weaker.joints[-2].strength
    assert of_contact.shear_pa == pytest.approx(6.0 * 102.1e3 / 0.3, rel=1e-3)
    assert of_weaker.shear_pa == pytest.approx(0.5 * of_contact.shear_pa)
    assert BOTTOM_M[0] == 0.4  # the flange below, which is another one
