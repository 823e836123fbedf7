"""The line of a road, with slopes, crossfall and a curve in plan: where what was made straight and level goes on it.

It is straight between stations, so that what is made of flat sides between these has flat sides on it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arithmetic import arctangent, cosine, sine
from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh
from .vectors import unit

_STEP_M = 1e-3
"""Half of the distance over which a direction is taken: a line is straight for longer, but at its stations."""


@dataclass(frozen=True, slots=True, eq=False)
class RoadLine:
    """A line through n stations, which takes s along the road, t across it to the left and h upwards to a position.

    Attributes
    ----------
    stations_m, heights_m, crossfalls : (n,) float
        Positions along the road, how much higher the line is there in its middle, and by how much it rises to the left
        for each metre across.
    shift_across
        How far along the road a skewed section moves for each metre across it.
    radius_m
        Radius in plan, above 0 where the road turns to the left; None of a straight one. What is curved has no skew.
    level_m, factors
        Height h below which all is deeper by such factors (n,); None of one depth.
    bends_m
        Of a curved line the stations (k,) between which it is straight in plan, the first and the last among them.
    axis_m, heading_rad
        Of a straight line its origin in plan (2,), at s = `begin_m`, and its direction.
    """

    stations_m: FloatArray
    heights_m: FloatArray
    crossfalls: FloatArray
    shift_across: float = 0.0
    radius_m: float | None = None
    bends_m: FloatArray | None = None
    level_m: float = 0.0
    factors: FloatArray | None = None
    axis_m: tuple[float, float] = (0.0, 0.0)
    heading_rad: float = 0.0
    begin_m: float = 0.0

    def to_world(self, own_m: FloatArray) -> FloatArray:
        """Return positions (..., 3) of s, t, h (..., 3)."""
        s, t, h = np.moveaxis(own_m, -1, 0)
        part, share = self._part(s)
        if self.radius_m is None or self.bends_m is None:
            plan = self._turned(np.stack((s - self.begin_m + t * self.shift_across, t), axis=-1), 1.0)
            x, y = plan[..., 0] + self.axis_m[0], plan[..., 1] + self.axis_m[1]
        else:
            bend, along = _part(s, self.bends_m)
            first, other = self.bends_m[bend] / self.radius_m, self.bends_m[bend + 1] / self.radius_m
            outwards = self.radius_m - t
            x = outwards * _between(sine(first), sine(other), along)
            y = self.radius_m - outwards * _between(cosine(first), cosine(other), along)
        if self.factors is not None:
            deeper = _between(self.factors[part], self.factors[part + 1], share)
            h = np.where(h < self.level_m, self.level_m + deeper * (h - self.level_m), h)
        return np.stack((x, y, h + self._rise(part, share, t)), axis=-1)

    def from_world(self, points_m: FloatArray) -> FloatArray:
        """Return s, t, h (..., 3) of positions (..., 3)."""
        x, y, z = np.moveaxis(points_m, -1, 0)
        s, t = self._from_plan(x, y)
        part, share = self._part(s)
        h = z - self._rise(part, share, t)
        if self.factors is not None:
            deeper = _between(self.factors[part], self.factors[part + 1], share)
            h = np.where(h < self.level_m, self.level_m + (h - self.level_m) / deeper, h)
        return np.stack((s, t, h), axis=-1)

    def rise_m(self, x_m: float, y_m: float) -> float:
        """Return how much higher the line is at a position in plan than at its first axis, m."""
        s, t = self._from_plan(np.array(x_m), np.array(y_m))
        return float(self._rise(*self._part(s), t))

    def factor_at(self, s: float) -> float:
        """Return how many times as deep all below `level_m` is at a position along the road."""
        return 1.0 if self.factors is None else float(np.interp(s, self.stations_m, self.factors))

    def _from_plan(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return s and t of positions in plan."""
        if self.radius_m is None or self.bends_m is None:
            plan = self._turned(np.stack((x - self.axis_m[0], y - self.axis_m[1]), axis=-1), -1.0)
            return plan[..., 0] - plan[..., 1] * self.shift_across + self.begin_m, plan[..., 1]
        return _from_curve(x, y, self.radius_m, self.bends_m)

    def directions(self, own_m: FloatArray, axis: int) -> FloatArray:
        """Return the directions (k, 3), of length 1, of lines along an axis through s, t, h (k, 3)."""
        step = _STEP_M * np.eye(3)[axis]
        return unit(self.to_world(own_m + step) - self.to_world(own_m - step))

    def carried(self, solid: TriangleMesh) -> TriangleMesh:
        """Return a solid whose corners were s, t, h in its place."""
        return TriangleMesh(self.to_world(solid.vertices), solid.triangles)

    def _turned(self, plan_m: FloatArray, way: float) -> FloatArray:
        if self.heading_rad == 0.0:
            return plan_m
        along, left = float(cosine(self.heading_rad)), way * float(sine(self.heading_rad))
        x, y = plan_m[..., 0], plan_m[..., 1]
        return np.stack((along * x - left * y, left * x + along * y), axis=-1)

    def _part(self, s: FloatArray) -> tuple[IntArray, FloatArray]:
        return _part(s, self.stations_m)

    def _rise(self, part: IntArray, share: FloatArray, t: FloatArray) -> FloatArray:
        heights, falls = self.heights_m, self.crossfalls
        rise: FloatArray = _between(heights[part], heights[part + 1], share)
        return rise + t * _between(falls[part], falls[part + 1], share)


