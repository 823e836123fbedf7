# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a study is said to take still."""

from types import SimpleNamespace

from support.study_files import study_file

from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.runs_table import DONE, RunOutcome
from bridge_demolition_addon.studies import session
from bridge_demolition_addon.studies.session import EnsembleSession


class EndsAtOnce:
    """An engine that has one draw at a time, which ends as soon as it is asked for."""

    capacity = 1

    def __init__(self):
        self.versions = {"blender": "5.0.1"}
        self._tasks = []

    def submit(self, task):
        self._tasks.append(task)

    def collect(self, _timeout_s):
        ended, self._tasks = self._tasks, []
        return [(task, RunOutcome(DONE)) for task in ended]

    def close(self):
        self._tasks.clear()


def test_a_pause_is_no_part_of_the_time_that_draws_take(tmp_path, monkeypatch):
    study = read_study(study_file(tmp_path / "in", 4))
    now = [1000.0]
    monkeypatch.setattr(session, "time", SimpleNamespace(monotonic=lambda: now[0]))

    def step_after(run, seconds):
        now[0] += seconds
        run.step(0.0)
        return run.planner.done, run.remaining_s

    run = EnsembleSession(study, tmp_path / "study", EndsAtOnce())
    assert run.remaining_s == 0.0
    assert step_after(run, 10.0) == (1, 30.0)
    run.is_paused = True
    assert step_after(run, 3600.0) == (1, 30.0)
    run.is_paused = False
    assert step_after(run, 10.0) == (2, 20.0)
    assert step_after(run, 40.0) == (3, 20.0)
    run.stop()
