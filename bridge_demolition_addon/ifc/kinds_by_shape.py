"""Kinds of elements by their shape, where neither class nor name says what anything is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from .elements import Element
from .kinds import OTHER, LeftOut
from .several_bridges import CARRYING
from .shapes import KeptShapes, shapes_of
from .source import IfcSource

_FLAT, _LONG, _HIGH = 0.5, 4.0, 1.2
"""Height by the smaller size in plan up to which a body is flat, length by width from which on it is long, and height
by the larger size in plan from which on it is high."""

_WALL = 4.0
"""Length by height up to which what is higher than thick is a wall; a girder is longer."""

_LARGE = 0.3
"""Plan by the largest one from which on a flat body is a deck."""


def with_kinds_by_shape(
    source: IfcSource, elements: Sequence[Element], kept: KeptShapes
) -> tuple[tuple[Element, ...], tuple[str, ...]]:
    """Return elements of which those that nothing is known of have kinds by their shape, and a note on them.

    This is done where nothing else carries the road.
    """
    unknown = [element for element in elements if element.kind == LeftOut(OTHER)]
    if not unknown or any(element.kind in CARRYING for element in elements):
        return tuple(elements), ()
    kinds = kinds_of_shapes(shapes_of(source, unknown, kept))
    if not kinds:
        return tuple(elements), ()
    counts = {kind: list(kinds.values()).count(kind) for kind in dict.fromkeys(kinds.values())}
    texts = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    note = f"nothing says what {len(kinds)} elements are: by their shapes they are {texts}; --kind says it better"
    known = (replace(one, kind=kinds.get(one.entity.id(), one.kind)) for one in elements)
    return tuple(known), (note,)


def kinds_of_shapes(shapes: Mapping[int, TriangleMesh]) -> dict[int, str]:
    """Return the kind of each shape, by its number."""
    sizes = {number: np.ptp(mesh.vertices, axis=0) for number, mesh in shapes.items()}
    if not sizes:
        return {}
    largest_m2 = max(float(size[0] * size[1]) for size in sizes.values())
    heights = {number: float(mesh.bounds[:, 2].mean()) for number, mesh in shapes.items()}
    middle = (min(heights.values()) + max(heights.values())) / 2.0
    return {number: _kind(size, largest_m2, is_low=heights[number] < middle) for number, size in sizes.items()}


def _kind(size: np.ndarray, largest_m2: float, *, is_low: bool) -> str:
    width, length = np.sort(size[:2]).tolist()
    height = float(size[2])
    if height <= _FLAT * width and width * length >= _LARGE * largest_m2:
        return "deck"
    if height > _HIGH * length:
        return "pier"
    if height > _HIGH * width and length < _WALL * height:
        return "wall"
    if is_low:
        return "footing" if height <= width else "wall"
    return "girder" if length >= _LONG * width else "pier cap"
