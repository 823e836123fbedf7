# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda study``: a small study in Blender, what it leaves, and what it refuses without changing anything."""

import json
import re
from dataclasses import replace

import numpy as np
import pandas
import pytest
from support.processes import run_bda, run_program
from support.scenarios import SHORT_RUN
from support.study_files import study_file, tables_in

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.ensemble.folder import study_in
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.runs_table import read_runs
from bridge_demolition_addon.model.study.sampled_runs import sampled_run

BRIEF = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.3))
RUNS = 4


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return study_file(tmp_path_factory.mktemp("study"), RUNS, ("One", "Two"), BRIEF)


@pytest.fixture(scope="module")
def done(study):
    """Folder of the study, whose four draws share a process, in a parent in which Blender cannot be loaded."""
    output = study.parent / "out"
    run = run_program("bda_without_blender", "study", study, "--output", output, "--jobs", 1)
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.splitlines()[-3:] == [str(output / name) for name in ("runs.csv", "runs.xlsx", "study.json")]
    return output


@pytest.mark.long
def test_pandas_reads_all_draws_in_one_line(study, done):
    table = pandas.read_csv(done / "runs.csv")
    assert table["run"].tolist() == [1, 2, 3, 4]
    assert table["status"].tolist() == ["done"] * RUNS
    inputs = [sampled_run(read_study(study), number).inputs for number in range(1, RUNS + 1)]
    for name in ("scenario.seed", "ball.mass_kg"):
        # Some versions of pandas read the last bit of a number as they like.
        assert table[f"in.{name}"].tolist() == pytest.approx([each[name] for each in inputs], rel=1e-15)
    assert (table["out.broken"] > 0).all() and np.isfinite(table["out.reach_m"]).all()


def test_the_folder_has_the_study_as_it_was_run(study, done):
    assert study_in(done).text == read_study(study).text
    assert json.loads((done / "study.json").read_text(encoding="utf-8"))["reach"]["runs"] == RUNS
    draws = list(done.glob("draws/*"))
    assert len(draws) == RUNS
    for draw in draws:
        assert sorted(path.name for path in draw.iterdir()) == ["outcome.json", "outlines.npz"]


@pytest.mark.long
def test_it_comes_to_the_same_with_a_process_for_each(study, done, tmp_path):
    assert run_bda("study", study, "--output", tmp_path / "out", "--jobs", 4, "--quiet") == (0, "", "")
    assert tables_in(tmp_path / "out") == tables_in(done)


@pytest.mark.long
def test_a_study_that_is_done_gets_its_report_with_pictures_of_two_draws(study, done):
    before = tables_in(done)
    status, printed, complained = run_bda("study", study, "--output", done, "--report")
    assert status == 0, complained
    assert tables_in(done) == before
    assert f"In {RUNS} independent runs, in which " in printed
    written = [line for line in printed.splitlines() if line.startswith(str(done / "report"))]
    assert str(done / "report" / "report.pdf") in written
    page = (done / "report" / "report.html").read_text(encoding="utf-8")
    assert f"In {RUNS} independent runs, in which " in page
    again = {int(path.name) for path in (done / "again").iterdir()}
    table = read_runs(done / "runs.csv")
    assert again >= {int(table.numbers[row]) for row in (table.median_row, table.worst_row)}
    assert "Median run, " in page and "Worst run, " in page


@pytest.mark.long
def test_a_draw_runs_once_more_with_everything_bit_for_bit(done):
    status, printed, complained = run_bda("study", done, "--again", 3)
    again = done / "again" / "3"
    assert status == 0, complained
    assert f"run 3 has the same result as in the study, bit by bit: {again}" in printed.splitlines()
    assert (again / "force_log.csv").stat().st_size > 0 and (again / "frames" / "after.png").stat().st_size > 0

    (draw,) = [path for path in done.glob("draws/*/outcome.json") if str(seed_of(done, 3)) in path.read_text()]
    kept = draw.read_text(encoding="utf-8")
    summary = json.loads((again / "summary.json").read_text(encoding="utf-8"))
    assert summary["connections"]["broken"] == json.loads(kept)["outputs"]["broken"]
    motion = json.loads(kept)["fingerprint"]["motion"]
    draw.write_text(kept.replace(motion, motion[::-1]), encoding="utf-8")
    status, _, complained = run_bda("study", done, "--again", 3, "--quiet")
    draw.write_text(kept, encoding="utf-8")
    assert status == 1
    assert "run 3 has another result than in the study: ['motion'] differs" in complained


def seed_of(folder, number):
    return sampled_run(study_in(folder), number).inputs["scenario.seed"]


