"""The program that makes runs in Blender: ``python -m bridge_demolition_addon.studies.run_program``.

It answers one request after another, see `run_process`. A request has the scenario of a run and the settings that say
what is recorded, both in TOML: motion alone, or everything as `bda run` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from ..model.results.arrays import RESULTS_FILE, Results, load_results
from ..model.run_folder.files import BLEND_FILE, FORCE_CHART
from ..model.scenario import Scenario
from ..model.scenario.file import scenario_from_text
from ..model.sequence.checked_model import check_actions
from ..model.structure.kept_models import KeptModels
from ..model.structure.model import Model
from ..model.study.files import OUTLINES_FILE, RUN_FOLDER
from ..model.study.outcome import evaluate
from ..model.study.settings import EnsembleSettings
from ..model.toml_tables import table_of_document, toml_document
from ..system.disk import whole_file
from ..system.programs import program_command
from ..system.progress import Progress
from .own_blender import versions_here
from .run_service import RunService


def run_program_command(blender: str = "", *, one_thread: bool = True) -> list[str]:
    """Return the command of this program, run by this Python or by a program of Blender, which may have one thread."""
    return program_command("studies.run_program", blender, one_thread=one_thread)


def main() -> NoReturn:
    """Answer requests until there are no more."""
    service = RunService()
    service.serve(versions_here(service), partial(play, KeptModels()))


def play(models: KeptModels, request: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Make the run of a request, leave its files in a folder, and return its outputs and its fingerprint.

    Runs of one bridge that is cut alike share its model, as those of all candidates of an optimisation do.
    """
    scenario = scenario_from_text(request["scenario"])
    model = models.model_of(scenario)
    check_actions(scenario, model)
    settings = table_of_document(EnsembleSettings, toml_document(request["study"]))
    if settings.keep == "outcome":
        from ..simulation.motion_run import motion_run

        with motion_run(scenario, model, folder) as (results, summary):
            return _kept(results, summary, scenario, settings, folder)
    return _play_whole(scenario, model, settings, folder)


def _play_whole(scenario: Scenario, model: Model, settings: EnsembleSettings, folder: Path) -> dict[str, Any]:
    from ..simulation.run import run_scenario

    run = folder / RUN_FOLDER
    pictures = settings.keep == "all"
    summary = run_scenario(scenario, run, overwrite=True, pictures=pictures, progress=Progress(), model=model)
    answer = _kept(load_results(run), summary, scenario, settings, folder)
    if settings.keep == "logs":
        for name in (RESULTS_FILE, BLEND_FILE, FORCE_CHART):
            (run / name).unlink(missing_ok=True)
    return answer


def _kept(
    results: Results, summary: Mapping[str, Any], scenario: Scenario, settings: EnsembleSettings, folder: Path
) -> dict[str, Any]:
    evaluation = evaluate(results, summary, scenario, settings.criteria, settings.least_mass_kg)
    with whole_file(folder / OUTLINES_FILE) as part:
        arrays: dict[str, Any] = evaluation.outlines.arrays()
        np.savez_compressed(part, **arrays)
    fingerprint = {name: summary["fingerprint"][name] for name in ("built", "motion")}
    return {"outputs": evaluation.outputs, "fingerprint": fingerprint}
