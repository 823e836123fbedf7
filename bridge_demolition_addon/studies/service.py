"""The side of a process of draws that answers: it takes one request after another, see `draw_process`."""

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
from .draw_process import MARK, UNWRITABLE

_FIRST_TO_GO = "500"
"""Linux ends a draw before the study when memory runs out, of up to 1000 for what it ends first."""

Play = Callable[[Mapping[str, Any], Path], Mapping[str, Any]]
"""Runs a request, leaves its files in a folder, and returns ``outputs`` and ``fingerprint``."""


class Service:
    """Requests from standard input, and answers to what standard output was: nothing else gets there any more.

    The process ends when its input does: whoever asked is gone then, whatever ended it.
    """

    def __init__(self):
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
        """Answer requests until there are no more.

        Parameters
        ----------
        versions
            What is run.
        play
            What runs each.
        """
        self.say({"versions": dict(versions)})
        while True:
            request = json.loads(self._requests.get())
            self.say(_answer(request, play))

    def _listen(self) -> None:
        for line in sys.stdin:
            self._requests.put(line)
        os._exit(0)  # whatever is at work


def _answer(request: Mapping[str, Any], play: Play) -> Mapping[str, Any]:
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
