"""Approaches: the road before and behind a bridge on its bank, with a lorry to compare with; for looks only.

A bank begins where no body of the run ever lies: it hides no debris.
"""

from __future__ import annotations

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..model.results.arrays import Results
from ..model.structure.finishes import ROAD_KINDS
from .dressing import DrawnPart, Stuff
from .shard_motion import boxes_of_bodies

LORRY_M = (8.0, 2.5, 3.5)
"""Length, width and height of the lorry."""

_LENGTH_M = 40.0
_SLOPE = 1.0
"""How far a bank reaches beside its road for each metre of its height."""

_CLEAR_M = 0.3
_FARTHEST = 1.5
"""How many times its own height a bank may begin away from the bridge; farther away it would belong to no road."""

_ROWS = 12
"""Frames that are looked at, at least, for where bodies come."""


def approaches(results: Results) -> list[DrawnPart]:
    """Return the banks at both ends of the decks, on flat ground; none where debris comes too far."""
    inventory, ground = results.inventory, results.ground()
    decks = np.flatnonzero(np.isin(inventory.body_member_kinds, ROAD_KINDS))
    if not len(decks) or not ground.is_flat:
        return []
    boxes = boxes_of_bodies(results, 0)[decks]
    lowest, highest = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    moving = np.flatnonzero(inventory.masses_kg > 0.0)
    first, last = lowest[0], highest[0]
    rows = np.unique(np.linspace(0, len(results.frames) - 1, max(_ROWS, len(results.frames) // 4)).astype(int))
    for row in rows.tolist():
        reached = boxes_of_bodies(results, row)[moving]
        first, last = min(first, reached[:, 0, 0].min()), max(last, reached[:, 1, 0].max())
    parts: list[DrawnPart] = []
    for at, away, gap in ((first, -1.0, lowest[0] - first), (last, 1.0, last - highest[0])):
        if gap <= _FARTHEST * highest[2] and highest[2] > 1.0:
            parts += _bank(float(at + away * _CLEAR_M), away, (float(lowest[1]), float(highest[1])), float(highest[2]))
            if away > 0.0:
                parts += _lorry(float(at) + 1.5, (lowest[1] + 3.0 * highest[1]) / 4.0, float(highest[2]))
    return parts


def _bank(begin: float, away: float, edges: tuple[float, float], top: float) -> list[DrawnPart]:
    """Return a bank from x = `begin` on, with a wall of concrete towards the bridge and a road on it."""
    right, left = edges
    reach = _SLOPE * top
    profile = np.array(((right - reach, 0.0), (left + reach, 0.0), (left + 0.6, top - 0.1), (right - 0.6, top - 0.1)))
    middle, width = begin + away * _LENGTH_M / 2.0, left - right
    wall = _prism(begin, begin + away * 0.5, np.array(((right, 0.0), (left, 0.0), (left, top), (right, top))))
    road = box((_LENGTH_M, width, 0.1), (middle, (right + left) / 2.0, top - 0.05))
    lines = [box((_LENGTH_M, 0.14, 0.008), (middle, y, top + 0.004)) for y in (right + 0.65, left - 0.65)]
    return [
        DrawnPart(Stuff.SOIL, _prism(begin + away * 0.1, begin + away * _LENGTH_M, profile)),
        DrawnPart(Stuff.CONCRETE, wall),
        DrawnPart(Stuff.ASPHALT, road),
        *(DrawnPart(Stuff.WHITE, line) for line in lines),
    ]


def _prism(begin: float, end: float, profile: np.ndarray) -> TriangleMesh:
    """Return a prism along x with a convex profile (4, 2) of y and z."""
    low, high = min(begin, end), max(begin, end)
    vertices = np.concatenate([np.column_stack((np.full(4, x), profile)) for x in (low, high)])
    sides = [(a, (a + 1) % 4 + 4, (a + 1) % 4) for a in range(4)] + [(a, a + 4, (a + 1) % 4 + 4) for a in range(4)]
    mesh = TriangleMesh(vertices, np.array([*sides, (0, 1, 2), (0, 2, 3), (4, 6, 5), (4, 7, 6)]))
    return mesh if mesh.volume > 0.0 else mesh.flipped()


def _lorry(begin: float, y: float, ground: float) -> list[DrawnPart]:
    """Return a lorry on the road, as long, wide and high as `LORRY_M`."""
    length, width, height = LORRY_M
    wheel, cab = 1.0, 2.0
    load = box(
        (length - cab - 0.2, width, height - wheel),
        (begin + (length + cab + 0.2) / 2.0, y, ground + (height + wheel) / 2.0),
    )
    front = box((cab, width, height - wheel - 0.3), (begin + cab / 2.0, y, ground + wheel / 2.0 + (height - 0.3) / 2.0))
    wheels = [
        box((0.9, 0.3, wheel), (begin + at, y + side * (width / 2.0 - 0.15), ground + wheel / 2.0))
        for at in (1.2, 5.6, 6.8)
        for side in (-1.0, 1.0)
    ]
    return [DrawnPart(Stuff.WHITE, load), DrawnPart(Stuff.RED, front), *(DrawnPart(Stuff.BLACK, one) for one in wheels)]
