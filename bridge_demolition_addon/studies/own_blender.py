"""The Blender that a program of runs has in its process."""

from __future__ import annotations

import os

from .run_service import RunService
from .versions import versions_with


def versions_here(service: RunService) -> dict[str, str]:
    """Load Blender and return all versions; say so and end the process where it is not there."""
    try:
        import bpy
    except ModuleNotFoundError as error:
        service.say({"error": f"Blender is not there: install the bpy package or run inside Blender ({error})"})
        os._exit(1)
    return versions_with(".".join(map(str, bpy.app.version)))
