"""An import in a process of its own: a file that crashes its reader costs an element, not what the user works on.

What the geometry library prints goes nowhere. An element that crashes the process, or takes longer than its limit, is
left out by its name; the process is started again and goes on behind it.
"""

from __future__ import annotations

import json
import queue
import subprocess
import tempfile
import threading
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from .. import errors
from ..errors import DemolitionError, IfcError
from ..system.isolated import status_text
from ..system.programs import program_command, start_program
from ..system.progress import Progress
from .folder import check_new
from .settings import ImportSettings

MARK = "bda-import "
"""What begins the program's own lines on its standard output."""

_LOOK_EVERY_S = 0.1
_MOST_SILENT_S = 1800.0
"""Time that the program may take for anything but an element: 2 GB of text are opened in less."""

_MOST_CRASHES = 50
_ENDS_WITHIN_S = 30.0


@dataclass(frozen=True, slots=True)
class Imported:
    """An import that was written: the bridge's name, the lines of its report, and numbers of elements by outcome."""

    title: str
    lines: tuple[str, ...]
    members: int
    connections: int
    left_out: int


@dataclass(frozen=True, slots=True)
class ListedElement:
    """An element of a file, before anything is built: its kind and material as they are taken, and why.

    The kind is empty where it is left out. `note` says what was assumed on the material, `bridge` which of several
    bridges it belongs to.
    """

    name: str
    ifc_class: str
    global_id: str
    kind: str
    why: str
    material: str
    note: str
    bridge: str


def list_elements(path: Path, settings: ImportSettings, progress: Progress | None = None) -> tuple[ListedElement, ...]:
    """Return the elements of a file, without working out their geometry."""
    progress = progress or Progress()
    progress.stage(f"reading {path.name}")
    attempt = _Attempt(_request(path, settings) | {"is_listing": True}, settings.time_limit_s)
    answer = attempt.answer(progress)
    _raise_refusal(path, answer)
    if "done" not in answer:
        raise IfcError(_crash_text(path, answer["crash"], 0))
    return tuple(ListedElement(**row) for row in answer["done"]["elements"])


def _request(path: Path, settings: ImportSettings) -> dict[str, Any]:
    return {"path": str(path.absolute()) if path.exists() else str(path), "settings": settings.as_json()}


def import_bridge(path: Path, folder: Path, settings: ImportSettings, progress: Progress | None = None) -> Imported:
    """Make a scenario of a bridge in an IFC file, in a new folder, whole or not at all."""
    check_new(folder)
    progress = progress or Progress()
    progress.stage(f"reading {path.name}")
    failed: dict[int, str] = {}
    with tempfile.TemporaryDirectory(prefix="bda-import-") as kept:
        while True:
            request = _request(path, settings) | {"is_listing": False, "folder": str(folder.absolute()), "kept": kept}
            attempt = _Attempt(request | {"failed": failed}, settings.time_limit_s)
            answer = attempt.answer(progress)
            if "done" in answer:
                done = answer["done"]
                counts = done["counts"]
                lines = tuple(done["lines"])
                return Imported(done["title"], lines, counts["member"], counts["connection"], counts["left out"])
            _raise_refusal(path, answer)
            if attempt.element is None or len(failed) >= _MOST_CRASHES:
                raise IfcError(_crash_text(path, answer["crash"], len(failed)))
            failed[attempt.element] = f"its geometry {answer['crash']}"


def _raise_refusal(path: Path, answer: dict[str, Any]) -> None:
    if "refused" in answer:
        kind = getattr(errors, answer["refused"], DemolitionError)
        raise (kind if issubclass(kind, DemolitionError) else errors.OutputError)(answer["text"])
    if "fault" in answer:
        raise IfcError(f"{path}: is not imported, by a fault of this add-on ({answer['fault']}): please report it")


def _crash_text(path: Path, crash: str, crashes: int) -> str:
    if crashes >= _MOST_CRASHES:
        return f"{path}: the geometry of more than {_MOST_CRASHES} elements crashes its reader; export it again"
    return f"{path}: {crash}; it is damaged, or holds what IfcOpenShell cannot read: export it again"


class _Attempt:
    """The program at work on a request; `element` is the number of the element that it works on, or None."""

    def __init__(self, request: dict[str, Any], limit_s: float) -> None:
        self.element: int | None = None
        self._limit_s = limit_s
        self._answers: queue.SimpleQueue[dict[str, Any] | None] = queue.SimpleQueue()
        self._last_words = tempfile.TemporaryFile()  # noqa: SIM115, open as long as the program
        command = program_command("ifc.import_program", with_libraries=True)
        self._process, requests, output = start_program(command, self._last_words)
        with suppress(OSError):  # it ended before it was asked; its status says so
            requests.write(json.dumps(request) + "\n")
            requests.close()
        threading.Thread(target=self._read, args=(output,), name="answers of an import", daemon=True).start()

    def answer(self, progress: Progress) -> dict[str, Any]:
        """Return the program's last answer, or ``crash`` with what happened to it."""
        try:
            return self._followed(progress)
        finally:
            self._process.kill()
            self._process.wait()
            self._last_words.close()

    def _followed(self, progress: Progress) -> dict[str, Any]:
        since, part = time.monotonic(), None
        while True:
            try:
                answer = self._answers.get(timeout=_LOOK_EVERY_S)
            except queue.Empty:
                limit_s = _MOST_SILENT_S if self.element is None else self._limit_s
                if time.monotonic() - since > limit_s:
                    return {"crash": f"took longer than {limit_s:g} s"}
                if part:
                    progress.part(*part)
                else:
                    progress.wait()
                continue
            since = time.monotonic()
            if answer is None:
                with suppress(subprocess.TimeoutExpired):
                    self._process.wait(_ENDS_WITHIN_S)
                return {"crash": f"crashed its reader ({status_text(self._process.poll())})"}
            if "element" in answer:
                self.element = answer["element"]
                part = answer["part"], answer["of"], f"elements: {answer['title']}"
                progress.part(*part)
            elif "stage" in answer:
                self.element, part = None, None
                if answer["stage"]:
                    progress.stage(answer["stage"])
            else:
                return answer

    def _read(self, output: IO[str]) -> None:
        with output as lines:
            for line in lines:
                if line.startswith(MARK):
                    self._answers.put(json.loads(line.removeprefix(MARK)))
        self._answers.put(None)
