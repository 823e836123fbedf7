# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever becomes of a process of draws becomes of the draw at work, and of no other."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from support.run_programs import VERSIONS, begun, program_in, request

from bridge_demolition_addon.errors import ScenarioError, SimulationError
from bridge_demolition_addon.model.study.settings import StudySettings
from bridge_demolition_addon.studies.run_process import RUNS_PER_PROCESS, RunLimits, RunProcess

not_on_windows = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals")


@pytest.fixture
def program(tmp_path):
    return program_in(tmp_path)


@pytest.fixture
def process(program):
    process = RunProcess(program[0], VERSIONS, RunLimits(time_s=60.0))
    yield process
    process.close()


def play(process, deed, folder, seed=1):
    end = process.play(request(deed, seed), folder)
    return end.status, end.reason


def test_a_draw_leaves_its_files_and_its_outputs(process, tmp_path):
    end = process.play(request("nothing", seed=2**30), tmp_path / "draw")
    assert (end.status, end.reason) == ("done", "")
    assert end.outputs == {"reach_m": 0.5, "broken": 2**30 % 7, "heavy": True}
    assert end.fingerprint == {"motion": "40000000"}
    assert 0.0 < end.wall_time_s < 60.0
    assert sorted(path.name for path in (tmp_path / "draw").iterdir()) == ["begun.txt", "outlines.npz"]


@pytest.mark.parametrize(
    "deed, status, reason",
    [
        pytest.param("crash", "crashed", "its process crashed with SIGSEGV", marks=not_on_windows),
        ("exit", "crashed", "its process ended with status 3"),
        ("fail", "failed", "the world is not as expected"),
        ("lose a body", "failed", "a body was lost"),
        ("stumble", "failed", "KeyError: 'nothing'"),
        ("no memory", "out_of_memory", "there was no more memory for it"),
        ("refuse", "refused", "time.duration_s is 0: expected more"),
        pytest.param("kill", "killed", "its process was killed by SIGKILL", marks=not_on_windows),
    ],
)
def test_the_draw_at_work_pays_alone(process, tmp_path, deed, status, reason):
    assert play(process, "nothing", tmp_path / "1") == ("done", "")
    assert play(process, deed, tmp_path / "2") == (status, reason)
    assert play(process, "nothing", tmp_path / "3") == ("done", "")


def test_one_that_takes_too_long_is_ended(program, tmp_path):
    process = RunProcess(program[0], VERSIONS, RunLimits(time_s=0.5))
    assert play(process, "nothing", tmp_path / "1") == ("done", "")
    began = time.monotonic()
    assert play(process, "hang", tmp_path / "2") == ("timed_out", "it took longer than 0.5 s")
    assert 0.5 <= time.monotonic() - began < 20.0
    process.close()
    assert begun(program[1])[0] == ["nothing", "hang"]  # not once more, which would hang again


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="memory is watched on Linux only")
def test_one_that_takes_too_much_memory_is_ended(program, tmp_path):
    process = RunProcess(program[0], VERSIONS, RunLimits(time_s=60.0, memory_mb=400.0))
    assert play(process, "take memory", tmp_path / "1") == ("out_of_memory", "it took more than 400 MB")
    assert play(process, "nothing", tmp_path / "2") == ("done", "")
    process.close()


@pytest.mark.parametrize("limit", [None, 500.0])
def test_limits_are_those_of_the_study(monkeypatch, limit):
    settings = StudySettings(scenario="a.toml", time_limit_s=7.0, memory_limit_mb=limit)
    monkeypatch.setattr(sys, "platform", "linux")
    assert RunLimits.of(settings) == RunLimits(7.0, limit)
    monkeypatch.setattr(sys, "platform", "darwin")
    if limit:
        with pytest.raises(ScenarioError, match=r"study\.memory_limit_mb: memory can be limited on Linux only"):
            RunLimits.of(settings)
    else:
        assert RunLimits.of(settings) == RunLimits(7.0)


@pytest.mark.parametrize("keep, one_thread", [("outcome", True), ("logs", True), ("all", False)])
def test_pictures_are_rendered_with_all_threads(keep, one_thread):
    assert RunLimits.of(StudySettings(scenario="a.toml", keep=keep)).one_thread == one_thread


