# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars across faces of shards: however a member is cut, each section has all of its steel, at its depth."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel
from bridge_demolition_addon.engineering.geometry.vectors import transformed
from bridge_demolition_addon.engineering.mechanics.section_cuts import section_axes
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import BarLayer, ConnectionSettings
from bridge_demolition_addon.model.structure.member_layers import layers_of_members
from bridge_demolition_addon.model.structure.model import build_model

THICKNESS_M, WIDTH_M = 0.25, 8.5
BOTTOM = BarLayer(members=("deck",), depth_m=0.04, area_mm2=12_000.0)
FORCES_AND_WIDTHS = ("yield_n", "openings_m")
TOP = BarLayer(members=("deck",), side="top", depth_m=0.05, area_mm2=8_000.0)


@cache
def model_with(*layers, ductile_elongation_m=0.1, **settings):
    """The I-235 span in 60 irregular shards, with bars."""
    connections = ConnectionSettings(
        type="FIXED",
        method="face",
        material="reinforced concrete slab",
        ductile_elongation_m=ductile_elongation_m,
        **settings,
    )
    fracture = replace(I235.fracture, shards=60)
    return build_model(replace(I235, fracture=fracture, connections=connections, reinforcement=layers))


def pull_across(model, position_m):
    """Force of all bars between the shards on both sides of a plane x, where those that fold back count against."""
    is_before = np.append(model.centres_m[:, 0] < position_m, False)
    first, second = is_before[model.connections.pairs].T
    signs = np.sign(model.connections.normals[:, 0]) * (first.astype(int) - second)
    return float((signs * model.bars.yield_n).sum())


@pytest.mark.parametrize("position_m", [2.0, 6.5, 11.0])
def test_every_section_has_all_of_a_layer(position_m):
    model = model_with(BOTTOM)
    (section,) = [group.section(35e6) for group in layers_of_members((BOTTOM,), model.members)]
    pull = 12_000e-6 * 500e6
    # By hand: M = A f_y (d - a / 2) of the deck about its top, and as a tie M / d.
    moment = pull * (0.21 - 0.5 * pull / (WIDTH_M * 35e6))
    assert section.moments_nm()[0] == pytest.approx(moment, rel=1e-9)
    assert pull_across(model, position_m) == pytest.approx(moment / 0.21, rel=1e-6)


def test_bars_pull_at_their_depth():
    model = model_with(BOTTOM)
    across = section_axes(model.connections.normals)[:, :, 1:]
    positions = model.connections.points + transformed(across, model.bars.offsets_m)
    with_bars = model.bars.yield_n > 0.0
    level = model.members[0].solid.bounds[0, 2] + 0.04
    np.testing.assert_allclose(positions[with_bars, 2], level, atol=1e-9)
    assert 0 < with_bars.sum() < len(with_bars)


def test_each_row_of_bars_knows_its_layer_and_member():
    """Links along the road beside a layer: through one plane goes what each resists, by hand."""
    links = BarLayer(members=("deck",), along="x", spread_mm2_m2=2000.0, diameter_mm=10.0)
    model = model_with(links, BOTTOM)
    bars, is_before = model.bar_rows, np.append(model.centres_m[:, 0] < 6.5, False)
    first, second = is_before[model.connections.pairs[bars.connections]].T
    across_n = bars.pulls_n * bars.directions[:, 0] * (first.astype(int) - second)
    links_n, bottom_n = (float(across_n[bars.layers == layer].sum()) for layer in (0, 1))
    assert links_n == pytest.approx(2000e-6 * 500e6 * WIDTH_M * THICKNESS_M, rel=1e-6)
    pull_n = 12_000e-6 * 500e6
    assert bottom_n == pytest.approx(pull_n * (0.21 - 0.5 * pull_n / (WIDTH_M * 35e6)) / 0.21, rel=1e-6)
    (deck,) = set(bars.members.tolist())
    assert (model.members[deck].kind, model.layers) == ("deck", (links, BOTTOM))
    heights_m = (bars.moments_nm[:, 2] / bars.pulls_n)[bars.layers == 1]
    np.testing.assert_allclose(heights_m, model.members[deck].solid.bounds[0, 2] + 0.04, atol=1e-9)


def test_only_the_member_that_is_named_has_bars_and_none_end_in_others():
    model = model_with(BOTTOM)
    members = np.append(model.member_of_shard, -1)[model.connections.pairs]
    is_deck = np.array([member.kind == "deck" for member in model.members] + [False])[members].all(axis=1)
    assert (model.bars.yield_n[~is_deck] == 0.0).all()


def test_two_layers_bear_both_moments():
    model = model_with(BOTTOM, TOP)
    (section,) = [group.section(35e6) for group in layers_of_members((BOTTOM, TOP), model.members)]
    assert pull_across(model, 6.5) * THICKNESS_M == pytest.approx(sum(section.moments_nm()), rel=1e-6)


def test_a_stronger_bridge_has_stronger_bars():
    weak, strong = model_with(BOTTOM), model_with(BOTTOM, strength_factor=2.0)
    np.testing.assert_allclose(strong.bars.yield_n, 2.0 * weak.bars.yield_n, rtol=1e-9)


