"""Outlines of profiles that bodies are swept with: closed areas, and sheets of one thickness along a line.

As sections of steel bars they are known by their sizes where these are given, else by their outline.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..engineering.geometry.plan_areas import signed_area
from ..engineering.geometry.vectors import length, unit
from ..engineering.steelwork.named_sections import PlacedSection, moved, placed_by_sizes
from ..errors import GeometryError, ScenarioError
from .alignments import plain_number, points_of

_CHORD_M = 0.001
"""Largest distance of the middle of a chord from its arc."""

_SAME = 1e-6
"""Part of the size of a profile within which points are one."""

_SHARPEST = 0.2
"""Least cosine of half the angle by which the line of a sheet turns, so that its corners do not run away."""


def outline_of(profile: Any, unit_m: float, angle_rad: float) -> np.ndarray:
    """Return the corners (k, 2) of a profile, anticlockwise, m; a `GeometryError` names a kind not known.

    The file's units of length and angle are given in metres and radians.
    """
    if profile.is_a("IfcRectangleProfileDef"):
        x, y = profile.XDim * unit_m / 2.0, profile.YDim * unit_m / 2.0
        corners = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
    elif profile.is_a("IfcCenterLineProfileDef"):
        corners = _sheet(line_of(profile.Curve, unit_m, angle_rad), profile.Thickness * unit_m)
    elif profile.is_a("IfcArbitraryClosedProfileDef") and not profile.is_a("IfcArbitraryProfileDefWithVoids"):
        corners = line_of(profile.OuterCurve, unit_m, angle_rad)
    else:
        raise GeometryError(f"has sections of the kind {profile.is_a()}")
    if len(corners) > 1 and np.array_equal(corners[0], corners[-1]):
        corners = corners[:-1]
    if len(corners) < 3:
        raise GeometryError("has a section with less than three corners")
    return corners if signed_area(corners) > 0.0 else corners[::-1]


def line_of(curve: Any, unit_m: float, angle_rad: float) -> np.ndarray:
    """Return the points (n, 2) of a curve in the plane of a profile, m; a `GeometryError` names a kind not known."""
    if curve.is_a("IfcTrimmedCurve"):
        return _arc(curve, unit_m, angle_rad)
    if not curve.is_a("IfcCompositeCurve"):
        return points_of(curve)[:, :2] * unit_m
    parts = [line_of(segment.ParentCurve, unit_m, angle_rad) for segment in curve.Segments]
    return _chained(parts)


def _chained(parts: list[np.ndarray]) -> np.ndarray:
    """Return parts as one line, each where the one before it ends, and turned so that it goes on from there.

    Neither the order of parts nor which way they run is taken from the file: some programs say that all of them are
    turned round.
    """
    line, rest = parts[0], parts[1:]
    if rest and _nearest(line[0], rest)[0] < _nearest(line[-1], rest)[0]:
        line = line[::-1]
    while rest:
        _, row, is_turned = _nearest(line[-1], rest)
        part = rest.pop(row)
        line = np.concatenate([line, part[::-1] if is_turned else part])
    size = float(np.ptp(line, axis=0).max())
    line = line[[True, *(length(np.diff(line, axis=0)) > _SAME * size).tolist()]]
    return line[:-1] if len(line) > 2 and float(length(line[-1] - line[0])) <= _SAME * size else line


def _nearest(point: np.ndarray, parts: list[np.ndarray]) -> tuple[float, int, bool]:
    """Return the distance of the nearest end of parts from a point, the part's row, and whether that is its last."""
    ends = ((float(length(part[end] - point)), row, end == -1) for row, part in enumerate(parts) for end in (0, -1))
    return min(ends)


