"""What the user says of an IFC file besides what is in it."""

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
    """What the user says of an IFC file besides what is in it.

    Attributes
    ----------
    materials : Path, optional
        Table of materials; that of the add-on unless given.
    material : str, optional
        Name of the material, as the table knows it, of elements without one.
    unit : str, optional
        Unit of length, one of `UNITS`, in place of that of the file.
    ground_m : float, optional
        Height of the ground in the file, m; that of the lowest underside unless given.
    shards : int
        Into how many shards the bridge is cut.
    without : tuple of str
        Names, classes, kinds or GlobalIds of elements that are left out, with ``*`` for anything.
    kinds : tuple of (str, str)
        Name, class or GlobalId of elements, with ``*`` for anything, and the kind that they are, one of `KINDS`.
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
    """Return whether one of the names is meant, whatever its capital letters; ``*`` stands for anything."""
    return any(fnmatchcase(name.casefold(), pattern.casefold()) for name in names)
