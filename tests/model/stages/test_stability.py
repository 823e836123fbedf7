# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a bridge stands under its own weight: one verdict for all kinds of connections, with its reasons."""

import json
from dataclasses import replace

import pytest
from support.scenarios import I235
from support.stage_beams import DENSITY_KG_M3, MODULUS_M3, STRENGTH_PA, WEIGHT_N_M, add_block, beam_file

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.scenario import Charge, ConnectionSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.ending import left_alone
from bridge_demolition_addon.model.sequence.unusual import unusual_sizes
from bridge_demolition_addon.model.stages.stability import (
    COMES_DOWN,
    STANDS,
    UNKNOWN,
    Stability,
    stability_of,
)

pytestmark = pytest.mark.slow

HEAD = """
[scenario]
title = "Blocks"
[time]
duration_s = 1.0
[fracture]
shards = {shards}
[connections]
type = "FIXED"
method = "face"
material = "concrete"
[shards]
start_deactivated = false
"""


def blocks(folder, *members, shards=4):
    """A scenario of boxes: name, size and centre of each."""
    text = HEAD.format(shards=shards) + "".join(add_block(folder, *member) for member in members)
    path = folder / "blocks.toml"
    path.write_text(text, encoding="utf-8")
    return read_scenario(path)


def test_a_cantilever_stands_up_to_the_load_of_beam_theory(tmp_path):
    """Fixed at one end: w L² / 2 over W against the strength in bending, as beam theory has it."""
    for length_m, verdict in ((4.0, STANDS), (12.0, COMES_DOWN)):
        found = stability_of(read_scenario(beam_file(tmp_path / f"{length_m}", length_m)))
        factor = STRENGTH_PA * MODULUS_M3 / (WEIGHT_N_M * length_m**2 / 2.0)
        assert found.verdict == verdict
        assert found.load_factor == pytest.approx(factor, rel=0.15)
        assert (found.overloaded[0].member == "beam") if verdict == COMES_DOWN else not found.overloaded


@pytest.mark.long
def test_rigid_connections_and_one_force_are_judged_as_elastic(tmp_path):
    scenario = read_scenario(beam_file(tmp_path, 4.0))
    for changes in (
        {"stiffness": "rigid"},
        {"stiffness": "rigid", "type": "HINGE"},
        {"stiffness": None, "material": None, "breaking_force_n": 1e9},
    ):
        found = stability_of(replace(scenario, connections=replace(scenario.connections, **changes)), with_factor=False)
        assert (found.verdict, found.is_rigid, found.load_factor) == (STANDS, True, None)
        assert "as if its connections were elastic" in found.sentence
    weak = replace(scenario.connections, stiffness=None, material=None, breaking_force_n=1.0)
    assert stability_of(replace(scenario, connections=weak)).verdict == COMES_DOWN


def test_what_nothing_holds_comes_down_and_is_named(tmp_path):
    foot, floating = ("foot", (1, 1, 1), (5, 0, 0.5)), ("block", (2, 1, 1), (0, 0, 3))
    found = stability_of(blocks(tmp_path, foot, floating, shards=6))
    assert found.verdict == COMES_DOWN and "nothing holds" in found.sentence
    ((name, count, mass_kg),) = [(part.member, part.shards, part.mass_kg) for part in found.unsupported]
    assert name == "block" and count > 1 and mass_kg == pytest.approx(2.0 * DENSITY_KG_M3)
    assert not any("overloaded" in text for _, text in found.facts())


