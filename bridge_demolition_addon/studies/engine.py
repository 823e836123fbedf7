"""Engines that make runs: the interface, and processes on this machine, each making one run after another."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ..model.study.runs_table import RunOutcome
from .run_process import RunLimits, RunProcess
from .run_program import run_program_command
from .versions import installed_blender, versions_with

_Item = TypeVar("_Item")


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """A run to be made."""

    cache_key: str  # digest of what its result depends on
    request: Mapping[str, Any]  # to its program, ready for JSON
    folder: Path  # for its files once it has ended


class Engine(Protocol):
    """Makes runs in the background."""

    @property
    def versions(self) -> Mapping[str, str]:
        """Versions that make the runs."""

    @property
    def capacity(self) -> int:
        """Number of runs to submit at a time, so that the engine never waits for the next."""

    def submit(self, task: Task) -> None:
        """Have a run made as soon as there is room for it."""

    def collect(self, timeout_s: float) -> Iterator[tuple[Task, RunOutcome]]:
        """Yield runs that have ended since the last call; wait for the first one up to a time.

        What stops all runs, such as a full disk, is raised after those that ended well.
        """

    def close(self) -> None:
        """Stop at once; runs under way are lost. It may be called again."""


def cores() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def ended_items(items: queue.SimpleQueue[_Item], timeout_s: float) -> list[_Item]:
    """Take all items of a queue; wait for the first one up to a time."""
    taken: list[_Item] = []
    try:
        taken.append(items.get(timeout=timeout_s) if timeout_s > 0.0 else items.get_nowait())
        while True:
            taken.append(items.get_nowait())
    except queue.Empty:
        return taken


class LocalProcesses:
    """Makes runs in several processes at a time; their program and its versions are by default this Python's."""

    def __init__(
        self,
        jobs: int,
        limits: RunLimits,
        command: Sequence[str] | None = None,
        versions: Mapping[str, str] | None = None,
    ):
        self.capacity = jobs + 1  # none of the processes ever waits
        self.versions = dict(versions or versions_with(installed_blender()))
        self._tasks: queue.SimpleQueue[Task | None] = queue.SimpleQueue()
        self._ended: queue.SimpleQueue[tuple[Task, RunOutcome | Exception]] = queue.SimpleQueue()
        self._is_closed = False
        command = command or run_program_command(one_thread=limits.one_thread)
        self._processes = [RunProcess(command, self.versions, limits) for _ in range(jobs)]
        self._threads = [
            threading.Thread(target=self._work, args=(process,), name="runs", daemon=True)
            for process in self._processes
        ]
        for thread in self._threads:
            thread.start()

    def submit(self, task: Task) -> None:
        """Have a run made as soon as a process is free."""
        self._tasks.put(task)

    def collect(self, timeout_s: float) -> Iterator[tuple[Task, RunOutcome]]:
        """Yield runs that have ended; see `Engine`."""
        error = None
        for task, outcome in ended_items(self._ended, timeout_s):
            if isinstance(outcome, Exception):
                error = error or outcome
            else:
                yield task, outcome
        if error is not None:
            raise error

    def close(self) -> None:
        """Stop at once; runs under way are lost."""
        self._is_closed = True
        for process in self._processes:
            self._tasks.put(None)
            process.close()
        for thread in self._threads:
            thread.join()

    def _work(self, process: RunProcess) -> None:
        while (task := self._tasks.get()) is not None and not self._is_closed:
            outcome: RunOutcome | Exception
            try:
                outcome = process.play(task.request, task.folder)
            except Exception as error:  # raised where it is collected
                outcome = error
            if not self._is_closed:
                self._ended.put((task, outcome))
