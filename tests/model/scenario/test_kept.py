# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as Blender data keeps them: those saved before are read, and what is written reads as it was."""

import pytest

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import BlastSettings, Removal, SawCut, Weakening
from bridge_demolition_addon.model.scenario.kept import (
    table_from_values,
    table_values,
    tables_from_text,
    tables_text,
    values_from_text,
    values_text,
)

KINDS = (Removal, SawCut, Weakening)

SAVED_BEFORE = (
    '[{"table": "removals", "time_s": 1.5, "members": ["pier 1"], "lowest_corner_m": null, "highest_corner_m": null}, '
    '{"table": "saw_cuts", "time_s": 2.0, "members": null, "lowest_corner_m": [0.0, -1.0, 0.0], '
    '"highest_corner_m": [1.0, 1.0, 9.0], "point_m": [0.5, 0.0, 0.0], "normal": [1.0, 0.0, 0.0]}, '
    '{"table": "weakenings", "time_s": 3.0, "members": ["deck"], "lowest_corner_m": null, "highest_corner_m": null, '
    '"factor": 0.5}]'
)
CHANGES = (
    Removal(time_s=1.5, members=("pier 1",)),
    SawCut(
        time_s=2.0,
        lowest_corner_m=(0.0, -1.0, 0.0),
        highest_corner_m=(1.0, 1.0, 9.0),
        point_m=(0.5, 0.0, 0.0),
        normal=(1.0, 0.0, 0.0),
    ),
    Weakening(time_s=3.0, members=("deck",), factor=0.5),
)


def test_a_text_saved_before_is_read_and_written_as_it_was_with_new_keys():
    assert tables_from_text(SAVED_BEFORE, KINDS) == CHANGES
    new = {"removals": {"along": "box"}, "saw_cuts": {"along": "plane"}, "weakenings": {}}
    written = [table | {"skew_deg": 0.0} | new[table["table"]] for table in values_from_text(SAVED_BEFORE, [])]
    assert values_from_text(tables_text(CHANGES), []) == written


def test_an_empty_text_holds_no_tables():
    assert tables_from_text("", KINDS) == ()
    assert values_from_text("", {}) == {}


def test_a_value_that_a_table_cannot_have_is_named():
    with pytest.raises(ScenarioError, match=r"removals\.time_s is -1\.5: expected"):
        tables_from_text(SAVED_BEFORE.replace("1.5", "-1.5", 1), KINDS)


def test_the_values_of_a_table_make_an_equal_one():
    settings = BlastSettings(start_s=0.25, constant_decay=1.0, slow_frame_ms=2.0)
    assert table_from_values(BlastSettings, values_from_text(values_text(table_values(settings)), {})) == settings


def test_truth_values_that_come_back_as_numbers_are_read():
    assert table_from_values(BlastSettings, {"explosion": 0, "shielding": 1}) == BlastSettings(
        explosion=False, shielding=True
    )
