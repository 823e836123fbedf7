# SPDX-License-Identifier: GPL-3.0-or-later
"""Contents of a demolition plan in a report: every section that is named is there, all else is a named blank."""

from dataclasses import replace
from pathlib import Path

import pytest
from support.checkout import EXAMPLES
from support.run_folders import TOLD, flying_shards, keep_run
from support.stage_folders import with_stages
from support.study_folders import told_runs

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study.runs_table import RunsTable
from bridge_demolition_addon.report.ensemble.study import study_document
from bridge_demolition_addon.report.run import run_document
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.debris import zone_of
from bridge_demolition_addon.report.sections.plan_contents import PLAN_ITEMS, TITLE, asked_items
from bridge_demolition_addon.report.sections.stages import stages_report

DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans_in_100_shards.toml")
OUTPUT = 'neighbours."House".touchdown_mm_s'
FROM_ELSEWHERE = {"How far fragments fly", "Tendons", "Pulls"}
"""Of studies with blast zones, of bridges with tendons, and of cables that pull; tests of theirs look for these."""


@pytest.fixture(scope="module")
def documents(tmp_path_factory):
    """Documents of a run with everything, of one with drilled charges, and of a study."""
    made = []
    for name, scenario in (("told", TOLD), ("drilled", DRILLED)):
        run = read_run(keep_run(tmp_path_factory.mktemp("runs") / name, flying_shards(6, 13), scenario))
        made.append(run_document(run, "0", zone_of(run)))
    stages = stages_report(with_stages(tmp_path_factory.mktemp("stages")), Path(), Silence()).document
    return [*made, stages, study_document(with_neighbours(told_runs()), "0")]


def with_neighbours(runs):
    """A study whose runs know how the ground shakes at a neighbour: by their numbers in mm/s."""
    rows = [
        row if row.status != "done" else replace(row, outputs={**row.outputs, OUTPUT: float(row.number)})
        for row in runs.table.rows
    ]
    return replace(runs, table=RunsTable(tuple(rows)))


def test_a_study_says_the_largest_of_its_runs_at_the_neighbours(documents):
    ((name, median, largest, runs),) = documents[-1].table("neighbours_of_runs").rows
    assert (name, median, largest, runs) == ('"House" touchdown (mm/s)', 47.0, 93.0, 93)


def test_sections_that_items_name_exist(documents):
    titles = {section.title for document in documents for section in document.sections}
    named = {title for item in PLAN_ITEMS for title in item.sections}
    assert named - titles <= FROM_ELSEWHERE


def test_items_lead_to_sections_by_their_numbers_or_are_blanks(documents):
    for document in documents:
        numbered = [f"{number} {section.title}" for number, section in enumerate(document.sections, start=1)]
        rows = document.table("plan_contents").rows
        answers = [answer for _, _, row, _ in rows if row for answer in row.split("; ")]
        assert answers and set(answers) <= set(numbered)
        assert any(row[2] is None for row in rows)
        assert all(": " in row[3] and row[3].endswith("____") for row in rows)
        assert any(section.title == TITLE for section in document.sections)


def test_a_section_that_only_says_what_is_missing_answers_nothing(documents):
    zones = [
        row[2]
        for document in documents[:2]
        for row in document.table("plan_contents").rows
        if row[0].startswith("Exclusion zone")
    ]
    assert "Exclusion zone of one run" in zones[0] and DRILLED.exclusion is None and zones[1] is None


def test_every_item_has_a_source_and_one_who_fills_it_in():
    assert all(item.name and item.sources and item.by and item.left for item in PLAN_ITEMS)
    sources = " ".join(source for item in PLAN_ITEMS for source in item.sources)
    assert all(name in sources for name in ("ASCE MOP 157", "BS 6187:2011", "DIN 18007", "HSE", "29 CFR 1926"))


def test_explosives_are_asked_about_where_there_are_some():
    def names(scenario):
        return {item.name for item in asked_items(scenario)}

    without = replace(TOLD, charges=())
    assert names(TOLD) - names(without) >= {"Charges, delays, largest charge per delay", "Notice of the blasting"}
    assert "Crane and line of the ball" in names(without)
    assert "Crane and line of the ball" not in names(DRILLED)


def test_settings_stand_after_the_contents(documents):
    titles = [section.title for section in documents[0].sections]
    assert titles.index(TITLE) < titles.index("The run") < titles.index("The scenario") == len(titles) - 1
