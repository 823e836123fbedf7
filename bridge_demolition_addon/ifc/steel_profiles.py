"""Profiles of an IFC file as sections of steel bars: by their sizes where these are given, else by their outline."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..engineering.steelwork.named_sections import PlacedSection, moved, placed_by_sizes
from ..errors import GeometryError, ScenarioError

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

    Lengths in the file are in units of so many metres.

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


def _angle(profile: Any) -> _Sized:
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
    ("IfcLShapeProfileDef", _angle),
    ("IfcUShapeProfileDef", _channel_or_tee),
    ("IfcTShapeProfileDef", _channel_or_tee),
)
"""Kinds of profiles that have sizes, those first that are of another one as well."""
