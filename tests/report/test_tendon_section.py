# SPDX-License-Identifier: GPL-3.0-or-later
"""Tendons in a report of a run: energy in each, what it let go, and a notice that it hurts people."""

from types import SimpleNamespace

from bridge_demolition_addon.model.results.records import TendonOfRun, record_of
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph
from bridge_demolition_addon.report.sections.reinforcement import tendon_section

TENDONS = [
    {
        "name": "lower",
        "member": "deck",
        "force_N": 630e3,
        "stored_J": 34e3,
        "released": [
            {"time_s": 0.5, "how": "cut", "energy_J": 10e3},
            {"time_s": 0.9, "how": "ruptured", "energy_J": 4e3},
        ],
    },
    {"name": "upper", "member": "deck", "force_N": 630e3, "stored_J": 34e3, "released": []},
]


def run_with(tendons):
    records = [record_of(TendonOfRun, tendon, "tendons") for tendon in tendons]
    return SimpleNamespace(summary=SimpleNamespace(tendons=records))


def test_each_tendon_has_a_row():
    notice, table = tendon_section(run_with(TENDONS)).blocks
    assert isinstance(notice, Paragraph) and notice.is_notice
    assert isinstance(table, DataTable)
    assert table.shown_rows() == [
        ["lower", "deck", "630", "34.0", "14.0", "0.500", "cut, ruptured"],
        ["upper", "deck", "630", "34.0", "0.0", "-", ""],
    ]


def test_without_tendons_there_is_none():
    assert tendon_section(run_with([])) is None
