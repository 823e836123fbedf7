"""The program that makes runs in Blender: ``python -m bridge_demolition_addon.studies.run_program``.

It answers one request after another, see `run_process`. A request has the scenario of a run and the settings that say
what is recorded, both in TOML: motion alone, or everything as `bda run` does.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from ..errors import OutputError, UnreadableError
from ..model.results.arrays import LEFT_FILES, RESULTS_FILE, Results, load_results
from ..model.run_folder.files import BLEND_FILE, FORCE_CHART
from ..model.run_folder.summary import RunSummary
from ..model.scenario import Scenario
from ..model.scenario.file import scenario_from_text
from ..model.sequence.checked_model import check_actions
from ..model.structure.kept_models import KeptModels
from ..model.structure.model import Model
from ..model.study.file import OUTLINES_FILE, RUN_FOLDER, SIMULATED_FILE
from ..model.study.outcome import evaluate
from ..model.study.settings import EnsembleSettings
from ..model.toml_tables import table_of_document, toml_document
from ..system.disk import whole_file, write_whole_text
from ..system.programs import program_command
from ..system.progress import Progress
from ..system.reading import MEGABYTE, file_text
from .run_service import RunService, versions_here


def run_program_command(blender: str = "", *, one_thread: bool = True) -> list[str]:
    """Return the command of this program, run by this Python or by a program of Blender, which may have one thread."""
    return program_command("studies.run_program", blender, one_thread=one_thread)


def main() -> NoReturn:
    """Answer requests until there are no more."""
    service = RunService()
    service.serve(versions_here(service), partial(play, KeptModels()))


def play(models: KeptModels, request: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Make the run of a request, leave its files in a folder, and return its outputs and its fingerprint.

    One that was stopped while it was evaluated is only evaluated. Runs of one bridge that is cut alike share its model,
    as the candidates of an optimisation do.
    """
    scenario = scenario_from_text(request["scenario"])
    settings = table_of_document(EnsembleSettings, toml_document(request["study"]))
    keeps_run = settings.keep != "outcome"
    run = folder / RUN_FOLDER if keeps_run else folder
    if left := _simulated_before(folder, run):
        answer = _evaluated(*left, scenario, settings, folder)
    else:
        model = models.model_of(scenario)
        check_actions(scenario, model)
        with _whole_run(scenario, model, settings, run) if keeps_run else _motion(scenario, model, run) as made:
            write_whole_text(folder / SIMULATED_FILE, json.dumps(made[1]))
            answer = _evaluated(*made, scenario, settings, folder)
    (folder / SIMULATED_FILE).unlink()
    left_over = {"outcome": LEFT_FILES, "logs": (RESULTS_FILE, BLEND_FILE, FORCE_CHART), "all": ()}[settings.keep]
    for name in left_over:
        (run / name).unlink(missing_ok=True)
    return answer


def _simulated_before(folder: Path, run: Path) -> tuple[Results, dict[str, Any]] | None:
    """Return what a run left that was stopped while it was evaluated; None where there is none, or it is damaged."""
    try:
        return load_results(run), json.loads(file_text(folder / SIMULATED_FILE, 100 * MEGABYTE))
    except (OutputError, UnreadableError, ValueError):
        return None


def _motion(scenario: Scenario, model: Model, folder: Path) -> AbstractContextManager[tuple[Results, dict[str, Any]]]:
    from ..simulation.motion_run import motion_run

    return motion_run(scenario, model, folder)


@contextmanager
def _whole_run(
    scenario: Scenario, model: Model, settings: EnsembleSettings, run: Path
) -> Iterator[tuple[Results, dict[str, Any]]]:
    from ..simulation.run import run_scenario

    pictures = settings.keep == "all"
    summary = run_scenario(scenario, run, overwrite=True, pictures=pictures, progress=Progress(), model=model)
    yield load_results(run), summary


def _evaluated(
    results: Results, summary: Mapping[str, Any], scenario: Scenario, settings: EnsembleSettings, folder: Path
) -> dict[str, Any]:
    evaluation = evaluate(results, RunSummary.of(summary), scenario, settings.criteria, settings.least_mass_kg)
    with whole_file(folder / OUTLINES_FILE) as part:
        arrays: dict[str, Any] = evaluation.outlines.arrays()
        np.savez_compressed(part, **arrays)
    fingerprint = {name: summary["fingerprint"][name] for name in ("built", "motion")}
    return {"outputs": evaluation.outputs, "fingerprint": fingerprint}
