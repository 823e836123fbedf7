# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever happens to a run, what it had is kept, and its status and its folder say so."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest
from support.processes import TIMEOUT_S, call_bda, outcome, run_bda, start_bda
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.results.arrays import BALLS_FILE, FRAMES_FILE, INVENTORY_FILE, load_results
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

pytestmark = pytest.mark.long

BRIEF = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.2))
ENDLESS = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=2000.0))
POSIX = pytest.mark.skipif(sys.platform == "win32", reason="Windows moves no open files, and has no such signals")


def scenario_file(folder, scenario):
    path = folder / "scenario.toml"
    path.write_text(scenario_text(scenario), encoding="utf-8")
    return path


def started(path, output, *options):
    """A run that has logged two frames: before the second, no time has passed."""
    process = start_bda("run", path, "--output", output, "--no-pictures", *options)
    log = output / "force_log.csv"
    while len(logged_frames(log)) < 2:
        assert process.poll() is None
        time.sleep(0.05)
    return process


def logged_frames(log):
    """Numbers of the frames that a log has whole lines of."""
    if not log.exists():
        return set()
    heading, *lines, _ = [*log.read_text(encoding="utf-8").split("\n"), ""]
    assert heading.startswith("frame,") or not heading
    return {line.partition(",")[0] for line in lines[:-1]}


def whole_results(folder):
    """The summary, after a look at all else that a run leaves."""
    assert len(load_results(folder / "results.npz").frames.number) > 1
    assert read_scenario(folder / "scenario_as_run.toml").title == ENDLESS.title
    assert (folder / "scene.blend").stat().st_size > 0
    assert not list(folder.rglob("*.part*"))
    assert not any((folder / name).exists() for name in (FRAMES_FILE, BALLS_FILE, INVENTORY_FILE))
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


@POSIX
def test_a_second_run_does_not_write_to_the_folder_of_the_first(tmp_path, capsys):
    path, output = scenario_file(tmp_path, ENDLESS), tmp_path / "results"
    first = started(path, output)
    first.send_signal(signal.SIGSTOP)  # or it would leave a thousand frames
    status, printed, complained = call_bda(capsys, "run", path, "--output", output, "--no-pictures", "--overwrite")
    assert (status, printed) == (2, "")
    assert complained.startswith(f"bda: error: {output}: is being written to by process {first.pid} on ")
    assert call_bda(capsys, "report", output)[0] == 2
    first.send_signal(signal.SIGINT)
    first.send_signal(signal.SIGCONT)
    assert outcome(first)[0] == 130
    assert not whole_results(output)["completed"]
    assert not (output / "run.lock").exists()


@POSIX
def test_a_report_of_a_run_at_work_says_so(tmp_path, capsys):
    path, output = scenario_file(tmp_path, ENDLESS), tmp_path / "results"
    process = started(path, output)
    assert call_bda(capsys, "report", output, "--output", tmp_path / "report", "--quiet") == (0, "", "")
    assert process.poll() is None
    process.kill()
    outcome(process)
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert re.search(rf"still at work \(process {process.pid} on [^)]*\): .* \d+ frames are recorded so far", page)
    assert "ended before its end" not in page and "killed" not in page


@POSIX
def test_a_killed_run_leaves_no_half_of_a_file_and_its_folder_free(tmp_path):
    path, output = scenario_file(tmp_path, ENDLESS), tmp_path / "results"
    process = started(path, output)
    process.kill()
    assert outcome(process)[0] == -signal.SIGKILL
    assert (output / "run.lock").exists()
    assert not (output / "summary.json").exists() and not (output / "results.npz").exists()
    (output / "results.part.npz").write_bytes(b"half")
    brief = scenario_file(tmp_path, BRIEF)
    assert run_bda("run", brief, "--output", output, "--no-pictures", "--overwrite", "--quiet") == (0, "", "")
    assert whole_results(output)["completed"]
    assert not (output / "run.lock").exists()


@POSIX
def test_a_killed_run_keeps_all_but_its_last_frame_and_is_reported_as_such(tmp_path, capsys):
    path, output = scenario_file(tmp_path, ENDLESS), tmp_path / "results"
    process = started(path, output)
    while len((output / "force_log.csv").read_text(encoding="utf-8").splitlines()) < 400:
        time.sleep(0.05)
    process.kill()
    outcome(process)
    lines = (output / "force_log.csv").read_text(encoding="utf-8").splitlines()[1:]
    left = load_results(output)
    logged = len(lines) // len(left.inventory.body_names)
    assert len(left.frames) in (logged, logged + 1)  # a frame is kept before it is logged
    last = [line.split(",") for line in lines if line.startswith(f"{left.frames.number[logged - 1]},")]
    forces = [[float(number) for number in line[3:6]] for line in last]
    np.testing.assert_allclose(left.frames.loads.body_forces_n[logged - 1], forces, rtol=1e-6)
    assert left.balls.times_s[-1] == pytest.approx(left.frames.time_s[-1])
    assert call_bda(capsys, "report", output, "--quiet") == (0, "", "")
    page = (output / "report.html").read_text(encoding="utf-8")
    assert "still at work" not in page and (output / "tables" / "hits_of_the_ball.csv").is_file()
    assert "The run ended before its end" in page and f"{len(left.frames)} frames are kept" in page


