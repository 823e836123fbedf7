"""The program that makes previews in Blender: ``python -m bridge_demolition_addon.studies.preview_program``.

It answers requests as `answering_program` asks them, and of several the last one alone: a newer request ends the run
under way at its next frame. A request has the file of a scenario, or none to have no run made. The program answers
while a run goes on, every few seconds, and at its end. While nothing is asked it loads what elastic connections need,
which would take as long as a run: the program is kept for the next request.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from ..display.bridge_preview import sharp_edges
from ..display.preview_outcome import PreviewOutcome
from ..model.scenario.file import scenario_from_text
from ..model.structure.kept_models import KeptModels
from ..model.study.preview_scenario import preview_model
from ..system.programs import program_command
from .run_service import RunService, answer_of, versions_here

if TYPE_CHECKING:
    from ..simulation.playback import Playing

FIRST_ANSWER_S = 1.5
"""After a request; the run may go on."""

_NEXT_ANSWERS_S = 0.5

FIRST_ELASTIC = """
[scenario]
title = "Loading what elastic connections need"
[time]
duration_s = 0.25
[bridge]
density_kg_m3 = 2500
span_lengths_m = [8.0]
[bridge.deck]
width_m = 3.0
thickness_m = 0.5
[bridge.piers]
columns = 1
column_length_m = 0.5
column_width_m = 0.5
height_m = 3.0
[bridge.pier_caps]
length_m = 1.0
width_m = 3.0
height_m = 0.5
[bridge.bearings]
friction = 0.05
[bridge.reinforcement]
designed_for = "LM1"
[fracture]
shards = 12
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
[shards]
use_deactivation = false
start_deactivated = false
[[removals]]
time_s = 0.0
members = ["pier 1"]
"""
"""A small bridge with all that most elastic ones have: bars, cracks, bearings and something that falls."""


class _SupersededError(BaseException):
    """A newer request waits; no `except Exception` keeps the older one going."""


def preview_program_command(blender: str = "") -> list[str]:
    """Return the command of this program, run by this Python or by a program of Blender."""
    return program_command("studies.preview_program", blender, one_thread=True)


def main() -> NoReturn:
    """Answer requests until there are no more."""
    folders: set[Path] = set()
    service = RunService(partial(_remove, folders))
    versions = versions_here(service)
    from ..simulation import motion_run  # noqa: F401, loaded before anything is asked

    service.say({"versions": versions})
    is_warm, models = False, KeptModels()
    while True:
        request = service.next_request()
        if "folder" in request:
            folders.add(Path(request["folder"]))
        if service.is_asked or "scenario" not in request:
            continue
        with suppress(_SupersededError):
            answer = answer_of(request, partial(play, service, models))
            service.say({"number": request["number"], "is_over": True, **answer})
            is_warm = is_warm or warm_up(lambda: service.is_asked, Path(request["folder"]))


def _remove(folders: Iterable[Path]) -> None:
    """Remove the folders of a process that was killed, so that it could not."""
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)


def warm_up(is_asked: Callable[[], bool], folder: Path) -> bool:
    """Make a short run with elastic connections, whose frames are kept in a folder meanwhile, as for a request.

    Return whether it came to its end: once something is asked it ends at its next frame.
    """
    from ..simulation.motion_run import motion_run

    scenario, model = preview_model(scenario_from_text(FIRST_ELASTIC))

    def look_on(_: Playing) -> None:
        if is_asked():
            raise _SupersededError

    try:
        with motion_run(scenario, model, folder, look_on):
            return True
    except _SupersededError:
        return False


def play(service: RunService, models: KeptModels, request: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Make the run of a request, whose frames are kept in a folder meanwhile, and return its outcome."""
    from ..simulation.motion_run import motion_run

    answer_at_s = time.monotonic() + FIRST_ANSWER_S
    scenario = scenario_from_text(Path(request["scenario"]).read_text(encoding="utf-8"))
    scenario, model = preview_model(scenario, models)
    outcome_of = partial(
        PreviewOutcome.of,
        edges_m=[sharp_edges(shard) for shard in model.shards],
        duration_s=scenario.time.duration_s,
        is_elastic=scenario.connections.is_elastic,
    )

    def look_on(playing: Playing) -> None:
        nonlocal answer_at_s
        if service.is_asked:
            raise _SupersededError
        if time.monotonic() < answer_at_s or not playing.recording.recorded_frames:
            return
        so_far = {"outcome": outcome_of(playing.recording.results()).to_json(), "left_s": playing.left_s}
        service.say({"number": request["number"], "is_over": False, "status": "running", **so_far})
        answer_at_s = time.monotonic() + _NEXT_ANSWERS_S

    with motion_run(scenario, model, folder, look_on) as (results, _):
        return {"outcome": outcome_of(results).to_json()}
