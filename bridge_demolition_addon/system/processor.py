"""The processor: its name, and libraries that are loaded on one core, so that they make no threads of their own.

A run without pictures is quicker so: bodies of a frame take longer to be shared out to a second thread than to be done.
"""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path


def processor_name() -> str:
    """Return its name, if the system knows it; else its architecture."""
    information = Path("/proc/cpuinfo")  # of Linux, where Python knows no more than the architecture
    if information.exists():
        for line in information.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def processor_count() -> int:
    """Return how many processors the system has, cores that appear twice counted so."""
    return os.cpu_count() or 1


_PROCESSOR = 36
"""Which number behind the name in Linux's line of a thread says on what core it runs."""


@contextmanager
def on_one_core() -> Iterator[None]:
    """Hold this thread to the core on which it runs, for the block; then it may run on all that it had, as before.

    A library that counts cores as it is loaded finds one. Only Linux can do that; elsewhere nothing changes.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    with suppress(OSError):
        os.sched_setaffinity(0, {_own_core()})
    try:
        yield
    finally:
        for thread in os.listdir("/proc/self/task"):  # those that were begun meanwhile are held, too
            with suppress(OSError):  # it has ended
                os.sched_setaffinity(int(thread), allowed)


def load_on_one_core(library: str) -> None:
    """Load a library on one core, where it is there and not loaded yet."""
    with suppress(ModuleNotFoundError), on_one_core():
        import_module(library)


def _own_core() -> int:
    line = Path("/proc/thread-self/stat").read_text(encoding="ascii", errors="replace")
    return int(line.rpartition(")")[2].split()[_PROCESSOR])
