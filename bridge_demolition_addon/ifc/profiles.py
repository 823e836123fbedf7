"""Outlines of profiles that bodies are swept with: closed areas, and sheets of one thickness along a line."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..engineering.geometry.plan_areas import signed_area
from ..engineering.geometry.vectors import length, unit
from ..errors import GeometryError
from .alignments import points_of

_CHORD_M = 0.001
"""Largest distance of the middle of a chord from its arc."""

_SAME = 1e-6
"""Part of the size of a profile within which points are one."""

_SHARPEST = 0.2
"""Least cosine of half the angle by which the line of a sheet turns, so that its corners do not run away."""


def outline_of(profile: Any, unit_m: float) -> np.ndarray:
    """Return the corners (k, 2) of a profile, anticlockwise, m; a `GeometryError` names a kind not known."""
    if profile.is_a("IfcRectangleProfileDef"):
        x, y = profile.XDim * unit_m / 2.0, profile.YDim * unit_m / 2.0
        corners = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
    elif profile.is_a("IfcCenterLineProfileDef"):
        corners = _sheet(_line(profile.Curve, unit_m), profile.Thickness * unit_m)
    elif profile.is_a("IfcArbitraryClosedProfileDef") and not profile.is_a("IfcArbitraryProfileDefWithVoids"):
        corners = _line(profile.OuterCurve, unit_m)
    else:
        raise GeometryError(f"has sections of the kind {profile.is_a()}")
    if len(corners) > 1 and np.array_equal(corners[0], corners[-1]):
        corners = corners[:-1]
    if len(corners) < 3:
        raise GeometryError("has a section with less than three corners")
    return corners if signed_area(corners) > 0.0 else corners[::-1]


def _line(curve: Any, unit_m: float) -> np.ndarray:
    """Return the points (n, 2) of a curve in the plane of a profile, m."""
    if curve.is_a("IfcTrimmedCurve"):
        return _arc(curve, unit_m)
    if not curve.is_a("IfcCompositeCurve"):
        return points_of(curve)[:, :2] * unit_m
    parts = [_line(segment.ParentCurve, unit_m) for segment in curve.Segments]
    return _chained(parts)


def _chained(parts: list[np.ndarray]) -> np.ndarray:
    """Return parts as one line, each turned so that it goes on where the one before it ends.

    Which way parts run is not taken from the file: some programs say that all of them are turned round.
    """
    if len(parts) > 1:
        ends = parts[1][[0, -1]]
        gaps = [float(length(ends - end).min()) for end in (parts[0][0], parts[0][-1])]
        parts = [parts[0][::-1] if gaps[0] < gaps[1] else parts[0], *parts[1:]]
    line = parts[0]
    for part in parts[1:]:
        first, last = length(part[[0, -1]] - line[-1]).tolist()
        line = np.concatenate([line, (part if first <= last else part[::-1])])
    size = float(np.ptp(line, axis=0).max())
    kept = [True, *(length(np.diff(line, axis=0)) > _SAME * size).tolist()]
    line = line[kept]
    return line[:-1] if len(line) > 2 and float(length(line[-1] - line[0])) <= _SAME * size else line


def _arc(curve: Any, unit_m: float) -> np.ndarray:
    """Return the points (n, 2) of an arc of a circle between two points, m."""
    circle = curve.BasisCurve
    if not circle.is_a("IfcCircle"):
        raise GeometryError(f"has a curve of the kind {circle.is_a()}")
    centre = np.array(circle.Position.Location.Coordinates[:2], dtype=float) * unit_m
    radius = float(circle.Radius) * unit_m
    ends = [_trimmed_at(trims, circle, centre, unit_m) for trims in (curve.Trim1, curve.Trim2)]
    start, end = (math.atan2(*(point - centre)[::-1]) for point in ends)
    turn = (end - start) % math.tau if curve.SenseAgreement else -((start - end) % math.tau)
    step = 2.0 * math.acos(max(0.5, 1.0 - _CHORD_M / radius))
    angles = start + turn * np.linspace(0.0, 1.0, max(2, math.ceil(abs(turn) / step) + 1))
    return centre + radius * np.column_stack((np.cos(angles), np.sin(angles)))


def _trimmed_at(trims: Any, circle: Any, centre: np.ndarray, unit_m: float) -> np.ndarray:
    for trim in trims:
        if hasattr(trim, "Coordinates"):
            return np.array(trim.Coordinates[:2], dtype=float) * unit_m
    raise GeometryError("has an arc without points at its ends")


def _sheet(line: np.ndarray, thickness_m: float) -> np.ndarray:
    """Return the outline of a sheet of one thickness, of which a line (n, 2) is the middle."""
    if len(line) < 2:
        raise GeometryError("has a sheet along a line of no length")
    ways = unit(np.diff(line, axis=0))
    left = np.column_stack((-ways[:, 1], ways[:, 0]))
    before, after = np.vstack([left[:1], left]), np.vstack([left, left[-1:]])
    middle = unit(before + after)
    cosines = np.maximum((middle * before).sum(axis=1), _SHARPEST)
    beside = middle * (thickness_m / 2.0 / cosines)[:, None]
    return np.concatenate([line - beside, (line + beside)[::-1]])
