"""Banks: a road before or behind a bridge, level with it, on soil that slopes down to the ground; for looks only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..engineering.terrain.recorded import RecordedGround
from .dressing import DrawnPart, Stuff
from .swept import swept

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
