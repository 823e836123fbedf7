# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole job in few lines: the viaduct of 2018 with valley, bed, dead load and one zone for its twelve columns.

What is published of it: 12 columns, 264 holes, 82 kg, 134 m, 6000 t (westfalenpost.de 214145455, come-on.de 9825615).
"""

from pathlib import Path

import pytest

from bridge_demolition_addon.model.bridge import bridge_members
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.dead_loads import lying_load

FILE = Path(__file__).with_name("viaduct_2018.toml")
MOST_LINES = 60


def test_it_is_written_in_few_lines():
    lines = [line for line in FILE.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines) < MOST_LINES


def test_it_has_what_is_published():
    scenario = read_scenario(FILE)
    zones = scenario.blast_zones
    assert len({zone.member for zone in zones}) == len(zones) == 12
    assert sum(zone.rows * zone.holes_a_row for zone in zones) == 264
    assert sum(zone.rows * zone.holes_a_row * zone.charge_g for zone in zones) == pytest.approx(82e3, rel=5e-3)
    assert [zone.delay_ms for zone in zones] == [
        125.0 * axis + 25.0 * column for axis in range(4) for column in range(3)
    ]
    members = bridge_members(scenario.bridge)
    standing = sum(member.mass_kg for member in members if member.kind != "abutment")
    lying = sum(lying_load(load, members).mass_kg for load in scenario.dead_loads)
    assert standing + lying == pytest.approx(6000e3, rel=0.01)
    # 15 m of asphalt of 240 kg/m² and 2400 kg/m, over 134 m and both overhangs of 0.5 m.
    assert lying == pytest.approx(135 * (15 * 240 + 2400), rel=1e-6)
