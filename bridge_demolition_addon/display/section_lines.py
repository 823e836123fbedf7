"""A section through a pile in a view: outlines, filled areas, and a scale of heights at their side, in the world."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, triangulate

from ..engineering.geometry.plan_areas import outlines
from ..model.debris.pile_sections import PileSection

_STEPS_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
_MOST_STEPS = 8
_BESIDE_M = 1.0
"""Distance of the scale from what is cut."""

_TICK_M = 0.3

_SUNK_SHARE = 0.1
"""Part of a step by which shards may have sunk into the ground without one more mark below it."""


@dataclass(frozen=True, slots=True, eq=False)
class HeightScale:
    """A scale of heights above 0: lines (2 k, 3) float, m, and the position (3,) of each mark with its height, m."""

    lines: np.ndarray
    marks: tuple[tuple[tuple[float, float, float], float], ...]


def section_outline(section: PileSection, area: CrossSection) -> np.ndarray:
    """Return the outlines of an area of a section as lines (2 k, 3) float, m."""
    lines = [np.zeros((0, 2))]
    for ring in outlines(area):
        lines.append(np.stack((ring, np.roll(ring, -1, axis=0)), axis=1).reshape(-1, 2))
    return section.in_space(np.concatenate(lines))


def section_triangles(section: PileSection, area: CrossSection) -> np.ndarray:
    """Return the triangles (3 t, 3) float, m, that fill an area of a section."""
    rings = outlines(area)
    if not rings:
        return np.zeros((0, 3))
    corners = np.concatenate(rings)
    return section.in_space(corners[np.asarray(triangulate(rings)).ravel()])


def ground_line(section: PileSection) -> np.ndarray:
    """Return the ground below a section as lines (2 k, 3) float, m."""
    return section.in_space(np.stack((section.ground_m[:-1], section.ground_m[1:]), axis=1).reshape(-1, 2))


def height_scale(section: PileSection) -> HeightScale | None:
    """Return a scale of heights at the left of what is cut, from the ground to its top; None where nothing is cut."""
    bounds = [area.bounds() for area in (section.debris, section.standing) if not area.is_empty()]
    if not bounds:
        return None
    left = min(bound[0] for bound in bounds) - _BESIDE_M
    top, foot = max(bound[3] for bound in bounds), float(section.ground_at(np.array([left]))[0])
    heights = list(_heights(min(foot, *(bound[1] for bound in bounds)), top))
    ends = np.array([(left, heights[0]), (left, heights[-1])])
    ticks = [((left - _TICK_M, height), (left, height)) for height in heights]
    lines = section.in_space(np.concatenate([ends, np.array(ticks).reshape(-1, 2)]))
    places = section.in_space(np.array([(left - _TICK_M, height) for height in heights]))
    return HeightScale(
        lines, tuple((tuple(place), height) for place, height in zip(places.tolist(), heights, strict=True))
    )


def _heights(low_m: float, high_m: float) -> Iterator[float]:
    """Give round heights from one at or below the lowest to one at or above the highest, few of them."""
    step = _step_of(high_m - low_m, _STEPS_M)
    first, last = int(np.floor(low_m / step + _SUNK_SHARE)), int(np.ceil(high_m / step - 1e-6))
    for number in range(first, max(last, first + 1) + 1):
        yield round(number * step, 6)


def _step_of(range_m: float, steps_m: Sequence[float]) -> float:
    return next((step for step in steps_m if range_m / step <= _MOST_STEPS), steps_m[-1])