def _part(s: FloatArray, stations_m: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return between which stations positions are, and at which share of their distance."""
    part = np.clip(np.searchsorted(stations_m, s, side="right") - 1, 0, len(stations_m) - 2)
    begin = stations_m[part]
    return part, (s - begin) / (stations_m[part + 1] - begin)


def _from_curve(x: FloatArray, y: FloatArray, radius_m: float, bends_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return s and t of positions: between bends a section goes through the middle of the curve as well."""
    side = np.copysign(1.0, radius_m)
    from_centre = radius_m - y
    part, _ = _part(radius_m * arctangent(side * x, side * from_centre), bends_m)
    first, other = bends_m[part] / radius_m, bends_m[part + 1] / radius_m
    half, middle = 0.5 * (other - first), 0.5 * (first + other)
    along = x * cosine(middle) - from_centre * sine(middle)
    outwards = (x * sine(middle) + from_centre * cosine(middle)) / cosine(half)
    share = 0.5 + 0.5 * along / (outwards * sine(half))
    return _between(bends_m[part], bends_m[part + 1], share), radius_m - outwards


def _between(first: FloatArray, other: FloatArray, share: FloatArray) -> FloatArray:
    return first + share * (other - first)


def road_prism(
    along_m: Sequence[float], across_m: Sequence[float], undersides_m: Sequence[float], tops_m: Sequence[float]
) -> TriangleMesh:
    """Return a straight solid along the road with corners at stations (n,) and at positions across it (m,).

    Its underside and top (n,) are level across the road. On a `RoadLine` two solids that share stations and positions
    across fit to each other, though what is between four corners may be warped.
    """
    rows, columns = len(along_m), len(across_m)
    x, y = (grid.ravel() for grid in np.meshgrid(along_m, across_m, indexing="ij"))
    levels = [np.repeat(np.asarray(heights, float), columns) for heights in (undersides_m, tops_m)]
    corners = np.concatenate([np.column_stack((x, y, level)) for level in levels])
    corner = np.arange(rows * columns).reshape(rows, columns)
    fields = _quads(corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:])
    around = np.concatenate((corner[:-1, 0], corner[-1, :-1], corner[:0:-1, -1], corner[0, :0:-1]))
    after, above = np.roll(around, -1), rows * columns
    sides = _quads(around, after, after + above, around + above)
    return TriangleMesh(corners, np.concatenate((fields[:, ::-1], fields + above, sides)))


def _quads(*corners: IntArray) -> IntArray:
    """Return the two triangles of each of k quadrilaterals, (2 k, 3)."""
    first, second, third, fourth = (corner.ravel() for corner in corners)
    return np.column_stack((first, second, third, first, third, fourth)).reshape(-1, 3)
