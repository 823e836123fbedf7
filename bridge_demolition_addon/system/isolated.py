"""Work on files of other programs in a process of its own, so that nothing in them ends this one."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from ..errors import DemolitionError, UnreadableError, text_of
from .programs import program_command

_MARK = "bda-isolated "


MOST_MEMORY = 4 * 10**9
"""Bytes that a reader may take; three quarters of what the computer has, where that is less."""

_SHARE_OF_MEMORY = 0.75


def isolated(module: str, request: Mapping[str, Any], limit_s: float, most_memory: int = MOST_MEMORY) -> dict[str, Any]:
    """Have `main` of a module of this package, which calls `answer`, answer a request.

    Raise `UnreadableError`, without the name of a file, where it refuses, crashes or takes longer than its limit, or,
    on Linux, more memory: a few bytes of a packed file may unpack to any number of them.
    """
    command = program_command(module, with_libraries=True)
    with tempfile.TemporaryFile() as noise:
        try:
            done = subprocess.run(
                command,
                input=json.dumps({**request, "most_memory": most_memory}).encode(),
                stdout=subprocess.PIPE,
                stderr=noise,
                timeout=limit_s,
                start_new_session=sys.platform != "win32",
            )
        except subprocess.TimeoutExpired as error:
            raise UnreadableError(f"took its reader longer than {limit_s:g} s; export a smaller part of it") from error
    lines = done.stdout.decode("utf-8", "replace").splitlines()
    found = [line.removeprefix(_MARK) for line in lines if line.startswith(_MARK)]
    if not found:
        raise UnreadableError(f"crashed its reader ({status_text(done.returncode)}): it is damaged; export it again")
    said: dict[str, Any] = json.loads(found[-1])
    if "refused" in said:
        raise UnreadableError(said["refused"])
    return said


def answer(work: Callable[[dict[str, Any]], Mapping[str, Any]]) -> None:
    """Answer the request on standard input by some work; what libraries print goes nowhere."""
    sys.stdout.flush()
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    try:
        request = json.loads(sys.stdin.readline())
        _limit_memory(request["most_memory"])
        said = work(request)
    except MemoryError:
        said = {"refused": "unpacks to more than there is memory for: it is damaged, or far larger than a site"}
    except (DemolitionError, OSError) as error:
        said = {"refused": text_of(error)}
    except Exception:  # readers of other formats have many of their own for what is damaged, for programmers
        said = {"refused": "cannot be read: it is damaged, or of another kind than its name says; export it again"}
    answers.write(f"\n{_MARK}{json.dumps(said)}\n")
    answers.flush()


def _limit_memory(most_bytes: int) -> None:
    if sys.platform == "linux":
        import resource  # Windows has none

        of_computer = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
        most = min(most_bytes, int(_SHARE_OF_MEMORY * of_computer))
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def status_text(status: int | None) -> str:
    """Return how a process ended: its signal, or its status."""
    if status is not None and status < 0 and sys.platform != "win32":
        with suppress(ValueError):
            return signal.Signals(-status).name
    return f"status {status}"
