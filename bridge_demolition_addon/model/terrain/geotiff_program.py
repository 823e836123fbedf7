"""The program that reads a GeoTIFF: see `geotiff`, which starts it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ...system.isolated import answer
from .geotiff import heights_in


def main() -> None:
    """Answer the request: read heights, and leave them in a file."""
    answer(_read)


def _read(request: dict[str, Any]) -> dict[str, Any]:
    raster, unit_m = heights_in(
        Path(request["path"]), request["no_data"], request["scale"], int(request["most_heights"])
    )
    np.savez(request["kept"], first=raster.first, steps=raster.steps, heights=raster.heights)
    return {"unit_m": unit_m}
