"""Approaches: the road before and behind a bridge on its bank, with a lorry and a person; for looks only.

A bank begins where no body of the run ever lies: it hides no debris.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..engineering.arrays import FloatArray, IntArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box, cylinder
from ..engineering.terrain.surface import RecordedGround
from ..model.results.arrays import Results
from ..model.results.motion import without_removed
from ..model.structure.finishes import ROAD_KINDS
from .dressing import DrawnPart, Stuff
from .moved_surfaces import boxes_of_bodies
from .road_furniture import NARROWEST_ROAD_M


def swept(stations_m: FloatArray, outlines_m: FloatArray) -> TriangleMesh:
    """Return the closed solid of convex outlines (n, c, 2) of y and z, m, at n stations along x, m, at least two."""
    outlines = np.asarray(outlines_m, float)
    count, corners = outlines.shape[:2]
    x = np.broadcast_to(np.asarray(stations_m, float)[:, None, None], (count, corners, 1))
    vertices = np.concatenate((x, outlines), axis=2).reshape(-1, 3)
    corner, following = np.arange(corners), (np.arange(corners) + 1) % corners
    quads = np.concatenate(
        [
            np.column_stack((corner, following, following + corners, corner + corners)) + first
            for first in range(0, (count - 1) * corners, corners)
        ]
    )
    inner = np.arange(1, corners - 1)
    cap = np.column_stack((np.zeros(corners - 2, int), inner, inner + 1))
    last = (count - 1) * corners
    mesh = TriangleMesh(vertices, np.concatenate((quads[:, [0, 2, 1]], quads[:, [0, 3, 2]], cap, cap[:, ::-1] + last)))
    return mesh if mesh.volume > 0.0 else mesh.flipped()


LORRY_M = (8.0, 2.5, 3.5)
"""Length, width and height of the lorry."""

PERSON_M = 1.75
"""Height of the person, with helmet."""

_WHEEL_M, _TYRE_M, _AXLES_M = 1.0, 0.32, (1.1, 5.6, 6.8)
_CAB_M, _FLOOR_M = 2.0, 1.1
_SIDES = 10


def lorry(begin_m: float, y_m: float) -> list[DrawnPart]:
    """Return a lorry that stands at height 0, its front at x = `begin_m`, as long, wide and high as `LORRY_M`."""
    length, width, height = LORRY_M
    load_long = length - _CAB_M - 0.2
    load = box(
        (load_long, width, height - _FLOOR_M), (begin_m + length - load_long / 2.0, y_m, (height + _FLOOR_M) / 2.0)
    )
    roof = height - 0.5
    sill, eaves = np.array((0.0, 1.7)), np.array((0.3, roof))
    front = _across(np.array((sill, (0.0, 0.5), (_CAB_M, 0.5), (_CAB_M, roof), eaves)), begin_m, y_m, width - 0.1)
    low, high = sill + 0.08 * (eaves - sill), sill + 0.9 * (eaves - sill)
    glass = _across(np.array((low, high, high - (0.02, 0.0), low - (0.02, 0.0))), begin_m, y_m, width - 0.4)
    windows = box((0.9, width - 0.06, 0.7), (begin_m + 0.9, y_m, roof - 0.5))
    frame = box((length - 0.6, 0.9, 0.3), (begin_m + 0.3 + (length - 0.6) / 2.0, y_m, 0.85))
    wheels = [_wheel(begin_m + axle, y_m + side * (width - _TYRE_M) / 2.0) for axle in _AXLES_M for side in (-1.0, 1.0)]
    return [
        DrawnPart(Stuff.WHITE, load),
        DrawnPart(Stuff.RED, front),
        *(DrawnPart(Stuff.BLACK, one) for one in (glass, windows, frame, *wheels)),
    ]


def person(x_m: float, y_m: float) -> list[DrawnPart]:
    """Return a person who stands at height 0, `PERSON_M` high, in a yellow vest and with a white helmet."""
    sides = (-1.0, 1.0)
    legs = [_limb((0.1 * side, 0.0, 0.0), (0.08 * side, 0.0, 0.9), (0.07, 0.09), (0.09, 0.1)) for side in sides]
    trunk = _limb((0.0, 0.0, 0.82), (0.0, 0.0, 1.46), (0.18, 0.12), (0.23, 0.13))
    arms = [_limb((0.33 * side, 0.02, 0.8), (0.25 * side, 0.0, 1.43), (0.045, 0.05), (0.07, 0.07)) for side in sides]
    head = _limb((0.0, 0.0, 1.44), (0.0, 0.0, 1.66), (0.07, 0.08), (0.09, 0.1))
    helmet = _limb((0.0, 0.0, 1.62), (0.0, 0.0, PERSON_M), (0.13, 0.15), (0.07, 0.08))
    of_stuff = {Stuff.BLACK: legs, Stuff.YELLOW: [trunk, *arms], Stuff.SKIN: [head], Stuff.WHITE: [helmet]}
    place = np.array((x_m, y_m, 0.0))
    return [
        DrawnPart(stuff, TriangleMesh(solid.vertices + place, solid.triangles))
        for stuff, solids in of_stuff.items()
        for solid in solids
    ]


def _across(outline: FloatArray, begin_m: float, y_m: float, width_m: float) -> TriangleMesh:
    """Return a solid with a convex outline (c, 2) of x from `begin_m` and z, as wide as it says across the road."""
    along = swept(np.array((-width_m / 2.0, width_m / 2.0)), np.stack((outline, outline)))
    vertices = along.vertices[:, [1, 0, 2]] + (begin_m, y_m, 0.0)
    return _turned(vertices, along.triangles)


def _wheel(x: float, y: float) -> TriangleMesh:
    upright = cylinder(_WHEEL_M / 2.0, _TYRE_M, 2 * _SIDES)
    vertices = upright.vertices[:, [0, 2, 1]] + (x, y - _TYRE_M / 2.0, _WHEEL_M / 2.0)
    return _turned(vertices, upright.triangles)


def _limb(
    low: tuple[float, float, float],
    high: tuple[float, float, float],
    thick_low: tuple[float, float],
    thick_high: tuple[float, float],
) -> TriangleMesh:
    """Return what is round and tapers from one height to another, with half its thicknesses along x and y there."""
    turns = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    ring = np.column_stack((np.cos(turns), np.sin(turns)))
    outlines = np.stack([ring * thick + end[:2] for end, thick in ((low, thick_low), (high, thick_high))])
    upright = swept(np.array((low[2], high[2])), outlines)
    return _turned(upright.vertices[:, [1, 2, 0]], upright.triangles)


def _turned(vertices: FloatArray, triangles: IntArray) -> TriangleMesh:
    """Return a solid whose axes were exchanged, with its faces outwards."""
    mesh = TriangleMesh(vertices, triangles)
    return mesh if mesh.volume > 0.0 else mesh.flipped()


LENGTH_M = 60.0
_STATION_M = 2.0

_SLOPE = 1.0
"""How far a bank reaches beside its road for each metre of its height."""

_STEEPEST = 0.08
"""Gradient at which a road climbs where the ground beside it would else lie above it."""

_OVER_GROUND_M, _STEP_M = 0.1, 0.6
"""How far a road is above the ground that carries it, and how much higher than a deck that ground may be."""

_BURIED_M, _FARTHEST_M, _SEARCH_M = 1.0, 30.0, 0.25
"""How deep the foot of a slope reaches into the ground, up to where it is searched, and how finely."""

_SHOULDER_M, _ROAD_M = 0.6, 0.1
_WALL_M, _WALL_OVER_M = 0.5, 0.2
_LINE_M, _PAINT_M, _DASH_M = 0.14, 0.008, 3.0
_RAIL_FROM_EDGE_M, _RAIL_HEIGHT_M, _POST_EVERY_M = 0.2, 0.75, 4.0


@dataclass(frozen=True, slots=True, eq=False)
class Bank:
    """A road along x on its bank, from the bridge on.

    `stations_m` (n,) begin at the bridge; `road_m` (n,) is how high the road is there, and `feet_m` (n, 2, 2) has y and
    z of the feet of its slopes, right and left. `edges_m` are the sides of the road, y.
    """

    stations_m: FloatArray
    road_m: FloatArray
    feet_m: FloatArray
    edges_m: tuple[float, float]

    @property
    def away(self) -> float:
        """Which way along x it goes: 1 or -1."""
        return float(np.sign(self.stations_m[-1] - self.stations_m[0]))

    @property
    def length_m(self) -> float:
        """Length along x."""
        return float(abs(self.stations_m[-1] - self.stations_m[0]))

    def height_at(self, x_m: FloatArray | float) -> FloatArray:
        """Return how high the road is at positions along x."""
        away = self.away
        return np.interp(away * np.asarray(x_m, float), away * self.stations_m, self.road_m)

    def parts(self) -> list[DrawnPart]:
        """Return soil, wall towards the bridge, road, markings and crash barriers."""
        right, left = self.edges_m
        along = (self.stations_m, self.road_m)
        lines = [_ribbon(*along, y, _LINE_M, _PAINT_M, 0.0) for y in (right + 0.65, left - 0.65)]
        for begin in np.arange(0.0, self.length_m - _DASH_M, 2.0 * _DASH_M).tolist():
            x = self.stations_m[0] + self.away * np.array((begin, begin + _DASH_M))
            lines.append(_ribbon(x, self.height_at(x), (right + left) / 2.0, _LINE_M, _PAINT_M, 0.0))
        return [
            DrawnPart(Stuff.SOIL, swept(self.stations_m, self._soil())),
            DrawnPart(Stuff.CONCRETE, self._wall()),
            DrawnPart(Stuff.ASPHALT, _ribbon(*along, (right + left) / 2.0, left - right, _ROAD_M, -_ROAD_M)),
            *(DrawnPart(Stuff.WHITE, line) for line in lines),
            *(DrawnPart(Stuff.STEEL, part) for y in self._barriers() for part in self._barrier(y)),
        ]

    def _soil(self) -> FloatArray:
        right, left = self.edges_m
        under = self.road_m - _ROAD_M
        sides = left + _SHOULDER_M, right - _SHOULDER_M
        shoulders = [np.column_stack((np.full(len(under), y), under)) for y in sides]
        return np.stack((self.feet_m[:, 0], self.feet_m[:, 1], *shoulders), axis=1)

    def _wall(self) -> TriangleMesh:
        """Return the wall that holds the soil towards the bridge, with its wings down the slopes."""
        (right, left), top = self.edges_m, float(self.road_m[0])
        foot_right, foot_left = self.feet_m[0] + ((-_WALL_OVER_M, 0.0), (_WALL_OVER_M, 0.0))
        out = _SHOULDER_M + _WALL_OVER_M
        outline = (foot_right, foot_left, (left + out, top), (right - out, top))
        x = self.stations_m[0] - self.away * np.array((0.02, -_WALL_M))
        return swept(x, np.array((outline, outline)))

    def _barriers(self) -> tuple[float, float]:
        return self.edges_m[0] + _RAIL_FROM_EDGE_M, self.edges_m[1] - _RAIL_FROM_EDGE_M

    def _barrier(self, y: float) -> list[TriangleMesh]:
        posts = []
        for after in np.arange(0.5, self.length_m, _POST_EVERY_M).tolist():
            x = float(self.stations_m[0] + self.away * after)
            middle = float(self.height_at(x)) + _RAIL_HEIGHT_M / 2.0
            posts.append(box((0.1, 0.1, _RAIL_HEIGHT_M), (x, y, middle)))
        return [_ribbon(self.stations_m, self.road_m, y, 0.08, 0.3, _RAIL_HEIGHT_M - 0.3), *posts]


def bank(
    begin_m: float, away: float, edges_m: tuple[float, float], top_m: float, ground: RecordedGround
) -> Bank | None:
    """Return a bank from x = `begin_m` on, whose road begins at `top_m`; None where the ground leaves no room for it.

    The road is level, and climbs where the ground below it is higher; it ends where the ground is too steep for that.
    """
    stations = begin_m + away * np.arange(0.0, LENGTH_M + 1e-9, _STATION_M)
    across = np.linspace(edges_m[0] - _SHOULDER_M, edges_m[1] + _SHOULDER_M, 7)
    positions = np.stack(np.broadcast_arrays(stations[:, None], across[None]), axis=-1)
    carries = ground.heights_at(positions).max(axis=1) + _OVER_GROUND_M
    if carries[0] > top_m + _STEP_M:
        return None
    road = [max(top_m, float(carries[0]))]
    for needed in carries[1:].tolist():
        highest = road[-1] + _STEEPEST * _STATION_M
        if needed > highest + _OVER_GROUND_M:
            break
        road.append(min(max(road[-1], needed), highest))
    if len(road) < 2:
        return None
    stations, heights = stations[: len(road)], np.array(road)
    feet = [_feet(ground, stations, heights - _ROAD_M, y, out) for y, out in zip(edges_m, (-1.0, 1.0), strict=True)]
    return Bank(stations, heights, np.stack(feet, axis=1), edges_m)


def _feet(ground: RecordedGround, stations: FloatArray, heights: FloatArray, edge: float, out: float) -> FloatArray:
    """Return y and z (n, 2) where the slope at a side of a road has gone well into the ground."""
    reaches = np.arange(0.0, _FARTHEST_M, _SEARCH_M)
    y = edge + out * (_SHOULDER_M + reaches)
    slope = heights[:, None] - reaches / _SLOPE
    there = ground.heights_at(np.stack(np.broadcast_arrays(stations[:, None], y[None]), axis=-1))
    is_below = slope <= there
    first = np.where(is_below.any(axis=1), is_below.argmax(axis=1), len(reaches) - 1)
    deeper = reaches[first] + _BURIED_M * _SLOPE
    return np.column_stack((edge + out * (_SHOULDER_M + deeper), heights - deeper / _SLOPE))


def _ribbon(
    stations: FloatArray, heights: FloatArray, middle: float, width: float, thickness: float, above: float
) -> TriangleMesh:
    """Return a strip along the road whose lower side is `above` it, m."""
    low, high = heights + above, heights + above + thickness
    sides = middle - width / 2.0, middle + width / 2.0
    corners = [(sides[0], low), (sides[1], low), (sides[1], high), (sides[0], high)]
    outlines = np.stack([np.column_stack((np.full(len(z), y), z)) for y, z in corners], axis=1)
    return swept(stations, outlines)


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
