"""The program that has Blender write a run: see `blender_process`, which starts it."""

from __future__ import annotations

import json
import os
import sys
import traceback
from pathlib import Path
from typing import Any, NoReturn

from ..errors import MissingLibraryError
from ..model.results.arrays import load_results
from .blender_process import MARK
from .formats import USD


def main() -> NoReturn:
    """Do what the request says, and end the process, whatever state Blender is in."""
    status = 0
    try:
        _write(json.loads(sys.stdin.readline()))
        _say({"is_done": True})
    except MissingLibraryError as error:
        _say({"missing": str(error)})
    except BaseException:
        traceback.print_exc()
        status = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def _write(request: dict[str, Any]) -> None:
    try:
        import bpy
    except ModuleNotFoundError as error:
        raise MissingLibraryError(
            f"Blender, which writes {request['format']}, is not there: install the bpy package ({error})"
        ) from error
    results, path = load_results(Path(request["folder"])), Path(request["path"])
    if request["format"] == USD.name:
        from .usd import write_usd

        if hasattr(bpy.utils, "expose_bundled_modules"):  # since Blender 4.4; before, they could be imported anyway
            bpy.utils.expose_bundled_modules()
        write_usd(results, path, _tell)
    else:
        from .alembic import write_alembic

        write_alembic(results, path, _tell)


def _tell(done: int, total: int, text: str) -> None:
    _say({"done": done, "total": total, "text": text})


def _say(answer: dict[str, Any]) -> None:
    print(f"\n{MARK}{json.dumps(answer)}", flush=True)
