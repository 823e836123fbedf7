"""Curves that bridges are laid out along: polylines, and alignments of lines, arcs and clothoids with their gradients.

They are worked out here, as the geometry library crashes on some of them. IFC 4.3, 8.9.3.5 and 8.9.3.35: a segment
starts at its placement, along its direction; a negative length runs along its parent backwards, to the right on a
circle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ..engineering.geometry.vectors import length, unit
from ..errors import GeometryError

_STEPS = 64
"""Steps over which the direction of a clothoid is added up, by Simpson's rule."""

_DEEPEST = 10
_FLAT = 1e-12


@dataclass(frozen=True, slots=True)
class CurveFrame:
    """Directions along a curve, to its left and upwards, and the point on it, (3,) each."""

    along: np.ndarray
    left: np.ndarray
    up: np.ndarray
    point: np.ndarray


@dataclass(frozen=True, slots=True)
class Curve:
    """A curve: its frame at a distance along it, m, and the distances at which it has corners."""

    at: Callable[[float], CurveFrame]
    corners_m: np.ndarray


def curve_of(entity: Any, unit_m: float, deepest: int = _DEEPEST) -> Curve:
    """Return a curve of a file with its unit of length in metres; a `GeometryError` names a kind not known."""
    if deepest <= 0:
        raise GeometryError("runs along a curve that lies on itself")
    if entity.is_a("IfcPolyline") or entity.is_a("IfcIndexedPolyCurve"):
        return _polyline(points_of(entity) * unit_m)
    if entity.is_a("IfcGradientCurve"):
        return _with_gradient(entity, unit_m)
    if entity.is_a("IfcCompositeCurve"):
        plan = _Plan.of(entity, unit_m)
        return Curve(lambda along: _level_frame(*plan.at(along), 0.0, 0.0), np.zeros(0))
    if entity.is_a("IfcOffsetCurveByDistances"):
        return _offset(entity, unit_m, deepest)
    raise GeometryError(f"runs along a curve of the kind {entity.is_a()}")


def points_of(curve: Any) -> np.ndarray:
    """Return the points (n, 2 or 3) of a curve of straight lines, in the file's unit."""
    if curve.is_a("IfcPolyline"):
        return np.array([point.Coordinates for point in curve.Points], dtype=float)
    if curve.is_a("IfcIndexedPolyCurve"):
        return np.array(curve.Points.CoordList, dtype=float)
    raise GeometryError(f"has a curve of the kind {curve.is_a()}")


def place_along(point: Any, unit_m: float) -> np.ndarray:
    """Return how far along a curve a point is, to its left and above it, (3,), m."""
    along = plain_number(point.DistanceAlong) + (getattr(point, "OffsetLongitudinal", None) or 0.0)
    offsets = [getattr(point, name, None) or 0.0 for name in ("OffsetLateral", "OffsetVertical")]
    return np.array((along, *offsets), dtype=float) * unit_m


def plain_number(value: Any) -> float:
    """Return a number that may have a type of IFC around it."""
    return float(getattr(value, "wrappedValue", value))


def _polyline(points: np.ndarray) -> Curve:
    points = np.column_stack((points, np.zeros(len(points)))) if points.shape[1] == 2 else points
    steps = length(np.diff(points, axis=0))
    if len(points) < 2 or not (steps > 0.0).all():
        raise GeometryError("runs along a polyline with a side of no length")
    along, ways = np.concatenate([[0.0], np.cumsum(steps)]), unit(np.diff(points, axis=0))

    def at(along_m: float) -> CurveFrame:
        row = int(np.clip(np.searchsorted(along, along_m, side="right") - 1, 0, len(ways) - 1))
        return _frame(ways[row], points[row] + ways[row] * (along_m - along[row]))

    return Curve(at, along[1:-1])


def _frame(way: np.ndarray, point: np.ndarray) -> CurveFrame:
    left = unit(np.array((-way[1], way[0], 0.0)))
    return CurveFrame(way, left, np.cross(way, left), point)


