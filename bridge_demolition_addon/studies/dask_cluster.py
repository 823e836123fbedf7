"""Runs on an existing Dask cluster, in processes outside its workers, which survive their crashes.

Files come back through Dask: no shared file system is needed.
"""

from __future__ import annotations

import queue
import shutil
import tempfile
import time
import uuid
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import ClusterError, SimulationError
from ..model.study.runs_table import KILLED, RunOutcome
from ..system.disk import writing
from .engine import Task, ended_items
from .run_process import RunLimits, WarmProcesses
from .run_program import run_program_command
from .versions import installed_blender, versions_with

if TYPE_CHECKING:
    from distributed import Future

_ANSWERS_WITHIN_S = 5.0
_COUNT_EVERY_S = 5.0
_WARM = WarmProcesses()
"""Those of this worker, for all of its threads."""

_GONE = "the scheduler has gone; once it is back, the same command goes on"


class DaskCluster:
    """Makes runs on the workers of a scheduler, such as ``tcp://host:8786``, one in each of their threads.

    The program of runs is by default the workers' own Python, and its versions are the first worker's.
    """

    def __init__(
        self,
        address: str,
        limits: RunLimits,
        command: Sequence[str] | None = None,
        versions: Mapping[str, str] | None = None,
    ):
        try:
            from distributed import Client
        except ModuleNotFoundError as error:
            raise ClusterError(
                "a study on a cluster needs Dask: install it with pip install 'bridge-demolition-addon[dask]'"
            ) from error
        try:
            self._client = Client(address, timeout=_ANSWERS_WITHIN_S, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise ClusterError(f"{address}: no Dask scheduler answers there; start one with dask scheduler") from error
        self._address, self._limits, self._command = address, limits, command
        self._futures: set[Future] = set()
        self._ended: queue.SimpleQueue[tuple[Task, Future]] = queue.SimpleQueue()
        self._threads, self._counted_s = 0, -_COUNT_EVERY_S
        try:
            if not self._thread_count():
                raise ClusterError(f"{address}: the Dask scheduler there has no workers; start some with dask worker")
            self.versions = dict(versions or self._client.submit(_versions_here, pure=False).result())
        except BaseException:
            self._client.close()
            raise

    @property
    def capacity(self) -> int:
        """Twice as many as workers have threads, so that none of these ever waits."""
        return 2 * max(self._thread_count(), 1)

    def submit(self, task: Task) -> None:
        """Have a run made as soon as a worker is free."""
        future = self._client.submit(
            _play_here,
            dict(task.request),
            self._command,
            self.versions,
            self._limits,
            key=f"run-{task.cache_key}-{uuid.uuid4().hex}",  # not the result of another study
            pure=False,
        )
        self._futures.add(future)
        future.add_done_callback(lambda ended: self._ended.put((task, ended)))

    def collect(self, timeout_s: float) -> Iterator[tuple[Task, RunOutcome]]:
        """Yield runs that have ended, with their files where they belong; see `Engine`."""
        ended = ended_items(self._ended, timeout_s)
        if not ended and self._client.status not in ("running", "connecting"):
            raise SimulationError(f"{self._address}: {_GONE}")
        for task, future in ended:
            yield task, self._outcome_of(task, future)

    def close(self) -> None:
        """Drop the runs under way: they go on to their end where they are, unused."""
        if self._client.status == "closed":
            return
        self._client.cancel(list(self._futures), force=True)
        self._client.close()

    def _outcome_of(self, task: Task, future: Future) -> RunOutcome:
        from distributed import CancelledError, KilledWorker
        from distributed.comm.core import CommClosedError

        self._futures.discard(future)
        if future.status in ("cancelled", "lost"):
            raise SimulationError(f"{self._address}: {_GONE}")
        try:
            outcome, files = future.result()
        except KilledWorker:
            return RunOutcome(KILLED, "each worker that it was given to ended")
        except (CancelledError, CommClosedError) as error:
            raise SimulationError(f"{self._address}: {_GONE}") from error
        finally:
            future.release()
        put_returned(task.folder, files, self._address)
        return outcome

    def _thread_count(self) -> int:
        if time.monotonic() - self._counted_s >= _COUNT_EVERY_S:
            self._threads, self._counted_s = sum(self._client.nthreads().values()), time.monotonic()
        return self._threads


def put_returned(folder: Path, files: Mapping[str, bytes], address: str) -> None:
    """Write the files of a run that a worker returned, in place of any before, none of them outside of its folder."""
    paths = {name: folder / name for name in files}
    for name, path in paths.items():
        if not path.resolve().is_relative_to(folder.resolve()):
            raise SimulationError(f"{address}: a worker returned a file {name!r}: do not trust it")
    with writing(folder):
        if folder.exists():  # of a run that was simulated here before
            shutil.rmtree(folder)
        for name, path in paths.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(files[name])


def _versions_here() -> dict[str, str]:
    return versions_with(installed_blender())


def _play_here(
    request: Mapping[str, Any], command: Sequence[str] | None, versions: Mapping[str, str], limits: RunLimits
) -> tuple[RunOutcome, dict[str, bytes]]:
    """Make a run in a process outside the worker; return its outcome, and its files by their paths in its folder."""
    with (
        _WARM.process(command or run_program_command(one_thread=limits.one_thread), versions, limits) as process,
        tempfile.TemporaryDirectory(prefix="bda-run-") as folder,
    ):
        target = Path(folder) / "run"
        outcome = process.play(request, target)
        paths = [path for path in target.rglob("*") if path.is_file()]
        return outcome, {path.relative_to(target).as_posix(): path.read_bytes() for path in paths}
