"""Draws on this machine: several processes, each of which runs one draw after another."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Mapping, Sequence

from .draw_process import DrawProcess, End, Limits
from .draw_program import draw_command
from .engine import Task
from .versions import installed_blender, versions_with


def cores() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class LocalProcesses:
    """Runs draws in some processes at a time.

    Parameters
    ----------
    jobs
        How many.
    limits
        When a draw is ended.
    command, versions
        Program of draws and its arguments, and what it has to run; by default that of this Python.

    Attributes
    ----------
    versions : dict
        What all of them have to run.
    capacity : int
        One more than jobs, so that none of them ever waits.
    """

    def __init__(
        self,
        jobs: int,
        limits: Limits,
        command: Sequence[str] | None = None,
        versions: Mapping[str, str] | None = None,
    ):
        self.capacity = jobs + 1
        self.versions = dict(versions or versions_with(installed_blender()))
        self._tasks: queue.SimpleQueue[Task | None] = queue.SimpleQueue()
        self._ends: queue.SimpleQueue[tuple[Task, End | Exception]] = queue.SimpleQueue()
        self._is_closed = False
        self._processes = [DrawProcess(command or draw_command(), self.versions, limits) for _ in range(jobs)]
        self._threads = [
            threading.Thread(target=self._work, args=(each,), name="draws", daemon=True) for each in self._processes
        ]
        for thread in self._threads:
            thread.start()

    def submit(self, task: Task) -> None:
        """Have a draw run as soon as a process is free."""
        self._tasks.put(task)

    def collect(self, timeout_s: float) -> list[tuple[Task, End]]:
        """Return draws that have ended; see `Engine`."""
        found = []
        try:
            found.append(self._ends.get(timeout=timeout_s) if timeout_s > 0.0 else self._ends.get_nowait())
            while True:
                found.append(self._ends.get_nowait())
        except queue.Empty:
            pass
        for _, end in found:
            if isinstance(end, Exception):
                raise end
        return found

    def close(self) -> None:
        """Stop at once; what is at work is lost."""
        self._is_closed = True
        for process in self._processes:
            self._tasks.put(None)
            process.close()
        for thread in self._threads:
            thread.join()

    def _work(self, process: DrawProcess) -> None:
        while (task := self._tasks.get()) is not None and not self._is_closed:
            try:
                end = process.play(task.request, task.folder)
            except Exception as error:  # whoever collects raises it
                end = error
            if not self._is_closed:
                self._ends.put((task, end))
