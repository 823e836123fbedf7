"""A unit of length that the file cannot mean: with it no deck or girder would have the length of a bridge's."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..errors import IfcError
from .elements import Element
from .settings import UNITS, ImportSettings
from .several_bridges import CARRYING
from .source import IfcSource

_SHORTEST_M, _LONGEST_M = 1.0, 3000.0
"""Lengths between which the longest part of a deck or girder is."""


def with_likely_unit(
    source: IfcSource, elements: Sequence[Element], shapes: Mapping[int, TriangleMesh], settings: ImportSettings
) -> tuple[IfcSource, Mapping[int, TriangleMesh]]:
    """Return a file and the shapes of its elements, with another unit and a note where its own is a thousand times off.

    What the user says of the unit counts.
    """
    carrying = [shapes[number] for one in elements if one.kind in CARRYING and (number := one.entity.id()) in shapes]
    longest_m = max((float(np.ptp(mesh.bounds, axis=0).max()) for mesh in carrying), default=_SHORTEST_M)
    if settings.unit is not None or settings.strict or _SHORTEST_M <= longest_m <= _LONGEST_M:
        return source, shapes
    said = f"the longest part that carries the road is {longest_m:.3g} m long by the unit of the file"
    factors = {name: UNITS[name] / source.unit_m for name in ("m", "mm")}
    likely = [name for name, factor in factors.items() if _SHORTEST_M <= longest_m * factor <= _LONGEST_M]
    if not likely:
        raise IfcError(f"{source.path}: {said}; say which unit it is, one of {', '.join(UNITS)}, by --unit")
    factor = factors[likely[0]]
    notes = (*source.notes, f"{said}, {source.unit_m:g} m: taken for {likely[0]}; --unit says it better")
    changed = replace(source, scale=source.scale * factor, unit_m=UNITS[likely[0]], notes=notes)
    return changed, {number: replace(mesh, vertices=mesh.vertices * factor) for number, mesh in shapes.items()}
