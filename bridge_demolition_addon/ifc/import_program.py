"""The program that imports a bridge: see `import_process`, which starts it, and starts it again where it crashed.

It reads a request from its standard input, one line of JSON, and answers with lines of JSON behind `MARK` on what its
standard output was: what the libraries print there goes nowhere.
"""

from __future__ import annotations

import json
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..errors import DemolitionError, text_of
from .bridge import read_bridge
from .elements import Element
from .folder import write_bridge
from .import_process import MARK
from .settings import ImportSettings
from .shapes import KeptShapes

Say = Callable[[Mapping[str, Any]], None]


def main() -> None:
    """Do what the request asks for, and answer with what was done, or with what is wrong."""
    say = _sayer()
    request = json.loads(sys.stdin.readline())
    try:
        say({"done": _imported(request, say)})
    except (DemolitionError, OSError) as error:
        say({"refused": type(error).__name__, "text": text_of(error)})
    except MemoryError:
        say({"refused": "IfcError", "text": f"{request['path']}: needs more memory than there is; leave elements out"})
    except Exception as error:  # said as a fault of ours, in one sentence: a file of another program led to it
        frame = traceback.extract_tb(error.__traceback__)[-1]
        say({"fault": f"{type(error).__name__} in {Path(frame.filename).name}, line {frame.lineno}: {error}"})


def _imported(request: Mapping[str, Any], say: Say) -> dict[str, Any]:
    """Import a bridge into a folder, and return what is said of it."""
    kept = KeptShapes(Path(request["kept"]), {int(number): why for number, why in request["failed"].items()})

    def begins(done: int, total: int, element: Element | None) -> None:
        if element is None:
            return say({"stage": "putting the members together"})
        say({"element": element.entity.id(), "title": element.title, "part": done, "of": total})

    kept.begins = begins
    bridge = read_bridge(Path(request["path"]), ImportSettings.from_json(request["settings"]), kept)
    say({"stage": "writing the scenario"})
    lines = write_bridge(bridge, Path(request["folder"]))
    became = [outcome.became for outcome in bridge.outcomes]
    counts = {word: became.count(word) for word in ("member", "connection", "left out")}
    return {"title": bridge.scenario.title, "lines": lines, "counts": counts}


def _sayer() -> Say:
    sys.stdout.flush()
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)

    def say(answer: Mapping[str, Any]) -> None:
        answers.write(MARK + json.dumps(answer) + "\n")
        answers.flush()

    return say
