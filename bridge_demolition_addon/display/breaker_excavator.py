"""The excavator that carries a jackhammer, with its arm over the bridge; for looks only."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..model.results.arrays import Results
from .crawlers import Crawler, freest, standing_places
from .dressing import DrawnPart, Stuff, rod
from .standing_room import StandingRoom

_EXCAVATOR_BEYOND_M = (7.0, 8.0, 9.0, 10.0, 12.0, 14.0, 17.0, 20.0, 25.0)
_EXCAVATOR_ASIDE_M = (-2.0, 2.0, 0.0, -5.0, 5.0, -8.0, 8.0)
"""How far from its work it may stand, away from the bridge and along it."""

_ELBOW_SHARES, _ELBOW_RISES_M = (0.45, 0.6, 0.75), (0.8, 2.0, 4.0)
"""Where its elbow may be: as parts of the way from the tool to the heel of its arm, and how high above both."""

_EXCAVATOR_HEEL_M = (1.2, -0.3, 2.0)
_EXCAVATOR_BOOM_M, _STICK_M = 0.55, 0.4
_HOUSING_M, _COVERED, _OVER_M = 0.5, 0.45, 0.5
"""Side of the housing of the hydraulic hammer, which part of the chisel it covers, and how far it reaches above it."""

_ROWS = 6
"""Frames in which its arm must cut nothing."""


def breaker_excavators(results: Results, room: StandingRoom) -> dict[int, Crawler]:
    """Return an excavator for every jackhammer of a run, by its body, which stays where it cuts nothing.

    Finding its place looks at the whole run: once is enough for all pictures.
    """
    some = np.unique(np.linspace(0, len(results.frames) - 1, _ROWS).astype(int))
    found = {}
    for tool in results.inventory.of_kind("tool").tolist():
        wrists = _wrists(results, tool)[some]
        found[tool], _ = freest(_excavators(wrists.mean(axis=0), room), wrists, room, _EXCAVATOR_BOOM_M)
    return found


def excavator_parts(
    results: Results, row: int, room: StandingRoom, excavators: Mapping[int, Crawler]
) -> list[DrawnPart]:
    """Return what is drawn of excavators in a row of a run's frames, each with its hammer around the chisel."""
    parts: list[DrawnPart] = []
    for tool, excavator in excavators.items():
        heel, elbow, wrist = excavator.arm_to(_wrists(results, tool)[row])
        parts += [
            DrawnPart(Stuff.YELLOW, rod(heel, elbow, _EXCAVATOR_BOOM_M)),
            DrawnPart(Stuff.YELLOW, rod(elbow, wrist, _STICK_M)),
            DrawnPart(Stuff.BLACK, _housing(wrist, _chisel_m(results, tool))),
            *excavator.parts(room.ground),
        ]
    return parts


def _wrists(results: Results, tool: int) -> FloatArray:
    """Return where the end of an arm is in all frames (f, 3), m: above its chisel."""
    places: FloatArray = np.array(results.frames.positions_m[:, tool], float)
    return places + np.array((0.0, 0.0, _chisel_m(results, tool) + _OVER_M))


def _chisel_m(results: Results, tool: int) -> float:
    return float(np.ptp(results.inventory.vertices_of(tool)[:, 2]))


def _excavators(work: FloatArray, room: StandingRoom) -> Iterator[Crawler]:
    for foot, turn in standing_places(work[:2], room.ground, _EXCAVATOR_BEYOND_M, _EXCAVATOR_ASIDE_M):
        for elbow in product(_ELBOW_SHARES, _ELBOW_RISES_M):
            yield Crawler(foot, turn, _EXCAVATOR_HEEL_M, elbow)


def _housing(wrist: FloatArray, length_m: float) -> TriangleMesh:
    """Return the hydraulic hammer between the end of an arm and a chisel of some length below it."""
    high = _OVER_M + _COVERED * length_m
    return box((_HOUSING_M, _HOUSING_M, high), (wrist - (0.0, 0.0, high / 2.0)).tolist())
