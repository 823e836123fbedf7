# SPDX-License-Identifier: GPL-3.0-or-later
"""A run whose process has its bridge from the run before has the bits of the same run in a fresh process."""

from contextlib import closing
from dataclasses import replace

import pytest
from support.checkout import TESTS
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.model.structure.kept_models import KeptModels
from bridge_demolition_addon.model.study.settings import EnsembleSettings
from bridge_demolition_addon.studies.run_process import RunLimits, RunProcess
from bridge_demolition_addon.studies.run_program import play, run_program_command
from bridge_demolition_addon.studies.versions import installed_blender, versions_with

EVERYTHING = read_scenario(TESTS / "simulation" / "everything.toml")
ELASTIC = replace(
    EVERYTHING,
    time=replace(EVERYTHING.time, duration_s=0.6),
    fracture=replace(EVERYTHING.fracture, shards=12),
    saw_cuts=(),
    weakenings=(),
)
FROM_HIGHER = replace(SHORT_RUN, ball=replace(SHORT_RUN.ball, drop_height_m=0.5, mass_kg=5000))
LESS_CHARGE = replace(ELASTIC, charges=(replace(ELASTIC.charges[0], mass_kg=20.0),))
PAIRS = {"ball": (FROM_HIGHER, SHORT_RUN), "charge": (LESS_CHARGE, ELASTIC)}


def request(scenario, keep="outcome"):
    settings = EnsembleSettings(scenario="scenario.toml", keep=keep)
    return {"scenario": scenario_text(scenario), "study": settings.shared_text}


def files_in(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize("before, after", PAIRS.values(), ids=PAIRS)
def test_it_has_the_bits_of_a_run_that_built_its_own(tmp_path, before, after):
    for name in ("shared", "own"):
        (tmp_path / name).mkdir()
    models = KeptModels()
    first = play(models, request(before), tmp_path / "shared")
    shared = play(models, request(after), tmp_path / "shared")
    assert len(models) == 1
    assert shared == play(KeptModels(), request(after), tmp_path / "own")
    assert files_in(tmp_path / "shared") == files_in(tmp_path / "own")
    assert first["fingerprint"]["motion"] != shared["fingerprint"]["motion"]


@pytest.mark.long
@pytest.mark.parametrize("keep", ["outcome", "logs"])
def test_it_has_the_bits_of_a_run_in_a_fresh_process(tmp_path, keep):
    versions = versions_with(installed_blender())
    outcomes = []
    for runs in ((FROM_HIGHER, SHORT_RUN), (SHORT_RUN,)):
        with closing(RunProcess(run_program_command(), versions, RunLimits())) as process:
            made = [process.play(request(scenario, keep), tmp_path / str(len(runs))) for scenario in runs]
        outcomes.append(made[-1])
    shared, alone = outcomes
    assert shared.status == alone.status == "done"
    assert (shared.outputs, shared.fingerprint) == (alone.outputs, alone.fingerprint)
