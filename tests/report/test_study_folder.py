# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a study from its folder: its files, read back, and folders that are no study's."""

import csv
import json
import re
import shutil
from base64 import b64encode
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imsave
from support.run_folders import flying_shards, keep_run
from support.study_folders import TOLD_SCENARIO, VARIED, keep_study, told_runs, told_study

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.scenario import Zone
from bridge_demolition_addon.model.study.runs_table import read_runs
from bridge_demolition_addon.report.ensemble.reported_ensemble import read_study_runs
from bridge_demolition_addon.report.write import write_report

pytestmark = pytest.mark.long

ASKED = {"quantile": 0.5, "confidence": 0.75, "rank": 2}
FILES = {"report.html", "report.pdf", "study_plan.dxf", "study_plan.geojson", "tables"}


def small_runs(runs=8, **ends):
    return told_runs(told_study(runs=runs, vary=VARIED[1:3], **ASKED), **ends)


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """The folder of a study of eight runs, one of which crashed, and the files of its report."""
    folder = keep_study(tmp_path_factory.mktemp("studies") / "told", small_runs(12, ends={3: "crashed"}))
    return folder, write_report([folder], None, progress=Silence())


@pytest.fixture
def folder(tmp_path):
    return keep_study(tmp_path / "told", small_runs())


def test_the_report_lies_in_a_folder_of_its_own(kept):
    folder, written = kept
    assert {path.name for path in (folder / "report").iterdir()} >= FILES
    assert all(path.is_relative_to(folder / "report") and path.is_file() for path in written)


def test_what_is_read_is_what_was_kept(kept):
    folder, _ = kept
    runs, known = read_study_runs(folder), small_runs(12, ends={3: "crashed"})
    assert runs.ensemble.text == known.ensemble.text
    assert runs.distances_m.tolist() == known.distances_m.tolist()
    assert runs.bridge.area() == pytest.approx(known.bridge.area())
    for found, expected in zip(runs.swept, known.swept, strict=True):
        assert (found is None) == (expected is None)
        for ring, other in zip(found or (), expected or (), strict=True):
            np.testing.assert_allclose(ring, other, atol=1e-5)  # single precision


def test_the_page_begins_with_the_statement_and_needs_nothing_else(kept):
    text = (kept[0] / "report" / "report.html").read_text(encoding="utf-8")
    first = text.index("In 12 independent runs")
    assert (
        text.index("<figure>") < text.index('<p class="notice">Debris stays within') < first
    )  # the plan and the verdict
    assert "blender of tests, numpy 2" in text
    assert "<script" not in text and not re.search(r'(?:src|href)="(?!data:|#)', text)
    assert "<b>& $5$" not in text and "&lt;b&gt;&amp; $5$" in text


