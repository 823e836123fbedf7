# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs of the tests and the command line, each in a process of its own.

They heed Ctrl-C, SIGTERM and SIGHUP, also where pytest ignores them, as in the background of a shell or after `nohup`.
What a test leaves running ends with the test.
"""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import IO

import pytest
from support.checkout import ROOT, TESTS

from bridge_demolition_addon.cli.main import main

TIMEOUT_S = 300


def run_program(name: str, *arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a program of `tests/programs`, which finds the modules of the tests, to its end."""
    process = start_program(name, *arguments, **environment)
    return subprocess.CompletedProcess(process.args, *outcome(process))


def start_program(name: str, *arguments: object, **environment: str) -> subprocess.Popen[str]:
    """Start a program of `tests/programs`."""
    return start(_command(name, *arguments), **_environment(environment))


def is_alive(process_id: int) -> bool:
    """Return whether the system knows a process by this number."""
    try:
        os.kill(process_id, 0)
    except ProcessLookupError:
        return False
    return True


class ProgramAtWork:
    """A program of `tests/programs` that does what it is asked for, line by line, as long as it lives.

    What it complains of goes to a file.
    """

    def __init__(self, name: str, complaints: Path, **environment: str):
        self._complaints = complaints
        with complaints.open("wb") as file:
            self._process = start(
                _command(name), stdin=subprocess.PIPE, stderr=file, outlives_test=True, **_environment(environment)
            )

    def ask(self, line: str, answer: str) -> tuple[str, str]:
        """Ask for something: what is printed until a line is the answer or the program ends, and its complaints."""
        limit = threading.Timer(TIMEOUT_S, self._process.kill)
        limit.start()
        heard = self._complaints.stat().st_size
        with suppress(BrokenPipeError):  # it died as it waited, and says why
            self._process.stdin.write(line + "\n")
            self._process.stdin.flush()
        printed = []
        for printed_line in self._process.stdout:
            printed.append(printed_line)
            if printed_line.strip() == answer:
                break
        limit.cancel()
        return "".join(printed), self._complaints.read_bytes()[heard:].decode("utf-8", "replace")

    def end(self) -> None:
        """End the program, which may have ended by itself."""
        self._process.kill()
        self._process.communicate()


def _command(name: str, *arguments: object) -> list[str]:
    return [sys.executable, str(TESTS / "programs" / f"{name}.py"), *map(str, arguments)]


def _environment(more: dict[str, str]) -> dict[str, str]:
    return {"PYTHONPATH": os.pathsep.join(map(str, (TESTS, ROOT)))} | more


_started: list[subprocess.Popen[str]] = []


def start(
    command: Sequence[str],
    *,
    stdin: int | None = None,
    stderr: int | IO = subprocess.PIPE,
    outlives_test: bool = False,
    **environment: str,
) -> subprocess.Popen[str]:
    """Start a command in a process that heeds signals, and that ends with the test unless it is to outlive it."""
    process = subprocess.Popen(
        list(command),
        cwd=ROOT,
        env=os.environ | environment,
        stdin=stdin,
        stdout=subprocess.PIPE,
        stderr=stderr,
        text=True,
        encoding="utf-8",
        preexec_fn=_heed_signals if os.name == "posix" else None,
    )
    if not outlives_test:
        _started.append(process)
    return process


def _heed_signals() -> None:
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def end_started() -> None:
    """End what was started since and still runs."""
    while _started:
        process = _started.pop()
        if process.poll() is None:
            process.kill()
        for stream in (process.stdin, process.stdout, process.stderr):
            if stream:
                stream.close()
        process.wait()


def call_bda(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, str, str]:
    """Call the command line in this process, where nothing hangs on the process: status, and what it wrote to both.

    A process of its own would take two seconds more, to load Blender and all libraries.
    """
    capsys.readouterr()
    status = main([*map(str, arguments)])
    return status, *capsys.readouterr()


def start_bda(*arguments: object, **environment: str) -> subprocess.Popen[str]:
    """Start the command line where Ctrl-C can reach it alone, and where Blender has not run yet."""
    return start([sys.executable, "-m", "bridge_demolition_addon", *map(str, arguments)], **environment)


def outcome(process: subprocess.Popen[str]) -> tuple[int, str, str]:
    """Wait for the end of a process: its status, what it printed, and what it complained of."""
    printed, complained = process.communicate(timeout=TIMEOUT_S)
    return process.returncode, printed, complained


def run_bda(*arguments: object, **environment: str) -> tuple[int, str, str]:
    """Run the command line to its end: its status, what it printed, and what it complained of."""
    return outcome(start_bda(*arguments, **environment))
