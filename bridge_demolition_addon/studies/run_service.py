"""How a program makes runs: it answers requests until there are no more, whatever the runs are made by.

Blender is loaded only where it is asked for, so that a program that makes runs without it starts at once.
"""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

from ..errors import BlastError, DemolitionError, GeometryError, OutputError, ScenarioError, text_of
from ..model.study.runs_table import DONE, FAILED, OUT_OF_MEMORY, REFUSED
from .versions import versions_with

MARK = "bda-draw "
"""What begins the program's own lines on its standard output."""

UNWRITABLE = "unwritable"
"""Status of an answer of a program that could not write; no run's."""

_FIRST_TO_GO = "500"
"""Linux ends a run before the study when memory runs out; what has 1000 goes first."""

Play = Callable[[Mapping[str, Any], Path], Mapping[str, Any]]
"""Makes the run of a request, leaves its files in a folder, and returns ``outputs`` and ``fingerprint``."""


class RunService:
    """Requests from standard input, and answers to what standard output was: nothing else gets there.

    The process ends when its input does: then the process that asked has ended.

    Parameters
    ----------
    at_end
        Called before that, for what would otherwise stay behind; not where the process is killed.
    """

    def __init__(self, at_end: Callable[[], None] = lambda: None) -> None:
        self._at_end = at_end
        sys.stdout.flush()
        self._answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.close(nowhere)
        if sys.platform == "linux":
            with suppress(OSError):
                Path("/proc/self/oom_score_adj").write_text(_FIRST_TO_GO, encoding="ascii")
        self._requests: queue.SimpleQueue[str] = queue.SimpleQueue()
        threading.Thread(target=self._listen, daemon=True).start()

    def say(self, answer: Mapping[str, Any]) -> None:
        """Answer with a line."""
        try:
            self._answers.write(MARK + json.dumps(answer) + "\n")
            self._answers.flush()
        except OSError:
            os._exit(1)

    def serve(self, versions: Mapping[str, str], play: Play) -> NoReturn:
        """Answer requests until there are no more: say which versions are run, then play each request."""
        self.say({"versions": dict(versions)})
        while True:
            request = self.next_request()
            self.say(answer_of(request, play))

    @property
    def is_asked(self) -> bool:
        """Whether another request waits."""
        return not self._requests.empty()

    def next_request(self) -> dict[str, Any]:
        """Return the next request; wait for it."""
        request: dict[str, Any] = json.loads(self._requests.get())
        return request

    def _listen(self) -> None:
        for line in sys.stdin:
            self._requests.put(line)
        self._at_end()
        os._exit(0)  # whatever is at work


def answer_of(request: Mapping[str, Any], play: Play) -> Mapping[str, Any]:
    """Return the answer to a request: what its run gives, or why it gives nothing, as ``status`` and ``reason``."""
    try:
        return {"status": DONE, **play(request, Path(request["folder"]))}
    except (BlastError, GeometryError, ScenarioError) as error:
        return {"status": REFUSED, "reason": text_of(error)}
    except MemoryError:
        return {"status": OUT_OF_MEMORY, "reason": "there was no more memory for it"}
    except (DemolitionError, OSError) as error:
        is_unwritable = isinstance(error, OSError) or (
            isinstance(error, OutputError) and isinstance(error.__cause__, OSError)
        )
        if isinstance(error, OSError) and error.filename is None:  # as where a file that is open grows no more
            error = OSError(error.errno, error.strerror, request["folder"])
        return {"status": UNWRITABLE if is_unwritable else FAILED, "reason": text_of(error)}
    except Exception as error:
        traceback.print_exc()
        return {"status": FAILED, "reason": f"{type(error).__name__}: {error}"}


def versions_here(service: RunService) -> dict[str, str]:
    """Load Blender and return all versions; say so and end the process where it is not there."""
    try:
        import bpy
    except ModuleNotFoundError as error:
        service.say({"error": f"Blender is not there: install the bpy package or run inside Blender ({error})"})
        os._exit(1)
    return versions_with(".".join(map(str, bpy.app.version)))
