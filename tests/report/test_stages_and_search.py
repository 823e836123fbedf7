# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports with a chapter on stages, of stages alone, and of a search."""

import csv
from dataclasses import replace

import pytest
from support.run_folders import killed_run
from support.scenarios import I235
from support.search_folders import search_folder
from support.stage_folders import STAGES, with_stages

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.scenario.file import scenario_text

REACTIONS = """\
stage,time_s,step,support,kind,at_x_m,at_y_m,at_z_m,force_x_kN,force_y_kN,force_z_kN,\
moment_x_kNm,moment_y_kNm,moment_z_kNm,own_weight_kN
1,0,as it was built,west,foundation,0,0,0,-31,0,260,0,75,0,0
1,0,as it was built,east,support,13,0,0,31,0,240,0,-75,0,12
2,0.5,"removal of pier <1>",west,foundation,0,0,0,-44,1,495.25,2,91,0,0
2,0.5,"removal of pier <1>",east,support,13,0,0,44,-1,-15.25,1,-8,0,12
"""


def page_of(folder):
    return (folder / "report.html").read_text(encoding="utf-8")


def test_stages_alone_make_a_report_that_warns_of_what_does_not_stand(tmp_path):
    folder = with_stages(tmp_path / "stages of a bridge")
    assert main(["report", str(folder), "--quiet"]) == 0
    page = page_of(folder)
    assert "<title>stages of a bridge" in page and "× 2.31" in page and "more than × 64" in page
    assert (
        "Stage 2, from 0.5 s (removal of pier &lt;1&gt;) does not stand: it comes down at 0.83 times its load." in page
    )
    assert "Stage 3, from 1 s (saw cut of 4 connections): 21.0 t are held by no connection to a support." in page
    assert "pier 1" in page and "42.0" in page and "55%" in page
    rows = list(csv.DictReader((folder / "tables" / "stages.csv").open(encoding="utf-8")))
    assert [row["largest_utilisation"] for row in rows] == ["0.42", "1.3", "0.1"]
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF-")


def test_reactions_of_supports_are_told_by_their_extremes_over_the_stages(tmp_path):
    folder = with_stages(tmp_path / "stages")
    (folder / "reactions.csv").write_text(REACTIONS, encoding="utf-8")
    assert main(["report", str(folder), "--quiet"]) == 0
    page = page_of(folder)
    assert "Stage 2: east is held down with 15.2 kN against uplift." in page and "west is held down" not in page
    rows = list(csv.DictReader((folder / "tables" / "reaction_forces.csv").open(encoding="utf-8")))
    assert [row["support"] for row in rows] == ["west", "east"]
    found = [(row["least_force_z_kN"], row["least_force_z_kN_in_stage"]) for row in rows]
    assert found == [("260.0", "1"), ("-15.25", "2")]
    found = [(row["largest_force_x_kN"], row["largest_force_x_kN_in_stage"]) for row in rows]
    assert found == [("-31.0", "1"), ("44.0", "2")]
    moments = list(csv.DictReader((folder / "tables" / "reaction_moments.csv").open(encoding="utf-8")))
    assert [row["largest_moment_y_kNm"] for row in moments] == ["91.0", "-8.0"]
    (folder / "reactions.csv").write_text(REACTIONS.replace("495.25", "soon"), encoding="utf-8")
    assert main(["report", str(folder), "--quiet"]) == 2


@pytest.mark.long
def test_a_run_has_a_chapter_on_stages_where_its_folder_holds_them(tmp_path):
    folder = killed_run(tmp_path / "run")
    assert main(["report", str(folder), "--quiet"]) == 0
    assert "Collapse load factor" not in page_of(folder)
    with_stages(folder)
    assert main(["report", str(folder), "--quiet"]) == 0
    page = page_of(folder)
    assert "Collapse load factor" in page and "only its logs are here" in page


