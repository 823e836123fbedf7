# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of a study that was stopped while it was evaluated is evaluated, not made again."""

import os
import shutil

import pytest
from support.scenarios import SHORT_RUN
from support.study_files import study_file

from bridge_demolition_addon.model.ensemble.folder import EnsembleFolder
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.structure.kept_models import KeptModels
from bridge_demolition_addon.model.study.file import OUTLINES_FILE, SIMULATED_FILE, read_study
from bridge_demolition_addon.model.study.runs_table import KILLED, RunOutcome
from bridge_demolition_addon.model.study.settings import EnsembleSettings
from bridge_demolition_addon.studies import run_program


def request(keep):
    settings = EnsembleSettings(scenario="scenario.toml", keep=keep)
    return {"scenario": scenario_text(SHORT_RUN), "study": settings.shared_text}


def names_in(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@pytest.mark.slow
@pytest.mark.parametrize("keep", ["outcome", "logs"])
def test_what_was_simulated_is_only_evaluated(tmp_path, monkeypatch, keep):
    whole, left = tmp_path / "whole", tmp_path / "left"
    evaluate = run_program.evaluate

    def seen(*arguments):
        if not left.exists():
            shutil.copytree(whole, left)  # what a kill leaves now
        return evaluate(*arguments)

    monkeypatch.setattr(run_program, "evaluate", seen)
    whole.mkdir()
    answer = run_program.play(KeptModels(), request(keep), whole)
    damaged = tmp_path / "damaged"
    shutil.copytree(left, damaged)
    (damaged / SIMULATED_FILE).write_text("{")
    # Without models there is nothing to simulate with.
    assert run_program.play(None, request(keep), left) == answer
    assert names_in(left) == names_in(whole)
    assert (left / OUTLINES_FILE).read_bytes() == (whole / OUTLINES_FILE).read_bytes()
    with pytest.raises(AttributeError):
        run_program.play(None, request(keep), damaged)


def test_it_is_kept_until_then_whatever_ends_the_study(tmp_path):
    study, parts = read_study(study_file(tmp_path, 4, ("nothing",), seed=1)), tmp_path / "out" / "draws"
    with EnsembleFolder(tmp_path / "out", study, {}) as folder:
        simulated, half = folder.work_folder("a"), folder.work_folder("b")
        for part in (simulated, half):
            part.mkdir()
            (part / "results_frames.npy").write_bytes(b"frames")
        (simulated / SIMULATED_FILE).write_text("{}")
        folder.keep("a", {}, RunOutcome(KILLED, "by its user"))
        folder.keep("b", {}, RunOutcome(KILLED, "by its user"))
    os.replace(simulated, parts / "a-1.part")  # as another process left it
    with EnsembleFolder(tmp_path / "out", study, {}) as folder:
        assert [part.name for part in parts.iterdir()] == ["a-1.part"]
        assert not folder.work_folder("b").exists()
        assert names_in(folder.work_folder("a")) == ["results_frames.npy", SIMULATED_FILE]
