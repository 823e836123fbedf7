# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda report``, and the report at the end of ``bda run``."""

from dataclasses import replace

import pytest
from support.processes import run_bda, run_program
from support.run_folders import TOLD, flying_shards, keep_run, killed_run
from support.scenarios import I235, SHORT_RUN

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.scenario import Exclusion
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text


@pytest.fixture
def folder(tmp_path):
    return keep_run(tmp_path / "run", flying_shards(6, 13), I235)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The folder of a run with everything in it, and how its report was made where there is no Blender."""
    folder = keep_run(tmp_path_factory.mktemp("made") / "run", flying_shards(6, 13), TOLD)
    return folder, run_program("bda_without_blender", "report", folder)


@pytest.mark.long
def test_a_report_needs_no_blender(made):
    _, done = made
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.long
def test_a_report_says_how_far_it_is_and_where_it_lies(made):
    folder, done = made
    lines = done.stdout.splitlines()
    assert any(line.endswith(" pictures drawn") for line in lines)
    assert any(line.endswith(" pages written") for line in lines)
    for name in ("report.html", "report.pdf", "exclusion_zone_of_one_run.dxf"):
        assert str(folder / name) in lines
        assert (folder / name).stat().st_size > 0


def test_it_goes_elsewhere_and_is_quiet_when_asked(tmp_path, capsys):
    folder = killed_run(tmp_path / "run")  # what is in it makes no difference here
    before = sorted(folder.rglob("*"))
    assert main(["report", str(folder), "--output", str(tmp_path / "a" / "b"), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    assert (tmp_path / "a" / "b" / "report.html").is_file()
    assert sorted(folder.rglob("*")) == before


def test_what_is_no_run_is_wrong_input(tmp_path, capsys):
    assert main(["report", str(tmp_path)]) == 2
    complained = capsys.readouterr().err
    assert complained == f"bda: error: {tmp_path}: holds no run: expected results.npz or force_log.csv in it\n"


def test_several_runs_without_a_folder_are_wrong_input(folder, capsys):
    assert main(["report", str(folder), str(folder)]) == 2
    assert "give one with --output" in capsys.readouterr().err


def test_an_output_that_is_a_file_is_wrong_input(folder, tmp_path, capsys):
    (tmp_path / "file").write_text("mine")
    assert main(["report", str(folder), "--output", str(tmp_path / "file"), "--quiet"]) == 2
    assert "the report cannot be written" in capsys.readouterr().err
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.long
def test_a_run_ends_with_a_report_when_asked(tmp_path):
    short = replace(SHORT_RUN, exclusion=Exclusion(buffer_m=3.0))
    path, output = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(scenario_text(short), encoding="utf-8")
    status, printed, complained = run_bda("run", path, "--output", output, "--no-pictures", "--report")
    assert (status, complained) == (0, "")
    lines = printed.splitlines()
    for name in (
        "report.html",
        "report.pdf",
        "exclusion_zone_of_one_run.dxf",
        "tables/debris.csv",
        "scenario_as_run.toml",
    ):
        assert lines.count(str(output / name)) == 1, name
    assert read_scenario(output / "scenario_as_run.toml") == short
    assert "I-235 bridge, one span, wrecking ball" in (output / "report.html").read_text(encoding="utf-8")
