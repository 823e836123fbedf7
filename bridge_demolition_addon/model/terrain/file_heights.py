"""Heights as a file has them: in its own coordinates, with the unit that it says, and what was left out."""

from __future__ import annotations

from dataclasses import dataclass

from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface


@dataclass(frozen=True, eq=False, slots=True)
class FileHeights:
    """Heights of a file.

    Attributes
    ----------
    unit_m
        Metres in its unit, where the file says it; 1 otherwise.
    unit
        What the file calls it; empty where it says none.
    notes
        What was left out of it.
    """

    source: Raster | Surface
    unit_m: float = 1.0
    unit: str = ""
    notes: tuple[str, ...] = ()
