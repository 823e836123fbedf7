# SPDX-License-Identifier: GPL-3.0-or-later
"""The programme of works by hand, reach and noise of machines by geometry and ISO 9613-2, and what is refused."""

import math
from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.engineering.timing.shifts import clock, worked_from
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.scenario.programme import Machine, Programme
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph, Picture
from bridge_demolition_addon.report.sections.programme import programme_section

TEXT = """
[scenario]
title = "A weekend"
[time]
duration_s = 1
[bridge]
density_kg_m3 = 2500
span_lengths_m = [13.0, 13.0]
[bridge.deck]
width_m = 8.0
thickness_m = 0.8
overhang_m = 0.5
[bridge.piers]
kind = "wall"
column_length_m = 0.8
column_width_m = 6.0
height_m = 5.0
[fracture]
shards = 40
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
[[machines]]
name = "breaker"
position_m = [13.0, -14.0, 1.5]
reach_m = 12.0
members = ["pier 2"]
output_m3_h = 6.0
sound_power_db = 121.0
[[machines]]
name = "loader"
tool = "loader"
position_m = [0.0, -14.0, 1.5]
[programme]
begins_h = 20.0
shifts_h = [[0.0, 4.0], [20.0, 24.0]]
[[programme.possessions]]
name = "railway closed"
from_h = 22.0
to_h = 52.0
[[programme.tasks]]
name = "surfacing"
hours_h = 3.0
[[programme.tasks]]
name = "deck"
machine = "breaker"
volume_m3 = 36.0
after = ["surfacing"]
possession = "railway closed"
[[programme.tasks]]
name = "pier 2"
machine = "breaker"
volume_m3 = 24.0
possession = "railway closed"
[[programme.tasks]]
name = "rubble"
machine = "loader"
hours_h = 10.0
after = ["deck", "pier 2"]
possession = "railway closed"
"""


def test_times_by_hand():
    """Shifts from 20 to 4 h: 3 h, then 36/6 = 6 h over a day's end at 28 h, then 4 h the next night, then 10 h."""
    scenario = scenario_from_text(TEXT)
    rows = scenario.programme.scheduled(scenario.machines)
    times = [(row.task.name, row.begins_h, row.ends_h) for row in rows]
    # Surfacing 20 to 23 h. The deck has 23 to 28 h, and an hour of the next night, up to 45 h. Pier: 45 to 49 h.
    # Rubble: 49 to 52 h of that night, then 68 h and 7 h more.
    assert times == [
        ("surfacing", 20.0, 23.0),
        ("deck", 23.0, 45.0),
        ("pier 2", 45.0, 49.0),
        ("rubble", 49.0, 75.0),
    ]
    assert [row.late_h for row in rows] == [0.0, 0.0, 0.0, 23.0]


def test_work_in_shifts():
    assert worked_from(7.0, 10.0, [(7.0, 12.0), (13.0, 18.0)]) == (7.0, 18.0)
    assert worked_from(12.5, 6.0, [(7.0, 12.0), (13.0, 18.0)]) == (13.0, 32.0)
    assert worked_from(30.0, 24.0, [(0.0, 24.0)]) == (30.0, 54.0)
    assert (clock(0.0), clock(31.5), clock(47.9999)) == ((1, "00:00"), (2, "07:30"), (3, "00:00"))


def test_check_says_what_a_machine_reaches_and_what_is_late():
    lines = "\n".join(scenario_facts(scenario_from_text(TEXT)))
    # L_W - 20 lg 10 - 8 = 93 dB.
    assert "6 m³/h, 93 dB(A) at 10 m, 79 dB(A) at 50 m, 73 dB(A) at 100 m" in lines
    assert "23.0 h too late for railway closed" in lines
    assert "day 1, 20:00 to day 1, 23:00" in lines
    assert "it works up to 12 m" in lines
    assert "shards are farther away" in lines


def test_noise_falls_by_6_db_with_twice_the_distance():
    machine = Machine(name="breaker", position_m=[0, 0, 0], sound_power_db=120)
    assert machine.noise_db(20.0) == pytest.approx(120 - 10 * math.log10(2 * math.pi * 20**2), abs=0.02)
    assert machine.noise_db(20.0) - machine.noise_db(40.0) == pytest.approx(20 * math.log10(2), rel=1e-12)


def test_a_report_has_bars_and_names_what_is_late():
    section = programme_section(scenario_from_text(TEXT))
    (late,) = (str(block.text) for block in section.blocks if isinstance(block, Paragraph))
    assert late.startswith("rubble ends 23.0")
    (table,) = (block for block in section.blocks if isinstance(block, DataTable))
    assert [str(cell) for cell in table.rows[1][:4]] == ["deck", "breaker", "day 1, 23:00", "day 2, 21:00"]
    (picture,) = (block for block in section.blocks if isinstance(block, Picture))
    figure = Figure()
    picture.draw(figure)
    bars = [(bar.get_x(), bar.get_width()) for bar in figure.axes[0].patches]
    assert bars[2] == pytest.approx((1 + 23 / 24, 22 / 24))
    assert programme_section(replace(scenario_from_text(TEXT), programme=None)) is None


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('machine = "loader"', 'machine = "lorry"', r'tasks\.machine is "lorry": expected one of .*breaker, loader'),
        ('after = ["deck", "pier 2"]', 'after = ["cutting"]', r"tasks\.after .* listed before rubble: .*; not cutting"),
        ("output_m3_h = 6.0", "", r"tasks\.volume_m3 is 36.0: expected a machine of deck with output_m3_h, or hours_h"),
        ("to_h = 52.0", "to_h = 20.0", r"possessions\.to_h is 20.0: expected more than .*from_h, 22 \(h\)"),
        ("[20.0, 24.0]]", "[3.0, 24.0]]", r"shifts_h .* in order, each shift after the one before: 3 to 24"),
        ("hours_h = 3.0", "", r"programme.tasks has no volume_m3 or hours_h"),
        ('name = "pier 2"', 'name = "deck"', "have one name"),
    ],
)
def test_what_cannot_be_planned_is_refused(old, new, message):
    assert old in TEXT
    with pytest.raises(ScenarioError, match=message):
        scenario_from_text(TEXT.replace(old, new))


def test_members_that_are_not_there_are_refused():
    with pytest.raises(ScenarioError, match=r"machines\.members .* expected names or kinds of members"):
        list(scenario_facts(scenario_from_text(TEXT.replace('members = ["pier 2"]', 'members = ["pylon"]'))))
    assert Programme().scheduled(()) == []
