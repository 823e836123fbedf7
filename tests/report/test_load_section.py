# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads and pressures in a report of a run: force, impulse and work of each, in every language."""

from types import SimpleNamespace

from bridge_demolition_addon.model.results.records import LoadOfRun, record_of
from bridge_demolition_addon.report.languages.translation import ENGLISH, language_names, language_table
from bridge_demolition_addon.report.sections.loads import load_section

FLOOD = {
    "name": "flood",
    "largest_force_N": 57_600.0,
    "largest_force_s": 0.4,
    "impulse_Ns": [0.0, 21_600.0, -250.0],
    "work_J": 4200.0,
}


def run_with(loads):
    records = [record_of(LoadOfRun, load, "loads") for load in loads]
    return SimpleNamespace(summary=SimpleNamespace(loads=records))


def test_each_load_has_a_row():
    (table,) = load_section(run_with([FLOOD])).blocks
    assert table.shown_rows() == [["flood", "57.6", "0.400", "0.00", "21.60", "-0.25", "4.2"]]


def test_without_loads_there_is_none():
    assert load_section(run_with([])) is None


def test_its_words_and_those_of_the_planned_sequence_are_in_every_language():
    section = load_section(run_with([FLOOD]))
    (table,) = section.blocks
    words = {section.title, table.title, *(column.heading for column in table.columns), "{} pressure", "{} pressures"}
    words |= {"{}: pressure of up to {}", "load {}"}
    for language in language_names():
        if language != ENGLISH:
            assert words <= set(language_table(language).texts), language
