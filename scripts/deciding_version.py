# SPDX-License-Identifier: GPL-3.0-or-later
"""The version of what decides a result of runs: the last commit that changed it."""

import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DECIDES_RUNS = tuple(
    f"bridge_demolition_addon/{folder}" for folder in ("bullet", "engineering", "model", "scene", "simulation")
)


def deciding_version(*sources: str) -> str:
    """Return the last commit that changed runs, or one of the files by which this result is made."""
    words = ("git", "log", "-1", "--format=%h", "--", *DECIDES_RUNS, *sources)
    return subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