def _level_frame(x: float, y: float, heading: float, z: float, slope: float) -> CurveFrame:
    return _frame(unit(np.array((math.cos(heading), math.sin(heading), slope))), np.array((x, y, z)))


@dataclass(frozen=True, slots=True)
class _Segment:
    """A segment of a plan: where it starts, its heading there, rad, its length, and its curvature, 1/m, along it."""

    start_m: float
    point: tuple[float, float]
    heading: float
    length_m: float
    curvature: Callable[[np.ndarray], np.ndarray]

    def at(self, along_m: float) -> tuple[float, float, float]:
        """Return position and heading at a distance from the beginning of the curve."""
        way = np.linspace(0.0, along_m - self.start_m, 2 * _STEPS + 1)
        step = way[1] - way[0]
        bends = self.curvature(way)
        turned = np.concatenate([[0.0], np.cumsum((bends[1:] + bends[:-1]) * step / 2.0)])
        headings = self.heading + turned
        weights = np.ones(len(way))
        weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
        x = self.point[0] + float((weights * np.cos(headings)).sum() * step / 3.0)
        y = self.point[1] + float((weights * np.sin(headings)).sum() * step / 3.0)
        return x, y, float(headings[-1])


@dataclass(frozen=True, slots=True)
class _Plan:
    """An alignment in plan."""

    segments: tuple[_Segment, ...]

    @classmethod
    def of(cls, entity: Any, unit_m: float) -> _Plan:
        """Return the plan of a composite curve of curve segments."""
        segments: list[_Segment] = []
        start_m = 0.0
        for part in entity.Segments:
            if not part.is_a("IfcCurveSegment"):
                raise GeometryError(f"runs along a curve with parts of the kind {part.is_a()}")
            signed_m = plain_number(part.SegmentLength) * unit_m
            if abs(signed_m) <= _FLAT:
                continue  # an end that only closes the curve
            heading, point = _placed(part.Placement)
            at = (point[0] * unit_m, point[1] * unit_m)
            segments.append(_Segment(start_m, at, heading, abs(signed_m), _curvature(part, signed_m, unit_m)))
            start_m += abs(signed_m)
        if not segments:
            raise GeometryError("runs along a curve without a length")
        return cls(tuple(segments))

    def at(self, along_m: float) -> tuple[float, float, float]:
        """Return position and heading at a distance along it; beyond its ends its first or last segment goes on."""
        segment = next((part for part in reversed(self.segments) if part.start_m <= along_m), self.segments[0])
        return segment.at(along_m)


def _curvature(part: Any, signed_m: float, unit_m: float) -> Callable[[np.ndarray], np.ndarray]:
    parent, way = part.ParentCurve, math.copysign(1.0, signed_m)
    if parent.is_a("IfcLine") or parent.is_a("IfcPolyline"):
        return np.zeros_like
    if parent.is_a("IfcCircle"):
        bend = way / (parent.Radius * unit_m)
        return lambda along: np.full_like(along, bend)
    if parent.is_a("IfcClothoid"):
        constant = parent.ClothoidConstant * unit_m
        rate = constant / abs(constant) ** 3
        first = plain_number(part.SegmentStart) * unit_m
        return lambda along: way * rate * (first + way * along)
    raise GeometryError(f"runs along a curve with parts of the kind {parent.is_a()}")


def _placed(placement: Any) -> tuple[float, tuple[float, float]]:
    """Return direction, rad, and position of a placement in plan."""
    ratios = placement.RefDirection.DirectionRatios if placement.RefDirection else (1.0, 0.0)
    x, y = placement.Location.Coordinates[:2]
    return math.atan2(ratios[1], ratios[0]), (x, y)


def _with_gradient(entity: Any, unit_m: float) -> Curve:
    plan = _Plan.of(entity.BaseCurve, unit_m)
    heights = _heights(entity, unit_m)

    def at(along_m: float) -> CurveFrame:
        x, y, heading = plan.at(along_m)
        return _level_frame(x, y, heading, *heights(along_m))

    return Curve(at, np.zeros(0))


