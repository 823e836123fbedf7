"""Formats that only Blender writes: in a process of its own, so that its end is not ours, and that it can be stopped.

The program reads a request from its standard input, one line of JSON, and answers on its standard output with lines of
JSON behind `MARK`; other lines there are Blender's own.
"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import IO, Any

from ..errors import MissingLibraryError, SimulationError
from ..system.programs import program_command, start_program
from ..system.progress import Progress
from .formats import Format

MARK = "bda-export "
"""What begins the program's own lines on its standard output."""

_LAST_WORDS = 400


def write_in_blender(form: Format, folder: Path, path: Path, progress: Progress, blender: str = "") -> None:
    """Have Blender write a run: the program `blender`, or by default Blender as a module of this Python."""
    progress.stage(f"writing {form.name} with Blender")
    with tempfile.TemporaryFile() as last_words:
        process, requests, answers = start_program(program_command("exports.blender_program", blender), last_words)
        try:
            request = {"format": form.name, "folder": str(folder.resolve()), "path": str(path.resolve())}
            requests.write(json.dumps(request) + "\n")
            requests.close()
            is_done = _follow(answers, progress)
        except BrokenPipeError:  # it ended before it was asked
            is_done = False
        finally:
            process.kill()
            status = process.wait()
            answers.close()
        if not is_done:
            last_words.seek(0)
            lines = last_words.read().decode("utf-8", "replace").strip().splitlines()
            reason = lines[-1][-_LAST_WORDS:] if lines else "it gave no reason"
            raise SimulationError(f"Blender ended with status {status} before {form.name} was written: {reason}")


def _follow(answers: IO[str], progress: Progress) -> bool:
    """Show how far the program is, and return whether it has written all."""
    for line in answers:
        if not line.startswith(MARK):
            continue
        answer: dict[str, Any] = json.loads(line.removeprefix(MARK))
        if "missing" in answer:
            raise MissingLibraryError(answer["missing"])
        if answer.get("is_done"):
            return True
        progress.part(answer["done"], answer["total"], answer["text"])
    return False
