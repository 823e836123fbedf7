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
from collections.abc import Callable
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

    def noted(code: CodeType) -> bool:
        """Note an event of a function, where it is traced and has not had its most."""
        if code not in known:
            known[code] = traced_name(code, names)
        if not known[code] or events[code] == MOST_EVENTS:
            return False
        events[code] += 1
        file.write(f"{time.monotonic_ns()} {known[code]}\n")
        file.flush()
        return True

    if sys.version_info >= (3, 12):
        monitor(noted)
    else:
        profile(noted)


def monitor(noted: Callable[[CodeType], bool]) -> None:
    """Have Python say each call and return, and no more of a function that is not noted: this costs next to nothing."""
    monitoring, events = sys.monitoring, sys.monitoring.events
    tool, watched = monitoring.PROFILER_ID, (events.PY_START, events.PY_RESUME, events.PY_RETURN, events.PY_YIELD)
    monitoring.use_tool_id(tool, "ways")
    for event in watched:
        monitoring.register_callback(tool, event, lambda code, *_: None if noted(code) else monitoring.DISABLE)
    monitoring.set_events(tool, sum(watched))


def profile(noted: Callable[[CodeType], bool]) -> None:
    """The same with Python 3.11, which says every call and return."""

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event in ("call", "return"):
            noted(frame.f_code)

    threading.setprofile(note)
    sys.setprofile(note)


if "TRACED" in os.environ:
    trace(Path(os.environ["TRACE_FOLDER"]), [tuple(name.split(":")) for name in os.environ["TRACED"].split()])