def _heights(entity: Any, unit_m: float) -> Callable[[float], tuple[float, float]]:
    """Return height and slope at distances along the plan of a gradient curve."""
    parts: list[tuple[float, float, float, Any]] = []
    for part in entity.Segments:
        if abs(plain_number(part.SegmentLength)) <= _FLAT:
            continue
        heading, (start, height) = _placed(part.Placement)
        parts.append((start * unit_m, height * unit_m, heading, part))
    if not parts:
        raise GeometryError("runs along a curve without heights")

    rows = [
        (start, height, _heading_that_meets(part, heading, height, ahead, unit_m), part)
        for (start, height, heading, part), ahead in zip(parts, _aheads(parts), strict=True)
    ]

    def at(along_m: float) -> tuple[float, float]:
        start, height, heading, part = next((row for row in reversed(rows) if row[0] <= along_m), rows[0])
        return _on_vertical(part, along_m - start, height, heading, unit_m)

    return at


def _aheads(parts: list[tuple[float, float, float, Any]]) -> list[tuple[float, float] | None]:
    """Return how far from the beginning of each part, and how high, the next one begins; None for the last."""
    following = [(after[0] - before[0], after[1]) for before, after in pairwise(parts)]
    return [*following, None]


def _heading_that_meets(
    part: Any, heading: float, height: float, ahead: tuple[float, float] | None, unit_m: float
) -> float:
    """Return the direction in which a vertical segment begins, rad.

    By the standard it is the heading of its placement. Some programs leave the parabola's own slope in its
    coefficients, and its placement level: that counts where the segment then ends where the next one begins.
    """
    parent = part.ParentCurve
    if ahead is None or not parent.is_a("IfcPolynomialCurve"):
        return heading
    coefficients = list(parent.CoefficientsY or ())
    own = math.atan(math.tan(heading) + (coefficients[1] if len(coefficients) > 1 else 0.0))
    return min((heading, own), key=lambda way: abs(_on_vertical(part, ahead[0], height, way, unit_m)[0] - ahead[1]))


def _on_vertical(part: Any, x: float, height: float, heading: float, unit_m: float) -> tuple[float, float]:
    """Return height and slope at a horizontal distance from the beginning of a vertical segment."""
    parent, slope = part.ParentCurve, math.tan(heading)
    if parent.is_a("IfcLine") or parent.is_a("IfcPolyline"):
        return height + slope * x, slope
    if parent.is_a("IfcPolynomialCurve"):
        coefficients = list(parent.CoefficientsY or ())
        if len(coefficients) > 3:
            raise GeometryError("runs along a curve whose heights are no parabola")
        bend = (coefficients[2] if len(coefficients) > 2 else 0.0) / unit_m
        return height + slope * x + bend * x * x, slope + 2.0 * bend * x
    if parent.is_a("IfcCircle"):
        bend = math.copysign(1.0, plain_number(part.SegmentLength)) / (parent.Radius * unit_m)
        sine = min(max(math.sin(heading) + bend * x, -1.0), 1.0)
        cosine = math.sqrt(1.0 - sine * sine)
        return height + (math.cos(heading) - cosine) / bend, sine / max(cosine, _FLAT)
    raise GeometryError(f"runs along a curve with heights of the kind {parent.is_a()}")


def _offset(entity: Any, unit_m: float, deepest: int) -> Curve:
    """Return a curve offset from another one, whose distances are counted from its first offset on."""
    basis = curve_of(entity.BasisCurve, unit_m, deepest - 1)
    places = np.array([place_along(point, unit_m) for point in entity.OffsetValues])
    order = np.argsort(places[:, 0], kind="stable")
    stations, left, up = places[order].T

    def at(along_m: float) -> CurveFrame:
        on = along_m + stations[0]
        frame = basis.at(on)
        beside, above = float(np.interp(on, stations, left)), float(np.interp(on, stations, up))
        point = frame.point + beside * frame.left + above * np.array((0.0, 0.0, 1.0))
        return CurveFrame(frame.along, frame.left, frame.up, point)

    return Curve(at, basis.corners_m - stations[0])
