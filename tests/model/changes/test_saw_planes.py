# SPDX-License-Identifier: GPL-3.0-or-later
"""Saw cuts by hand: each side weighs what the plane leaves it, and halves lie on the bearings under them."""

import numpy as np
import pytest

from bridge_demolition_addon.model.changes.change import schedule
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.sequence.lifts import model_structure
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.stages.tables import stage_row, stage_sentences

KG_M3, SPAN_M, WIDTH_M, THICKNESS_M = 2500.0, 8.0, 2.4, 0.5
DECK_KG = KG_M3 * SPAN_M * WIDTH_M * THICKNESS_M
BRIDGE = f"""
[scenario]
title = "Sawn deck"
seed = {{seed}}
[time]
duration_s = 2.0
[bridge]
span_lengths_m = [{SPAN_M}]
density_kg_m3 = {KG_M3}
[bridge.deck]
width_m = {WIDTH_M}
thickness_m = {THICKNESS_M}
[bridge.abutments]
length_m = 1.0
width_m = 2.4
height_m = 2.0
[bridge.bearings]
pads = 4
[bridge.reinforcement]
designed_for = "own weight"
[fracture]
shards = {{shards}}
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
[[saw_cuts]]
time_s = 1.0
point_m = {{point}}
normal = {{normal}}
members = ["deck"]
"""
LENGTHWAYS, ACROSS, SKEWED = [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.5, 0.0]


class Sawn:
    """A deck on two abutments, the shards before and behind the plane of its cut, and the connections that are left."""

    def __init__(self, normal, point=(3.0, 0.05, 2.2), seed=1, shards=22, more=""):
        self.scenario = scenario_from_text(
            BRIDGE.format(seed=seed, shards=shards, normal=normal, point=list(point)) + more
        )
        self.model = checked_model(self.scenario)
        self.bridge = StandingBridge(self.model, self.scenario.joints)
        (cut,) = schedule(self.scenario.changes, model_structure(self.model))
        self.intact = np.ones(len(self.model.connections), bool)
        self.intact[cut.connections] = False
        deck = np.array([self.model.members[member].kind == "deck" for member in self.model.member_of_shard])
        before = (self.model.centres_m - point) @ normal > 0.0
        self.sides = deck & before, deck & ~before

    def kg(self):
        return [self.model.masses_kg[side].sum() for side in self.sides]

    def joined(self):
        """Return whether a connection that is left joins the two sides."""
        ends = [side[self.model.connections.pairs[self.intact]] for side in self.sides]
        return bool(((ends[0][:, 0] & ends[1][:, 1]) | (ends[1][:, 0] & ends[0][:, 1])).any())


@pytest.mark.parametrize("shards", [22, 60])
@pytest.mark.parametrize("seed", [1, 5, 9])
def test_halves_of_a_lengthways_cut_lie_on_their_bearings_with_what_the_plane_leaves_them(seed, shards):
    sawn = Sawn(LENGTHWAYS, seed=seed, shards=shards)
    shares = np.array([(WIDTH_M / 2.0 - 0.05) / WIDTH_M, (WIDTH_M / 2.0 + 0.05) / WIDTH_M])
    assert sawn.kg() == pytest.approx(DECK_KG * shares, rel=1e-9) and not sawn.joined()
    rest = sawn.bridge.unbroken(sawn.intact)
    assert rest.held.all()
    # Each half is a simple beam: half its weight at either end.
    rows = sawn.model.bearings.springs.rows
    carried_n = np.abs(rest.loads.forces_n[rows, 2])
    ends = sawn.model.connections.pairs[rows]
    far = sawn.model.connections.points[rows, 0] > SPAN_M / 2.0
    for side, kg in zip(sawn.sides, sawn.kg(), strict=True):
        on_side = side[ends].any(axis=1)
        for end in (far, ~far):
            assert carried_n[on_side & end].sum() == pytest.approx(kg * 9.80665 / 2.0, rel=0.01)


@pytest.mark.parametrize(("normal", "shards"), [(ACROSS, 22), (SKEWED, 60)])
def test_a_cut_across_parts_a_deck(normal, shards):
    sawn = Sawn(normal, (3.0, 0.0, 2.2), seed=4, shards=shards)
    assert sawn.kg() == pytest.approx([DECK_KG * 5.0 / 8.0, DECK_KG * 3.0 / 8.0], rel=1e-9) and not sawn.joined()


def test_around_shards_sides_weigh_what_shards_do_and_points_of_ones_own_are_not_cut():
    assert min(Sawn(LENGTHWAYS, more='along = "faces"\n').kg()) != pytest.approx(DECK_KG * 1.15 / 2.4, rel=1e-3)
    points = "".join(f"[[fracture.points]]\nplace_m = [{x}, {y}, 2.2]\n" for x in (1.0, 4.0, 7.0) for y in (-0.6, 0.6))
    assert Sawn(LENGTHWAYS, more=points).kg() == pytest.approx([DECK_KG / 2.0] * 2)  # cells meet at y = 0


@pytest.mark.slow
def test_stages_say_that_a_deck_that_is_sawn_lengthways_stands():
    sawn = Sawn(LENGTHWAYS)
    _, stage = stages_of(sawn.scenario, sawn.bridge, lambda done, total: None)
    row = stage_row(2, stage, sawn.bridge)
    assert not stage.loose.any() and row["not_held_kg"] == 0.0 and stage.collapse_factor > 1.0
    said = " ".join(stage_sentences(stage, row))
    assert "saw cut of" in said and "times its load" in said and "held by no connection" not in said
