# SPDX-License-Identifier: GPL-3.0-or-later
"""Cables in a report of a run: the force of each, the energy it let go, and a notice that it kills."""

from types import SimpleNamespace

from bridge_demolition_addon.model.results.records import PullOfRun, record_of
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph
from bridge_demolition_addon.report.sections.loads import pull_section

PULLS = [
    {
        "name": "left",
        "largest_force_N": 80e3,
        "largest_force_s": 4.5,
        "paid_out_s": 3.25,
        "ended": "broke",
        "ended_s": 4.5,
        "let_go_J": 2500.0,
        "work_J": 61e3,
    },
    {
        "name": "right",
        "largest_force_N": 20e3,
        "largest_force_s": 2.0,
        "paid_out_s": None,
        "ended": None,
        "ended_s": None,
        "let_go_J": None,
        "work_J": 1e3,
    },
]


def run_with(pulls):
    records = [record_of(PullOfRun, pull, "pulls") for pull in pulls]
    return SimpleNamespace(summary=SimpleNamespace(pulls=records, lifts=()))


def test_each_cable_has_a_row():
    notice, table = pull_section(run_with(PULLS)).blocks
    assert isinstance(notice, Paragraph) and notice.is_notice
    assert isinstance(table, DataTable)
    assert table.shown_rows() == [
        ["left", "80.0", "4.500", "3.250", "61.0", "broke", "4.500", "2.5"],
        ["right", "20.0", "2.000", "-", "1.0", "held to the end", "-", "-"],
    ]


def test_without_cables_there_is_none():
    assert pull_section(run_with([])) is None
