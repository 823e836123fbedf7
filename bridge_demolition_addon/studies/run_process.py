"""A process that makes runs, one after another: a crash costs only the current run, and the next finds Blender started.

Its program, see `answering_program`, leaves files in the folder that the request names.
"""

from __future__ import annotations

import math
import queue
import shutil
import signal
import sys
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from ..errors import ScenarioError, SimulationError
from ..model.study.file import SIMULATED_FILE
from ..model.study.runs_table import CRASHED, DONE, KILLED, OUT_OF_MEMORY, REFUSED, TIMED_OUT, RunOutcome
from ..model.study.settings import EnsembleSettings
from .answering_program import KILLING_SIGNALS, AnsweringProgram
from .run_service import UNWRITABLE

RUNS_PER_PROCESS = 50
"""After so many, a process is replaced: Blender gives back little of the memory that a run took."""

_MOST_STARTS = 3
"""How often a program is started that is killed before it has begun."""

_LOOK_EVERY_S = 0.25
_VMSTAT = Path("/proc/vmstat")


@dataclass(frozen=True, slots=True)
class RunLimits:
    """What a run may take: it is ended above its time or memory."""

    time_s: float | None = None  # wall time
    memory_mb: float | None = None  # of its process
    one_thread: bool = True  # of Blender; pictures are rendered with all

    @classmethod
    def of(cls, settings: EnsembleSettings) -> Self:
        """Return the limits of a study, a search or an optimisation."""
        if settings.memory_limit_mb is not None and sys.platform != "linux":
            raise ScenarioError(f"{settings.table}.memory_limit_mb: memory can be limited on Linux only; leave it out")
        return cls(settings.time_limit_s, settings.memory_limit_mb, one_thread=settings.keep != "all")


class RunProcess:
    """Makes runs in a process, which has to run these versions, and starts another where that one ends."""

    def __init__(self, command: Sequence[str], versions: Mapping[str, str], limits: RunLimits):
        self._command, self._versions, self._limits = list(command), dict(versions), limits
        self._program: AnsweringProgram | None = None
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

    def _ready_program(self) -> AnsweringProgram:
        starts = 0
        while self._program is None:
            with self._closing:
                if self._is_closed:
                    raise SimulationError("the study was stopped")
                self._program = AnsweringProgram(self._command)
            starts += 1
            if not self._program.begin(self._versions, may_be_killed=starts < _MOST_STARTS):
                self._program = None
        return self._program

    def _play_once(
        self, program: AnsweringProgram, request: Mapping[str, Any], folder: Path, began: float
    ) -> RunOutcome:
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

    def _answer(self, program: AnsweringProgram, request: Mapping[str, Any]) -> dict[str, Any]:
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


def _meaning(code: int, for_memory: bool) -> dict[str, str]:
    """Return the outcome of a run whose process ended with a status, maybe as the system's memory had run out."""
    if code >= 0:
        return {"status": CRASHED, "reason": f"its process ended with status {code}"}
    if -code not in KILLING_SIGNALS:
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
    if (folder / SIMULATED_FILE).exists():  # it is only to be evaluated
        return
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir(parents=True)


IDLE_S = 30.0
"""How long a process waits for a run before it is ended; starting another takes seconds."""

_Kind = tuple[tuple[str, ...], tuple[tuple[str, str], ...], RunLimits]


class WarmProcesses:
    """Processes that wait for runs of their kind: the same program, versions and limits. They end with this process."""

    def __init__(self, idle_s: float = IDLE_S):
        self._idle_s = idle_s
        self._lock = threading.Lock()
        self._waiting: dict[RunProcess, tuple[_Kind, threading.Timer]] = {}

    @contextmanager
    def process(self, command: Sequence[str], versions: Mapping[str, str], limits: RunLimits) -> Iterator[RunProcess]:
        """Lend a process that no other thread has, for the block; it is ended where the block raises an error."""
        kind = (tuple(command), tuple(sorted(versions.items())), limits)
        process = self._waiting_one(kind) or RunProcess(command, versions, limits)
        try:
            yield process
        except BaseException:
            process.close()
            raise
        self._keep(kind, process)

    def _waiting_one(self, kind: _Kind) -> RunProcess | None:
        with self._lock:
            process = next((process for process, (own, _) in self._waiting.items() if own == kind), None)
            if process:
                self._waiting.pop(process)[1].cancel()
        return process

    def _keep(self, kind: _Kind, process: RunProcess) -> None:
        timer = threading.Timer(self._idle_s, self._end, (process,))
        timer.daemon = True
        with self._lock:
            self._waiting[process] = kind, timer
        timer.start()

    def _end(self, process: RunProcess) -> None:
        """End a process, unless a run has taken it meanwhile."""
        with self._lock:
            is_waiting = self._waiting.pop(process, None) is not None
        if is_waiting:
            process.close()