@POSIX
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_a_run_that_is_asked_to_end_keeps_what_it_has(tmp_path, name):
    path, output = scenario_file(tmp_path, ENDLESS), tmp_path / "results"
    process, number = started(path, output), getattr(signal, name)
    process.send_signal(number)
    status, _, complained = outcome(process)
    assert (status, complained) == (128 + number, "bda: interrupted\n")
    assert not whole_results(output)["completed"]


@POSIX
@pytest.mark.parametrize("happens", ["deleted", "moved", "replaced"])
def test_a_run_whose_folder_goes_ends_and_leaves_its_results_in_its_place(tmp_path, happens):
    path, output = scenario_file(tmp_path, ENDLESS), tmp_path / "results"
    process = started(path, output)
    output.rename(tmp_path / "elsewhere")
    if happens == "deleted":  # all at once: a folder that goes file by file is still there when the run looks
        shutil.rmtree(tmp_path / "elsewhere")
    kept = output
    if happens == "replaced":
        output.mkdir()
        (output / "notes.txt").write_text("mine", encoding="utf-8")
        kept = tmp_path / "results_2"
    status, _, complained = outcome(process)
    assert status == 1
    was = f"bda: error: {output}: was moved or deleted while a run wrote to it"
    assert complained == f"{was}; the results up to then are in {kept}\n"
    assert not whole_results(kept)["completed"]
    if happens == "replaced":
        assert [path.name for path in output.iterdir()] == ["notes.txt"]


@POSIX
def test_a_run_outlives_the_reader_of_what_it_prints(tmp_path):
    path, output = scenario_file(tmp_path, BRIEF), tmp_path / "results"
    process = start_bda("run", path, "--output", output, "--no-pictures")
    assert process.stdout.readline()  # as `head -1` does
    process.stdout.close()
    assert process.stderr.read() == ""
    assert process.wait(TIMEOUT_S) == 0
    assert whole_results(output)["completed"]


@POSIX
def test_a_full_disk_leaves_no_half_of_a_file(tmp_path):
    """The disk is as full as a limit for the size of files makes it: after some frames no more fit."""
    path, output = scenario_file(tmp_path, BRIEF), tmp_path / "results"
    limited = "import resource, runpy, signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
    limited += "resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)); "
    limited += "runpy.run_module('bridge_demolition_addon', run_name='__main__')"
    command = [sys.executable, "-c", limited, "run", str(path), "--output", str(output), "--no-pictures", "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    assert done.returncode == 1
    assert f"{output / FRAMES_FILE}: cannot be written" in done.stderr and "the frames up to then are in" in done.stderr
    assert "Errno" not in done.stderr and "None" not in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert not (output / "results.npz").exists() and not list(output.glob("*.part*"))
    assert not (output / "summary.json").exists()
    left = load_results(output)
    assert len(left.frames) > 1 and left.frames.number.tolist() == list(range(2, 2 + len(left.frames)))


@POSIX
def test_no_title_and_no_name_is_read_as_markup(tmp_path):
    """Neither as a formula, nor as an element of a page, nor as a variable in one of Blender's paths."""
    title = r"50% of $1, 60% of $2 \frac <b>x</b> & {blend_name}"
    path, output = scenario_file(tmp_path, replace(BRIEF, title=title)), tmp_path / "_{run} of $1 ## $2_^"
    status, printed, complained = run_bda("run", path, "--output", output, "--report")
    assert (status, "bda" in complained) == (0, False)
    for name in ("before", "impact", "after"):
        assert str(output / "frames" / f"{name}.png") in printed.splitlines()
    page = (output / "report.html").read_text(encoding="utf-8")
    assert "<h1>50% of $1, 60% of $2 \\frac &lt;b&gt;x&lt;/b&gt; &amp; {blend_name}</h1>" in page
    assert (output / "force_over_time.png").stat().st_size > 0


def test_a_path_that_is_too_long_for_blender_is_refused_before_anything_is_built(tmp_path, capsys):
    path = scenario_file(tmp_path, BRIEF)
    output = tmp_path.joinpath(*["x" * 200] * 5)
    excess = len(os.fsencode(output / "exclusion_zone_of_one_run.geojson")) - 1023
    status, printed, complained = call_bda(capsys, "run", path, "--output", output)
    assert (status, printed) == (2, "")
    assert complained.startswith(f"bda: error: {output}: its path is {excess} bytes too long")
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("row", ["1O.5,0,2", "x,0,2", "1.5;2;3", "0,1,z"])
def test_a_first_row_of_points_with_a_slip_is_no_heading(tmp_path, row, capsys):
    points = tmp_path / "points.csv"
    points.write_text(f"{row}\n6,0,2\n", encoding="utf-8")
    text = scenario_text(BRIEF).replace("[fracture]", f"[fracture]\npoints_file = {json.dumps(str(points))}")
    path = tmp_path / "scenario.toml"
    path.write_text(text, encoding="utf-8")
    status, _, complained = call_bda(capsys, "check", path)
    assert status == 2
    assert f"{points}, row 1: expected three numbers (m) with commas between them, found " in complained
