# SPDX-License-Identifier: GPL-3.0-or-later
"""Single pages for client, authority and crew: one page each, of what the report says."""

import re
from dataclasses import replace

import pytest
from support.run_folders import TOLD, flying_shards, keep_run
from support.stage_folders import with_stages
from support.study_folders import told_runs

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.scenario import Exclusion, Removal
from bridge_demolition_addon.report.document import pdf
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph, Photo, Picture
from bridge_demolition_addon.report.document.drawings import drawings
from bridge_demolition_addon.report.ensemble.study import study_document
from bridge_demolition_addon.report.run import run_document
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.debris import zone_of
from bridge_demolition_addon.report.sections.planned_sequence import means_text, planned_steps
from bridge_demolition_addon.report.single_pages import single_pages
from bridge_demolition_addon.report.write import write_report

SCENARIO = replace(
    TOLD,
    removals=(Removal(time_s=0.3, members=("pier 1",)),),
    exclusion=Exclusion(buffer_m=5, designed_drop_m=1, cordon_m=300),
)


@pytest.fixture(scope="module", params=["run", "study"])
def pages(request, tmp_path_factory):
    """The single pages of a run or a study, and its scenario."""
    if request.param == "study":
        runs = told_runs()
        return single_pages(study_document(runs, "0"), runs.ensemble.scenario), runs.ensemble.scenario
    run = read_run(keep_run(tmp_path_factory.mktemp("runs") / "run", flying_shards(), SCENARIO))
    return single_pages(run_document(run, "0", zone_of(run)), run.scenario), run.scenario


def test_each_is_one_page(pages):
    for audience, page in pages[0].items():
        assert len(pdf.laid_out(page, drawings(page))) == 1, audience


def test_each_begins_with_what_is_to_be_doubted_and_the_verdict(pages):
    for page in pages[0].values():
        doubt, verdict, *_ = (block for block in page.summary if isinstance(block, Paragraph))
        assert doubt.is_notice and re.search("shards still move|not everything had rested", doubt.text)
        assert verdict.is_notice and re.match("In this one run|Debris stays within", verdict.text)


def test_the_client_sees_a_picture(pages):
    assert any(isinstance(block, Picture | Photo) for block in pages[0]["client"].summary)


def tables(page):
    return {block.title: block for block in page.summary if isinstance(block, DataTable)}


def test_the_authority_sees_what_is_not_modelled_and_the_blanks(pages):
    *_, limits, blanks = (text for (text,) in tables(pages[0]["authority"])["What this does not say"].rows)
    assert "Nothing here has been calibrated" in limits and "Service lines" in blanks


def test_the_authority_sees_the_neighbours(tmp_path):
    run = read_run(keep_run(tmp_path / "run", flying_shards(), SCENARIO))
    page = single_pages(run_document(run, "0", zone_of(run)), run.scenario)["authority"]
    names = {block.name for block in page.summary if isinstance(block, DataTable)}
    assert names >= {"plan", "neighbours", "touchdown", "zones"}


def test_the_crew_sees_times_in_order_and_what_is_kept_clear(pages):
    page, scenario = pages[0]["crew"], pages[1]
    sequence = tables(page)["Planned sequence"]
    times = [row[0] for row in sequence.rows if row[0] is not None]
    assert times == sorted(times)
    first_s = scenario.blast.start_s
    delays = sorted(first_s + charge.delay_ms / 1e3 for charge in scenario.charges)
    fired = [time_s for time_s, _, what, _ in sequence.rows if "detonates" in what]
    assert fired == pytest.approx(delays)
    distances = dict(tables(page)["Who stands where, and when"].rows)
    wanted = "300 m" if scenario is not None and scenario.exclusion.cordon_m else "________ m"
    assert distances["Clear of people within"].startswith(wanted)
    assert "30 CFR 56.6310" in distances["If a charge may not have fired"]
    assert all(row[2:] == ("________", "________") for row in tables(page)["To be ticked"].rows)


def test_a_crane_has_twice_the_load_of_its_ball_and_four_times_on_its_line(tmp_path):
    run = read_run(keep_run(tmp_path / "run", flying_shards(6, 13), replace(SCENARIO, charges=())))
    page = single_pages(run_document(run, "0", zone_of(run)), run.scenario)["crew"]
    rows = dict(tables(page)["Who stands where, and when"].rows)
    mass_t = SCENARIO.ball.mass_kg / 1e3
    assert f"{2 * mass_t:.1f} t" in rows["Crane and line"] and f"{4 * mass_t:.1f} t" in rows["Crane and line"]
    assert "If a charge may not have fired" not in rows


def test_what_is_planned_is_said_in_order():
    steps = planned_steps(SCENARIO)
    assert [step.begins_s for step in steps] == sorted(step.begins_s for step in steps)
    assert any(step.what == "removal" and step.where == "pier 1" and step.begins_s == 0.3 for step in steps)
    assert "2 bare charges with 7 kg" in means_text(SCENARIO) and "1 removal" in means_text(SCENARIO)


@pytest.mark.long
def test_the_command_writes_those_that_are_asked_for(tmp_path, capsys):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), SCENARIO)
    assert main(["report", str(folder), "--pages", "client,crew", "--quiet"]) == 0
    assert {path.name for path in folder.glob("page_for_*")} == {"page_for_client.pdf", "page_for_crew.pdf"}
    assert main(["report", str(folder), "--pages", "clients"]) == 2
    assert "'clients': expected client, authority, crew or all" in capsys.readouterr().err


def test_there_are_none_of_stages_and_of_several_runs(tmp_path):
    stages = with_stages(tmp_path / "stages")
    with pytest.raises(OutputError, match="pages are of a run or a study"):
        write_report([stages], None, pages=["crew"], progress=Silence())
    with pytest.raises(OutputError, match="--pages is for the report of one run or study"):
        write_report([stages, stages], tmp_path / "both", pages=["crew"], progress=Silence())
