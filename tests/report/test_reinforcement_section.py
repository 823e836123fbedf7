# SPDX-License-Identifier: GPL-3.0-or-later
"""Reinforcement in a report: the schedule as a table, its steel, a picture, and concrete without bars."""

from dataclasses import replace

import pytest
from support.bridges_by_rule import LM1, bridge, layer, scenario, scheduled

from bridge_demolition_addon.model.scenario import BridgeReinforcement, Ground
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph, Picture
from bridge_demolition_addon.report.sections.reinforcement import reinforcement_section


def blocks(section, kind):
    return [block for block in section.blocks if isinstance(block, kind)]


def test_the_schedule_is_a_table():
    section = reinforcement_section(scenario(bridge()))
    schedule, steel = blocks(section, DataTable)
    assert len(schedule.rows) == len(scheduled(bridge()).rows)
    (main,) = layer(scheduled(bridge()), "deck", "bottom", "x")
    names = [column.key for column in schedule.columns]
    row = dict(zip(names, schedule.rows[0], strict=True))
    assert (row["members"], row["side"], row["along"], row["choice"]) == ("deck", "bottom", "x", main.bars_text)
    assert row["area_mm2"] == pytest.approx(main.layer.area_mm2)
    assert row["ratio_percent"] == pytest.approx(100.0 * main.layer.area_mm2 / (3700.0 * 600.0))
    assert dict(steel.rows)["steel of all"].endswith("usual in decks are 80 to 150 kg/m³")
    assert len(blocks(section, Picture)) == 1
    assert not [block for block in blocks(section, Paragraph) if block.is_notice]
    assert "1.35 G + 1.5 Q" in blocks(section, Paragraph)[0].text


def test_concrete_without_bars_is_a_notice():
    section = reinforcement_section(scenario(bridge(None)))
    (notice,) = section.blocks
    assert notice.is_notice and notice.text.startswith("No reinforcing bars in deck, pier cap, pier: ")


def test_no_bars_on_purpose_need_no_section():
    assert reinforcement_section(scenario(bridge(BridgeReinforcement(designed_for="none")))) is None


def test_ground_that_is_not_there_any_more_is_said():
    plan = replace(scenario(bridge(LM1)), ground=Ground(file="/nowhere/terrain.stl"))
    (notice,) = [block for block in blocks(reinforcement_section(plan), Paragraph) if block.is_notice]
    assert notice.text.startswith("The schedule of bars cannot be made again: ")
