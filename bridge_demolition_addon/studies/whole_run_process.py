"""A whole run in a process of its own, outside Blender's window."""

from __future__ import annotations

import queue
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import SimulationError
from ..model.results.collapse import ConnectionCounts
from ..model.study.runs_table import DONE
from .answering_program import AnsweringProgram


@dataclass(slots=True)
class RunState:
    """How far a run is.

    Attributes
    ----------
    stage : str
        What the run does now, as text.
    frames, of_frames : int
        Frames that are done, of how many.
    connections : ConnectionCounts
        What has become of connections by now.
    left_s : float or None
        Time that the simulation will still take, s; None where that is not known.
    is_over : bool
        Whether its results are in its folder.
    """

    stage: str = ""
    frames: int = 0
    of_frames: int = 0
    connections: ConnectionCounts = field(default_factory=lambda: ConnectionCounts(0, 0))
    left_s: float | None = None
    is_over: bool = False


class WholeRun:
    """A run that has been begun; nothing waits for it.

    Parameters
    ----------
    command
        Command of the program, see `whole_run_program`; one that cannot be started raises SimulationError.
    scenario
        Text of the scenario's file, in TOML.
    folder
        For the results; made by the run.
    overwrite, pictures
        Whether results that are there may be replaced, and whether pictures are rendered.
    """

    def __init__(self, command: Sequence[str], scenario: str, folder: Path, *, overwrite: bool, pictures: bool):
        self.folder, self.state = folder, RunState()
        self._program = AnsweringProgram(command)
        self._own = tempfile.TemporaryDirectory(prefix="bda-run-beside-", ignore_cleanup_errors=True)
        path = Path(self._own.name) / "scenario.toml"
        path.write_text(scenario, encoding="utf-8")  # a pipe that is full would have Blender wait
        request = {"scenario": str(path), "folder": str(folder), "overwrite": overwrite, "pictures": pictures}
        self._program.ask(request)

    @property
    def process_id(self) -> int:
        """The system's number of the process."""
        return self._program.process_id

    def look(self) -> bool:
        """Take what the run has said since the last look, and return whether there was anything.

        A run that is refused or fails, and a process that has ended by itself, raise SimulationError.
        """
        is_new = False
        while not self.state.is_over:
            try:
                answer = self._program.answers.get_nowait()
            except queue.Empty:
                break
            is_new = True
            self._take(answer)
        return is_new

    def stop(self) -> bool:
        """Ask the run to end with the frames that it has; False where it has none, or all, and would not listen."""
        is_asked = 0 < self.state.frames < self.state.of_frames
        if is_asked:
            self._program.ask({})
        return is_asked

    def end(self) -> None:
        """End the process, with the run if that goes on."""
        self._program.end()
        self._own.cleanup()

    def _take(self, answer: dict[str, Any] | None) -> None:
        if answer is None:
            last, code = self._program.last_line, self._program.ended()
            raise SimulationError(f"the process of the run ended with status {code}: {last}")
        if reason := answer.get("error") or answer.get("reason"):
            raise SimulationError(reason)
        if "stage" in answer:
            self.state.stage = answer["stage"]
        if "frames" in answer:
            state = self.state
            state.frames, state.of_frames = answer["frames"], answer["of_frames"]
            state.connections, state.left_s = ConnectionCounts(**answer["connections"]), answer["left_s"]
        self.state.is_over = answer.get("status") == DONE
