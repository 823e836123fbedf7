"""Approaches: the road before and behind a bridge on its bank, with figures to compare with; for looks only.

A bank begins where no body of the run ever lies: it hides no debris.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh
from ..model.results.arrays import Results
from ..model.results.motion import without_removed
from ..model.structure.finishes import ROAD_KINDS
from .banks import Bank, bank
from .dressing import DrawnPart
from .road_furniture import NARROWEST_ROAD_M
from .scale_figures import LORRY_M, lorry, person
from .shard_motion import boxes_of_bodies

_CLEAR_M = 0.3
_FARTHEST = 1.5
"""How many times its own height a bank may begin away from the bridge; farther away it would belong to no road."""

_LOWEST_M = 1.0
"""Least height of a deck over the ground that has banks."""

_AT_END_M = 1.0
"""Shards of a deck that are so near to its end say how wide and high the road is there."""

_LORRY_AFTER_M, _PERSON_AFTER_M = 2.0, 1.2
"""How far behind the beginning of a bank they stand."""

_LORRY_LENGTHS = 1.5
"""Least length of a bridge for a lorry beside it, in lengths of the lorry."""

_ROWS = 12
"""Frames that are looked at, at least, for where bodies come."""


def approaches(results: Results) -> list[DrawnPart]:
    """Return the banks at both ends of decks along x, with lorry and person; none where debris comes too far."""
    decks = np.flatnonzero(np.isin(results.inventory.body_member_kinds, ROAD_KINDS))
    if not len(decks):
        return []
    boxes, ground = boxes_of_bodies(results, 0)[decks], results.ground()
    lowest, highest = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    if highest[0] - lowest[0] < highest[1] - lowest[1] or highest[1] - lowest[1] < NARROWEST_ROAD_M:
        return []
    parts: list[DrawnPart] = []
    for end, (reached, away) in enumerate(zip(_reached(results), (-1.0, 1.0), strict=True)):
        at = float((lowest, highest)[end][0])
        (right, left), top = _road_at_end(boxes, at)
        over_ground = top - float(ground.heights_at(np.array((reached, (right + left) / 2.0))))
        if away * (reached - at) > _FARTHEST * over_ground or over_ground <= _LOWEST_M:
            continue
        begun = bank(reached + away * _CLEAR_M, away, (right, left), top, ground)
        if begun:
            parts += begun.parts()
            if away > 0.0:
                parts += _figures(begun, has_lorry=float(highest[0] - lowest[0]) >= _LORRY_LENGTHS * LORRY_M[0])
    return parts


def _reached(results: Results) -> tuple[float, float]:
    """Return the lowest and highest x of any body that moves and is not removed, m, at any time."""
    moving = np.flatnonzero(without_removed(results)[0].inventory.masses_kg > 0.0)
    count = len(results.frames)
    rows = np.unique(np.linspace(0, count - 1, max(_ROWS, count // 4)).astype(int))
    boxes = np.stack([boxes_of_bodies(results, row)[moving] for row in rows.tolist()])
    return float(boxes[:, :, 0, 0].min()), float(boxes[:, :, 1, 0].max())


def _road_at_end(boxes: FloatArray, at: float) -> tuple[tuple[float, float], float]:
    """Return the right and left side and the height of the road at an end of decks with boxes (n, 2, 3), m."""
    there = boxes[(boxes[:, 0, 0] <= at + _AT_END_M) & (boxes[:, 1, 0] >= at - _AT_END_M)]
    top = float(there[:, 1, 2].max())
    upper = there[there[:, 1, 2] > top - 0.05]
    return (float(upper[:, 0, 1].min()), float(upper[:, 1, 1].max())), top


def _figures(begun: Bank, *, has_lorry: bool) -> list[DrawnPart]:
    """Return a person at the near side of a bank's road, and a lorry on its far side."""
    (right, left), begin = begun.edges_m, float(begun.stations_m[0])
    parts = person(begin + _PERSON_AFTER_M, right + 0.15 * (left - right))
    if has_lorry and begun.length_m > _LORRY_AFTER_M + LORRY_M[0]:
        parts += lorry(begin + _LORRY_AFTER_M, (right + 3.0 * left) / 4.0)
    return [replace(part, solid=_raised(part.solid, begun)) for part in parts]


def _raised(solid: TriangleMesh, begun: Bank) -> TriangleMesh:
    """Return a solid on a bank's road, which it follows where that climbs."""
    heights = begun.height_at(solid.vertices[:, 0])
    return TriangleMesh(solid.vertices + np.column_stack((np.zeros((len(heights), 2)), heights)), solid.triangles)
