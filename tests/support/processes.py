"""Programs of the tests and the command line, each in a process of its own."""

import os
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

from support.checkout import ROOT, TESTS

TIMEOUT_S = 300


def run_program(name: str, *arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a program of `tests/programs`, which finds the modules of the tests, to its end."""
    return subprocess.run(
        _command(name, *arguments),
        cwd=ROOT,
        env=_environment(environment),
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=TIMEOUT_S,
        check=False,
    )


class ProgramAtWork:
    """A program of `tests/programs` that does what it is asked for, line by line, as long as it lives.

    What it complains of goes to a file.
    """

    def __init__(self, name: str, complaints: Path, **environment: str):
        self._complaints = complaints
        with complaints.open("wb") as file:
            self._process = subprocess.Popen(
                _command(name),
                cwd=ROOT,
                env=_environment(environment),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=file,
                text=True,
                encoding="utf-8",
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
        for each in self._process.stdout:
            printed.append(each)
            if each.strip() == answer:
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
    return os.environ | {"PYTHONPATH": os.pathsep.join(map(str, (TESTS, ROOT)))} | more


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
