"""Machines on crawlers that stand beside a bridge with their arm over it, where they cut nothing; for looks only."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..engineering.terrain.recorded import RecordedGround
from .dressing import DrawnPart, Stuff
from .standing_room import StandingRoom, boxes_around

_PLATFORM_M = 8.0
"""Side of the level soil that it stands on where the ground is not level."""

_SIDES_DEG = (90.0, 0.0, 180.0)
"""Where a machine stands as seen from its work, from the x axis: behind the road, seen from the camera, if it can."""

_LEVEL_M = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Crawler:
    """A machine that stands at a foot (3,), m, turned towards its work, with an arm from its house.

    The arm begins at `heel_m`, in the machine's own axes. Where it has an `elbow`, that is a part of the way from the
    arm's end to its heel, and a height above the upper one of both, m.
    """

    foot_m: FloatArray
    turn_rad: float
    heel_m: tuple[float, float, float]
    elbow: tuple[float, float] | None = None

    def arm_to(self, end_m: FloatArray) -> FloatArray:
        """Return the joints (j, 3) of its arm, m, from its heel to an end (3,)."""
        heel = self.foot_m + _turned(self.turn_rad) @ np.array(self.heel_m)
        if self.elbow is None:
            return np.array((heel, end_m))
        share, rise = self.elbow
        middle = end_m + share * (heel - end_m)
        middle[2] = max(heel[2], end_m[2]) + rise
        return np.array((heel, middle, end_m))

    def parts(self, ground: RecordedGround) -> list[DrawnPart]:
        """Return tracks, house, cab and counterweight, and a level platform where the ground is not level."""
        solids = (
            *((Stuff.BLACK, (5.2, 0.8, 1.0), (0.0, side * 1.4, 0.5)) for side in (-1.0, 1.0)),
            (Stuff.BLACK, (2.4, 2.0, 0.5), (0.0, 0.0, 0.95)),
            (Stuff.YELLOW, (4.4, 3.0, 1.5), (-0.6, 0.0, 1.95)),
            (Stuff.BLACK, (0.9, 2.9, 1.3), (-3.2, 0.0, 1.9)),
            (Stuff.YELLOW, (1.7, 1.0, 0.9), (1.1, 1.0, 1.65)),
            (Stuff.BLACK, (1.6, 0.96, 1.0), (1.1, 1.0, 2.5)),
            (Stuff.YELLOW, (1.8, 1.04, 0.12), (1.1, 1.0, 3.05)),
        )
        machine = [DrawnPart(stuff, self._placed(box(size, middle))) for stuff, size, middle in solids]
        return machine + self._platform(ground)

    def _placed(self, solid: TriangleMesh) -> TriangleMesh:
        return TriangleMesh(self.foot_m + solid.vertices @ _turned(self.turn_rad).T, solid.triangles)

    def _platform(self, ground: RecordedGround) -> list[DrawnPart]:
        thick = float(self.foot_m[2] - _heights_below(self.foot_m[:2], ground).min())
        if thick < _LEVEL_M:
            return []
        middle = self.foot_m - (0.0, 0.0, (thick + 1.0) / 2.0)
        return [DrawnPart(Stuff.SOIL, box((_PLATFORM_M, _PLATFORM_M, thick + 1.0), middle.tolist()))]


def standing_places(
    work_m: FloatArray, ground: RecordedGround, distances_m: Sequence[float], asides_m: Sequence[float]
) -> Iterator[tuple[FloatArray, float]]:
    """Yield feet (3,), m, and turns of machines that look at their work (2,): behind the road and near ones first."""
    for side in np.radians(_SIDES_DEG).tolist():
        away, across = _turned(side)[:2, 0], _turned(side)[:2, 1]
        for distance, aside in product(distances_m, asides_m):
            at = work_m + distance * away + aside * across
            towards = work_m - at
            yield np.array((*at, _heights_below(at, ground).max())), float(np.arctan2(towards[1], towards[0]))


def freest(
    machines: Iterable[Crawler], ends_m: FloatArray, room: StandingRoom, thickness_m: float
) -> tuple[Crawler, int]:
    """Return the first machine that cuts nothing with its arm to any end (e, 3), m, or the one that cuts least.

    With it comes how often it cuts.
    """
    best: tuple[Crawler, int] | None = None
    for machine in machines:
        boxes = boxes_around(machine.parts(room.ground))
        cuts = room.cuts(boxes, np.array([machine.arm_to(end) for end in ends_m]), thickness_m)
        if best is None or cuts < best[1]:
            best = machine, cuts
        if not cuts:
            break
    assert best is not None
    return best


def _heights_below(at_m: FloatArray, ground: RecordedGround) -> FloatArray:
    """Return how high the ground is below the platform of a machine, m."""
    half = _PLATFORM_M / 2.0
    return ground.heights_at(at_m + half * np.array(list(product((-1.0, 0.0, 1.0), repeat=2))))


def _turned(angle_rad: float) -> FloatArray:
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    return np.array(((cosine, -sine, 0.0), (sine, cosine, 0.0), (0.0, 0.0, 1.0)))
