# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a worker go to a process that is warm, one at a time, and it is ended once there are none."""

import time

import pytest
from support.processes import is_alive
from support.run_programs import VERSIONS, begun, program_in, request

from bridge_demolition_addon.studies.run_process import RunLimits, WarmProcesses

LIMITS = RunLimits(time_s=60.0)


@pytest.fixture
def program(tmp_path):
    return program_in(tmp_path)


def play(warm, program, folder, limits=LIMITS):
    with warm.process(program[0], VERSIONS, limits) as process:
        return process.play(request("nothing"), folder).status


def processes(program):
    return begun(program[1])[1]


def test_the_next_run_has_the_process_of_the_one_before(program, tmp_path):
    warm = WarmProcesses(idle_s=60.0)
    assert [play(warm, program, tmp_path / "run") for _ in range(3)] == ["done"] * 3
    assert len(set(processes(program))) == 1


def test_runs_at_the_same_time_and_those_with_other_limits_have_one_each(program, tmp_path):
    warm = WarmProcesses(idle_s=60.0)
    with warm.process(program[0], VERSIONS, LIMITS) as process:
        process.play(request("nothing"), tmp_path / "1")
        assert play(warm, program, tmp_path / "2") == "done"
    assert play(warm, program, tmp_path / "3", RunLimits(time_s=30.0)) == "done"
    assert len(set(processes(program))) == 3


def test_one_that_nobody_asks_is_ended(program, tmp_path):
    warm = WarmProcesses(idle_s=0.2)
    assert play(warm, program, tmp_path / "1") == "done"
    (process,) = processes(program)
    deadline = time.monotonic() + 20.0
    while is_alive(process):
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert play(warm, program, tmp_path / "2") == "done"
    assert len(set(processes(program))) == 2


def test_an_error_ends_the_process(program, tmp_path):
    warm = WarmProcesses(idle_s=60.0)
    with pytest.raises(KeyError), warm.process(program[0], VERSIONS, LIMITS) as process:
        process.play(request("nothing"), tmp_path / "1")
        raise KeyError
    assert play(warm, program, tmp_path / "2") == "done"
    assert len(set(processes(program))) == 2
