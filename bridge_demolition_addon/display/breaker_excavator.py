"""The excavator that carries a jackhammer, with its arm over the bridge; for looks only."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..model.results.arrays import Results
from .crawlers import Crawler, freest, stands
from .dressing import DrawnPart, Stuff, rod
from .standing_room import StandingRoom

_BEYOND_M = (7.0, 8.0, 9.0, 10.0, 12.0, 14.0, 17.0, 20.0, 25.0)
_ASIDE_M = (-2.0, 2.0, 0.0, -5.0, 5.0, -8.0, 8.0)
"""How far from its work it may stand, away from the bridge and along it."""

_ELBOW_SHARES, _ELBOW_RISES_M = (0.45, 0.6, 0.75), (0.8, 2.0, 4.0)
"""Where its elbow may be: as parts of the way from the tool to the heel of its arm, and how high above both."""

_HEEL_M = (1.2, -0.3, 2.0)
_BOOM_M, _STICK_M = 0.55, 0.4
_HOUSING_M, _COVERED, _OVER_M = 0.5, 0.45, 0.5
"""Side of the housing of the hydraulic hammer, which part of the chisel it covers, and how far it reaches above it."""

_ROWS = 6
"""Frames in which its arm must cut nothing."""


def breaker_excavators(results: Results, row: int, room: StandingRoom) -> list[DrawnPart]:
    """Return an excavator for every jackhammer of a run in a row of its frames, with its hammer around the chisel.

    It stays where it stands, and cuts neither the bridge nor debris.
    """
    parts: list[DrawnPart] = []
    some = np.unique(np.linspace(0, len(results.frames) - 1, _ROWS).astype(int))
    for tool in results.inventory.of_kind("tool").tolist():
        length = float(np.ptp(results.inventory.vertices_of(tool)[:, 2]))
        wrists = np.array(results.frames.positions_m[:, tool], float) + np.array((0.0, 0.0, length + _OVER_M))
        excavator, _ = freest(_excavators(wrists[some].mean(axis=0), room), wrists[some], room, _BOOM_M)
        heel, elbow, wrist = excavator.arm_to(wrists[row])
        parts += [
            DrawnPart(Stuff.YELLOW, rod(heel, elbow, _BOOM_M)),
            DrawnPart(Stuff.YELLOW, rod(elbow, wrist, _STICK_M)),
            DrawnPart(Stuff.BLACK, _housing(wrist, length)),
            *excavator.parts(room.ground),
        ]
    return parts


def _excavators(work: FloatArray, room: StandingRoom) -> Iterator[Crawler]:
    for foot, turn in stands(work[:2], room.ground, _BEYOND_M, _ASIDE_M):
        for elbow in product(_ELBOW_SHARES, _ELBOW_RISES_M):
            yield Crawler(foot, turn, _HEEL_M, elbow)


def _housing(wrist: FloatArray, length_m: float) -> TriangleMesh:
    """Return the hydraulic hammer between the end of an arm and a chisel of some length below it."""
    high = _OVER_M + _COVERED * length_m
    return box((_HOUSING_M, _HOUSING_M, high), (wrist - (0.0, 0.0, high / 2.0)).tolist())
