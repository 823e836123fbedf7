"""The program that makes runs in Blender: ``python -m bridge_demolition_addon.studies.run_program``.

It answers one request after another, see `run_process`. A request has the scenario of a run and the settings that say
what is recorded, both in TOML: motion alone, or everything as `bda run` does.
"""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from ..errors import BlastError, DemolitionError, GeometryError, OutputError, ScenarioError, text_of
from ..model.results.arrays import RESULTS_FILE, Results, load_results
from ..model.run_folder.files import BLEND_FILE, FORCE_CHART
from ..model.scenario import Scenario
from ..model.scenario.file import scenario_from_text
from ..model.sequence.checked_model import checked_model
from ..model.study.files import OUTLINES_FILE, RUN_FOLDER
from ..model.study.outcome import evaluate
from ..model.study.runs_table import DONE, FAILED, OUT_OF_MEMORY, REFUSED
from ..model.study.settings import EnsembleSettings
from ..model.toml_tables import table_of_document, toml_document
from ..system.disk import whole_file
from ..system.programs import program_command
from ..system.progress import Progress
from .run_process import MARK, UNWRITABLE
from .versions import versions_with

_FIRST_TO_GO = "500"
"""Linux ends a run before the study when memory runs out; what has 1000 goes first."""

Play = Callable[[Mapping[str, Any], Path], Mapping[str, Any]]
"""Makes the run of a request, leaves its files in a folder, and returns ``outputs`` and ``fingerprint``."""


class RunService:
    """Requests from standard input, and answers to what standard output was: nothing else gets there.

    The process ends when its input does: then the process that asked has ended.
    """

    def __init__(self) -> None:
        sys.stdout.flush()
        self._answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.close(nowhere)
        if sys.platform == "linux":
            with suppress(OSError):
                Path("/proc/self/oom_score_adj").write_text(_FIRST_TO_GO, encoding="ascii")
        self._requests: queue.SimpleQueue[str] = queue.SimpleQueue()
        threading.Thread(target=self._listen, daemon=True).start()

    def say(self, answer: Mapping[str, Any]) -> None:
        """Answer with a line."""
        try:
            self._answers.write(MARK + json.dumps(answer) + "\n")
            self._answers.flush()
        except OSError:
            os._exit(1)

    def serve(self, versions: Mapping[str, str], play: Play) -> NoReturn:
        """Answer requests until there are no more: say which versions are run, then play each request."""
        self.say({"versions": dict(versions)})
        while True:
            request = json.loads(self._requests.get())
            self.say(_answer(request, play))

    def _listen(self) -> None:
        for line in sys.stdin:
            self._requests.put(line)
        os._exit(0)  # whatever is at work


def _answer(request: Mapping[str, Any], play: Play) -> Mapping[str, Any]:
    try:
        return {"status": DONE, **play(request, Path(request["folder"]))}
    except (BlastError, GeometryError, ScenarioError) as error:
        return {"status": REFUSED, "reason": text_of(error)}
    except MemoryError:
        return {"status": OUT_OF_MEMORY, "reason": "there was no more memory for it"}
    except (DemolitionError, OSError) as error:
        is_unwritable = isinstance(error, OSError) or (
            isinstance(error, OutputError) and isinstance(error.__cause__, OSError)
        )
        if isinstance(error, OSError) and error.filename is None:  # as where a file that is open grows no more
            error = OSError(error.errno, error.strerror, request["folder"])
        return {"status": UNWRITABLE if is_unwritable else FAILED, "reason": text_of(error)}
    except Exception as error:
        traceback.print_exc()
        return {"status": FAILED, "reason": f"{type(error).__name__}: {error}"}


def run_program_command(blender: str = "") -> list[str]:
    """Return the command of this program, run by this Python or by a program of Blender."""
    return program_command("studies.run_program", blender)


def main() -> NoReturn:
    """Answer requests until there are no more."""
    service = RunService()
    try:
        import bpy
    except ModuleNotFoundError as error:
        service.say({"error": f"Blender is not there: install the bpy package or run inside Blender ({error})"})
        os._exit(1)
    service.serve(versions_with(".".join(map(str, bpy.app.version))), play)


def play(request: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Make the run of a request, leave its files in a folder, and return its outputs and its fingerprint."""
    scenario = scenario_from_text(request["scenario"])
    settings = table_of_document(EnsembleSettings, toml_document(request["study"]))
    if settings.keep == "outcome":
        from ..simulation.motion_run import motion_run

        with motion_run(scenario, checked_model(scenario), folder) as (results, summary):
            return _kept(results, summary, scenario, settings, folder)
    return _play_whole(scenario, settings, folder)


def _play_whole(scenario: Scenario, settings: EnsembleSettings, folder: Path) -> dict[str, Any]:
    from ..simulation.run import run_scenario

    run = folder / RUN_FOLDER
    summary = run_scenario(scenario, run, overwrite=True, pictures=settings.keep == "all", progress=Progress())
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
