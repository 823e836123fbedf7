# SPDX-License-Identifier: GPL-3.0-or-later
"""The composite span stands before its girders are severed, and comes down after the second cut by statics."""

import math

import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.stability import STANDS, stability_of
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.steel_bars import bar_uses

FILE = EXAMPLES / "steel" / "composite_span_dropped.toml"


def test_it_stands_and_its_girders_carry_what_statics_says():
    """Shear at the end of half of the bridge, w L / 2, of which the deck carries up to a tenth; M at midspan below."""
    scenario = read_scenario(FILE)
    model = build_model(scenario)
    assert stability_of(scenario, model, with_factor=False).verdict == STANDS
    uses = {use.name: use for use in bar_uses(scenario, model, model_at_rest(model, scenario.joints))}
    assert max(use.used for use in uses.values()) < 0.5
    area = section_named("PG 1000x12x300x20x400x30").area_m2
    weight = STANDARD_GRAVITY_M_S2 * (2500.0 * 2.8 * 0.2 + 7850.0 * area)
    end = uses["span G1 0-1"]
    shear = end.web_used * end.web.resistance_n
    assert 0.85 < shear / (weight * 12.5) < 1.02
    # Web of 950 mm × 12 mm, stiffeners at 2.5 m: λ = 1.0695, χ = 0.776, by hand (tests of webs).
    assert end.web.slenderness == pytest.approx(1.0695, rel=1e-3)
    assert end.web.resistance_n == pytest.approx(0.776 * 355e6 * 0.95 * 0.012 / math.sqrt(3.0), rel=2e-3)