@pytest.mark.long
def test_stages_of_the_runs_scenario_are_worked_out_when_asked_for(tmp_path, capfd):
    folder = killed_run(tmp_path / "run")
    assert main(["report", str(folder), "--stages", "--quiet"]) == 2
    assert "has no scenario whose stages could be worked out" in capfd.readouterr().err
    (folder / "scenario_as_run.toml").write_text(scenario_text(I235), encoding="utf-8")
    assert main(["report", str(folder), "--stages", "--quiet"]) == 2
    # Its connections share no faces, so that nobody knows how stiff they are.
    assert (
        'connections.method is "vertex": how the bridge stands can only be worked out with method = "face"'
        in capfd.readouterr().err
    )
    fixed = replace(
        I235,
        ball=None,
        fracture=replace(I235.fracture, shards=8),
        connections=replace(I235.connections, type="FIXED", method="face", search_radius_m=None),
    )
    (folder / "scenario_as_run.toml").write_text(scenario_text(fixed), encoding="utf-8")
    assert main(["report", str(folder), "--stages", "--quiet"]) == 0
    [row] = csv.DictReader((folder / "stages.csv").open(encoding="utf-8"))
    assert f"× {float(row['collapse_factor']):.2f}" in page_of(folder)
    assert float(row["reaction_z_kN"]) == pytest.approx(float(row["weight_kN"]), rel=1e-3)


def test_a_search_makes_a_report_of_its_answer_its_curve_and_its_trials(tmp_path):
    folder, successes = search_folder(tmp_path / "search")
    assert main(["report", str(folder), "--quiet"]) == 0
    page = page_of(folder / "report")
    assert f"{successes} of 20 runs met all criteria: all runs were made." in page
    assert "ball.mass_kg: half of all runs meet them at" in page and "data:image/" in page
    rows = list(csv.DictReader((folder / "report" / "tables" / "trials.csv").open(encoding="utf-8")))
    assert len(rows) == 20 and rows[-1]["success"] == "not met" and float(rows[0]["value"]) == 200.0


def without_last_row(path):
    path.write_text("".join(path.read_text(encoding="utf-8").splitlines(keepends=True)[:-1]), encoding="utf-8")


def without_the_quantity(path):
    path.write_text(path.read_text(encoding="utf-8").replace("in.ball.mass_kg", "in.mass_kg"), encoding="utf-8")


@pytest.mark.long
def test_a_search_that_goes_on_has_a_report_that_says_so(tmp_path):
    folder, _ = search_folder(tmp_path / "search")
    without_last_row(folder / "trials.csv")
    assert main(["report", str(folder), "--quiet"]) == 0
    assert "19 of up to 20 runs are there: the search states nothing before" in page_of(folder / "report")


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda folder: (folder / "trials.csv").unlink(), "holds no trials.csv yet"),
        (lambda folder: without_the_quantity(folder / "trials.csv"), "trials.csv is damaged"),
        (lambda folder: (folder / "trials.csv").write_text("a,b\n"), "expected a table of runs"),
    ],
)
def test_a_search_that_cannot_be_read_is_refused(tmp_path, capfd, spoil, said):
    folder, _ = search_folder(tmp_path / "search")
    spoil(folder)
    assert main(["report", str(folder), "--quiet"]) == 2
    assert said in capfd.readouterr().err and not (folder / "report").exists()


@pytest.mark.parametrize("stages", ["", "stage,time_s\n1,2\n", STAGES.replace("0.83", "soon")])
def test_damaged_tables_of_stages_are_refused(tmp_path, capfd, stages):
    folder = with_stages(tmp_path / "stages", stages)
    assert main(["report", str(folder), "--quiet"]) == 2
    assert "bda stages" in capfd.readouterr().err and not (folder / "report.html").exists()


def test_stages_are_worked_out_for_one_run_alone(tmp_path, capfd):
    folder = with_stages(tmp_path / "stages")
    assert main(["report", str(folder), "--stages", "--quiet"]) == 2
    assert "is for the report of a run" in capfd.readouterr().err
    assert main(["report", str(folder), str(folder), "--stages", "--output", str(tmp_path / "out"), "--quiet"]) == 2
    assert "leave it out where several are compared" in capfd.readouterr().err
