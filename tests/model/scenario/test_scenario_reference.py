# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of a scenario's keys says what the code does."""

from support.checkout import ROOT

from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.reference import scenario_reference
from bridge_demolition_addon.model.schema import holds_many, key_fields, subtable_class, subtable_fields

DOCUMENT = ROOT / "docs" / "scenario.md"


def all_tables(table_class, brackets="[{}]"):
    """Every table with its heading in a file."""
    yield brackets.format(table_class.table), table_class
    for item in subtable_fields(table_class):
        yield from all_tables(subtable_class(item), "[[{}]]" if holds_many(item) else "[{}]")


def test_the_document_is_up_to_date():
    assert DOCUMENT.read_text(encoding="utf-8") == scenario_reference(), (
        "run: python -m bridge_demolition_addon.model.scenario.reference docs/scenario.md"
    )


def test_every_key_has_a_row_of_four_cells():
    sections = scenario_reference().split("\n## ")[1:]
    tables = list(all_tables(Scenario))
    assert [section.splitlines()[0] for section in sections] == [heading for heading, _ in tables]
    for section, (_, table_class) in zip(sections, tables, strict=True):
        rows = [line for line in section.splitlines() if line.startswith("| `")]
        assert [row.split("`")[1] for row in rows] == [item.name for item in key_fields(table_class)]
        assert {row.count(" | ") for row in rows} <= {3}
