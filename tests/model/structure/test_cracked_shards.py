# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams that crack within shards too: their deflection is that of the fully cracked state, until their bars yield."""

import math

import numpy as np
import pytest
from support.cracked_beam import AREA_MM2, BARS, cracked, cracked_stiffness_nm2
from support.prestressed_beam import MODULUS_M3, WEIGHT_N_M, Beam, beam_text, tendon

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import scenario_from_text

pytestmark = pytest.mark.slow


def deflection_m(*, within, blocks, area):
    """Deflection of the beam's middle by its weight."""
    text = beam_text(BARS.replace(f"area_mm2 = {AREA_MM2}", f"area_mm2 = {area}"), blocks=blocks)
    if within:
        text = text.replace("[connections]", "[connections]\ncracks_within_shards = true")
    beam = Beam(text)
    bridge = cracked(beam)
    bridge.carry(1.0)
    assert not bridge.fallen.any()
    return beam, bridge.deflection_m


def by_state_two_m(beam, area_mm2):
    """The same by curvature, of the cracked section where the beam's edge is pulled by more than the concrete bears."""
    along = (np.arange(4000) + 0.5) * 0.5 * beam.span_m / 4000
    over = 0.5 * (beam.length_m - beam.span_m)
    moment = 0.5 * WEIGHT_N_M * (beam.length_m * along - (along + over) ** 2)
    cracks = moment / MODULUS_M3 > MATERIALS["concrete"].tension_pa
    stiffness = np.where(cracks, cracked_stiffness_nm2(beam, area_mm2), beam.stiffness_nm2)
    return float((moment / stiffness * along).sum() * 0.5 * beam.span_m / 4000)


@pytest.mark.parametrize(("blocks", "area"), [(20, 3500.0), (40, 3500.0), (20, 2600.0)])
def test_a_cracked_beam_deflects_as_in_the_cracked_state(blocks, area):
    """EN 1992-1-1, 7.4.3, without tension stiffening, in any number of shards.

    Within 10 %: bodies press at their edges alone, and crack one face farther than by statics.
    """
    beam, deflects = deflection_m(within=True, blocks=blocks, area=area)
    assert deflects == pytest.approx(by_state_two_m(beam, area), rel=0.1)


def test_without_cracks_in_shards_the_deflection_hangs_on_how_a_beam_is_cut():
    """Bars stretch at as many cracks as there are faces: 20 of them are a third too stiff, 40 a quarter too soft."""
    (beam, of_20), (_, of_40) = (deflection_m(within=False, blocks=blocks, area=AREA_MM2) for blocks in (20, 40))
    by_theory = by_state_two_m(beam, AREA_MM2)
    assert of_20 < 0.9 * by_theory and of_40 > 1.15 * by_theory


def test_openings_have_what_shards_stretch():
    """A face in the middle: bars of 500 N/mm² between blocks of 1 m yield as their edge opens by 2.5 mm h / (d - x).

    They rupture at so much more than without cracks in shards as they yield later.
    """
    text = beam_text(BARS, blocks=20)
    models = [
        Beam(text.replace("[connections]", f"[connections]\ncracks_within_shards = {within}"))
        for within in ("true", "false")
    ]
    row = models[0].middle_face
    stretched, alone = (beam.model.bars for beam in models)
    yields_m = stretched.yield_shares[row] * stretched.openings_m[row]
    steel, depth = 200.0 / 34.0 * 3.5e-3, 0.92
    pressed = (-steel + math.sqrt(steel * steel + 2.0 * 0.5 * steel * depth)) / 0.5
    assert yields_m == pytest.approx(0.0025 / (depth - pressed), rel=0.02)
    at_crack_m = 0.0025 / 0.05 * alone.openings_m[row]
    assert stretched.openings_m[row] - alone.openings_m[row] == pytest.approx(yields_m - at_crack_m, rel=1e-6)
    assert alone.yield_shares is None


def test_bars_beside_a_tendon_stretch_as_without_it():
    """Bonded strands rupture at another opening; bars of the face yield where they did."""
    strands = tendon("eccentricities_m = [0.3, 0.3, 0.3]", more="bonded = true")
    yields_m = []
    for text in (beam_text(BARS, blocks=20), beam_text(BARS + strands, blocks=20)):
        beam = Beam(text.replace("[connections]", "[connections]\ncracks_within_shards = true"))
        bars, row = beam.model.bars, beam.middle_face
        yields_m.append((bars.yield_shares[row] * bars.openings_m[row], bars.openings_m[row]))
    (alone_m, ruptures_alone_m), (beside_m, ruptures_beside_m) = yields_m
    assert beside_m == pytest.approx(alone_m, rel=1e-9)
    assert ruptures_beside_m != pytest.approx(ruptures_alone_m, rel=1e-3)


@pytest.mark.parametrize("more", ["", "ductile_share = 0.2\nductile_elongation_m = 0.05\n"])
def test_cracks_in_shards_need_layers_of_bars(more):
    text = beam_text().replace("[connections]", f"[connections]\ncracks_within_shards = true\n{more}")
    with pytest.raises(ScenarioError, match=r"cracks_within_shards is true: expected false where there is no \[\[rein"):
        scenario_from_text(text)