@pytest.mark.long
@pytest.mark.parametrize("keep, more", [("logs", ["force_log.csv"]), ("all", ["force_log.csv", "results.npz"])])
def test_more_is_kept_where_it_is_asked_for(tmp_path, keep, more):
    study = study_file(tmp_path / "in", 1, ("One",), BRIEF, keep=keep)
    assert run_bda("study", study, "--output", tmp_path / "out", "--quiet") == (0, "", "")
    runs = list((tmp_path / "out").glob("draws/*/run"))
    assert len(runs) == 1
    for run in runs:
        assert {"summary.json", "scenario_as_run.toml", *more} <= {path.name for path in run.iterdir()}
        assert (run / "results.npz").exists() == (keep == "all")
    table = pandas.read_csv(tmp_path / "out" / "runs.csv")
    assert (table["out.largest_force_N"] > 0.0).all()  # loads are known where they are recorded


def refused(capsys, *arguments):
    """What is said where nothing is run; in this process, as none gets as far as Blender."""
    assert main(["study", *map(str, arguments)]) == 2
    complained = capsys.readouterr().err
    assert complained.startswith("bda: error: ") and len(complained.splitlines()) == 1
    return complained


def test_a_changed_study_is_refused(study, done, tmp_path, capsys):
    before = tables_in(done)
    for change in (("quantile = 0.5", "quantile = 0.6"), ("lowest = 8000.0", "lowest = 8500.0")):
        other = tmp_path / "study.toml"
        text = study.read_text(encoding="utf-8").replace(*change)
        other.write_text(text.replace('"scenario.toml"', f"'{study.parent / 'scenario.toml'}'"), encoding="utf-8")
        complained = refused(capsys, other, "--output", done)
        assert f"{done}: was begun with another study or scenario, see study.toml there" in complained
    assert tables_in(done) == before


def test_another_version_is_refused(study, done, capsys):
    kept = (done / "versions.json").read_text(encoding="utf-8")
    numpy = json.loads(kept)["numpy"]
    (done / "versions.json").write_text(kept.replace(numpy, "1.0.0"), encoding="utf-8")
    complained = refused(capsys, study, "--output", done)
    (done / "versions.json").write_text(kept, encoding="utf-8")
    assert f"{done}: was begun with numpy 1.0.0, which is another version here" in complained


@pytest.mark.parametrize("name", ["notes.txt", "draws/notes.txt"])
def test_a_folder_of_something_else_is_refused(study, tmp_path, capsys, name):
    mine = tmp_path / "mine" / name
    mine.parent.mkdir(parents=True)
    mine.touch()
    complained = refused(capsys, study, "--output", tmp_path / "mine")
    assert f"{tmp_path / 'mine'}: exists already and is not the folder of a study" in complained
    assert [path for path in (tmp_path / "mine").rglob("*") if path.is_file()] == [mine]


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("--output", "out", "--jobs", "0"), "argument --jobs: '0' is wrong: expected a whole number from 1 to 1000"),
        (("--output", "out", "--jobs", "two"), "'two' is wrong"),
        (("--output", "out", "--jobs", "2", "--dask", "tcp://127.0.0.1:1"), "leave it out with --dask"),
        (("--output", "out", "--dask", "tcp://127.0.0.1:1"), "tcp://127.0.0.1:1: no Dask scheduler answers there"),
        (("--output", "out", "--dask", "nonsense://"), "nonsense://: no Dask scheduler answers there"),
        (("--again", "1"), "study.toml: expected the folder of a study"),
    ],
    ids=lambda each: " ".join(each) if isinstance(each, tuple) else "",
)
def test_wrong_arguments_are_refused(study, monkeypatch, tmp_path, capsys, arguments, words):
    monkeypatch.chdir(tmp_path)
    assert words in refused(capsys, study, *arguments)
    assert not list(tmp_path.iterdir())


def test_a_draw_that_there_is_not_is_refused(done, capsys):
    assert "has runs 1 to 4" in refused(capsys, done, "--again", 5)


def test_a_check_goes_by_draws_that_are_done(study, done, capsys):
    before = tables_in(done)
    assert main(["study", str(study), "--check", "--output", str(done), "--jobs", "2"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    ends = [json.loads(path.read_text(encoding="utf-8")) for path in done.glob("draws/*/outcome.json")]
    mean_s = sum(end["wall_time_s"] for end in ends) / RUNS
    said = [float(number) for number in re.findall(r"([\d.]+) s for", last)]
    assert said == pytest.approx([mean_s, mean_s * RUNS / 2], rel=0.05), "two digits are said, of times of three"
    assert last.endswith("with 2 runs at a time on as many cores: as those that are done")
    assert tables_in(done) == before


def test_a_check_runs_nothing(study, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["study", str(study), "--check"]) == 0
    printed = capsys.readouterr().out
    assert printed.splitlines()[-1].endswith("to a factor of 3, by the size of the model")
    assert f"{RUNS} runs" in printed and f"of {RUNS} runs will be the limit for " in printed
    for number in range(1, RUNS + 1):
        assert str(sampled_run(read_study(study), number).inputs["scenario.seed"]) in printed
    assert not list(tmp_path.iterdir())
