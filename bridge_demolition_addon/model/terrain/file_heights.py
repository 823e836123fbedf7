"""Heights as a file has them: in its own coordinates, with the unit that it says, and what was left out."""

from __future__ import annotations

from dataclasses import dataclass

from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError

_FEW_LOST, _LOST_SHARE = 3, 0.01
"""Triangles without their points that a surface may have: so many, or such a part of all."""


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


def note_on_lost(lost: int, total: int, first: str) -> tuple[str, ...]:
    """Return a note on triangles that name points that are not there; a `GeometryError` where they are not few."""
    if lost and lost == total:
        raise GeometryError("its surface has no triangles: all of them name points that are not there")
    if lost > max(_FEW_LOST, _LOST_SHARE * total):
        raise GeometryError(
            f"its surface is damaged: {lost} of {total} triangles name points that are not there, first {first}; "
            "export it again"
        )
    return (f"{lost} of {total} triangles name points that are not there: left out",) if lost else ()
