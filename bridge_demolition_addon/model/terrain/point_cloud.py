"""Point clouds in LAS and LAZ: a process of its own unpacks them, as the codecs are not Python."""

from __future__ import annotations

import tempfile
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from ...errors import GeometryError, MissingLibraryError
from ...system.isolated import isolated
from ...system.reading import MEGABYTE, check_file

CLOUD_FILES = (".las", ".laz")

MOST_BYTES = 4000 * MEGABYTE
MOST_POINTS = 200_000_000

_LIMIT_S = 600.0
_MOST_MEMORY = 16 * 10**9
"""Bytes of as many points, with all that a file says of each."""

_HOW = "point clouds in LAS are read by laspy: install it with pip install 'bridge-demolition-addon[scans]'"


def read_cloud(path: Path, most_points: int = MOST_POINTS) -> tuple[np.ndarray, np.ndarray]:
    """Return the points (n, 3) of a cloud, in its own coordinates, and their classes (n,); 2 is ground.

    The classes are those of the ASPRS, *LAS specification 1.4*, table 17. Raise `UnreadableError` where the file cannot
    be read.
    """
    check_file(path, MOST_BYTES)
    if find_spec("laspy") is None:
        raise MissingLibraryError(_HOW)
    with tempfile.TemporaryDirectory(prefix="bda-cloud-") as folder:
        kept = Path(folder) / "points.npz"
        request = {"path": str(path.absolute()), "kept": str(kept), "most_points": most_points}
        isolated("model.terrain.cloud_program", request, _LIMIT_S, _MOST_MEMORY)
        with np.load(kept) as arrays:
            points, classes = arrays["points"], arrays["classes"]
    if not len(points):
        raise GeometryError("holds no points")
    return points, classes
