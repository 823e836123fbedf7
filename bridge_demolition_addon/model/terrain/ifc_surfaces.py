"""Surfaces of the ground in IFC files, which a process of its own reads."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ...system.isolated import isolated
from ...system.reading import MEGABYTE, check_file
from .file_heights import FileHeights

IFC_FILES = (".ifc",)

_MOST_BYTES = 2000 * MEGABYTE
_LIMIT_S = 600.0


def read_ifc_surface(path: Path, name: str | None) -> FileHeights:
    """Return the ground of a file, in metres: of all elements that are ground, or of those of a name.

    Where the file has a map conversion, it is in the map's coordinates.
    """
    check_file(path, _MOST_BYTES)
    with tempfile.TemporaryDirectory(prefix="bda-ground-") as folder:
        kept = Path(folder) / "ground.npz"
        # By its name: what reads IFC stands higher than the model.
        said = isolated("ifc.ground_program", {"path": str(path.absolute()), "name": name, "kept": str(kept)}, _LIMIT_S)
        if not said["surfaces"]:
            named = ", ".join(map(repr, said["others"][:5])) or "nothing with a surface"
            wanted = f"that is called {name!r}" if name else "that is ground"
            raise GeometryError(f"has no surface {wanted}: it has {named}; say which by ground.surface")
        with np.load(kept) as arrays:
            mesh = TriangleMesh(arrays["vertices"], arrays["triangles"])
    return FileHeights(Surface(mesh), notes=tuple(said["notes"]))
