"""Markings, kerbs and railings on decks, in short pieces that go with the shards they stand on; for looks only."""

from __future__ import annotations

import numpy as np

from ..engineering.geometry.solids import box
from ..model.results.arrays import Results
from ..model.structure.finishes import ROAD_KINDS
from .dressing import DrawnPart, Stuff
from .moved_surfaces import boxes_of_bodies

PIECE_M = 0.5
"""Length of a piece along the road."""

_POST_EVERY = 3
_DASH, _DASH_AND_GAP = 6, 12
"""Pieces of a dash, and of a dash and a gap: 3 m of each."""

_KERB_M, _KERB_HEIGHT_M = 0.35, 0.14
_RAILING_M, _RAIL_M, _POST_M = 1.0, 0.07, 0.08
_LINE_M, _PAINT_M = 0.14, 0.008
_NARROWEST_M = 4.0
"""Narrowest deck with a line in its middle."""

NARROWEST_ROAD_M = 2.5
"""Narrowest deck that carries a road: others are single beams."""


def road_furniture(results: Results) -> list[DrawnPart]:
    """Return markings, kerbs and railings of the decks of a run; none where there is no deck along x.

    A piece stands on the top of the outermost shard of its station, at the shard's own edge.
    """
    inventory = results.inventory
    decks = np.flatnonzero(np.isin(inventory.body_member_kinds, ROAD_KINDS))
    if not len(decks):
        return []
    boxes = boxes_of_bodies(results, 0)[decks]
    lowest, highest = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    if highest[0] - lowest[0] < highest[1] - lowest[1] or highest[1] - lowest[1] < NARROWEST_ROAD_M:
        return []
    top = boxes[:, 1, 2]
    centres = results.frames.positions_m[0, decks]
    parts: list[DrawnPart] = []
    stations = np.arange(lowest[0] + PIECE_M / 2.0, highest[0] - PIECE_M / 2.0 + 1e-9, PIECE_M)
    for number, x in enumerate(stations.tolist()):
        here = (boxes[:, 0, 0] <= x) & (boxes[:, 1, 0] >= x)
        if not here.any():
            continue
        here &= top > top[here].max() - 0.05
        rows = np.flatnonzero(here)
        right, left = rows[np.argmin(boxes[rows, 0, 1])], rows[np.argmax(boxes[rows, 1, 1])]
        edges = float(boxes[right, 0, 1]), float(boxes[left, 1, 1])
        for row, y, inwards in ((right, edges[0], 1.0), (left, edges[1], -1.0)):
            parts += _edge(int(decks[row]), x, y, inwards, float(top[row]), number % _POST_EVERY == 0)
        lines = [(edge + inwards * (_KERB_M + 0.3)) for edge, inwards in zip(edges, (1.0, -1.0), strict=True)]
        if edges[1] - edges[0] >= _NARROWEST_M and number % _DASH_AND_GAP < _DASH:
            lines.append(sum(edges) / 2.0)
        for y in lines:
            row = rows[np.argmin(((centres[rows, :2] - (x, y)) ** 2).sum(axis=1))]
            size = (PIECE_M, _LINE_M, _PAINT_M)
            parts.append(DrawnPart(Stuff.WHITE, box(size, (x, y, float(top[row]) + _PAINT_M / 2.0)), int(decks[row])))
    return parts


def _edge(body: int, x: float, y: float, inwards: float, top: float, has_post: bool) -> list[DrawnPart]:
    """Return kerb, rails and every now and then a post of a station at an edge of a deck."""
    middle = y + inwards * _KERB_M / 2.0
    kerb = box((PIECE_M, _KERB_M, _KERB_HEIGHT_M), (x, middle, top + _KERB_HEIGHT_M / 2.0))
    parts = [DrawnPart(Stuff.CONCRETE, kerb, body)]
    for share in (0.55, 1.0):
        height = top + _KERB_HEIGHT_M + share * _RAILING_M
        parts.append(DrawnPart(Stuff.STEEL, box((PIECE_M, _RAIL_M, _RAIL_M), (x, middle, height)), body))
    if has_post:
        centre = (x, middle, top + _KERB_HEIGHT_M + _RAILING_M / 2.0)
        parts.append(DrawnPart(Stuff.STEEL, box((_POST_M, _POST_M, _RAILING_M), centre), body))
    return parts
