# SPDX-License-Identifier: GPL-3.0-or-later
"""The truss span of steel stands before its chords are severed."""

from dataclasses import replace

import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.stability import STANDS, stability_of
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.steel_bars import bar_uses

FILE = EXAMPLES / "steel" / "truss_severed.toml"


def test_it_stands_and_none_of_its_bars_buckles():
    scenario = read_scenario(FILE)
    model = build_model(scenario)
    assert stability_of(scenario, model, with_factor=False).verdict == STANDS
    uses = bar_uses(scenario, model, model_at_rest(model, scenario.joints))
    assert len(uses) == 92
    assert max(use.used for use in uses) < 0.5


@pytest.mark.long
def test_no_seed_changes_it():
    """Its header says that one run is all that there is."""
    scenario = read_scenario(FILE)
    model, other = (build_model(replace(scenario, seed=seed)) for seed in (1, 2))
    assert (model.centres_m == other.centres_m).all()
    assert (model.connections.points == other.connections.points).all()
