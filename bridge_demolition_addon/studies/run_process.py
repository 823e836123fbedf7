"""A process that makes runs, one after another: a crash costs only the current run.

The program reads a request from its standard input, one line of JSON, and answers on its standard output with a line of
JSON behind `MARK`; other lines there come from other code. Its first answer says which versions it runs. It leaves
files in the folder that the request names.
"""

from __future__ import annotations

import json
import math
import os
import queue
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from ..errors import ScenarioError, SimulationError
from ..model.study.runs_table import CRASHED, DONE, KILLED, OUT_OF_MEMORY, REFUSED, TIMED_OUT, RunOutcome
from ..model.study.settings import EnsembleSettings
from ..system.programs import start_program
from .run_service import MARK, UNWRITABLE

RUNS_PER_PROCESS = 50
"""After so many, a process is replaced: Blender gives back little of the memory that a run took."""

_MOST_STARTS = 3
"""How often a program is started that is killed before it has begun."""

_LOOK_EVERY_S = 0.25
_KILLING_SIGNALS = [
    getattr(signal, name) for name in ("SIGKILL", "SIGTERM", "SIGINT", "SIGHUP") if hasattr(signal, name)
]
_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Each process has a core of its own, and numpy's threads would wait for each other on it."""

_ENDS_WITHIN_S = 30.0
"""After its last answer, a core dump included."""

_LAST_WORDS = 400
_VMSTAT = Path("/proc/vmstat")


@dataclass(frozen=True, slots=True)
class RunLimits:
    """When a run is ended."""

    time_s: float | None = None  # wall time
    memory_mb: float | None = None  # of its process

    @classmethod
    def of(cls, settings: EnsembleSettings) -> Self:
        """Return the limits of a study, a search or an optimisation."""
        if settings.memory_limit_mb is not None and sys.platform != "linux":
            raise ScenarioError(f"{settings.table}.memory_limit_mb: memory can be limited on Linux only; leave it out")
        return cls(settings.time_limit_s, settings.memory_limit_mb)


class RunProcess:
    """Makes runs in a process, which has to run these versions, and starts another where that one ends."""

    def __init__(self, command: Sequence[str], versions: Mapping[str, str], limits: RunLimits):
        self._command, self._versions, self._limits = list(command), dict(versions), limits
        self._program: _Program | None = None
        self._closing = threading.Lock()
        self._is_closed = False

    def play(self, request: Mapping[str, Any], folder: Path) -> RunOutcome:
        """Make a run whose files go to a folder, which is cleared first.

        A run whose process ends is made again in a fresh one, if the process had made earlier runs, or if another
        program killed it: so the result does not depend on how runs are distributed over processes.
        """
        began = time.monotonic()
        program = self._ready_program()
        is_fresh = program.played == 0
        outcome = self._play_once(program, request, folder, began)
        if outcome.status == KILLED or (not is_fresh and outcome.status in (CRASHED, OUT_OF_MEMORY)):
            outcome = self._play_once(self._ready_program(), request, folder, time.monotonic())
        return outcome

    def close(self) -> None:
        """End the process, and the run that is under way in it."""
        with self._closing:
            self._is_closed = True
            program = self._program
        if program:
            program.end()

    def _ready_program(self) -> _Program:
        starts = 0
        while self._program is None:
            with self._closing:
                if self._is_closed:
                    raise SimulationError("the study was stopped")
                self._program = _Program(self._command)
            starts += 1
            if not self._program.begin(self._versions, may_be_killed=starts < _MOST_STARTS):
                self._program = None
        return self._program

    def _play_once(self, program: _Program, request: Mapping[str, Any], folder: Path, began: float) -> RunOutcome:
        _clear(folder)
        answer = self._answer(program, {**request, "folder": str(folder)})
        status = answer["status"]
        if status not in (DONE, REFUSED) or program.played >= RUNS_PER_PROCESS:
            program.end()
            self._program = None
        if status == UNWRITABLE:
            raise SimulationError(answer["reason"])
        values = {name: answer[name] for name in ("reason", "outputs", "fingerprint") if name in answer}
        return RunOutcome(status, **values, wall_time_s=time.monotonic() - began)

    def _answer(self, program: _Program, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the program's answer, or one in its place."""
        limits, began, kills = self._limits, time.monotonic(), _kills_for_memory()
        program.ask(request)
        while True:
            left_s = math.inf if limits.time_s is None else limits.time_s - (time.monotonic() - began)
            with suppress(queue.Empty):
                answer = program.answers.get(timeout=min(_LOOK_EVERY_S, max(left_s, 0.0)))
                return answer or _meaning(program.ended(), _kills_for_memory() > kills)
            if left_s <= 0.0:
                return {"status": TIMED_OUT, "reason": f"it took longer than {limits.time_s:g} s"}
            if limits.memory_mb is not None and program.memory_mb() > limits.memory_mb:
                return {"status": OUT_OF_MEMORY, "reason": f"it took more than {limits.memory_mb:g} MB"}


class _Program:
    """A program that runs, and a thread that reads its answers."""

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
            if may_be_killed and -code in _KILLING_SIGNALS:
                return False
            raise SimulationError(f"runs cannot be made: their program ended with status {code}: {self._last_line}")
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
    def _last_line(self) -> str:
        self._last_words.seek(0)
        lines = self._last_words.read().decode("utf-8", "replace").strip().splitlines()
        return lines[-1][-_LAST_WORDS:] if lines else "it printed nothing"

    def _read(self) -> None:
        with self._output as lines:
            for line in lines:
                if line.startswith(MARK):
                    self.answers.put(json.loads(line.removeprefix(MARK)))
        self.answers.put(None)


def _meaning(code: int, for_memory: bool) -> dict[str, str]:
    """Return the outcome of a run whose process ended with a status, maybe as the system's memory had run out."""
    if code >= 0:
        return {"status": CRASHED, "reason": f"its process ended with status {code}"}
    if -code not in _KILLING_SIGNALS:
        return {"status": CRASHED, "reason": f"its process crashed with {_signal_name(-code)}"}
    if for_memory:
        return {"status": OUT_OF_MEMORY, "reason": "the system ended its process, as memory had run out"}
    return {"status": KILLED, "reason": f"its process was killed by {_signal_name(-code)}"}


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _kills_for_memory() -> int:
    """Return how many processes Linux has killed as memory had run out; 0 elsewhere."""
    try:
        lines = _VMSTAT.read_text(encoding="ascii").splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith("oom_kill ")), 0)


def _clear(folder: Path) -> None:
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir(parents=True)