def _arc(curve: Any, unit_m: float, angle_rad: float) -> np.ndarray:
    """Return the points (n, 2) of an arc of a circle, m."""
    circle = curve.BasisCurve
    if not circle.is_a("IfcCircle"):
        raise GeometryError(f"has a curve of the kind {circle.is_a()}")
    centre = np.array(circle.Position.Location.Coordinates[:2], dtype=float) * unit_m
    radius = float(circle.Radius) * unit_m
    start, end = (_angle(trims, circle, centre / unit_m, angle_rad) for trims in (curve.Trim1, curve.Trim2))
    turn = (end - start) % math.tau if curve.SenseAgreement else -((start - end) % math.tau)
    step = 2.0 * math.acos(max(0.5, 1.0 - _CHORD_M / radius))
    angles = start + (turn or math.tau) * np.linspace(0.0, 1.0, max(2, math.ceil(abs(turn or math.tau) / step) + 1))
    return centre + radius * np.column_stack((np.cos(angles), np.sin(angles)))


def _angle(trims: Any, circle: Any, centre: np.ndarray, angle_rad: float) -> float:
    """Return the direction of an end of an arc from its centre, given as a point or an angle."""
    for trim in trims:
        if hasattr(trim, "Coordinates"):
            x, y = np.array(trim.Coordinates[:2], dtype=float) - centre
            return math.atan2(y, x)
    ratios = circle.Position.RefDirection.DirectionRatios if circle.Position.RefDirection else (1.0, 0.0)
    return math.atan2(ratios[1], ratios[0]) + plain_number(trims[0]) * angle_rad


def _sheet(line: np.ndarray, thickness_m: float) -> np.ndarray:
    """Return the outline of a sheet of one thickness around its middle line (n, 2)."""
    if len(line) < 2:
        raise GeometryError("has a sheet along a line of no length")
    ways = unit(np.diff(line, axis=0))
    left = np.column_stack((-ways[:, 1], ways[:, 0]))
    before, after = np.vstack([left[:1], left]), np.vstack([left, left[-1:]])
    middle = unit(before + after)
    cosines = np.maximum((middle * before).sum(axis=1), _SHARPEST)
    beside = middle * (thickness_m / 2.0 / cosines)[:, None]
    return np.concatenate([line - beside, (line + beside)[::-1]])


_OUTLINES = ("IfcArbitraryClosedProfileDef", "IfcCenterLineProfileDef", "IfcCompositeProfileDef")
"""Profiles that have no sizes: what is cut through the body says what they are."""

_LEAST_STRETCH = 1e-6


@dataclass(frozen=True, slots=True)
class _Plane:
    """How the plane of a profile lies in another one: its x axis (2,), its origin (2,), and whether it is mirrored."""

    x_axis: np.ndarray
    origin_m: np.ndarray
    mirrored: bool = False


def section_of_profile(profile: Any, unit_m: float) -> PlacedSection | None:
    """Return the section of a profile by its sizes; None for one that has an outline alone.

    The file's unit of length is given in metres.

    Raises
    ------
    GeometryError
        It is of no kind that bars of steel have here, or its sizes contradict each other.
    """
    if profile.is_a("IfcDerivedProfileDef"):
        inner = section_of_profile(profile.ParentProfile, unit_m)
        return inner and _placed_in(inner, _derived(profile, unit_m))
    if any(profile.is_a(name) for name in _OUTLINES):
        return None
    found = next((read for name, read in _SIZES if profile.is_a(name)), None)
    if found is None:
        raise GeometryError(f"has a profile of the kind {profile.is_a()}")
    shape, sizes, radius = found(profile)
    try:
        placed = placed_by_sizes(shape, [unit_m * size for size in sizes], radius and unit_m * radius)
    except ScenarioError as error:
        raise GeometryError(f"has a profile whose sizes contradict each other ({error})") from error
    return _placed_in(placed, _own_plane(profile, unit_m))


def _placed_in(placed: PlacedSection, plane: _Plane) -> PlacedSection:
    return moved(placed, plane.x_axis, plane.origin_m, mirrored=plane.mirrored)


def _own_plane(profile: Any, unit_m: float) -> _Plane:
    """Plane of a profile with sizes: its `Position`."""
    position = getattr(profile, "Position", None)
    if position is None:
        return _Plane(np.array([1.0, 0.0]), np.zeros(2))
    origin = unit_m * np.array(position.Location.Coordinates[:2], float)
    return _Plane(_unit(position.RefDirection, (1.0, 0.0)), origin)


