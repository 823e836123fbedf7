"""Kinds of elements by their shape, where neither class nor name says what anything is."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence, Set
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

_SUPPORTS = ("pier", "pier cap", "wall", "footing")

_GAP_M, _LEAST_HEIGHT_M = 0.1, 0.3
"""Between a girder and its deck, and height of a girder at least."""

_LARGE = 0.3
"""Plan by the largest one from which on a flat body is a deck."""


def with_kinds_by_shape(
    source: IfcSource, elements: Sequence[Element], kept: KeptShapes
) -> tuple[tuple[Element, ...], tuple[str, ...]]:
    """Give elements of unknown kind a kind by their shape; return the elements and a note on them.

    This is done where nothing else carries the road, and below a deck for what it lacks: girders, or all supports.
    """
    unknown = [element for element in elements if element.kind == LeftOut(OTHER)]
    known_kinds = {element.kind for element in elements if element.is_member}
    lacking = _lacking(known_kinds)
    if not unknown or not lacking:
        return tuple(elements), ()
    shapes = shapes_of(source, unknown, kept)
    if "deck" in known_kinds:
        decks = shapes_of(source, [element for element in elements if element.kind == "deck"], kept)
        below = kinds_below(list(decks.values()), shapes)
        kinds = {number: kind for number, kind in below.items() if kind in lacking}
    else:
        kinds = kinds_of_shapes(shapes)
    if not kinds:
        return tuple(elements), ()
    counts = {kind: list(kinds.values()).count(kind) for kind in dict.fromkeys(kinds.values())}
    texts = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    note = f"nothing says what {len(kinds)} elements are: by their shapes they are {texts}; --kind says it better"
    known = (replace(one, kind=kinds.get(one.entity.id(), one.kind)) for one in elements)
    return tuple(known), (note,)


def _lacking(kinds: Set[object]) -> Set[str]:
    """Return the kinds that a bridge with members of some kinds lacks; none where it has a girder or an arch."""
    if not kinds & set(CARRYING):
        return {"deck", "girder", *_SUPPORTS}
    if kinds & {"girder", "arch"}:
        return set()
    return {"girder"} if kinds & {"abutment", *_SUPPORTS} else {"girder", *_SUPPORTS}


def kinds_below(decks: Sequence[TriangleMesh], shapes: Mapping[int, TriangleMesh]) -> dict[int, str]:
    """Return the kind of each shape below one of the decks, by its number; pipes are thin, or hang lower."""
    found = {}
    lowest_m = min((float(mesh.bounds[0, 2]) for mesh in shapes.values()), default=0.0)
    for number, mesh in shapes.items():
        (low, high), middle = mesh.bounds, mesh.bounds.mean(axis=0)
        for deck_low, deck_high in (deck.bounds for deck in decks):
            is_within = bool(np.all((deck_low[:2] <= middle[:2]) & (middle[:2] <= deck_high[:2])))
            if is_within and low[2] < deck_low[2] and high[2] < deck_high[2] and high[2] - low[2] >= _LEAST_HEIGHT_M:
                is_low = high[2] < deck_low[2] - _GAP_M and middle[2] < (lowest_m + deck_low[2]) / 2.0
                found[number] = _kind(high - low, math.inf, is_low=bool(is_low))
                break
    return found


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
