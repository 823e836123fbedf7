# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda run`` runs a scenario, says how far it is, and ends with a status that tells what happened."""

import json
import re
import signal
import sys
import time
from dataclasses import replace

import pytest
from support.processes import outcome, run_bda, start_bda
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

LOGS = ("summary.json", "force_log.csv", "debris_log.csv", "results.npz", "scene.blend")


@pytest.fixture(scope="module")
def scenario_path(tmp_path_factory):
    """A few large shards for a few frames, hit at once."""
    path = tmp_path_factory.mktemp("scenario") / "small.toml"
    path.write_text(scenario_text(SHORT_RUN), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def finished(scenario_path, tmp_path_factory):
    """The output folder of a finished run, and what it printed."""
    output = tmp_path_factory.mktemp("run") / "results"
    return output, run_bda("run", scenario_path, "--output", output, "--no-pictures")


def test_a_run_says_how_far_it_is_and_where_the_results_are(finished):
    output, (status, printed, complained) = finished
    assert (status, complained) == (0, "")
    lines = printed.splitlines()
    assert sum(line.startswith("frame ") for line in lines) == 10
    for name in LOGS:
        assert str(output / name) in lines
        assert (output / name).stat().st_size > 0
    assert any(line.startswith("connections ") for line in lines)
    assert any(line.startswith("no reinforcing bars in deck, pier cap, pier: ") for line in lines)
    assert "\r" not in printed


@pytest.mark.long
def test_what_is_printed_is_in_the_units_that_are_wanted_and_the_summary_in_si(finished, scenario_path, tmp_path):
    output, (_, printed, _) = finished
    wanted = "--no-pictures", "--units", "imperial"
    _, us, _ = run_bda("run", scenario_path, "--output", tmp_path / "us", *wanted)
    newtons = json.loads((tmp_path / "us" / "summary.json").read_text())["largest_resultant"]["force_N"]
    assert newtons == json.loads((output / "summary.json").read_text())["largest_resultant"]["force_N"]
    shown = float(re.search(r"largest load on a shard +([\d.]+) kN, the resultant on", printed)[1])
    assert shown == pytest.approx(newtons / 1e3, rel=5e-3)
    kip = float(re.search(r"largest load on a shard +([\d.]+) kip, the resultant on", us)[1])
    assert kip == pytest.approx(newtons / 4448.222, rel=5e-3)  # the kip of NIST SP 811, appendix B.8


def test_no_pictures_are_rendered_when_none_are_wanted(finished):
    output, _ = finished
    assert not list(output.glob("frames/*.png"))


@pytest.mark.long
def test_a_film_is_made_when_it_is_wanted(tmp_path):
    path, output = tmp_path / "brief.toml", tmp_path / "results"
    brief = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.1))  # each picture takes a second
    path.write_text(scenario_text(brief), encoding="utf-8")
    status, printed, _ = run_bda("run", path, "--output", output, "--no-pictures", "--film")
    assert status == 0
    for film in ("contours.mp4", "contours_slow_motion.mp4"):
        assert str(output / film) in printed.splitlines()
        # An MP4 file begins with a box of type ftyp (ISO/IEC 14496-12).
        assert (output / film).read_bytes()[4:8] == b"ftyp"
    assert [path.name for path in output.glob("*.png")] == ["force_over_time.png"]


@pytest.mark.long
def test_results_are_not_overwritten_unasked(finished, scenario_path):
    output, _ = finished
    before = {path: path.stat().st_mtime_ns for path in output.rglob("*")}
    status, _, complained = run_bda("run", scenario_path, "--output", output, "--no-pictures", "--quiet")
    assert status == 2
    assert complained.startswith(f"bda: error: {output}: ")
    assert len(complained.splitlines()) == 1
    assert {path: path.stat().st_mtime_ns for path in output.rglob("*")} == before


@pytest.mark.long
def test_results_are_overwritten_when_asked(scenario_path, tmp_path):
    output = tmp_path / "results"
    output.mkdir()
    (output / "summary.json").write_text("old")
    (output / "scenario_as_run.toml").write_text("old")
    (output / "notes.txt").write_text("mine")
    arguments = ("run", scenario_path, "--output", output, "--no-pictures", "--overwrite", "--quiet")
    status, printed, complained = run_bda(*arguments)
    assert (status, complained) == (0, "")
    assert printed == ""
    assert (output / "summary.json").read_text() != "old"
    assert (output / "notes.txt").read_text() == "mine"


def test_a_file_is_no_folder_for_results(scenario_path, tmp_path):
    output = tmp_path / "results"
    output.write_text("mine")
    status, _, complained = run_bda("run", scenario_path, "--output", output, "--overwrite")
    assert status == 2
    assert complained.startswith(f"bda: error: {output}: ")
    assert len(complained.splitlines()) == 1
    assert output.read_text() == "mine"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows interrupts a whole console, this test with it")
def test_an_interrupted_run_says_so_and_keeps_its_logs(scenario_path, tmp_path):
    long = tmp_path / "long.toml"
    scenario = read_scenario(scenario_path)
    long.write_text(scenario_text(replace(scenario, time=replace(scenario.time, duration_s=2000))), encoding="utf-8")
    log = tmp_path / "results" / "force_log.csv"
    process = start_bda("run", long, "--output", log.parent, "--no-pictures")
    while not (log.exists() and log.stat().st_size):
        assert process.poll() is None
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    status, _, complained = outcome(process)
    assert (status, complained) == (130, "bda: interrupted\n")
    assert len(log.read_text().splitlines()) > 1