def test_draws_share_a_process_until_it_is_replaced(process, program, tmp_path):
    for number in range(RUNS_PER_PROCESS + 1):
        assert play(process, "nothing", tmp_path / str(number)) == ("done", "")
    _, processes = begun(program[1])
    assert len(set(processes[:-1])) == 1 and processes[-1] != processes[0]


@not_on_windows
def test_what_earlier_draws_left_behind_is_no_draws_fault(process, program, tmp_path):
    assert play(process, "nothing", tmp_path / "1") == ("done", "")
    assert play(process, "crash if shared", tmp_path / "2") == ("done", "")
    deeds, processes = begun(program[1])
    assert deeds == ["nothing", "crash if shared", "crash if shared"]
    assert processes[0] == processes[1] != processes[2]


@not_on_windows
def test_a_draw_that_somebody_kills_is_played_once_more(process, program, tmp_path):
    killer = threading.Thread(target=kill_first, args=(program[1],))
    killer.start()
    assert play(process, "take time", tmp_path / "1") == ("done", "")
    killer.join()
    deeds, processes = begun(program[1])
    assert deeds == ["take time", "take time"] and processes[0] != processes[1]


@not_on_windows
@pytest.mark.parametrize("kills", [2, 3])
def test_a_program_may_be_killed_as_it_starts(program, tmp_path, kills):
    command, _ = program
    starts = tmp_path / "starts"
    starts.touch()
    killed = f"import os, pathlib; starts = pathlib.Path({str(starts)!r}); "
    killed += "starts.write_text(starts.read_text() + '.'); "
    killed += f"len(starts.read_text()) > {kills} or os.kill(os.getpid(), 9); "
    process = RunProcess([*command[:2], killed + command[2]], VERSIONS, RunLimits())
    if kills < 3:
        assert play(process, "nothing", tmp_path / "1") == ("done", "")
    else:
        with pytest.raises(SimulationError, match="their program ended with status -9: it printed nothing"):
            play(process, "nothing", tmp_path / "1")
    assert len(starts.read_text()) == 3
    process.close()


def kill_first(log):
    while not begun(log)[1]:
        time.sleep(0.01)
    os.kill(begun(log)[1][0], signal.SIGKILL)


def test_lines_of_others_on_its_output_mean_nothing(process, tmp_path):
    assert play(process, "say", tmp_path / "1") == ("done", "")


def test_a_folder_that_cannot_be_written_is_not_the_draws_fault(process, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(NotADirectoryError):
        play(process, "nothing", tmp_path / "file" / "1")
    with pytest.raises(SimulationError, match="nowhere: No such file or directory"):
        play(process, "write elsewhere", tmp_path / "2")


def test_other_versions_are_refused(program, tmp_path):
    process = RunProcess(program[0], {"program": "of users"}, RunLimits())
    with pytest.raises(SimulationError, match=r"other versions .*: program of tests instead of of users"):
        play(process, "nothing", tmp_path / "1")


@pytest.mark.parametrize(
    "command, words",
    [
        ([sys.executable, "-c", "import sys; sys.exit('no module of that name')"], "status 1: no module of that name"),
        (["/nowhere/blender"], "/nowhere/blender: runs cannot be made by it: No such file"),
    ],
    ids=["that ends", "that is not there"],
)
def test_a_program_that_cannot_run_draws_says_why(tmp_path, command, words):
    with pytest.raises(SimulationError, match=words):
        play(RunProcess(command, VERSIONS, RunLimits()), "nothing", tmp_path / "1")


@pytest.mark.parametrize("deed", ["nothing", "hang"])
def test_it_ends_with_whoever_asked(program, tmp_path, deed):
    """At the end of its input, as the system closes it whatever has ended the study."""
    import json

    asked = json.dumps({**request(deed), "folder": str(tmp_path)}) + "\n"
    child = subprocess.Popen(program[0], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    child.stdin.write(asked)
    child.stdin.flush()
    while not begun(program[1])[0]:
        assert child.poll() is None
        time.sleep(0.01)
    child.stdin.close()
    assert child.wait(timeout=20) == 0