def test_a_deck_that_lies_loose_is_held_by_contact_on_two_piers_and_not_known_on_one(tmp_path):
    piers = [("west", (1, 2, 2), (0, 0, 1)), ("east", (1, 2, 2), (5, 0, 1))]
    deck = ("deck", (6, 2, 0.5), (2.5, 0, 2.25))
    apart = '[[connections.between]]\nmembers = ["deck", "{}"]\nnone = true\n'
    on_two = blocks(tmp_path, *piers, deck, shards=30)
    path = tmp_path / "blocks.toml"
    path.write_text(path.read_text() + apart.format("west") + apart.format("east"), encoding="utf-8")
    on_two = read_scenario(path)
    found = stability_of(on_two, with_factor=False)
    assert found.verdict == STANDS
    assert found.loose_on == ("deck on west", "deck on east")
    assert found.loose[0].member == "deck" and found.loose[0].mass_kg == pytest.approx(6.0 * DENSITY_KG_M3)
    lone = blocks(tmp_path, piers[0], deck, shards=20)
    path.write_text(path.read_text() + apart.format("west"), encoding="utf-8")
    found = stability_of(read_scenario(path), with_factor=False)
    assert lone.title == "Blocks" and found.verdict != STANDS and "deck" in found.reason


def test_without_faces_it_cannot_be_known_but_for_what_nothing_holds():
    found = stability_of(I235)
    assert (found.verdict, found.is_asleep, found.load_factor) == (UNKNOWN, True, None)
    assert 'cannot be known by statics: connections.method is "vertex"' in found.sentence
    assert found.sentence.endswith("bda check --awake")
    hardly = replace(I235.connections, search_radius_m=1e-6)
    apart = stability_of(replace(I235, connections=hardly))
    assert apart.verdict != STANDS
    loose = ConnectionSettings(method="nearest", neighbours=2, breaking_force_n=1e5, foundation=False)
    lies = stability_of(replace(I235, connections=loose))
    assert lies.verdict == UNKNOWN and "lie loose" in lies.reason
    assert sum(part.mass_kg for part in lies.loose) == pytest.approx(107_000.0, rel=1e-6)


def test_a_column_uses_its_strength_by_its_weight(tmp_path):
    """A column of 6 m: the weight over its foot by the strength of concrete in compression, 30 N/mm² or so."""
    scenario = blocks(tmp_path, ("column", (1, 1, 6), (0, 0, 3)), shards=1)
    found = stability_of(scenario)
    strength = scenario.joints[0].strength.compression_pa
    stress = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * 6.0
    assert found.utilisation == pytest.approx(stress / strength, rel=1e-3)
    assert found.load_factor == 64.0 and "above 64" in found.sentence


def test_a_verdict_is_stored_as_json_and_read_again(tmp_path):
    found = stability_of(blocks(tmp_path, ("block", (2, 1, 1), (0, 0, 3))))
    stored = json.loads(json.dumps(found.to_json()))
    assert Stability.of_json(stored) == found
    summary = RunSummary.of({"stability": stored})
    assert summary.stability == found and found.texts == (found.sentence,)
    assert RunSummary.of({"stability": None}).stability is RunSummary().stability is None


def test_a_mesh_that_ends_within_a_millimetre_of_the_ground_is_held_by_it(tmp_path):
    for gap_m, verdict in ((0.0005, STANDS), (-0.0005, STANDS), (0.004, UNKNOWN), (0.1, COMES_DOWN)):
        folder = tmp_path / f"{gap_m}"
        folder.mkdir()
        found = stability_of(blocks(folder, ("block", (2, 1, 1), (0, 0, 0.5 + gap_m))), with_factor=False)
        assert found.verdict == verdict, gap_m


def test_a_bridge_is_left_alone_awake_and_without_actions():
    alone = left_alone(replace(I235, charges=(Charge(position_m=(6.5, 0.0, 1.0), mass_kg=1.0),)), 2.0)
    assert alone.actions == () and not alone.shards.start_deactivated
    assert (alone.time.duration_s, alone.time.stop_at_rest) == (2.0, False)
    assert alone.bridge == I235.bridge and alone.zones == I235.zones


def test_sizes_that_look_like_another_unit_are_named():
    def said(**deck):
        changed = replace(I235, bridge=replace(I235.bridge, deck=replace(I235.bridge.deck, **deck)))
        return " ".join(unusual_sizes(changed, prepared_members(changed).members))

    assert list(unusual_sizes(I235, prepared_members(I235).members)) == []
    assert "The deck is 90 m thick" in said(thickness_m=90.0) and "another unit" in said(thickness_m=90.0)
    assert "0.0012 m thick" in said(thickness_m=0.0012)
