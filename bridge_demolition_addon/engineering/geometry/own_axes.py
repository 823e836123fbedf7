"""A member's own axes: along its line on plan, which may be curved, across it, and up from its underside.

Members from files are inclined, cambered and curved. What is level and straight in a member that is not, such as a
layer of bars, is so in these axes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection

from ..arrays import FloatArray
from .mesh import TriangleMesh, plane_cuts
from .vectors import cross_2d, dot, length, unit

_STATIONS = 24
"""Sections along a member that its line, its underside and its top are taken from."""

_ACROSS = 9
"""Points across a section at which its underside and its top are taken."""

_STRAIGHT = 0.1
"""Part of its width by which the middles of its sections may be off a line that is straight."""

_WHOLE = 0.8
"""Part of the usual width of a section from which on it is whole: at skewed ends there are less wide ones."""

_NEAR_UNDERSIDE = 0.3
"""Part of its depth within which what looks down is its underside, and not that of a part that cantilevers."""

_STEPPED = 0.25
"""Part of the depth by which the top may be off its middle: a parapet or kerb on it is no part of it."""

_INSIDE = 0.98
_HALF_M = 0.25
"""Distance before and behind a position over which the direction of a line along an axis is taken."""


@dataclass(frozen=True, slots=True, eq=False)
class OwnAxes:
    """Axes of a member: s along it from its beginning, t across it to the left, h upwards, all in m.

    Of what lies, h is 0 at its underside and `height_m` at its top, whatever its depth there. Of what stands, h is the
    height itself, and the line is straight.
    """

    stations_m: FloatArray  # (k,), s of points of the line
    line_m: FloatArray  # (k, 2), the points on plan
    length_m: float
    width_m: float
    lowest_m: float
    height_m: float
    undersides_m: FloatArray | None  # (k,), height of the underside at the line; None of what stands
    slopes: FloatArray  # (k,), of the underside across the line
    across_m: FloatArray  # (a,), t of the points of the top
    tops_m: FloatArray  # (k, a), heights of the top
    sections: tuple[FloatArray, ...]  # (c, 2, 2) each, sides of sections across what lies, by t and h

    def from_world(self, points_m: FloatArray) -> FloatArray:
        """Return s, t, h (..., 3) of positions (..., 3)."""
        flat = points_m.reshape(-1, 3)
        s, t = self._on_plan(flat[:, :2])
        h = flat[:, 2]
        if self.undersides_m is not None:
            underside, top = self._underside_and_top(s, t)
            h = self.height_m * (h - underside) / (top - underside)
        return np.stack((s, t, h), axis=1).reshape(points_m.shape)

    def to_world(self, own_m: FloatArray) -> FloatArray:
        """Return positions (..., 3) of s, t, h (..., 3)."""
        flat = own_m.reshape(-1, 3)
        s, t, h = flat.T
        part = np.clip(np.searchsorted(self.stations_m, s, side="right") - 1, 0, len(self.stations_m) - 2)
        along = unit(np.diff(self.line_m, axis=0))[part]
        plan = self.line_m[part] + (s - self.stations_m[part])[:, None] * along
        plan = plan + t[:, None] * np.column_stack((-along[:, 1], along[:, 0]))
        if self.undersides_m is not None:
            underside, top = self._underside_and_top(s, t)
            h = underside + h / self.height_m * (top - underside)
        return np.column_stack((plan, h)).reshape(own_m.shape)

    def directions(self, own_m: FloatArray, axis: int) -> FloatArray:
        """Return the directions (k, 3), of length 1, of lines along an axis through s, t, h (k, 3)."""
        step = np.zeros(3)
        step[axis] = _HALF_M
        return unit(self.to_world(own_m + step) - self.to_world(own_m - step))

    def ends_m(self, axis: int) -> tuple[float, float]:
        """Return from where to where the member goes along an axis."""
        lows = 0.0, -0.5 * self.width_m, self.lowest_m
        sizes = self.length_m, self.width_m, self.height_m
        return lows[axis], lows[axis] + sizes[axis]

    def width_at_m(self, height_m: float) -> float:
        """Return how wide what lies is at a height above its underside, in the middle of its sections."""
        widths = [_width(section, height_m) for section in self.sections]
        return float(np.median(widths))

    @property
    def web_m(self) -> float:
        """The least width of what lies, over the middle half of its height."""
        return min(self.width_at_m(share * self.height_m) for share in (0.25, 0.4, 0.5, 0.6, 0.75))

    def _on_plan(self, plan_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return s and t (n,) of positions on plan (n, 2), by the part of the line that is nearest."""
        along = unit(np.diff(self.line_m, axis=0))
        sizes = np.diff(self.stations_m)
        offsets = plan_m[:, None] - self.line_m[:-1]
        s, t = dot(offsets, along), cross_2d(along, offsets)
        low = np.where(np.arange(len(sizes)) == 0, -np.inf, 0.0)
        high = np.where(np.arange(len(sizes)) == len(sizes) - 1, np.inf, sizes)
        beside = s - np.clip(s, low, high)
        part = (np.abs(t) + np.abs(beside)).argmin(axis=1)
        rows = np.arange(len(plan_m))
        return s[rows, part] + self.stations_m[part], t[rows, part]

    def _underside_and_top(self, s: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        undersides = self.undersides_m
        assert undersides is not None  # of what stands no height is asked for
        part = np.clip(np.searchsorted(self.stations_m, s, side="right") - 1, 0, len(self.stations_m) - 2)
        share = (s - self.stations_m[part]) / np.diff(self.stations_m)[part]
        underside = _between(undersides, part, share) + t * _between(self.slopes, part, share)
        column = np.clip(np.searchsorted(self.across_m, t, side="right") - 1, 0, len(self.across_m) - 2)
        beside = np.clip((t - self.across_m[column]) / np.diff(self.across_m)[column], 0.0, 1.0)
        first = _between(self.tops_m[:, column], part, share, np.arange(len(t)))
        other = _between(self.tops_m[:, column + 1], part, share, np.arange(len(t)))
        return underside, first + beside * (other - first)


def _between(values: FloatArray, part: np.ndarray, share: FloatArray, column: np.ndarray | None = None) -> FloatArray:
    first = values[part] if column is None else values[part, column]
    other = values[part + 1] if column is None else values[part + 1, column]
    found: FloatArray = first + share * (other - first)
    return found


def standing_axes(solid: TriangleMesh) -> OwnAxes:
    """Return the axes of a column or a wall: along the longer side of its plan, across it and upwards."""
    points = solid.vertices
    along = longer_side(points[:, :2])
    s, t = dot(points[:, :2], along), cross_2d(along, points[:, :2])
    middle = 0.5 * (float(t.min()) + float(t.max()))
    beside = np.array([-along[1], along[0]])
    ends = np.array([float(s.min()), float(s.max())])
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    return OwnAxes(
        stations_m=ends - ends[0],
        line_m=ends[:, None] * along + middle * beside,
        length_m=float(np.ptp(s)),
        width_m=float(np.ptp(t)),
        lowest_m=low,
        height_m=high - low,
        undersides_m=None,
        slopes=np.zeros(2),
        across_m=np.zeros(2),
        tops_m=np.zeros((2, 2)),
        sections=(),
    )


def lying_axes(solid: TriangleMesh, road: FloatArray | None = None) -> OwnAxes:
    """Return the axes of a deck or beam: along the longer side of its plan, or the side nearest to a direction (2,).

    They follow the middles of its sections, where these are not on a straight line, and its underside and top.
    """
    corners = solid.corners
    along = longer_side(solid.vertices[:, :2])
    if road is not None and abs(float(dot(along, road))) < abs(float(cross_2d(along, road))):
        along = np.array([-along[1], along[0]])
    if float(dot(along, np.array([1.0, 0.0]) if road is None else road)) < 0.0:
        along = -along
    s = dot(solid.vertices[:, :2], along)
    begin, end = float(s.min()), float(s.max())
    at = begin + (end - begin) * (np.arange(_STATIONS) + 0.5) / _STATIONS
    beside = np.array([-along[1], along[0]])
    cuts = [_cut(corners, position * along, along) for position in at]
    found = [(position, cut) for position, cut in zip(at, cuts, strict=True) if len(cut)]
    widths = np.array([np.ptp(cut[..., 0]) for _, cut in found])
    whole = [row for row, width in zip(found, widths, strict=True) if width >= _WHOLE * float(np.median(widths))]
    stations = np.array([position for position, _ in whole])
    middles = np.array([0.5 * (cut[..., 0].min() + cut[..., 0].max()) for _, cut in whole])
    mean = float(np.median(middles))
    if float(np.abs(middles - mean).max()) < _STRAIGHT * float(np.median(widths)):
        middles = np.full(len(middles), mean)
    stations, middles = _to_the_ends(stations, middles, begin, end)
    line = stations[:, None] * along + middles[:, None] * beside
    return _followed(corners, line)


def _to_the_ends(stations: FloatArray, values: FloatArray, begin: float, end: float) -> tuple[FloatArray, FloatArray]:
    """Add values at both ends of a line, as far from their neighbours as these are from the next."""
    if len(stations) < 2:
        return np.array([begin, end]), np.repeat(values[:1], 2, axis=0)
    slopes = [(values[b] - values[a]) / (stations[b] - stations[a]) for a, b in ((0, 1), (-2, -1))]
    first, last = values[0] + (begin - stations[0]) * slopes[0], values[-1] + (end - stations[-1]) * slopes[1]
    return np.array([begin, *stations, end]), np.concatenate((first[None], values, last[None]))


def _followed(corners: FloatArray, line: FloatArray) -> OwnAxes:
    """Return the axes along a line (k, 2), with heights of what is cut across it."""
    steps = length(np.diff(line, axis=0))
    stations = np.concatenate((np.zeros(1), np.cumsum(steps)))
    ways = unit(np.diff(line, axis=0))
    inner = list(zip(stations[1:-1], line[1:-1], unit(ways[:-1] + ways[1:]), strict=True))
    if not inner:
        inner = [(0.5 * stations[-1], line.mean(axis=0), ways[0])]
    cuts = [_cut(corners, point, way) for _, point, way in inner]
    width = float(np.median([np.ptp(cut[..., 0]) for cut in cuts if len(cut)]))
    near = [cut[(np.abs(cut[..., 0]) <= 0.75 * width).any(axis=1)] for cut in cuts]
    if not any(len(cut) for cut in near):  # all of it lies off the line
        near = cuts
    # At a gap in a member, and where it lies off the line, there is no section.
    met = [row for row, cut in enumerate(near) if len(cut)]
    if len(line) > 2:
        line = line[[0, *(row + 1 for row in met), -1]]
    inner, near = [inner[row] for row in met], [near[row] for row in met]
    across = 0.5 * _INSIDE * width * np.linspace(-1.0, 1.0, _ACROSS)
    surfaces = [_surfaces(cut, across) for cut in near]
    at = np.array([station for station, _, _ in inner])
    undersides = np.array([underside for underside, _, _ in surfaces])
    slopes = np.array([slope for _, slope, _ in surfaces])
    tops = np.array([top for _, _, top in surfaces])
    total = float(stations[-1])
    ends_at, undersides = _to_the_ends(at, undersides, 0.0, total)
    _, slopes = _to_the_ends(at, slopes, 0.0, total)
    _, tops = _to_the_ends(at, tops, 0.0, total)
    points = line if len(ends_at) == len(line) else np.array([line[0], line[-1]])
    depths = tops - undersides[:, None] - slopes[:, None] * across
    height = float(np.median(depths[:, 1:-1]))
    axes = OwnAxes(ends_at, points, total, width, 0.0, height, undersides, slopes, across, tops, ())
    return OwnAxes(
        ends_at,
        points,
        total,
        width,
        0.0,
        height,
        undersides,
        slopes,
        across,
        tops,
        tuple(_by_height(axes, station, cut) for station, cut in zip(at, near, strict=True)),
    )


def _cut(corners: FloatArray, point: FloatArray, way: FloatArray) -> FloatArray:
    """Return the sides (c, 2, 2) of the section across a way (2,) through a point on plan (2,): across it, and up."""
    offsets = corners[..., :2] - point
    turned = np.stack((dot(offsets, way), cross_2d(way, offsets), corners[..., 2]), axis=-1)
    _, ends = plane_cuts(turned, 0, 0.0)
    return ends[..., 1:]


def _surfaces(section: FloatArray, across: FloatArray) -> tuple[float, float, FloatArray]:
    """Return height and slope of the underside of a section at its middle, and its top (a,), at points across it."""
    heights = [_heights_at(section, position) for position in across]
    crossed = np.array([len(found) > 0 for found in heights])
    if not crossed.any():  # what is cut here is narrower than usual, and off the line
        low, high = float(section[..., 1].min()), float(section[..., 1].max())
        return low, 0.0, np.full(len(across), high)
    at = across[crossed]
    lows = np.array([min(found) for found in heights if len(found)])
    highs = np.array([max(found) for found in heights if len(found)])
    slope = _slope(at, highs)
    for _ in range(2):
        level = lows - slope * at
        near = level - level.min() <= _NEAR_UNDERSIDE * float(np.median(highs - lows))
        slope = _slope(at[near], lows[near])
    # Between two points the underside may be lower yet.
    underside = float((section[..., 1] - slope * section[..., 0]).min())
    usual = float(np.median(highs - slope * at))
    depth = usual - underside
    limited = np.clip(highs - slope * at, usual - _STEPPED * depth, usual + _STEPPED * depth) + slope * at
    return underside, slope, np.interp(across, at, limited)


def _heights_at(section: FloatArray, across_m: float) -> list[float]:
    first, other = section[:, 0], section[:, 1]
    before, after = first[:, 0] - across_m, other[:, 0] - across_m
    crossed = (before > 0.0) != (after > 0.0)
    share = before[crossed] / (before[crossed] - after[crossed])
    found: list[float] = (first[crossed, 1] + share * (other[crossed, 1] - first[crossed, 1])).tolist()
    return found


def _slope(at: FloatArray, values: FloatArray) -> float:
    """Return the slope of the straight line nearest to values."""
    off = at - at.mean()
    squares = float((off * off).sum())
    return float((off * (values - values.mean())).sum()) / squares if squares > 0.0 else 0.0


def _by_height(axes: OwnAxes, station: float, section: FloatArray) -> FloatArray:
    """Return the sides (c, 2, 2) of a section by t and h."""
    flat = section.reshape(-1, 2)
    underside, top = axes._underside_and_top(np.full(len(flat), station), flat[:, 0])
    h = axes.height_m * (flat[:, 1] - underside) / (top - underside)
    return np.column_stack((flat[:, 0], h)).reshape(section.shape)


def _width(section: FloatArray, height_m: float) -> float:
    """Return how wide a section (c, 2, 2) is at a height, without what is hollow."""
    at = np.sort(list(_crossings(section, height_m)))
    return float((at[1::2] - at[: len(at) // 2 * 2 : 2]).sum())


def _crossings(section: FloatArray, height_m: float) -> Iterator[float]:
    yield from _heights_at(section[..., ::-1], height_m)


_ALIKE = 1.0 - 1e-9


def longer_side(points: FloatArray) -> FloatArray:
    """Return the direction (2,) of the longer side of the smallest rectangle around points (n, 2)."""
    middle = points.mean(axis=0)
    (corners,) = CrossSection.hull_points(points - middle).to_polygons()
    sides = np.roll(corners, -1, axis=0) - corners
    best_area, best = math.inf, np.array([1.0, 0.0])
    for side in unit(sides):
        long, wide = float(np.ptp(dot(corners, side))), float(np.ptp(cross_2d(side, corners)))
        if long * wide < best_area * _ALIKE:
            best_area = long * wide
            best = side if long >= wide * _ALIKE else np.array([-side[1], side[0]])
    return best
