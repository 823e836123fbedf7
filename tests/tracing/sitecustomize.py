# SPDX-License-Identifier: GPL-3.0-or-later
"""Notes calls and returns of some functions of the package, in every process that finds this module.

Python imports a module of this name as it starts. TRACED names the functions, such as `cli/run.py:execute`, or a class
for all its methods. A file in TRACE_FOLDER, named after the process, gets a line for each of their first calls and
returns: when, and which. The clock is the same in all processes.
"""

import os
import sys
import threading
import time
from collections import Counter
from pathlib import Path
from types import CodeType, FrameType

PACKAGE = str(Path(__file__).resolve().parents[2] / "bridge_demolition_addon") + os.sep
MOST_EVENTS = 40
"""Noted of a function."""


def traced_name(code: CodeType, names: list[tuple[str, str]]) -> str:
    """The name under which a function is traced; empty where it is not."""
    if code.co_filename.startswith(PACKAGE):
        module, name = code.co_filename[len(PACKAGE) :].replace(os.sep, "/"), code.co_qualname
        for wanted_module, wanted in names:
            if module == wanted_module and (
                name == wanted or name.startswith(f"{wanted}.") or name.endswith(f".{wanted}")
            ):
                return f"{wanted_module}:{wanted}"
    return ""


def trace(folder: Path, names: list[tuple[str, str]]) -> None:
    """Note calls and returns from now on, in this thread and those to come."""
    known: dict[CodeType, str] = {}
    events: Counter[CodeType] = Counter()
    file = (folder / f"{os.getpid()}.txt").open("w", encoding="utf-8")

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event in ("call", "return"):
            code = frame.f_code
            if code not in known:
                known[code] = traced_name(code, names)
            if known[code] and events[code] < MOST_EVENTS:
                events[code] += 1
                file.write(f"{time.monotonic_ns()} {known[code]}\n")
                file.flush()

    threading.setprofile(note)
    sys.setprofile(note)


if "TRACED" in os.environ:
    trace(Path(os.environ["TRACE_FOLDER"]), [tuple(each.split(":")) for each in os.environ["TRACED"].split()])