def _derived(profile: Any, unit_m: float) -> _Plane:
    """Plane of a profile that is another one turned, moved or mirrored."""
    if profile.is_a("IfcMirroredProfileDef"):
        return _Plane(np.array([1.0, 0.0]), np.zeros(2), mirrored=True)
    operator = profile.Operator
    if operator.Scale not in (None, 1.0) or operator.is_a("IfcCartesianTransformationOperator2DnonUniform"):
        raise GeometryError("has a profile that is another one made larger")
    x_axis = _unit(operator.Axis1, (1.0, 0.0))
    upright = _unit(operator.Axis2, (-x_axis[1], x_axis[0]))
    mirrored = bool(x_axis[0] * upright[1] - x_axis[1] * upright[0] < 0.0)
    origin = unit_m * np.array(operator.LocalOrigin.Coordinates[:2], float)
    # Mirrored at its upright axis, a plane has its x axis the other way round.
    return _Plane(-x_axis if mirrored else x_axis, origin, mirrored)


def _unit(direction: Any, otherwise: tuple[float, float]) -> np.ndarray:
    x, y = direction.DirectionRatios[:2] if direction is not None else otherwise
    size = math.sqrt(x * x + y * y)
    if size < _LEAST_STRETCH:
        raise GeometryError("has a profile with a direction of no length")
    return np.array([x / size, y / size])


_Sized = tuple[str, list[float], float | None]
"""A shape of the catalogue, its sizes, and the root radius of an I-section."""


def _asymmetric(profile: Any) -> _Sized:
    """I-section with two flanges; IFC2X3 has it as an I-section with another top flange."""
    bottom = getattr(profile, "BottomFlangeWidth", None) or profile.OverallWidth
    bottom_plate = getattr(profile, "BottomFlangeThickness", None) or profile.FlangeThickness
    top_plate = profile.TopFlangeThickness or bottom_plate
    if (profile.TopFlangeWidth, top_plate) == (bottom, bottom_plate):
        return "I", [profile.OverallDepth, bottom, profile.WebThickness, bottom_plate], None
    sizes = [profile.OverallDepth, profile.WebThickness, profile.TopFlangeWidth, top_plate, bottom, bottom_plate]
    return "PG", sizes, None


def _i_section(profile: Any) -> _Sized:
    sizes = [profile.OverallDepth, profile.OverallWidth, profile.WebThickness, profile.FlangeThickness]
    return "I", sizes, profile.FilletRadius


def _hollow(profile: Any) -> _Sized:
    """Tube with rounded corners where the file gives them a radius; else a welded box."""
    wall = profile.WallThickness
    if profile.OuterFilletRadius:
        return "RHS", [profile.YDim, profile.XDim, wall], None
    return "BOX", [profile.YDim, profile.XDim, wall, wall], None


def _rectangle(profile: Any) -> _Sized:
    return "FLAT", [profile.YDim, profile.XDim], None


def _round_tube(profile: Any) -> _Sized:
    return "CHS", [2.0 * profile.Radius, profile.WallThickness], None


def _angle_section(profile: Any) -> _Sized:
    return "L", [profile.Depth, profile.Width or profile.Depth, profile.Thickness], None


def _channel_or_tee(profile: Any) -> _Sized:
    shape = "U" if profile.is_a("IfcUShapeProfileDef") else "T"
    sizes = [profile.Depth, profile.FlangeWidth, profile.WebThickness, profile.FlangeThickness]
    return shape, sizes, None


_SIZES: tuple[tuple[str, Callable[[Any], _Sized]], ...] = (
    ("IfcAsymmetricIShapeProfileDef", _asymmetric),
    ("IfcIShapeProfileDef", _i_section),
    ("IfcRectangleHollowProfileDef", _hollow),
    ("IfcRectangleProfileDef", _rectangle),
    ("IfcCircleHollowProfileDef", _round_tube),
    ("IfcLShapeProfileDef", _angle_section),
    ("IfcUShapeProfileDef", _channel_or_tee),
    ("IfcTShapeProfileDef", _channel_or_tee),
)
"""Kinds of profiles that have sizes, those first that are of another one as well."""
