"""Outlines of sections: polygons in the plane of a section, with what follows from their shape alone.

A section is one or more polygons (k, 2) in m, along its y and z: outer ones run anticlockwise, holes clockwise. A
rounded corner is one side at 45° that takes or leaves the same area: the second moments of rolled sections are then off
by less than 0.1 %, and a body with this outline has just the mass of the section.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..geometry.plan_areas import signed_area
from ..geometry.vectors import length

_CUT_BY_RADIUS = math.sqrt(2.0 - math.pi / 2.0)
"""Leg of the triangle that has the area between a right angle and an arc in it, by the radius: r² (1 - π / 4)."""

_HALVINGS = 80


@dataclass(frozen=True, slots=True, eq=False)
class PlaneShape:
    """What follows from an outline whose centre is the origin."""

    area_m2: float
    second_moments_m4: FloatArray  # (2, 2), ∫ z² dA and ∫ y² dA on the diagonal, -∫ y z dA off it
    elastic_moduli_m3: FloatArray  # (2,), about y and z, by the edge that is farther away
    plastic_moduli_m3: FloatArray  # (2,), about axes along y and z


def about_centre(rings: Sequence[FloatArray]) -> tuple[FloatArray, ...]:
    """Return an outline moved so that its centre is the origin."""
    areas = np.array([signed_area(ring) for ring in rings])
    moments = np.array([_first_moments(ring) for ring in rings])
    centre = moments.sum(axis=0) / areas.sum()
    return tuple(ring - centre for ring in rings)


def plane_shape(rings: Sequence[FloatArray]) -> PlaneShape:
    """Return area and moments of an outline about its centre, which is the origin."""
    area = math.fsum(float(signed_area(ring)) for ring in rings)
    integrals = np.array([_second_integrals(ring) for ring in rings]).sum(axis=0)
    yy, yz, zz = integrals.tolist()
    farthest = np.abs(np.concatenate(rings)).max(axis=0)
    return PlaneShape(
        area_m2=area,
        second_moments_m4=np.array([[zz, -yz], [-yz, yy]]),
        elastic_moduli_m3=np.array([zz / farthest[1], yy / farthest[0]]),
        plastic_moduli_m3=np.array([_plastic_modulus(rings, area, axis) for axis in (1, 0)]),
    )


def rectangle(width_m: float, height_m: float, middle_m: tuple[float, float] = (0.0, 0.0)) -> FloatArray:
    """Return the corners of a rectangle, anticlockwise."""
    corners = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    return np.asarray(corners * (width_m, height_m) + middle_m)


def rounded(corners: Sequence[tuple[float, float]], radii_m: Sequence[float]) -> FloatArray:
    """Return a polygon whose right angles (k,) are rounded by radii, each as one side that has the same area."""
    points = np.array(corners, float)
    ring = []
    for index, radius in enumerate(radii_m):
        corner = points[index]
        if radius == 0.0:
            ring.append(corner)
            continue
        for neighbour in (points[index - 1], points[(index + 1) % len(points)]):
            side = neighbour - corner
            ring.append(corner + side * (_CUT_BY_RADIUS * radius / float(length(side))))
    return np.array(ring)


def _first_moments(ring: FloatArray) -> FloatArray:
    following = np.roll(ring, -1, axis=0)
    doubled = ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]
    return np.asarray((doubled[:, None] * (ring + following)).sum(axis=0) / 6.0)


def _second_integrals(ring: FloatArray) -> tuple[float, float, float]:
    """∫ y² dA, ∫ y z dA and ∫ z² dA over a polygon."""
    y, z = ring.T
    y2, z2 = np.roll(ring, -1, axis=0).T
    doubled = y * z2 - z * y2
    yy = (doubled * (y * y + y * y2 + y2 * y2)).sum() / 12.0
    zz = (doubled * (z * z + z * z2 + z2 * z2)).sum() / 12.0
    yz = (doubled * (y * z2 + 2.0 * (y * z + y2 * z2) + y2 * z)).sum() / 24.0
    return float(yy), float(yz), float(zz)


def _plastic_modulus(rings: Sequence[FloatArray], area: float, axis: int) -> float:
    """Return ∫ |c - c₀| dA, where half of the area lies at a coordinate c above c₀."""
    values = np.concatenate(rings)[:, axis]
    low, high = float(values.min()), float(values.max())
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if _above(rings, axis, middle)[0] > 0.5 * area:
            low = middle
        else:
            high = middle
    above, moment = _above(rings, axis, low)
    # About the centre the two halves have moments of the same size, and of other signs.
    return 2.0 * moment - low * (2.0 * above - area)


def _above(rings: Sequence[FloatArray], axis: int, level: float) -> tuple[float, float]:
    """Area above a level of a coordinate, and its first moment about 0."""
    parts = [_clipped(ring, axis, level) for ring in rings]
    parts = [part for part in parts if len(part)]
    area = math.fsum(float(signed_area(part)) for part in parts)
    return area, math.fsum(float(_first_moments(part)[axis]) for part in parts)


def _clipped(ring: FloatArray, axis: int, level: float) -> FloatArray:
    """Part of a polygon above a level; where it falls into several, thin bridges without area join them."""
    kept: list[FloatArray] = []
    for corner, following in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        begin, end = float(corner[axis]) - level, float(following[axis]) - level
        if begin >= 0.0:
            kept.append(corner)
        if (begin >= 0.0) != (end >= 0.0):
            kept.append(corner + (following - corner) * (begin / (begin - end)))
    return np.array(kept)
