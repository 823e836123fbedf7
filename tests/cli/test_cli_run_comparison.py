# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda run`` with several scenarios: a comparison, whose runs are kept beside each other."""

import signal
import sys
import time
from dataclasses import replace

import pytest
from support.processes import outcome, run_bda, start_bda
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

pytestmark = pytest.mark.long

TEXT = scenario_text(SHORT_RUN)


def keep(path, **changes):
    path.parent.mkdir(exist_ok=True)
    path.write_text(scenario_text(replace(SHORT_RUN, **changes)), encoding="utf-8")
    return path


@pytest.fixture
def files(tmp_path):
    """Two scenarios that differ in the place of the hit."""
    other = replace(SHORT_RUN.ball, target_m=(3.0, 0.0))
    return [keep(tmp_path / "in" / "middle.toml"), keep(tmp_path / "in" / "side.toml", ball=other)]


def test_each_run_has_its_folder_and_a_report_compares_them(files, tmp_path, capsys):
    output = tmp_path / "out"
    status, printed, complained = run_bda("run", *files, "--output", output, "--no-pictures", "--report")
    assert (status, complained) == (0, "")
    assert sorted(path.name for path in output.iterdir()) == ["middle", "report", "side"]
    lines = printed.splitlines()
    for name, target in (("middle", (6.5, 0.0)), ("side", (3.0, 0.0))):
        for result in ("results.npz", "force_log.csv", "report.html"):
            assert lines.count(str(output / name / result)) == 1
            assert (output / name / result).stat().st_size > 0
        assert read_scenario(output / name / "scenario_as_run.toml").ball.target_m == target
    assert lines.index(f"scenario 1 of 2: {files[0]}") < lines.index(f"scenario 2 of 2: {files[1]}")
    assert sum(line.startswith("connections ") for line in lines) == 2
    for name in ("report.html", "report.pdf", "tables/comparison.csv"):
        assert lines.count(str(output / "report" / name)) == 1
    header = (output / "report" / "tables" / "comparison.csv").read_text(encoding="utf-8").splitlines()[0]
    assert "middle" in header and "side" in header

    # Again without a report: the old ones would be those of other runs.
    again = (*files, "--output", output, "--no-pictures", "--quiet")
    assert f"{output / 'middle'}: exists already" in refused(capsys, *again)
    assert (output / "report" / "report.html").is_file()
    assert run_bda("run", *again, "--overwrite") == (0, "", "")
    assert not list(output.rglob("report.*")) and not list(output.rglob("tables/*.csv"))


def refused(capsys, *arguments):
    """What is said where nothing is run; in this process, as none gets as far as Blender."""
    assert main(["run", *map(str, arguments)]) == 2
    complained = capsys.readouterr().err
    assert complained.startswith("bda: error: ") and len(complained.splitlines()) == 1
    return complained


@pytest.mark.parametrize("other", ["middle.toml", "in/middle.toml", "in/Middle.TOML"])
def test_two_files_of_one_name_are_refused(files, other, tmp_path, capsys):
    path = keep(tmp_path / other)
    complained = refused(capsys, files[0], path, "--output", tmp_path / "out")
    assert f"{files[0]} and {path}: the results of both would go to {tmp_path / 'out'}" in complained
    assert not (tmp_path / "out").exists()


def test_a_scenario_may_not_take_the_folder_of_the_report(files, tmp_path, capsys):
    path = keep(tmp_path / "in" / "report.toml")
    complained = refused(capsys, *files, path, "--output", tmp_path / "out", "--report")
    assert f"{tmp_path / 'out' / 'report'}: is the folder of the report" in complained
    assert not (tmp_path / "out").exists()


SAW_CUT_BESIDE_THE_BRIDGE = "[[saw_cuts]]\ntime_s = 0.1\npoint_m = [90.0, 0.0, 0.0]\nnormal = [1.0, 0.0, 0.0]\n"


@pytest.mark.parametrize(
    "text, words",
    [
        (
            scenario_text(SHORT_RUN).replace("target_m = [6.5, 0.0]", "target_m = [60.0, 0.0]"),
            "ball.target_m.1 is 60.0",
        ),
        (f"{TEXT}\n{SAW_CUT_BESIDE_THE_BRIDGE}", "saw_cuts"),
    ],
    ids=["for a value", "for what follows from it"],
)
def test_none_is_run_where_one_is_refused(files, text, words, tmp_path, capsys):
    wrong = tmp_path / "in" / "wrong.toml"
    wrong.write_text(text, encoding="utf-8")
    complained = refused(capsys, *files, wrong, "--output", tmp_path / "out")
    assert f"{wrong}: " in complained
    assert words in complained
    assert not (tmp_path / "out").exists()


def test_none_is_run_where_results_of_one_are_there(files, tmp_path, capsys):
    there = tmp_path / "out" / "side"
    there.mkdir(parents=True)
    (there / "summary.json").write_text("mine", encoding="utf-8")
    assert f"{there}: exists already" in refused(capsys, *files, "--output", tmp_path / "out")
    assert [path.name for path in there.parent.iterdir()] == ["side"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows interrupts a whole console, this test with it")
def test_ctrl_c_stops_all_and_keeps_what_there_is(files, tmp_path):
    long = keep(tmp_path / "in" / "long.toml", time=replace(SHORT_RUN.time, duration_s=2000))
    output = tmp_path / "out"
    process = start_bda("run", files[0], long, files[1], "--output", output, "--no-pictures", "--report")
    log = output / "long" / "force_log.csv"
    while not (log.exists() and log.stat().st_size):
        assert process.poll() is None
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    status, _, complained = outcome(process)
    assert (status, complained) == (130, "bda: interrupted\n")
    assert sorted(path.name for path in output.iterdir()) == ["long", "middle"]
    assert (output / "middle" / "results.npz").is_file()
    assert len(log.read_text(encoding="utf-8").splitlines()) > 1
