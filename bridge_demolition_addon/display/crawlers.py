"""Crawlers next to a bridge: the crane of a ball, the excavator of a jackhammer, where they cut nothing; for looks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Self

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..engineering.terrain.surface import RecordedGround
from ..model.results.arrays import Results
from .dressing import DrawnPart, Stuff, rod
from .moved_surfaces import boxes_of_bodies

_CLEAR_M = 0.3
"""Least distance of a machine from what it must not cut."""

_ROOM_ROWS = 12
"""Frames that are looked at for where bodies come."""

_BESIDE = ("ground", "ball", "tool", "crane")
"""Kinds of bodies that are no part of the bridge."""


@dataclass(frozen=True, slots=True, eq=False)
class StandingRoom:
    """What a machine must not cut: boxes by their lowest and highest corners, m.

    Attributes
    ----------
    built_m : (n, 2, 3) float
        Boxes around the bodies of the bridge as they are built, and around what is drawn with it.
    reached_m : (k, 2, 3) float
        The same, and boxes around these bodies wherever they come in the run.
    ground : RecordedGround
        What machines stand on.
    """

    built_m: FloatArray
    reached_m: FloatArray
    ground: RecordedGround

    @classmethod
    def of_run(cls, results: Results, drawn: Sequence[DrawnPart] = ()) -> Self:
        """Return the room that a run leaves, with what is drawn in it."""
        of_bridge = np.flatnonzero(~np.isin(results.inventory.body_kinds, _BESIDE))
        rows = np.unique(np.linspace(0, len(results.frames) - 1, _ROOM_ROWS).astype(int))
        by_row = [boxes_of_bodies(results, row)[of_bridge] for row in rows.tolist()]
        beside = boxes_around(drawn)
        return cls(np.concatenate((by_row[0], beside)), np.concatenate((*by_row, beside)), results.ground())

    def cuts(self, boxes_m: FloatArray, arms_m: FloatArray, thickness_m: float) -> int:
        """Return how often a machine cuts: its boxes (b, 2, 3) anything ever, its arms (a, j, 3) what is built."""
        reached = _grown(self.reached_m, _CLEAR_M)
        apart = (boxes_m[:, None, 0] > reached[None, :, 1]) | (boxes_m[:, None, 1] < reached[None, :, 0])
        built = _grown(self.built_m, thickness_m / 2.0 + _CLEAR_M)
        crossed = _crossed(arms_m[:, :-1].reshape(-1, 3), arms_m[:, 1:].reshape(-1, 3), built)
        return int((~apart.any(axis=2)).sum()) + int(crossed.sum())


def boxes_around(parts: Sequence[DrawnPart]) -> FloatArray:
    """Return the lowest and highest corners (n, 2, 3), m, of the boxes around solids."""
    corners = [(part.solid.vertices.min(axis=0), part.solid.vertices.max(axis=0)) for part in parts]
    return np.array(corners, float).reshape(-1, 2, 3)


def _grown(boxes: FloatArray, by_m: float) -> FloatArray:
    return boxes + np.array((-by_m, by_m))[:, None]


def _crossed(starts: FloatArray, ends: FloatArray, boxes: FloatArray) -> np.ndarray:
    """Return which boxes (n, 2, 3) lines between points (s, 3) go through, (s, n)."""
    along = ends - starts
    along = np.where(abs(along) < 1e-9, 1e-9, along)[:, None]
    begin, end = ((boxes[None, :, side] - starts[:, None]) / along for side in (0, 1))
    enters = np.minimum(begin, end).max(axis=2)
    leaves = np.maximum(begin, end).min(axis=2)
    return np.asarray((enters <= leaves) & (leaves >= 0.0) & (enters <= 1.0))


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
