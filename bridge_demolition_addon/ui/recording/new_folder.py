"""Where the results of a run go for which no folder was chosen: a new one beside the file, named and counted up."""

from __future__ import annotations

import os
import re
from pathlib import Path

import bpy

_OF_ALL_RUNS = "Bridge Demolition"
"""Folder in the user's documents, for files that have no place of their own yet."""

_LONGEST_NAME = 60


def new_folder(title: str) -> Path:
    """Return a folder for a run that is not there yet: named after its scenario, with the next free number.

    It is beside the saved file, or in the user's documents where the file has not been saved.
    """
    saved = bpy.data.filepath
    parent = Path(saved).parent if saved else documents_folder() / _OF_ALL_RUNS
    name = re.sub(r"[^\w.-]+", "_", title)[:_LONGEST_NAME].strip("._") or "demolition"
    numbers = [0]
    if parent.is_dir():
        numbers += [int(found[1]) for path in parent.iterdir() if (found := _numbered(name, path.name))]
    return parent / f"{name}_{max(numbers) + 1}"


def documents_folder() -> Path:
    """Return the user's folder for documents, as the desktop names it; their home where there is none."""
    home = Path.home()
    desktop = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config") / "user-dirs.dirs"
    named = desktop.read_text(encoding="utf-8") if desktop.is_file() else ""
    found = re.search(r'^XDG_DOCUMENTS_DIR="(.+)"', named, re.MULTILINE)
    documents = Path(found[1].replace("$HOME", str(home))) if found else home / "Documents"
    return documents if documents.is_dir() else home


def _numbered(name: str, other: str) -> re.Match[str] | None:
    return re.fullmatch(re.escape(name) + r"_(\d+)", other, re.IGNORECASE)
