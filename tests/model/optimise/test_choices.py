# SPDX-License-Identifier: GPL-3.0-or-later
"""One of several values for some keys alike, in an optimisation of drilled charges."""

from dataclasses import replace

import pytest
from support.drilled_columns import ZONE, column_scenario

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.optimise.file import optimisation_of, total_charge_kg
from bridge_demolition_addon.model.optimise.settings import ChosenOption, ChosenQuantity, OptimiseSettings
from bridge_demolition_addon.model.study.criteria import Criterion
from bridge_demolition_addon.model.study.keys import changed

UPPER = replace(ZONE, name="upper", middle_m=3.2)


def optimisation(folder, *choices, **tables):
    settings = OptimiseSettings(
        scenario="column.toml",
        objective="charge",
        choices=choices,
        criteria=(Criterion(name="down", kind="collapsed"),),
        candidates=20,
        **tables,
    )
    return optimisation_of(settings, column_scenario(folder, ZONE, UPPER))


def test_one_of_several_values_is_the_same_for_all_keys(tmp_path):
    """0 to a third is the first of three, and 1 the last; without explosive a zone does not go off."""
    grams = ChosenOption(keys=("blast_zones.zone.charge_g", "blast_zones.upper.charge_g"), values=(0, 40.0, 73.5))
    found = optimisation(tmp_path, grams)
    for share, charge_g in ((0.0, 0.0), (0.33, 0.0), (0.34, 40.0), (0.67, 73.5), (1.0, 73.5)):
        scenario = changed(found.scenario, found.space.values([share]))
        assert [zone.charge_g for zone in scenario.blast_zones] == [charge_g] * 2
        assert total_charge_kg(scenario) == pytest.approx(20 * charge_g / 1000.0)
        assert all(zone.goes_off is (charge_g > 0.0) for zone in scenario.blast_zones)
    assert found.space.shown([1.0]) == {"blast_zones.zone.charge_g": 73.5, "blast_zones.upper.charge_g": 73.5}


def test_zones_fire_or_not_and_explosives_are_chosen(tmp_path):
    fires = ChosenOption(keys=("blast_zones.upper.fires",), values=(True, False))
    kind = ChosenOption(keys=("blast_zones.explosive",), values=("emulsion", "gelatine"))
    space = optimisation(tmp_path, fires, kind).space
    scenario = changed(column_scenario(tmp_path, ZONE, UPPER), space.values([1.0, 1.0]))
    assert [zone.fires for zone in scenario.blast_zones] == [True, False]
    assert {zone.explosive for zone in scenario.blast_zones} == {"gelatine"}


@pytest.mark.parametrize(
    ("choice", "text"),
    [
        (
            {"keys": (), "values": (1.0, 2.0)},
            "choices.keys is a list of length 0: expected a list of one or more texts",
        ),
        ({"keys": ("blast_zones.charge_g",), "values": (1.0, 1.0)}, "choices.values is .*: expected two that differ"),
        ({"keys": ("blast_zones.charge_g",), "values": (0.0, 1e5)}, "charge_g may come to 100000"),
        ({"keys": ("blast_zones.explosive",), "values": ("emulsion", "dynamite")}, 'explosive is "dynamite"'),
        ({"keys": ("blast_zones.gram",), "values": (0.0, 1.0)}, "blast_zones.gram"),
    ],
)
def test_choices_that_cannot_be_are_refused(tmp_path, choice, text):
    with pytest.raises(ScenarioError, match=text):
        optimisation(tmp_path, ChosenOption(**choice))


def test_a_key_is_named_once(tmp_path):
    grams = ChosenOption(keys=("blast_zones.zone.charge_g",), values=(0.0, 70.0))
    with pytest.raises(ScenarioError, match="named more than once"):
        optimisation(
            tmp_path, grams, quantities=(ChosenQuantity(key="blast_zones.charge_g", lowest=10.0, highest=70.0),)
        )
