"""Settings of an import: what the user adds to an IFC file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Self

from ..errors import IfcError

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254}
"""Metres in a unit of length."""

KINDS = (
    *("deck", "girder", "arch", "bracing", "pier cap", "pier", "abutment", "wing wall", "wall", "footing"),
    *("approach slab", "fill", "bearing", "parapet", "member"),
)
"""Kinds that elements become."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportSettings:
    """What the user adds to an IFC file.

    Attributes
    ----------
    materials
        Table of materials; the add-on's unless given.
    material
        Name in the table of the material of elements without one.
    unit
        Unit of length, one of `UNITS`, in place of the file's.
    ground_m
        Height of the ground in the file; the lowest underside's unless given.
    without
        Names, classes, kinds or GlobalIds of elements that are left out, with ``*`` for anything.
    materials_of
        Name, class or GlobalId of elements, with ``*`` for anything, and the name of their material in the table.
    kinds
        Name, class or GlobalId of elements, with ``*`` for anything, and their kind, one of `KINDS`.
    only
        Name or GlobalId of the bridge that is taken of a file with several, with ``*`` for anything; the one with the
        most members unless given.
    bearing_gap_m
        Gap up to which a bearing, or another member, is brought to what it lies on.
    strict
        Whether what is missing or damaged is refused; otherwise it is assumed, mended or left out, and said.
    time_limit_s
        How long the geometry of an element may take.
    bars
        Whether straight bars of steel become `[steelwork]`; otherwise they are cut into shards as all else. None for
        yes, but where this is strict, as bars need elastic connections, and supports that are assumed.
    """

    materials: Path | None = None
    material: str | None = None
    unit: str | None = None
    ground_m: float | None = None
    shards: int = 300
    without: tuple[str, ...] = ()
    kinds: tuple[tuple[str, str], ...] = ()
    materials_of: tuple[tuple[str, str], ...] = ()
    only: str | None = None
    bearing_gap_m: float = 0.015
    strict: bool = False
    time_limit_s: float = 60.0
    bars: bool | None = None

    def __post_init__(self) -> None:
        if self.unit is not None and self.unit not in UNITS:
            raise IfcError(f'unit is "{self.unit}": expected one of {", ".join(UNITS)}')
        for pattern, kind in self.kinds:
            if kind not in KINDS:
                raise IfcError(f'kind of "{pattern}" is "{kind}": expected one of {", ".join(KINDS)}')
        if self.strict and self.bars:
            raise IfcError("bars and strict are both asked for: expected one of them, as supports of bars are assumed")

    @property
    def takes_bars(self) -> bool:
        """Whether bars of steel become `[steelwork]`."""
        return not self.strict if self.bars is None else self.bars

    def as_json(self) -> dict[str, Any]:
        """Return the settings as JSON can hold them."""
        return asdict(self) | {"materials": str(self.materials) if self.materials else None}

    @classmethod
    def from_json(cls, values: Mapping[str, Any]) -> Self:
        """Return the settings that `as_json` has given."""
        plain = dict(values)
        plain["materials"] = Path(plain["materials"]) if plain["materials"] else None
        plain["without"] = tuple(plain["without"])
        for name in ("kinds", "materials_of"):
            plain[name] = tuple((pattern, value) for pattern, value in plain[name])
        return cls(**plain)


def matches(pattern: str, names: tuple[str, ...]) -> bool:
    """Return whether a pattern is or matches one of the names, whatever the case; ``*`` stands for anything."""
    plain = [name.casefold() for name in names]
    return pattern.casefold() in plain or any(fnmatchcase(name, pattern.casefold()) for name in plain)
