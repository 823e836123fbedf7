"""Programs of the tests and the command line, each in a process of its own."""

import os
import subprocess
import sys

from places import ROOT, TESTS

TIMEOUT_S = 300


def run_program(name: str, *arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a program of `tests/programs`, which finds the modules of the tests, to its end."""
    paths = {"PYTHONPATH": os.pathsep.join(map(str, (TESTS, ROOT)))}
    command = [sys.executable, str(TESTS / "programs" / f"{name}.py"), *map(str, arguments)]
    return subprocess.run(
        command,
        cwd=ROOT,
        env=os.environ | paths | environment,
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=TIMEOUT_S,
        check=False,
    )


def start_bda(*arguments: object, **environment: str) -> subprocess.Popen[str]:
    """Start the command line where Ctrl-C can reach it alone, and where Blender has not run yet."""
    return subprocess.Popen(
        [sys.executable, "-m", "bridge_demolition_addon", *map(str, arguments)],
        cwd=ROOT,
        env=os.environ | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    )


def outcome(process: subprocess.Popen[str]) -> tuple[int, str, str]:
    """Wait for the end of a process: its status, what it printed, and what it complained of."""
    printed, complained = process.communicate(timeout=TIMEOUT_S)
    return process.returncode, printed, complained


def run_bda(*arguments: object, **environment: str) -> tuple[int, str, str]:
    """Run the command line to its end: its status, what it printed, and what it complained of."""
    return outcome(start_bda(*arguments, **environment))
