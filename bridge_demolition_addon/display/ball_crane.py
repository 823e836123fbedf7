"""The crane that a ball hangs from, with its rope, drawn beside the bridge; for looks only."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..engineering.arrays import FloatArray
from ..model.results.arrays import Results
from .crawlers import Crawler, freest, standing_places
from .dressing import DrawnPart, Stuff, rod
from .standing_room import StandingRoom

_ABOVE_M = (6.0, 12.0, 20.0, 35.0)
"""How far its tip may be above the highest place of the ball, where the crane is not the run's own."""

_BEYOND_M, _ASIDE_M = (20.0, 23.0, 26.0, 30.0, 35.0), (-4.0, 4.0, 0.0, -8.0, 8.0)
"""How far from its tip it may stand: far enough to be seen over the deck."""

_HEEL_M = (1.2, 0.0, 2.0)
_BOOM_M, _LATTICE = 0.9, 14
_ROPE_M = 0.07


def ball_cranes(results: Results, row: int, room: StandingRoom) -> list[DrawnPart]:
    """Return a crane for every ball of a run in a row of its frames, with its rope to the ball.

    Its tip is above where the ball was when it was last at its highest, or where the ball's own crane stands. It stands
    where it cuts neither the bridge nor debris.
    """
    parts: list[DrawnPart] = []
    for number, ball in enumerate(results.inventory.of_kind("ball").tolist()):
        crane, tip = _crane(_tips(results, row, number, ball), room)
        rope = DrawnPart(Stuff.BLACK, rod(tip, results.frames.positions_m[row, ball], _ROPE_M))
        parts += [rope, *_boom(*crane.arm_to(tip)), *crane.parts(room.ground)]
    return parts


def _tips(results: Results, row: int, number: int, ball: int) -> list[FloatArray]:
    """Return where the tip of a ball's crane may be (3,), m, the best place first."""
    frames, own = results.frames, results.inventory.of_kind("crane")
    if number < len(own):
        return [np.array(frames.positions_m[row, own[number]], float)]
    path = frames.positions_m[: row + 1, ball]
    at_top = np.flatnonzero(path[:, 2] >= path[:, 2].max() - 0.5)[-1]
    highest = float(frames.positions_m[:, ball, 2].max())
    return [np.array((*path[at_top, :2], highest + above), float) for above in _ABOVE_M]


def _crane(tips: list[FloatArray], room: StandingRoom) -> tuple[Crawler, FloatArray]:
    """Return the crane that cuts least, and its tip (3,), m."""
    found = []
    for tip in tips:
        machines = (Crawler(*stand, _HEEL_M) for stand in standing_places(tip[:2], room.ground, _BEYOND_M, _ASIDE_M))
        crane, cuts = freest(machines, tip[None], room, _BOOM_M)
        found.append((cuts, crane, tip))
        if not cuts:
            break
    _, crane, tip = min(found, key=lambda one: one[0])
    return crane, tip


def _boom(heel: FloatArray, tip: FloatArray) -> list[DrawnPart]:
    """Return the lattice boom of a crane, which tapers towards its tip."""
    axis = (tip - heel) / np.linalg.norm(tip - heel)
    sideways = np.cross(axis, (0.0, 0.0, 1.0))
    sideways /= np.linalg.norm(sideways)
    upwards = np.cross(sideways, axis)
    corners = [_BOOM_M * (a * upwards + b * sideways) / 2.0 for a, b in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
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
    return [DrawnPart(Stuff.RED, one) for one in rods]
