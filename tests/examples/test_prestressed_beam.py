# SPDX-License-Identifier: GPL-3.0-or-later
"""The prestressed beam stands before its tendons are cut, and would not stand without them."""

from dataclasses import replace

import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.stability import COMES_DOWN, STANDS, stability_of
from bridge_demolition_addon.model.structure.model import build_model

FILE = EXAMPLES / "prestressed" / "beam_cut_in_stages.toml"


@pytest.mark.parametrize(("with_tendons", "verdict"), [(True, STANDS), (False, COMES_DOWN)])
def test_it_stands_by_its_tendons(with_tendons, verdict):
    scenario = read_scenario(FILE)
    if not with_tendons:
        scenario = replace(scenario, tendons=(), tendon_cuts=())
    assert stability_of(scenario, build_model(scenario), with_factor=False).verdict == verdict


def test_a_cut_of_each_tendon_says_its_energy():
    """F² L / 2 E A = 630 kN squared by 20.0 m over 2 · 195 GPa · 600 mm², 34 kJ each."""
    model = build_model(read_scenario(FILE))
    stored_j = model.tendons.forces_of_shards(model.centres_m).stored_j()
    assert stored_j == pytest.approx([34e3] * 3, rel=0.01)


def test_no_seed_changes_it():
    """Its one run is all that there is: it is cut in prisms."""
    model, other = (build_model(replace(read_scenario(FILE), seed=seed)) for seed in (1, 2))
    assert (model.centres_m == other.centres_m).all()
    assert (model.connections.points == other.connections.points).all()
