"""The program that makes a whole run outside Blender: ``python -m bridge_demolition_addon.studies.whole_run_program``.

It answers one request after another, as `answering_program` asks them. A request has the file of a scenario, the folder
for the results, and whether pictures are rendered. While the run goes on, the program says how far it is, and any other
request stops it: what there is by then is kept.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

from ..model.results.collapse import ConnectionCounts
from ..model.scenario.file import scenario_from_text
from ..system.programs import program_command
from ..system.progress import Counts, Progress
from .run_service import RunService, versions_here

_SAID_EVERY_S = 0.3


def whole_run_program_command(blender: str = "", *, pictures: bool = True) -> list[str]:
    """Return the command of this program, run by this Python or by a program of Blender.

    It renders no pictures without `pictures`: Blender has one thread then.
    """
    return program_command("studies.whole_run_program", blender, one_thread=not pictures)


def main() -> NoReturn:
    """Answer requests until there are no more."""
    service = RunService()
    service.serve(versions_here(service), partial(play, service))


def play(service: RunService, request: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Make the run of a request, and keep it in a folder as `bda run` does."""
    from ..simulation.run import run_scenario

    scenario = scenario_from_text(Path(request["scenario"]).read_text(encoding="utf-8"))
    progress = _SaidProgress(service)
    run_scenario(scenario, folder, overwrite=request["overwrite"], pictures=request["pictures"], progress=progress)
    return {}


class _SaidProgress(Progress):
    """Says how far a run is, a few times a second."""

    def __init__(self, service: RunService):
        self._service, self._said_s = service, 0.0

    def stage(self, text: str) -> None:
        self._service.say({"stage": text})

    def frame(self, done: int, total: int, connections: Counts, left_s: float | None) -> None:
        assert isinstance(connections, ConnectionCounts)
        now_s = time.monotonic()
        if now_s - self._said_s >= _SAID_EVERY_S or done == total:
            self._said_s = now_s
            self.is_stopped = self._service.is_asked
            self._service.say(
                {"frames": done, "of_frames": total, "connections": asdict(connections), "left_s": left_s}
            )
