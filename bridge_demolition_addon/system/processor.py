"""The processor that calculates."""

import os
import platform
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
