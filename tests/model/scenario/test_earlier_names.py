# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys that were renamed are read by their earlier names, which a line says."""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model import toml_tables
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.schema import EARLIER_NAMES
from bridge_demolition_addon.model.study.keys import keys_named

TEXT = SMALL.read_text(encoding="utf-8")
OTHERS = """
[[neighbours]]
name = "house"
{} = [30.0, 0.0, 1.0]

[[charges]]
mass_kg = 1.0
{} = [0.0, 0.0, 1.0]
"""


@pytest.fixture(autouse=True)
def said_anew():
    toml_tables.say_renamed.cache_clear()


def test_a_file_with_earlier_names_is_the_same_scenario_and_a_line_names_the_present_one(caplog):
    earlier, now = (scenario_from_text(TEXT + OTHERS.format(name, name)) for name in ("place_m", "position_m"))
    assert earlier == now
    assert sorted(record.getMessage() for record in caplog.records) == [
        "charges.place_m is charges.position_m now: its earlier name will be refused some day",
        "neighbours.place_m is neighbours.position_m now: its earlier name will be refused some day",
    ]


def test_both_names_at_once_are_refused():
    with pytest.raises(ScenarioError, match=r"charges\.place_m is given with its present name"):
        scenario_from_text(TEXT + OTHERS.format("position_m", "place_m = [0.0, 0.0, 1.0]\nposition_m"))


def test_scripts_and_studies_may_say_the_earlier_name():
    assert Charge(place_m=(1.0, 2.0, 3.0), mass_kg=1.0).position_m == (1.0, 2.0, 3.0)
    scenario = scenario_from_text(TEXT + OTHERS.format("position_m", "position_m"))
    (found,) = keys_named(scenario, "neighbours.house.place_m.1")
    assert found.value == 30.0 and found.name == "neighbours.house.position_m.1"


def test_no_key_has_an_earlier_name():
    from bridge_demolition_addon.ui.scenario.prop import all_tables, shown_keys

    names = {item.name for table in all_tables() for item in shown_keys(table)}
    assert names.isdisjoint(EARLIER_NAMES) and set(EARLIER_NAMES.values()) <= names
