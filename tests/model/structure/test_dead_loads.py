# SPDX-License-Identifier: GPL-3.0-or-later
"""Dead loads are masses from the start: sums and lever arms by hand, and what is taken off first."""

from dataclasses import replace

import numpy as np
import pytest
from support.bearing_decks import WEIGHT_N_M, deck_text, standing_deck

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import DeadLoad
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stages import reactions_n, stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge

pytestmark = pytest.mark.slow

LENGTH_M = 26.0
SURFACING = '[[dead_loads]]\nname = "surfacing"\nmass_kg_m2 = 240\nacross_m = [-1.25, 1.25]\n'
PARAPET = '[[dead_loads]]\nname = "parapet"\nmass_kg_m = 600\nacross_m = [1.2, 1.5]\n'
SURFACING_KG, PARAPET_KG = 240 * 2.5 * LENGTH_M, 600 * LENGTH_M


@pytest.mark.parametrize(("shards", "seed", "skew"), [(40, 1, 0), (90, 2, 0), (60, 3, 25)])
def test_masses_and_reactions_are_larger_by_what_lies_on_the_deck(shards, seed, skew):
    text = deck_text(shards=shards, seed=seed).replace("[bridge.deck]", f"skew_deg = {skew}\n[bridge.deck]")
    bare = checked_model(scenario_from_text(text))
    model, _, forces = standing_deck(text + SURFACING + PARAPET)
    added = model.masses_kg - bare.masses_kg
    assert added.sum() == pytest.approx(SURFACING_KG + PARAPET_KG, rel=1e-9)
    assert (added[model.member_of_shard != 0] == 0.0).all() and (added >= 0.0).all()
    up = sum(bearing.force_n[2] for bearing in forces.values())
    own = WEIGHT_N_M * LENGTH_M
    assert up == pytest.approx(own + STANDARD_GRAVITY_M_S2 * (SURFACING_KG + PARAPET_KG), rel=1e-6)


def test_what_is_taken_off_first_is_a_stage_and_not_in_the_model():
    text = deck_text(shards=40)
    bare = checked_model(scenario_from_text(text))
    scenario = scenario_from_text(text + SURFACING + "until_s = 0.05\n" + PARAPET)
    model = checked_model(scenario)
    assert model.masses_kg.sum() - bare.masses_kg.sum() == pytest.approx(PARAPET_KG, rel=1e-9)
    stages = list(stages_of(scenario, StandingBridge(model, scenario.joints), lambda *_: None, with_factor=False))
    assert [stage.step for stage in stages] == ["as it was built", "surfacing is taken off"]
    assert [stage.equipment for stage in stages] == [("surfacing",), ()]
    before, after = (reactions_n(model, stage)[2] for stage in stages)
    assert before - after == pytest.approx(STANDARD_GRAVITY_M_S2 * SURFACING_KG, rel=1e-6)


def test_a_part_of_the_length_lies_where_it_is_said():
    """Its lever arm about the first axis is that of its middle, 3.5 m; shards of 1.3 m carry it at theirs."""
    text = deck_text(shards=120, seed=4)
    bare = checked_model(scenario_from_text(text))
    more = PARAPET + "along_m = [2.0, 5.0]\n"
    model = checked_model(scenario_from_text(text + more))
    added = model.masses_kg - bare.masses_kg
    assert added.sum() == pytest.approx(600 * 3.0, rel=1e-9)
    assert np.sum(added * model.centres_m[:, 0]) / added.sum() == pytest.approx(3.5, abs=0.5)
    assert np.sum(added * model.centres_m[:, 1]) / added.sum() > 0.5


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"mass_kg_m": 5.0}, "mass_kg_m2 and dead_loads.mass_kg_m are given together"),
        ({"mass_kg_m2": None}, "mass_kg_m"),
        ({"across_m": (2.0, 1.0)}, "two positions, the lower one first"),
    ],
)
def test_contradictions_are_refused(values, text):
    load = DeadLoad(name="surfacing", mass_kg_m2=240.0)
    with pytest.raises(ScenarioError, match=text):
        replace(load, **values)


@pytest.mark.parametrize(
    ("more", "text"),
    [
        (PARAPET.replace("[1.2, 1.5]", "[1.2, 1.8]"), r"positions on deck, which reaches from -1.5 to 1.5 \(m\)"),
        (PARAPET + 'member = "girder"\n', 'dead_loads.member is "girder": expected the name or kind of a member'),
        (
            PARAPET + 'until_s = 0.1\n[[removals]]\nmembers = ["deck"]\ntime_s = 0.05\n',
            r"dead_loads.until_s is 0.1: expected at most 0.05 \(s\)",
        ),
    ],
)
def test_loads_beside_the_deck_and_those_that_come_off_too_late_are_refused(more, text):
    with pytest.raises(ScenarioError, match=text):
        checked_model(scenario_from_text(deck_text(shards=20) + more))
