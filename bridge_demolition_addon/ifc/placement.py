"""Where the bridge stands in a scenario: x along the road from its beginning, y across it from its middle, z up."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.own_axes import longer_side
from ..engineering.geometry.vectors import transformed, turn_in_plane

_ON_AXIS_RAD = 1e-7
"""Angle below which a bridge runs along an axis of its file, and its coordinates are kept to the last digit."""

_QUARTERS = {0: ((1.0, 0.0), (0.0, 1.0)), 1: ((0.0, 1.0), (-1.0, 0.0)), -1: ((0.0, -1.0), (1.0, 0.0))}
"""Rotations back by a quarter, exact to the last digit."""


@dataclass(frozen=True, slots=True)
class Placement:
    """Transformation of positions in a file to positions in the scenario.

    The road's angle in the file's plan is counted anticlockwise from its x axis, from -π/2 to π/2. The point (3,) of
    the file is the origin of the scenario.
    """

    angle_rad: float
    origin_m: np.ndarray

    @property
    def turn(self) -> np.ndarray:
        """Matrix (2, 2) that turns plan vectors of the file into plan vectors of the scenario."""
        quarters = round(self.angle_rad / (math.pi / 2.0))
        if abs(self.angle_rad - quarters * math.pi / 2.0) < _ON_AXIS_RAD:
            return np.array(_QUARTERS[quarters])
        return turn_in_plane(-self.angle_rad)

    def placed(self, solid: TriangleMesh) -> TriangleMesh:
        """Return a solid of the file in its place in the scenario."""
        vertices = solid.vertices - self.origin_m
        vertices[:, :2] = transformed(self.turn, vertices[:, :2])
        return TriangleMesh(vertices, solid.triangles)


def placement_of(along_road: Sequence[TriangleMesh], ground_m: float) -> Placement:
    """Return where a bridge stands, with the height of the ground in the file, m.

    The road runs along the longer side of the smallest rectangle around the plan of the members that carry it.
    """
    points = np.concatenate([solid.vertices[:, :2] for solid in along_road])
    angle = _longer_side(points)
    unmoved = Placement(angle, np.zeros(3))
    turned = transformed(unmoved.turn, points)
    lowest, highest = turned.min(axis=0), turned.max(axis=0)
    beginning = np.array((lowest[0], (lowest[1] + highest[1]) / 2.0))
    return Placement(angle, np.append(transformed(unmoved.turn.T, beginning), ground_m))


def _longer_side(points: np.ndarray) -> float:
    """Return the direction of the longer side of the smallest rectangle around points (n, 2), in rad."""
    along = longer_side(points)
    angle = float(np.arctan2(along[1], along[0]))
    return -(((math.pi / 2.0 - angle) % math.pi) - math.pi / 2.0)