def test_tables_are_files_with_all_digits(kept):
    tables = kept[0] / "report" / "tables"
    assert {path.stem for path in tables.iterdir()} >= {
        *("study", "study_areas", "criteria", "varied", "rank_correlations", "median_and_worst", "farthest_draws")
    }
    with (tables / "farthest_draws.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert (rows[0]["run"], rows[0]["status"], rows[0]["reach_m"]) == ("3", "crashed", "")
    reaches = {row.number: row.outputs.get("reach_m") for row in read_runs(kept[0] / "runs.csv").rows}
    assert [float(row["reach_m"]) for row in rows[1:]] == [reaches[int(row["run"])] for row in rows[1:]]


def test_site_plans_have_the_limit_and_the_zones(kept):
    content = json.loads((kept[0] / "report" / "study_plan.geojson").read_text(encoding="utf-8"))
    names = [feature["properties"]["name"] for feature in content["features"]]
    assert names[-3:] == ["bridge", "zone Road <1> $2$", "zone yard"]
    assert "probability above 50 %" in names
    layers = set(
        re.findall(r"^8\r\n(.*)\r$", (kept[0] / "report" / "study_plan.dxf").read_bytes().decode("ascii"), re.M)
    )
    assert {"BRIDGE", "ZONE_ROAD_1_2", "ZONE_YARD", "PROBABILITY_ABOVE_50"} <= layers


def test_the_limit_is_drawn_where_it_is_said(folder):
    write_report([folder], None, progress=Silence())
    content = json.loads((folder / "report" / "study_plan.geojson").read_text(encoding="utf-8"))
    areas = {feature["properties"]["name"]: feature["properties"]["area_m2"] for feature in content["features"]}
    limit_m = sorted(read_study_runs(folder).distances_m)[-2]
    for name, around_m in (("limit", limit_m), ("distance to keep", 1.82 * limit_m + 5.0)):
        exact = 28.0 * 8.0 + 2.0 * 36.0 * around_m + np.pi * around_m**2
        assert areas[name] == pytest.approx(exact, rel=2.5e-3)


def test_the_same_folder_gives_the_same_files(folder, tmp_path):
    for name in ("one", "other"):
        write_report([folder], tmp_path / name, progress=Silence())
    assert not (folder / "report").exists()
    for path in (tmp_path / "one").rglob("*"):
        if path.is_file():
            assert path.read_bytes() == (tmp_path / "other" / path.relative_to(tmp_path / "one")).read_bytes()


def test_pictures_of_the_worst_draw_are_shown_once_it_was_run_again(folder):
    runs = read_study_runs(folder)
    worst = runs.table.rows[runs.table.worst_row].number
    pictures = folder / "again" / str(worst) / "frames"
    pictures.mkdir(parents=True)
    imsave(pictures / "after.png", np.full((9, 16, 3), 0.5))
    (pictures / "before.png").write_text("no picture")
    write_report([folder], None, progress=Silence())
    text = (folder / "report" / "report.html").read_text(encoding="utf-8")
    assert b64encode((pictures / "after.png").read_bytes()).decode("ascii") in text
    assert f"Worst run, {worst}, with a debris distance of" in text and ": before." not in text


def test_a_study_of_which_nothing_finished_has_a_report(tmp_path):
    runs = told_runs(told_study(runs=8, vary=(), **ASKED), ends=dict.fromkeys(range(1, 9), "failed"))
    folder = keep_study(tmp_path / "told", runs)
    write_report([folder], None, progress=Silence())
    text = (folder / "report" / "report.html").read_text(encoding="utf-8")
    assert "These runs set no limit: 8 of 8 did not finish" in text and "there is nothing to draw" in text


def test_a_study_without_a_site_has_no_degrees(tmp_path):
    bare = told_runs(told_study(runs=8, vary=(), scenario=replace(TOLD_SCENARIO, site=None), **ASKED))
    folder = keep_study(tmp_path / "bare", bare)
    write_report([folder], None, progress=Silence())
    assert not (folder / "report" / "study_plan.geojson").exists()


def test_bda_report_writes_it(folder, capsys):
    assert main(["report", str(folder)]) == 0
    assert str(folder / "report" / "report.pdf") in capsys.readouterr().out


def refused(folder, *more):
    with pytest.raises(OutputError) as caught:
        write_report([folder, *more], folder / "new", progress=Silence())
    assert not (folder / "new").exists()
    return str(caught.value)


def test_a_study_without_runs_is_refused(folder):
    (folder / "runs.csv").unlink()
    assert "holds no runs.csv yet: go on with the command that started the study" in refused(folder)


def test_a_draw_that_was_lost_is_named(folder):
    for draw in (folder / "draws").iterdir():
        if json.loads((draw / "outcome.json").read_text(encoding="utf-8"))["inputs"] == dict(
            small_runs().table.rows[4].inputs
        ):
            shutil.rmtree(draw)
    assert refused(folder).startswith(f"{folder / 'draws'}: run 5 of runs.csv is not there: go on with the command")


def test_outcomes_that_are_damaged_are_named(folder):
    damaged = next((folder / "draws").iterdir()) / "outcome.json"
    damaged.write_text('{"status": "done"}', encoding="utf-8")
    assert refused(folder).startswith(f"{damaged}: expected the outcome of a run ('inputs'): delete {damaged.parent}")


def test_a_study_that_another_version_ran_is_read(folder):
    """Addresses of draws depend on the version, and on keys that its scenarios have."""
    for number, draw in enumerate(list((folder / "draws").iterdir())):
        draw.rename(draw.with_name(f"{number:064x}"))
    assert read_study_runs(folder).distances_m.tolist() == small_runs().distances_m.tolist()


def test_a_draw_that_is_damaged_is_named(folder):
    damaged = next((folder / "draws").iterdir()) / "outlines.npz"
    damaged.write_bytes(damaged.read_bytes()[:-40])
    assert refused(folder).startswith(f"{damaged}: expected what debris covered")


def test_a_study_that_is_none_any_more_is_refused(folder):
    text = (folder / "study.toml").read_text(encoding="utf-8")
    (folder / "study.toml").write_text(text.replace("[study]", "[studie]"), encoding="utf-8")
    assert f"{folder / 'study.toml'}: " in refused(folder)


def test_damaged_versions_are_refused(folder):
    (folder / "versions.json").write_text("[1", encoding="utf-8")
    assert refused(folder).startswith(f"{folder / 'versions.json'}: expected the versions")


def test_studies_are_not_compared_with_runs(folder, tmp_path):
    run = keep_run(tmp_path / "run", flying_shards())
    assert "is the folder of a study, whose report is made by itself" in refused(folder, run)


@pytest.fixture(scope="module")
def with_drop_area(tmp_path_factory):
    """A study whose scenario has a zone around the bridge, 20 m wide, which the farthest run leaves."""
    zone = Zone(name="drop area", corners_m=((-21, -24), (47, -24), (47, 24), (-21, 24)))
    scenario = replace(TOLD_SCENARIO, zones=(*TOLD_SCENARIO.zones, zone))
    return keep_study(tmp_path_factory.mktemp("zones") / "told", told_runs(told_study(scenario=scenario)))


def test_a_zone_of_the_scenario_is_verified(with_drop_area, capsys):
    left = sum(read_study_runs(with_drop_area).distances_m > 20.0)
    assert main(["study", str(with_drop_area), "--verify", "drop area"]) == 0
    printed = capsys.readouterr().out
    assert left == 2 and printed.startswith("2 of 93 runs left the zone drop area. With 95 % confidence at most 6.62 %")
    assert "124" not in printed and "it takes 59 runs without one that leaves it, or 93 runs with one" in printed


@pytest.mark.parametrize(
    "zone, message",
    [("yard", "expected a zone that contains the whole bridge"), ("drop", "expected a zone from [[zones]]")],
)
def test_other_zones_are_not_verified(with_drop_area, capsys, zone, message):
    assert main(["study", str(with_drop_area), "--verify", zone]) == 2
    assert message in capsys.readouterr().err


def test_a_study_that_is_not_done_verifies_nothing(tmp_path, capsys):
    folder = keep_study(tmp_path / "told", small_runs(there=5))
    assert main(["study", str(folder), "--verify", "yard"]) == 2
    assert "5 of 8 runs are there" in capsys.readouterr().err
