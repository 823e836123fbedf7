"""The program that reads a binary mesh: see `mesh_reading`, which starts it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..system.isolated import answer
from .mesh_reading import loaded


def main() -> None:
    """Answer the request: read a mesh, and leave its vertices and triangles in a file."""
    answer(_read)


def _read(request: dict[str, Any]) -> dict[str, Any]:
    vertices, triangles = loaded(Path(request["path"]), is_cloud=request["is_cloud"], part=request["part"])
    np.savez(request["kept"], vertices=vertices, triangles=triangles)
    return {"vertices": len(vertices)}
