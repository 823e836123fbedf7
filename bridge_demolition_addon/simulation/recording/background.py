"""Work that is done beside Bullet, which goes on with its next sub-steps meanwhile.

Blender lets go of Python while it simulates, and numpy does so in long loops: both then run at the same time, each on a
core of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

THREAD_NAME = "recording"
"""What the names of the threads begin with."""


class BackgroundWork:
    """One thread that does one job at a time, in the order in which they come.

    A job must touch neither Blender's data nor Bullet's memory, but only what nobody else changes until it is done.
    """

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix=THREAD_NAME)
        self._job: Future[None] | None = None

    def begin(self, job: Callable[[], None]) -> None:
        """Begin a job once the one before is done, and raise the error of that one."""
        self.finish()
        self._job = self._thread.submit(job)

    def finish(self) -> None:
        """Wait until the job is done, and raise its error."""
        job, self._job = self._job, None
        if job:
            job.result()

    def close(self) -> None:
        """Wait for the job that may still run, whatever comes of it, and end the thread for good."""
        self._thread.shutdown()
        self._job = None
