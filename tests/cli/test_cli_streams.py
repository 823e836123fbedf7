# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line where its streams are closed or full, where it is interrupted early, and with odd paths."""

import os
import signal
import subprocess
import sys
from dataclasses import replace

import pytest
from support.checkout import I235_FILE, ROOT
from support.long_cases import long_but
from support.processes import TIMEOUT_S, outcome, run_program, start_bda
from support.scenarios import I235, SHORT_RUN

from bridge_demolition_addon.model.scenario.file import scenario_text

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="shells of Windows close no streams")


BRIEF = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.1))


def in_shell(arguments, redirections):
    """Run the command line in a shell that redirects its streams: its status, what it printed and complained of."""
    command = f'"{sys.executable}" -m bridge_demolition_addon {arguments} {redirections}'
    done = subprocess.run(
        ["sh", "-c", command], cwd=ROOT, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.long
@pytest.mark.parametrize(
    "arguments, redirections, status",
    [
        (f'check "{I235_FILE}"', ">&-", 0),
        (f'check "{I235_FILE}"', "<&- >&- 2>&-", 0),
        ("check missing.toml", "2>&-", 2),
        ("check missing.toml", ">&- 2>&-", 2),
        ("check missing.toml", "2>/dev/full", 2),
    ],
)
def test_a_closed_or_full_stream_is_no_failure_by_itself(arguments, redirections, status):
    found, _, complained = in_shell(arguments, redirections)
    assert (found, complained) == (status, "")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no full device")
def test_output_that_cannot_be_written_is_said():
    status, _, complained = in_shell(f'check "{I235_FILE}"', ">/dev/full")
    assert status == 1
    assert complained == "bda: error: <stdout>: No space left on device\n"


@pytest.mark.long
def test_no_file_of_a_run_takes_the_place_of_closed_streams(tmp_path):
    status, _, _ = in_shell(f'report "{tmp_path}"', ">&- 2>&-")
    assert status == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "module",
    long_but(["cycles.properties"], ["numpy.linalg", "cycles.properties"]),
    ids=["the command line", "Blender"],
)
def test_ctrl_c_while_something_is_loaded_ends_it_in_one_line(module, tmp_path):
    process = start_bda("run", I235_FILE, "--output", tmp_path / "out", "--no-pictures", PYTHONPROFILEIMPORTTIME="1")
    while (line := process.stderr.readline()) and line.split("|")[-1].strip() != module:
        pass
    process.send_signal(signal.SIGINT)
    said = [line for line in process.stderr.read().splitlines() if not line.startswith("import time:")]
    process.stdout.close()
    assert (process.wait(TIMEOUT_S), said) == (130, ["bda: interrupted"])


@pytest.mark.long
def test_ctrl_c_while_blender_starts_again_ends_it_in_one_line(tmp_path):
    run = ("run", I235_FILE, "--output", tmp_path / "out", "--no-pictures", "--quiet")
    done = run_program("bda_interrupted_by_blender", *run)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "bda: interrupted\n")
    assert not (tmp_path / "out" / "summary.json").exists()


@pytest.mark.long
def test_files_that_are_none_are_neither_waited_for_nor_read_without_end(tmp_path):
    pipe = tmp_path / "pipe.toml"
    os.mkfifo(pipe)
    for path in (pipe, "/dev/zero"):
        status, _, complained = outcome(start_bda("check", path))
        assert status == 2
        assert complained == (f"bda: error: {path}: is a pipe or a device, not a file: expected a scenario in TOML\n")


@pytest.mark.long
def test_a_run_and_its_report_in_a_folder_whose_name_is_not_utf_8(tmp_path):
    scenario = tmp_path / "bridge.toml"
    scenario.write_text(scenario_text(BRIEF), encoding="utf-8")
    output = os.fsdecode(os.fsencode(tmp_path) + b"/br\xfccke")
    run = ("run", scenario, "--output", output, "--no-pictures", "--report", "--quiet")
    status, printed, complained = outcome(start_bda(*run))
    assert (status, printed) == (0, "")
    assert all("is not to be used for distances" in line for line in complained.splitlines())  # short as it is
    for name in ("scene.blend", "report.pdf"):
        assert os.path.getsize(os.path.join(output, name)) > 0
    with open(os.path.join(output, "report.html"), encoding="utf-8") as page:
        assert "br\\xfccke" in page.read()


@pytest.mark.long
def test_a_scenario_in_a_folder_whose_name_is_not_utf_8(tmp_path):
    folder = os.fsencode(tmp_path) + b"/br\xfccke"
    os.mkdir(folder)
    path = folder + b"/bridge.toml"
    with open(path, "wb") as file:
        file.write(scenario_text(I235).encode())
    status, printed, complained = outcome(start_bda("check", os.fsdecode(path)))
    assert (status, complained) == (0, "")
    assert printed.startswith(I235.title)
