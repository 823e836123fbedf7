# SPDX-License-Identifier: GPL-3.0-or-later
"""What makes the runs hands over all that ended well before it says what stops the rest."""

import time

import pytest
from support.run_programs import VERSIONS, program_in, request

from bridge_demolition_addon.studies.engine import LocalProcesses, Task
from bridge_demolition_addon.studies.run_process import RunLimits


def test_a_run_that_ended_before_the_error_is_kept(tmp_path):
    command, _log = program_in(tmp_path)
    file = tmp_path / "file"
    file.touch()
    engine = LocalProcesses(1, RunLimits(time_s=60.0), command, VERSIONS)
    well, wrong = (Task(str(folder), request("nothing"), folder / "run") for folder in (tmp_path / "folder", file))
    for task in (well, wrong):
        engine.submit(task)
    deadline = time.monotonic() + 60.0
    while not (well.folder / "outlines.npz").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(0.5)  # so that both have ended and are collected at once
    ended = []
    with pytest.raises(NotADirectoryError):
        for _ in range(100):
            ended.extend(task for task, _outcome in engine.collect(1.0))
    engine.close()
    assert ended == [well]
