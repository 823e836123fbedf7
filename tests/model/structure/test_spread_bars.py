# SPDX-License-Identifier: GPL-3.0-or-later
"""Links and straight bars across faces of shards: shear by EN 1992-1-1, 6.2.3, and anchorage by 8.4."""

import sys
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support.checkout import ROOT
from support.scenarios import I235

sys.path.insert(1, str(ROOT / "validation"))

from beams import Beam

from bridge_demolition_addon.engineering.elasticity.steel_bars import USUAL_STEEL
from bridge_demolition_addon.engineering.geometry.vectors import transformed
from bridge_demolition_addon.engineering.mechanics.section_cuts import section_axes
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge.mesh_files import exported
from bridge_demolition_addon.model.scenario import BarLayer, ConnectionSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.member_layers import spread_bars
from bridge_demolition_addon.model.structure.model import build_model

LINKS = BarLayer(members=("deck",), along="z", spread_mm2_m2=2000.0, diameter_mm=10.0)
BOTTOM = BarLayer(members=("deck",), depth_m=0.04, area_mm2=12_000.0)


@cache
def model_with(*layers):
    """The I-235 span in 60 irregular shards, with bars."""
    connections = ConnectionSettings(type="FIXED", method="face", material="concrete", ductile_elongation_m=0.1)
    fracture = replace(I235.fracture, shards=60)
    return build_model(replace(I235, fracture=fracture, connections=connections, reinforcement=layers))


def forces_n(model):
    """Vectors (m, 3) of the forces at which bars yield, in the axes of the bridge, on the side of the normals."""
    return model.bars.yield_n[:, None] * transformed(section_axes(model.connections.normals), model.bars.directions)


@pytest.mark.parametrize("along", ["x", "y"])
def test_every_section_has_all_spread_bars(along):
    """Through any plane across them goes their area by that of the deck: faces that fold back count against."""
    model, axis = model_with(replace(LINKS, along=along)), "xy".index(along)
    deck = model.members[0].solid
    size = np.ptp(deck.vertices, axis=0)
    middle = deck.vertices[:, axis].mean() + 0.1
    before = np.append((model.centres_m[:, axis] < middle) & (model.member_of_shard == 0), False)
    is_deck = np.append(model.member_of_shard == 0, False)[model.connections.pairs].all(axis=1)
    first, second = before[model.connections.pairs].T
    crossing = (first.astype(int) - second) * is_deck
    pulled_n = (crossing[:, None] * forces_n(model)).sum(axis=0)
    across_m2 = size[1 - axis] * size[2]
    assert pulled_n[axis] == pytest.approx(2000e-6 * 500e6 * across_m2, rel=1e-6)
    assert pulled_n[np.array(axis) != [0, 1, 2]] == pytest.approx([0.0, 0.0], abs=1e-6 * abs(pulled_n[axis]))


def test_links_pull_along_themselves_in_the_middle_of_each_face():
    model = model_with(LINKS)
    has_links = model.bars.yield_n > 0.0
    expected = 2000e-6 * 500e6 * model.connections.normals[:, 2] * model.connections.areas
    np.testing.assert_allclose(forces_n(model)[has_links, 2], expected[has_links], rtol=1e-9)
    np.testing.assert_allclose(model.bars.offsets_m, 0.0, atol=1e-9)


def test_links_and_layers_pull_together():
    """Opened across a face, they do the work of both."""
    layers, links, both = model_with(BOTTOM), model_with(LINKS), model_with(BOTTOM, LINKS)
    np.testing.assert_allclose(forces_n(both), forces_n(layers) + forces_n(links), atol=1e-3)


def test_links_rupture_over_the_length_between_cracks_at_most_that_of_the_deck():
    (links,) = spread_bars((LINKS,), model_with(LINKS).members)
    # By hand: ρ = 0.2 % has cracks 0.75 × 10 mm × 0.998 / (4 × 0.002) = 936 mm apart, and the deck is 250 mm thick.
    # f_ctm of C35 is 3.21 N/mm². Beside the crack bars yield over 0.08 × 500 × 10 / (4 × 3.21) mm = 31.2 mm, by 2.625 %
    # in the mean, and are elastic over the other 93.8 mm, by 0.19 %: 2 × (0.819 + 0.178) mm.
    assert links.length_m == pytest.approx(0.25)
    assert links.opening_m(35e6, USUAL_STEEL) == pytest.approx(1.99e-3, abs=0.01e-3)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"depth_m": 0.05}, "reinforcement.area_mm2 is missing: expected it, or reinforcement.spread_mm2_m2"),
        ({"spread_mm2_m2": 10.0, "depth_m": 0.05}, "reinforcement.depth_m is 0.05: expected none with"),
        ({"spread_mm2_m2": 10.0, "side": "top"}, "reinforcement.side is .top.: expected none with"),
        ({"spread_mm2_m2": 10.0, "anchored": False}, "reinforcement.anchored is .*: expected none with"),
    ],
)
def test_bars_are_at_a_depth_or_spread(keys, message):
    with pytest.raises(ScenarioError, match=message):
        BarLayer(members=("deck",), **keys)


@pytest.mark.slow
@pytest.mark.parametrize(("half_m", "share"), [(0.4, 0.4 / 0.768), (2.0, 1.0)])
def test_straight_bars_have_less_near_their_ends(tmp_path, half_m, share):
    """A beam cut in its middle: φ 40 mm, f_y 500 N/mm², C30: l_b = 40 / 4 × 500 / (2.25 × 2.896) = 767 mm by hand."""
    beam = Beam(2.0 * half_m, 0.3, 0.3, 2.0, "bottom", 0.25, 500.0, 500.0, 30.0, 0.05, 0.002)
    for name, solid in beam.solids.items():
        (tmp_path / f"{name}.obj").write_bytes(exported(solid, ".obj"))
    pulls = []
    for anchored in ("true", "false"):
        path = tmp_path / f"{anchored}.toml"
        layer = f"[[reinforcement]]\ndiameter_mm = 40.0\nanchored = {anchored}\n"
        text = beam.scenario.replace(".stl", ".obj").replace("[[reinforcement]]\n", layer)
        path.write_text(f'[scenario]\ntitle = "beam"\n[time]\nduration_s = 1.0\n{text}', encoding="utf-8")
        pulls.append(build_model(read_scenario(path)).bars.yield_n.sum())
    assert pulls[1] / pulls[0] == pytest.approx(share, rel=0.002)


def test_bars_of_a_member_count_in_place_of_even_ones():
    """Within the deck its links alone; elsewhere the whole tensile strength, by the area of a face."""
    settings = {"stiffness": "elastic", "ductile_share": 1.0, "ductile_elongation_m": 0.05}
    connections = ConnectionSettings(type="FIXED", method="face", material="concrete", **settings)
    fracture = replace(I235.fracture, shards=60)
    model = build_model(replace(I235, fracture=fracture, connections=connections, reinforcement=(LINKS,)))
    name = [member.kind for member in model.members]
    of_pair = np.append(model.member_of_shard, -1)[model.connections.pairs]
    within = (of_pair[:, 0] == of_pair[:, 1]) & (of_pair[:, 0] == name.index("deck"))
    whole = model.crack_bars.bars.yield_n
    np.testing.assert_allclose(whole[within], model.bars.yield_n[within], rtol=1e-12)
    tension_pa = MATERIALS["concrete"].tension_pa
    elsewhere = ~within & (model.connections.areas > 0.0)
    assert elsewhere.any()
    np.testing.assert_allclose(whole[elsewhere], tension_pa * model.connections.areas[elsewhere], rtol=1e-12)
