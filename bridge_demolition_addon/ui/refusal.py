"""How the buttons refuse, and what they say of paths."""

from pathlib import Path

import bpy

from ..core.errors import OutputError


def refused(operator: bpy.types.Operator, error: Exception) -> set[str]:
    """End an operator with a message."""
    operator.report({"ERROR"}, str(error))
    return {"CANCELLED"}


def absolute(path: str) -> Path:
    """A path as the user gave it, where ``//`` is the folder of the saved file.

    Raises
    ------
    OutputError
        The path is relative to a file that has not been saved yet.
    """
    if path.startswith("//") and not bpy.data.filepath:
        raise OutputError(f"{path}: is relative to this file, which has no place yet; save it or give a full path")
    return Path(bpy.path.abspath(path))
