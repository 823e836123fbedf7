# SPDX-License-Identifier: GPL-3.0-or-later
"""What the extension leaves in Blender and on disk, for a job to check."""

import csv
from collections import Counter
from pathlib import Path

import bpy

EXTENSION = "bl_ext.user_default.bridge_demolition_addon"
SCENARIO = Path(__file__).resolve().parent / "small.toml"


def handlers(module: str = "simulation.handlers") -> Counter[str]:
    """How often each handler of a module of the extension is registered, by default those of a recording."""
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return Counter(
        f"{name}: {handler.__qualname__}"
        for name, functions in lists.items()
        if isinstance(functions, list)
        for handler in functions
        if handler.__module__.startswith(f"{EXTENSION}.{module}")
    )


def everything() -> dict[str, list[str]]:
    """Names of all that a file holds and a demolition is made of."""
    kinds = ("scenes", "objects", "meshes", "materials", "collections", "actions")
    return {kind: [each.name for each in getattr(bpy.data, kind)] for kind in kinds}


def rows(log: Path) -> list[dict[str, str]]:
    """A log's lines by the names of its columns.

    Raises
    ------
    ValueError
        A line is not whole.
    """
    text = log.read_text(encoding="utf-8")
    lines = list(csv.reader(text.splitlines()))
    if not text.endswith("\n") or any(len(line) != len(lines[0]) for line in lines):
        raise ValueError(f"{log.name} has a line that is not whole")
    return [dict(zip(lines[0], line, strict=True)) for line in lines[1:]]
