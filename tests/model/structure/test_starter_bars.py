# SPDX-License-Identifier: GPL-3.0-or-later
"""Members that are cast together share bars: links of girders in slabs, bars of columns in caps and footings.

Areas are those of the schedule, forces by hand. Slip of anchored bars: H. Sezen, E. J. Setzler (2008), Reinforcement
slip in reinforced concrete columns, ACI Structural Journal 105, 280-289.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support.bridges_by_rule import bridge, scenario

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.reinforcement.design import bar_schedule
from bridge_demolition_addon.model.scenario import BarLayer, Deck, FractureSettings, Girders, Support
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.facts import connection_facts
from bridge_demolition_addon.model.structure.model import build_model

GIRDERS = {"girders": Girders(number=2, width_m=0.5, depth_m=0.9), "deck": Deck(width_m=4.0, thickness_m=0.25)}
LENGTH_M = 13.0
YIELD_PA = 500e6


def without_opening(plan):
    return replace(plan, connections=replace(plan.connections, ductile_elongation_m=None))


@cache
def built(seed=1, shards=60, by_hand=(), **parts):
    of_bridge = bridge(**{**({"rule": None} if by_hand else {}), **{name: GIRDERS[name] for name in parts}})
    plan = scenario(of_bridge, reinforcement=by_hand) if by_hand else scenario(of_bridge)
    plan = without_opening(replace(plan, seed=seed, fracture=FractureSettings(shards=shards)))
    return plan, build_model(plan)


def between(model, first, second):
    """Connections between two members, by the starts of their names."""
    names = np.array([*(member.name for member in model.members), "ground"])
    pairs = names[np.append(model.member_of_shard, -1)[model.connections.pairs]]
    starts = [np.char.startswith(pairs, name) for name in (first, second)]
    return np.flatnonzero(starts[0].any(axis=1) & starts[1].any(axis=1))


def links_m2_m(plan, model, member):
    return 1e-6 * bar_schedule(plan, model.members).link_area_mm2_per_m(member)


@pytest.mark.parametrize(("seed", "shards"), [(1, 60), (7, 60), (3, 140)])
def test_links_of_a_girder_hold_its_slab_however_both_are_cut(seed, shards):
    plan, model = built(seed, shards, girders=True, deck=True)
    for girder in ("girder 1", "girder 2"):
        rows = between(model, girder, "deck")
        held_n = model.bars.yield_n[rows].sum()
        assert held_n == pytest.approx(links_m2_m(plan, model, girder) * LENGTH_M * YIELD_PA, rel=1e-6)


def test_what_is_printed_is_what_the_links_carry():
    plan, model = built(girders=True, deck=True)
    by_m = 1e-3 * links_m2_m(plan, model, "girder 1") * YIELD_PA
    (line,) = [text for name, text in connection_facts(plan, model) if "links to the slab" in text]
    words = line.split()
    assert float(words[words.index("kN/m") - 1]) == pytest.approx(by_m, rel=1e-3)
    # EN 1992-1-1, 6.25: rough and without cohesion no less than 0.7 of what the links pull, indented 0.9.
    assert float(words[words.index("kN/m", words.index("kN/m") + 1) - 1]) == pytest.approx(0.9 * by_m, rel=1e-3)


def plastic_moment_nm(side_m, cover_m, area_m2, compression_pa):
    """Of a square section with a layer at two sides: near bars stay elastic, EN 1992-1-1:2004, 3.1.7 and 6.1.

    A f_y + A E ε (c - x) / x = 0.8 b f_c x, with ε = 0.0035 where concrete is crushed.
    """
    block, elastic_n, yield_n = 0.8 * side_m * compression_pa, area_m2 * 200e9 * 0.0035, area_m2 * YIELD_PA
    by_x = elastic_n - yield_n
    x_m = (-by_x + (by_x**2 + 4.0 * block * elastic_n * cover_m) ** 0.5) / (2.0 * block)
    near_n = elastic_n * (cover_m / x_m - 1.0)
    assert 0.0 < near_n < yield_n
    return yield_n * (side_m - cover_m) + near_n * cover_m - block * x_m * 0.4 * x_m


def test_columns_go_on_into_caps_and_footings_with_the_moment_of_their_section():
    """Starters that turn about an edge resist half a side by their force."""
    plan, model = built()
    bars = [
        row.layer
        for row in bar_schedule(plan, model.members).bars
        if "pier 1 column 1" in row.members and row.layer.along == "z"
    ]
    areas_m2 = {layer.side: layer.area_m2 for layer in bars}
    assert (areas_m2["start"], areas_m2["right"]) == (areas_m2["end"], areas_m2["left"])
    (column,) = (member.solid for member in model.members if member.name == "pier 1 column 1")
    side_m, _, _ = np.ptp(column.vertices, axis=0)
    moments_nm = [
        plastic_moment_nm(side_m, bars[0].depth_m, areas_m2[side], plan.joints[0].strength.compression_pa)
        for side in ("start", "right")
    ]
    for other in ("pier 1 cap", "ground"):
        held_n = model.bars.yield_n[between(model, "pier 1 column 1", other)].sum()
        assert held_n * 0.5 * side_m == pytest.approx(sum(moments_nm), rel=1e-4)
        assert 0.9 < held_n / (sum(areas_m2.values()) * YIELD_PA) < 1.0


def test_a_deck_that_lies_on_its_caps_shares_none():
    _, model = built()
    rows = between(model, "deck", "pier")
    assert len(rows) and not model.bars.yield_n[rows].any()


def test_girders_without_links_have_the_least_ones():
    by_hand = (BarLayer(members=("girder",), depth_m=0.08, area_mm2=5000.0),)
    plan, model = built(by_hand=by_hand, girders=True, deck=True)
    strength_n_mm2 = 1e-6 * plan.joints[0].strength.compression_pa
    least_m2_m = 0.08 * strength_n_mm2**0.5 / 500.0 * 0.5  # 9.2.2 (5)
    held_n = model.bars.yield_n[between(model, "girder 1", "deck")].sum()
    assert held_n == pytest.approx(least_m2_m * LENGTH_M * YIELD_PA, rel=1e-6)


def test_members_without_bars_share_none():
    plan, _ = built(girders=True, deck=True)
    plain = replace(plan, bridge=replace(plan.bridge, reinforcement=None))
    assert build_model(plain).bars is None


@pytest.mark.parametrize("diameter_mm", [10.0, 20.0, 32.0])
def test_anchored_bars_slip_out_of_both_sides_until_they_rupture(diameter_mm):
    by_hand = (
        BarLayer(members=("girder",), depth_m=0.08, area_mm2=5000.0),
        BarLayer(members=("girder",), along="z", spread_mm2_m2=6000.0, diameter_mm=diameter_mm),
    )
    plan, model = built(by_hand=by_hand, girders=True, deck=True)
    root = (1e-6 * plan.joints[0].strength.compression_pa) ** 0.5
    # Bond of 1.0 √f_c up to yield and 0.5 √f_c beyond, N/mm²; slips of both add up, and of both sides.
    yielding = 500.0 / 200e3
    slip_mm = diameter_mm / 8.0 * (yielding * 500.0 / root + (0.05 + yielding) * 0.08 * 500.0 / (0.5 * root))
    openings_m = model.bars.openings_m[between(model, "girder 1", "deck")]
    np.testing.assert_allclose(openings_m, 2e-3 * slip_mm, rtol=0.15)


def test_a_slab_tears_from_its_girders_at_the_force_that_is_stated():
    """Pulled up evenly from girders that are held: more links than concrete holds yield at once, and harden by 8 %."""
    by_hand = (
        BarLayer(members=("girder",), depth_m=0.08, area_mm2=5000.0),
        BarLayer(members=("girder",), along="z", spread_mm2_m2=12000.0, diameter_mm=10.0),
    )
    of_bridge = bridge(rule=None, **GIRDERS)
    plan = without_opening(scenario(of_bridge, reinforcement=by_hand, supports=(Support(member="girder"),)))
    settings = replace(plan.connections, stiffness="elastic")
    plan = replace(plan, connections=settings, fracture=FractureSettings(shards=44))
    model = build_model(plan)
    bridge_at_rest, count = StandingBridge(model, plan.joints), len(model.connections)
    of_slab = [member.kind == "deck" for member in model.members]
    weights_n = STANDARD_GRAVITY_M_S2 * model.masses_kg * np.array(of_slab)[model.member_of_shard]
    loads = np.zeros((6, len(model.shards)))
    loads[2] = 21.0 * weights_n
    (line,) = [text for _, text in connection_facts(plan, model) if "links to the slab" in text]
    stated = line.split()
    stated_n = 2.0 * 1e3 * float(stated[stated.index("kN/m") - 1]) * LENGTH_M
    assert stated_n == pytest.approx(2.0 * 12000e-6 * 0.5 * YIELD_PA * LENGTH_M, rel=1e-3)
    torn_at = bridge_at_rest.collapse_factor(np.ones(count, bool), np.ones(count), loads) * 20.0 * weights_n.sum()
    assert torn_at == pytest.approx(1.08 * stated_n, rel=0.05)
