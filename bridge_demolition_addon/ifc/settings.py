"""Settings of an import: what the user adds to an IFC file."""

from __future__ import annotations

from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from ..errors import IfcError

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254}
"""Metres in a unit of length."""

KINDS = (
    *("deck", "girder", "bracing", "pier cap", "pier", "abutment", "wall", "footing"),
    *("bearing", "parapet", "member"),
)
"""Kinds that elements become."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportSettings:
    """What the user adds to an IFC file.

    Attributes
    ----------
    materials
        Table of materials; that of the add-on unless given.
    material
        Name in the table of the material of elements without one.
    unit
        Unit of length, one of `UNITS`, in place of that of the file.
    ground_m
        Height of the ground in the file; that of the lowest underside unless given.
    without
        Names, classes, kinds or GlobalIds of elements that are left out, with ``*`` for anything.
    kinds
        Name, class or GlobalId of elements, with ``*`` for anything, and their kind, one of `KINDS`.
    """

    materials: Path | None = None
    material: str | None = None
    unit: str | None = None
    ground_m: float | None = None
    shards: int = 300
    without: tuple[str, ...] = ()
    kinds: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        if self.unit is not None and self.unit not in UNITS:
            raise IfcError(f'unit is "{self.unit}": expected one of {", ".join(UNITS)}')
        for pattern, kind in self.kinds:
            if kind not in KINDS:
                raise IfcError(f'kind of "{pattern}" is "{kind}": expected one of {", ".join(KINDS)}')


def matches(pattern: str, names: tuple[str, ...]) -> bool:
    """Return whether a pattern matches one of the names, whatever the case; ``*`` stands for anything."""
    return any(fnmatchcase(name.casefold(), pattern.casefold()) for name in names)
