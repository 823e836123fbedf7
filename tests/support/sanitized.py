# SPDX-License-Identifier: GPL-3.0-or-later
"""A core that ends the process at the first fault of addresses or undefined behaviour."""

import subprocess
from pathlib import Path

import build_core


def sanitized_core(folder: Path) -> dict[str, str]:
    """Build it into a folder, and return what processes that load it have in their environment."""
    sanitizers = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g", "-O1"]
    build_core.compile_to(folder / build_core.here().library, options=sanitizers)
    ask = [*build_core.own_compiler(), "-print-file-name=libasan.so"]
    preloaded = subprocess.run(ask, capture_output=True, text=True, check=True).stdout.strip()
    # Python itself keeps memory until its end.
    return {"LD_PRELOAD": preloaded, "ASAN_OPTIONS": "detect_leaks=0", "PYTHONMALLOC": "malloc"}
