"""Sections through a pile: what an upright plane along or across the bridge cuts of the bodies of a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import FEWEST_CORNERS, outlines, united
from ...engineering.terrain.surface import RecordedGround
from ...errors import OutputError
from ..results.arrays import Results
from ..results.motion import MOVED_M, OUT_OF_REACH_M, relative_to_ground, travel
from .footprint import corners_at

_GROUND_STEP_M = 0.5
"""How far apart heights of ground that is not flat are taken."""

_BESIDE_M = 5.0
"""Length of ground that is shown at each side of what is cut."""


class Direction(StrEnum):
    """Which way a section runs; the plane of one is upright.

    Across the bridge it is at a position x, and its widths are along y. Along the bridge it is at a position y, and its
    widths are along x.
    """

    ACROSS = "across"
    ALONG = "along"

    @property
    def normal_axis(self) -> int:
        """Axis of the world that the plane is upright to: 0 for x, 1 for y."""
        return 0 if self is Direction.ACROSS else 1

    @property
    def width_axis(self) -> int:
        """Axis of the world that widths are along."""
        return 1 - self.normal_axis


@dataclass(frozen=True, eq=False, slots=True)
class PileSection:
    """A section at a recorded time. Areas lie in its plane: widths along its direction, then heights, m.

    Attributes
    ----------
    position_m : float
        Where the plane cuts the axis that it is upright to.
    frame, time_s : int, float
        Frame of Blender, and simulated time.
    debris, standing
        Areas of the shards that have moved by more than 0.1 m, and of the others.
    ground_m : (p, 2) float
        The ground below, from the least width to the largest.
    """

    direction: Direction
    position_m: float
    frame: int
    time_s: float
    debris: CrossSection
    standing: CrossSection
    ground_m: np.ndarray

    @property
    def debris_area_m2(self) -> float:
        """Area of the debris that is cut, without the gaps in it."""
        return float(self.debris.area())

    @property
    def debris_width_m(self) -> float:
        """Distance between the two ends of the debris; 0 where none is cut."""
        left, _, right, _ = _bounds(self.debris)
        return right - left

    @property
    def debris_height_m(self) -> float:
        """Largest height of the debris above the ground below it; 0 where none is cut."""
        corners = [ring for ring in outlines(self.debris) if len(ring)]
        if not corners:
            return 0.0
        points = np.concatenate(corners)
        return max(float((points[:, 1] - self.ground_at(points[:, 0])).max()), 0.0)

    @property
    def is_empty(self) -> bool:
        """Whether the plane cuts no shard."""
        return self.debris.is_empty() and self.standing.is_empty()

    def ground_at(self, widths_m: np.ndarray) -> np.ndarray:
        """Return the heights (k,) of the ground at widths (k,), m."""
        return np.interp(widths_m, self.ground_m[:, 0], self.ground_m[:, 1])

    def in_space(self, points_m: np.ndarray) -> np.ndarray:
        """Return points (..., 2) of the plane, width and height, where they are in the world, (..., 3) m."""
        points = np.asarray(points_m, float)
        placed = np.full((*points.shape[:-1], 3), self.position_m)
        placed[..., self.direction.width_axis], placed[..., 2] = points[..., 0], points[..., 1]
        return placed


def pile_section(results: Results, direction: Direction, position_m: float, row: int = -1) -> PileSection:
    """Cut the convex hulls of the shards of a run by an upright plane.

    Parameters
    ----------
    results
        What was recorded, with one frame at least.
    direction
        Which way the section runs.
    position_m
        Position x of a section across the bridge, position y of one along it.
    row
        Recorded frame, counted from 0; by default the last.

    Raises
    ------
    OutputError
        Nothing was recorded.
    """
    if not len(results.frames):
        raise OutputError("section: the run has no recorded frame: run the scenario again")
    results, direction = relative_to_ground(results), Direction(direction)
    shards = results.inventory.of_kind("shard")
    first, now = results.frames.positions_m[0, shards], results.frames.positions_m[row, shards]
    there = first[:, 2] - now[:, 2] <= OUT_OF_REACH_M / 2.0
    moved = travel(first, now) > MOVED_M
    debris, standing = (
        united(_cuts(corners_at(results, row, shards[chosen]), direction, position_m))
        for chosen in (there & moved, there & ~moved)
    )
    return PileSection(
        direction=direction,
        position_m=position_m,
        frame=int(results.frames.number[row]),
        time_s=float(results.frames.time_s[row]),
        debris=debris,
        standing=standing,
        ground_m=_ground_below(results.ground(), direction, position_m, _widths((debris, standing))),
    )


def _cuts(bodies: Sequence[np.ndarray], direction: Direction, position_m: float) -> list[CrossSection]:
    """Return what a plane cuts of the convex hulls of bodies, each (v, 3), in the plane."""
    axes, areas = [direction.width_axis, 2], []
    for corners in bodies:
        offsets = corners[:, direction.normal_axis] - position_m
        above, below = offsets > 0.0, offsets <= 0.0
        if not (above.any() and below.any()):
            continue
        # The plane cuts the hull where it cuts any of the lines between a corner on each side.
        shares = offsets[above, None] / (offsets[above, None] - offsets[None, below])
        starts, ends = corners[above][:, None, axes], corners[below][None, :, axes]
        points = (starts + shares[..., None] * (ends - starts)).reshape(-1, 2)
        if len(points) >= FEWEST_CORNERS:
            areas.append(CrossSection.hull_points(points))
    return [area for area in areas if not area.is_empty()]


def _widths(areas: Sequence[CrossSection]) -> tuple[float, float]:
    """Return the least and largest width of areas with a margin of some metres."""
    bounds = [_bounds(area) for area in areas if not area.is_empty()]
    left = min((bound[0] for bound in bounds), default=0.0)
    right = max((bound[2] for bound in bounds), default=0.0)
    return left - _BESIDE_M, right + _BESIDE_M


def _ground_below(
    ground: RecordedGround, direction: Direction, position_m: float, ends_m: tuple[float, float]
) -> np.ndarray:
    """Return the ground (p, 2) between two widths, in the plane."""
    steps = 1 if ground.is_flat else int(np.ceil((ends_m[1] - ends_m[0]) / _GROUND_STEP_M))
    widths = np.linspace(*ends_m, steps + 1)
    if ground.is_flat:
        return np.column_stack((widths, np.zeros(len(widths))))
    places = np.full((len(widths), 2), position_m)
    places[:, direction.width_axis] = widths
    return np.column_stack((widths, ground.heights_at(places)))


def _bounds(area: CrossSection) -> tuple[float, float, float, float]:
    """Return left, bottom, right and top of an area; zeros of one that is empty."""
    return (0.0, 0.0, 0.0, 0.0) if area.is_empty() else area.bounds()