@pytest.mark.parametrize(("factor", "widths"), [(0.5, 1.492), (2.0, 0.679)])
def test_a_factor_on_all_strengths_weakens_bond_by_the_strength_of_its_concrete(factor, widths):
    """Bars yield at so many times their force, bond has f^⅔: straight ends are held over a length that is f^-⅔ of it.

    Tension chord, 32 mm in 12 000 mm²: a mean strain at rupture of 1.49 and 0.68 times that with 0.3 · 35^⅔ N/mm².
    """
    settings = {"stiffness": "elastic", "ductile_elongation_m": None}
    layer = replace(BOTTOM, anchored=False, diameter_mm=32.0)
    own, scaled = (model_with(layer, strength_factor=value, **settings).bars for value in (1.0, factor))
    has_bars = own.yield_n > 0.0
    forces, openings = (getattr(scaled, name)[has_bars] / getattr(own, name)[has_bars] for name in FORCES_AND_WIDTHS)
    of_ends = factor * factor ** (2.0 / 3.0)
    assert min(of_ends, factor) <= forces.min() + 1e-9 and forces.max() <= max(of_ends, factor) + 1e-9
    assert factor < 1.0 or (forces > 1.2 * factor).any()
    assert factor > 1.0 or forces.min() == pytest.approx(of_ends)
    assert openings == pytest.approx(widths, rel=1e-3)


def test_columns_have_upright_bars():
    layers = [
        BarLayer(members=("pier",), along="z", side=side, depth_m=0.05, area_mm2=1e3) for side in ("start", "end")
    ]
    groups = list(layers_of_members(layers, model_with(BOTTOM).members))
    assert len(groups) == 4
    for group in groups:
        assert group.axes == (2, 0, 1)
        assert group.widths_m == pytest.approx((0.7, 0.7))
        assert group.levels_m[1] - group.levels_m[0] == pytest.approx(0.6)


def test_layers_have_to_be_in_their_members():
    with pytest.raises(ScenarioError, match=r"reinforcement.depth_m is 0.3: .* size of 'deck' along z, 0.25 \(m\)"):
        model_with(replace(BOTTOM, depth_m=0.3))
    with pytest.raises(ScenarioError, match=r"reinforcement.members .* expected names or kinds of members, such as"):
        model_with(replace(BOTTOM, members=("dec",)))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"stiffness": "rigid"}, r'connections.stiffness is "rigid": expected "elastic" with \[\[reinforcement\]\]'),
        ({"type": "HINGE"}, r'connections.stiffness is "rigid": expected "elastic" with \[\[reinforcement\]\]'),
        ({"material": None, "breaking_force_n": 1e5}, r"connections.material is missing: expected it with \[\[reinf"),
    ],
)
def test_bars_need_a_material_and_elastic_connections(changes, message):
    settings = {"type": "FIXED", "method": "face", "material": "concrete", "ductile_elongation_m": 0.1, **changes}
    with pytest.raises(ScenarioError, match=message):
        replace(I235, connections=ConnectionSettings(**settings), reinforcement=(BOTTOM,))


def test_an_opening_needs_reinforcement():
    connections = ConnectionSettings(method="face", material="concrete", ductile_elongation_m=0.1)
    with pytest.raises(ScenarioError, match=r"connections.ductile_elongation_m is 0.1: expected none where"):
        replace(I235, connections=connections)


def test_steel_needs_reinforcement():
    connections = ConnectionSettings(type="FIXED", method="face", material="concrete", ductile_hardening=1.1)
    with pytest.raises(ScenarioError, match=r"connections.ductile_hardening is 1.1: expected none where"):
        replace(I235, connections=connections)


def test_bars_both_ways_resist_askew_as_yield_lines_do():
    """Johansen: across a crack at an angle, bars of both ways resist F_x cos² + F_y sin² by its length."""
    along, across = BOTTOM, replace(BOTTOM, along="y", area_mm2=40_000.0)
    one, other, both = (model_with(*layers) for layers in ((along,), (across,), (along, across)))
    normals = both.connections.normals
    forces = [model.bars.yield_n[:, None] * model.bars.directions for model in (one, other, both)]
    # In the axes of their sections the first component is that along the normal, which opens the crack.
    np.testing.assert_allclose(forces[2], forces[0] + forces[1], atol=1e-6 * abs(forces[2]).max())
    by_x = one.bars.yield_n * abs(normals[:, 0])
    np.testing.assert_allclose(forces[0][:, 0], by_x, atol=1e-6 * by_x.max())


def test_few_bars_rupture_no_earlier_than_in_one_crack():
    """Slip out of both sides of a crack by the bond of Sezen and Setzler (2008), ACI Structural Journal 105, 280-289:
    1.0 √f_c up to yield and 0.5 √f_c beyond, N/mm²."""
    few = BarLayer(members=("deck",), depth_m=0.04, area_mm2=1_500.0, diameter_mm=12.0)
    (group,) = layers_of_members((few,), model_with(BOTTOM).members)
    (opening_m,) = group.openings_m(35e6, Steel())
    root, yielding = 35.0**0.5, 500.0 / 200e3
    slip_mm = 12.0 / 8.0 * (yielding * 500.0 / root + (0.05 + yielding) * 0.08 * 500.0 / (0.5 * root))
    assert opening_m == pytest.approx(2e-3 * slip_mm, rel=0.1)
