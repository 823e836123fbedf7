"""A process that makes previews of scenarios outside Blender, and is kept for the next one."""

from __future__ import annotations

import queue
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..display.preview_outcome import PreviewOutcome
from ..errors import SimulationError
from ..model.study.runs_table import DONE
from .answering_program import AnsweringProgram

_MOST_MB = 1500.0
"""Memory after which the process is replaced: Blender gives back little of what a run took."""


@dataclass(frozen=True, slots=True, eq=False)
class Preview:
    """What is known of the scenario that was asked for last.

    Attributes
    ----------
    outcome : PreviewOutcome or None
        None where the scenario cannot be run.
    is_over : bool
        Whether its run has ended.
    left_s : float or None
        Time that its run will still take; None where that is not known.
    reason : str
        Why it cannot be run, in a sentence; empty where it can.
    """

    outcome: PreviewOutcome | None
    is_over: bool
    left_s: float | None = None
    reason: str = ""


class PreviewProcess:
    """Asks the program of previews, which it starts when it is first needed, and never waits for it.

    Parameters
    ----------
    command
        Command of the program.
    """

    def __init__(self, command: Sequence[str]):
        self._command = list(command)
        self._program: AnsweringProgram | None = None
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._number = 0
        self._is_running = False

    @property
    def is_running(self) -> bool:
        """Whether a run is asked for that has not ended yet."""
        return self._is_running

    @property
    def process_id(self) -> int | None:
        """The system's number of the process; None before it is first needed, and once it has ended."""
        return self._program.process_id if self._program else None

    def ask(self, scenario: str) -> None:
        """Have a scenario run, in TOML; this ends the run before. A program that cannot start raises SimulationError.
        A full disk raises OSError.

        Parameters
        ----------
        scenario
            Text of its file.
        """
        program, folder = self._ready_program()
        (folder / f"{self._number}.toml").unlink(missing_ok=True)
        self._number += 1
        path = folder / f"{self._number}.toml"
        path.write_text(scenario, encoding="utf-8")  # a pipe that is full would have Blender wait
        self._is_running = True
        program.ask({"number": self._number, "folder": str(folder), "scenario": str(path)})

    def stop(self) -> None:
        """End the run under way; the process stays."""
        self._number += 1
        if self._is_running and self._program:
            self._program.ask({"number": self._number})
        self._is_running = False

    def look(self) -> Preview | None:
        """Return what is new of the scenario that was asked for last; None where nothing is.

        A process that has ended by itself raises SimulationError, and the next question starts another.
        """
        newest = None
        while self._program:
            try:
                answer = self._program.answers.get_nowait()
            except queue.Empty:
                break
            if answer is None:
                last, code = self._program.last_line, self._program.end()
                self.end()
                raise SimulationError(f"the process of the preview ended with status {code}: {last}")
            if error := answer.get("error"):
                self.end()
                raise SimulationError(error)
            if answer.get("number") == self._number:
                newest = _preview_of(answer)
        if newest and newest.is_over:
            self._is_running = False
            if self._program and self._program.memory_mb() > _MOST_MB:
                self.end()
        return newest

    def end(self) -> None:
        """End the process, with the run under way in it."""
        program, self._program = self._program, None
        folder, self._folder = self._folder, None
        self._is_running = False
        if program:
            program.end()
        if folder:
            folder.cleanup()

    def _ready_program(self) -> tuple[AnsweringProgram, Path]:
        if self._program is None or self._folder is None:
            self._program = AnsweringProgram(self._command)
            self._folder = tempfile.TemporaryDirectory(prefix="bda-preview-", ignore_cleanup_errors=True)
        return self._program, Path(self._folder.name)


def _preview_of(answer: dict[str, Any]) -> Preview:
    if "outcome" in answer:
        return Preview(PreviewOutcome.of_json(answer["outcome"]), answer["is_over"], answer.get("left_s"))
    assert answer["status"] != DONE
    return Preview(None, True, reason=answer["reason"])
