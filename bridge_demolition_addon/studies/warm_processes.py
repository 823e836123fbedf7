"""Processes of runs that stay warm between runs: the next one finds Blender started, and maybe its model built."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

from .run_process import RunLimits, RunProcess

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
