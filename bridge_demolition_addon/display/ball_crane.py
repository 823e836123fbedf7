"""The crane that a ball hangs from, with its rope, drawn beside the bridge; for looks only."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..engineering.geometry.solids import box
from ..engineering.terrain.recorded import RecordedGround
from ..model.results.arrays import Results
from .dressing import DrawnPart, Stuff, rod

_ABOVE_M, _BEYOND_M = 4.0, 16.0
"""How far its tip is above the highest place of the ball, and how far it stands from it."""

_BOOM_M, _LATTICE = 0.9, 12
_ROPE_M = 0.07
_PLATFORM_M = (9.0, 9.0)
"""Length and width of the level soil that it stands on where the ground is not level."""


def ball_cranes(results: Results, row: int) -> list[DrawnPart]:
    """Return a crane for every ball of a run in a row of its frames, with its rope to the ball.

    Its tip is above where the ball was when it was last at its highest, or where the ball's own crane stands.
    """
    inventory, frames, ground = results.inventory, results.frames, results.ground()
    own = inventory.of_kind("crane")
    parts: list[DrawnPart] = []
    for number, ball in enumerate(inventory.of_kind("ball").tolist()):
        path = frames.positions_m[: row + 1, ball]
        if number < len(own):
            tip = np.array(frames.positions_m[row, own[number]], float)
        else:
            highest = frames.positions_m[:, ball, 2].max()
            at_top = np.flatnonzero(path[:, 2] >= path[:, 2].max() - 0.5)[-1]
            tip = np.array((*path[at_top, :2], highest + _ABOVE_M), float)
        parts += [DrawnPart(Stuff.BLACK, rod(tip, path[-1], _ROPE_M)), *_crane(tip, ground)]
    return parts


def _crane(tip: np.ndarray, ground: RecordedGround) -> list[DrawnPart]:
    """Return a crawler crane on the far side of the road, whose lattice boom ends at a point (3,), m."""
    x, y = float(tip[0]) + 4.0, float(tip[1]) + _BEYOND_M
    z, platform = _platform(x, y, ground)
    foot = np.array((x, y, z))
    heel = foot + np.array((0.0, -1.5, 2.0))
    across = np.array((0.0, 0.0, _BOOM_M)), np.array((_BOOM_M, 0.0, 0.0))
    corners = [(a * across[0] + b * across[1]) / 2.0 for a, b in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    shares = np.linspace(0.0, 1.0, _LATTICE + 1)
    rods = []
    for number, corner in enumerate(corners):
        following = corners[(number + 1) % 4]
        rods.append(rod(heel + corner, tip + 0.2 * corner, 0.12))
        for begin, end in pairwise(shares.tolist()):
            ends = [
                heel + share * (tip - heel) + (1.0 - 0.8 * share) * place
                for share, place in ((begin, corner), (end, following))
            ]
            rods.append(rod(ends[0], ends[1], 0.06))
    tracks = [box((6.0, 1.0, 1.1), (x, y + side * 2.2, z + 0.55)) for side in (-1.0, 1.0)]
    house = box((5.0, 3.2, 2.2), (x + 0.5, y, z + 2.3))
    return [
        *(DrawnPart(Stuff.RED, one) for one in rods),
        *(DrawnPart(Stuff.BLACK, track) for track in tracks),
        DrawnPart(Stuff.YELLOW, house),
        *platform,
    ]


def _platform(x: float, y: float, ground: RecordedGround) -> tuple[float, list[DrawnPart]]:
    """Return how high the ground is that a crane stands on, and a level platform where it is not level."""
    length, width = _PLATFORM_M
    corners = np.array([(x + a * length / 2.0, y + b * width / 2.0) for a in (-1, 0, 1) for b in (-1, 0, 1)])
    heights = ground.heights_at(corners)
    high, low = float(heights.max()), float(heights.min())
    if high - low < 1e-3:
        return high, []
    return high, [DrawnPart(Stuff.SOIL, box((length, width, high - low + 1.0), (x, y, (high + low - 1.0) / 2.0)))]
