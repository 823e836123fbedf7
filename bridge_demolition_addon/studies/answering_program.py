"""A program in a process of its own that answers requests.

It reads a request from its standard input, one line of JSON, and answers on its standard output with lines of JSON
behind `MARK`; other lines there come from other code. Its first answer says which versions it runs.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import tempfile
import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..errors import SimulationError
from ..system.programs import start_program
from .run_service import MARK

KILLING_SIGNALS = [
    getattr(signal, name) for name in ("SIGKILL", "SIGTERM", "SIGINT", "SIGHUP") if hasattr(signal, name)
]
"""What another program ends one with, unlike a crash."""

_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Each process has a core of its own, and numpy's threads would wait for each other on it."""

_ENDS_WITHIN_S = 30.0
"""After its last answer, a core dump included."""

_LAST_WORDS = 400


class AnsweringProgram:
    """A program that runs, and a thread that reads its answers.

    Parameters
    ----------
    command
        Command of the program; one that cannot be started raises SimulationError.

    Attributes
    ----------
    played : int
        How many requests it got.
    answers : queue of dict
        What it said, as it says it; None once it has ended.
    """

    def __init__(self, command: Sequence[str]):
        self.played = 0
        self.answers: queue.SimpleQueue[dict[str, Any] | None] = queue.SimpleQueue()
        self._last_words = tempfile.TemporaryFile()  # noqa: SIM115, open as long as the program
        try:
            started = start_program(command, self._last_words, os.environ | _ONE_THREAD)
            self._process, self._requests, self._output = started
        except OSError as error:
            raise SimulationError(f"{command[0]}: runs cannot be made by it: {error.strerror}") from error
        threading.Thread(target=self._read, name="answers of runs", daemon=True).start()

    def begin(self, versions: Mapping[str, str], *, may_be_killed: bool) -> bool:
        """Wait for the first answer, check its versions, and return whether the program was not killed."""
        answer = self.answers.get()
        if answer is None:
            code = self.ended()
            if may_be_killed and -code in KILLING_SIGNALS:
                return False
            raise SimulationError(f"runs cannot be made: their program ended with status {code}: {self.last_line}")
        if error := answer.get("error"):
            self.end()
            raise SimulationError(error)
        other = {name: here for name, here in answer["versions"].items() if versions.get(name) != here}
        if other:
            self.end()
            differing = ", ".join(
                f"{name} {version} instead of {versions.get(name)}" for name, version in other.items()
            )
            raise SimulationError(f"runs would be made by other versions than those of the study: {differing}")
        return True

    def ask(self, request: Mapping[str, Any]) -> None:
        """Send a request; a program that has ended does not answer."""
        self.played += 1
        with suppress(OSError):
            self._requests.write(json.dumps(request) + "\n")
            self._requests.flush()

    @property
    def process_id(self) -> int:
        """The system's number of the process."""
        return self._process.pid

    def memory_mb(self) -> float:
        """Memory that the process has now; 0 once it has ended."""
        try:
            pages = Path(f"/proc/{self._process.pid}/statm").read_text(encoding="ascii").split()[1]
        except (OSError, IndexError):
            return 0.0
        return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def ended(self) -> int:
        """Return the exit status of a process that no longer answers."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(_ENDS_WITHIN_S)
        return self.end()

    def end(self) -> int:
        """End the process, where it has not, and return its exit status."""
        self._process.kill()
        code = self._process.wait()
        with suppress(OSError):  # what it was still to be asked
            self._requests.close()
        return code

    @property
    def last_line(self) -> str:
        """What it printed last on its standard error."""
        self._last_words.seek(0)
        lines = self._last_words.read().decode("utf-8", "replace").strip().splitlines()
        return lines[-1][-_LAST_WORDS:] if lines else "it printed nothing"

    def _read(self) -> None:
        with self._output as lines:
            for line in lines:
                if line.startswith(MARK):
                    self.answers.put(json.loads(line.removeprefix(MARK)))
        self.answers.put(None)
