# SPDX-License-Identifier: GPL-3.0-or-later
"""Make runs as an optimisation does, one candidate after another on the same seeds, and print the seconds of processor
that they take with models that are kept from run to run and those of getting these, and both with each run building its
own.

Both ways take turns, run by run, in one process. Usage: shared_runs.py STUDY.toml CANDIDATES
"""

import json
import os
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.structure.kept_models import KeptModels
from bridge_demolition_addon.model.study.file import Study, read_study
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.studies.run_program import play


def main(path: str, candidates: str) -> None:
    """Play the runs of all candidates, each of them twice; the first run in the process does not count."""
    study, kept = read_study(path), KeptModels()
    scenarios = [_candidate(study, number, share) for share in range(int(candidates)) for number in _numbers(study)]
    _seconds_of(scenarios[0], study, KeptModels())
    shared_s, own_s = np.zeros(2), np.zeros(2)
    for turn, scenario in enumerate(scenarios):
        for models in (kept, KeptModels()) if turn % 2 else (KeptModels(), kept):
            sums_s = shared_s if models is kept else own_s
            sums_s += _seconds_of(scenario, study, models)
    print(json.dumps([*shared_s, *own_s]), flush=True)
    os._exit(0)  # Blender's own end may hang


def _numbers(study: Study) -> range:
    return range(1, study.settings.runs + 1)


def _candidate(study: Study, number: int, share: int) -> Scenario:
    """Return a run by its number with a candidate's ball, each half as heavy again as the one before."""
    scenario = sampled_run(study, number).scenario
    return replace(scenario, ball=replace(scenario.ball, mass_kg=scenario.ball.mass_kg * 1.5**share))


def _seconds_of(scenario: Scenario, study: Study, models: KeptModels) -> np.ndarray:
    """Return the seconds of processor of a whole run, and those of getting its model."""
    request = {"scenario": scenario_text(scenario), "study": study.settings.shared_text}
    began = time.process_time()
    models.model_of(scenario)
    built = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        play(models, request, Path(folder))
    return np.array((time.process_time() - began, built - began))


if __name__ == "__main__":
    main(*sys.argv[1:])
