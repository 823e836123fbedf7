"""Lines on the ground and in the air of a view: zones, rings, ways, flashes; and how likely debris is where."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection
from numpy.typing import ArrayLike

from ..engineering.geometry.plan_areas import outlines
from ..engineering.geometry.proximity import ranges
from ..engineering.geometry.vectors import length
from ..engineering.statistics.probability_map import ProbabilityMap
from ..engineering.terrain.surface import RecordedGround
from ..model.debris.zones import ExclusionZone, widened, widened_around
from ..model.scenario import Exclusion, Zone
from .colour_scale import ColourMap, colours

FLASH_S = 0.25
"""How long a flash is seen; the light of a detonation itself lasts some milliseconds, less than a frame."""

_FADING_S = 0.08
_ABOVE_M = 0.02
"""Height above the ground of all that is drawn, so that it is not half hidden in it."""
_RAYS = 8
_DRAPED_M = 2.0

COLOUR_MAP = ColourMap.VIRIDIS
OPACITY = 0.6

_TWO_TRIANGLES = (0, 1, 2, 0, 2, 3)


def zone_lines(zone: Zone) -> np.ndarray:
    """Return the edges of a zone as lines (2 k, 3) float, m: on the ground or its bottom, and its top if any."""
    bottom = _ABOVE_M if zone.bottom_m is None else zone.bottom_m
    low = ring_of(np.array(zone.corners_m, float), bottom)
    if zone.top_m is None:
        return low
    high = low + np.array((0.0, 0.0, zone.top_m - bottom))
    uprights = np.stack((low[::2], high[::2]), axis=1).reshape(-1, 3)
    return np.concatenate((low, high, uprights))


def draped(lines_m: np.ndarray, ground: RecordedGround) -> np.ndarray:
    """Return lines (2 k, 3) float, m, with lines just above height 0 laid along the ground, in parts of 2 m at most."""
    if ground.is_flat:
        return lines_m
    sides = lines_m.reshape(-1, 2, 3)
    on_ground = sides[..., 2] == _ABOVE_M
    flat, others = sides[on_ground.all(axis=1)], sides[~on_ground.all(axis=1)]
    parts = np.maximum(np.ceil(length(flat[:, 1] - flat[:, 0]) / _DRAPED_M).astype(int), 1)
    rows, numbers = ranges(np.zeros(len(flat), int), parts)
    shares = np.stack((numbers, numbers + 1), axis=1) / parts[rows, None]
    flat = flat[rows, 0][:, None] + shares[..., None] * (flat[rows, 1] - flat[rows, 0])[:, None]
    sides = np.concatenate([flat, others])
    follows = np.concatenate([np.ones(flat.shape[:2], bool), on_ground[~on_ground.all(axis=1)]])
    sides[follows, 2] += ground.heights_at(sides[follows, :2])
    return sides.reshape(-1, 3)


def ring_of(corners_m: np.ndarray, height_m: float) -> np.ndarray:
    """Return the sides of a polygon (k, 2) as lines (2 k, 3) float, m, at a height."""
    ends = np.stack((corners_m, np.roll(corners_m, -1, axis=0)), axis=1).reshape(-1, 2)
    return np.column_stack((ends, np.full(len(ends), height_m)))


def distance_rings(plan: CrossSection, spacing_m: float, number: int) -> list[tuple[float, np.ndarray]]:
    """Return distances from a plan, m, and the lines (2 k, 3) float of the positions at these distances."""
    distances = [spacing_m * (count + 1) for count in range(number)]
    return [(distance, outline_lines(widened_around(plan, distance))) for distance in distances]


def planned_zone(plan: CrossSection, settings: Exclusion) -> ExclusionZone:
    """Return the exclusion zone as it is planned before a run, while its debris is unknown."""
    drop = widened(plan, settings.designed_drop_m)
    return ExclusionZone(plan, drop, CrossSection(), widened(drop, settings.buffer_m))


def way_lines(positions_m: np.ndarray) -> np.ndarray:
    """Return a way through positions (k, 3) as lines (2 (k - 1), 3) float, m."""
    return np.stack((positions_m[:-1], positions_m[1:]), axis=1).reshape(-1, 3)


def cross_lines(position_m: ArrayLike, size_m: float) -> np.ndarray:
    """Return a cross of three lines, (6, 3) float, m, at a position."""
    arms = size_m * np.eye(3)
    position = np.asarray(position_m, float)
    return np.stack((position - arms, position + arms), axis=1).reshape(-1, 3)


def flash_share(since_s: float) -> float:
    """Return how bright a flash is, from 0 to 1, so long after the detonation; 0 before it and when it is over."""
    if not -1e-9 <= since_s <= FLASH_S:
        return 0.0
    return math.exp(-max(since_s, 0.0) / _FADING_S)


def flash_lines(position_m: Sequence[float], radius_m: float) -> np.ndarray:
    """Return rays to all sides of a position as lines (2 r, 3) float, m."""
    turns = np.arange(_RAYS) * 2.0 * math.pi / _RAYS
    flat = [(math.cos(turn), math.sin(turn), rise) for turn in turns for rise in (-0.8, 0.0, 0.8)]
    rays = np.array([*flat, (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)])
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    position = np.asarray(position_m, float)
    return np.stack((position + 0.15 * radius_m * rays, position + radius_m * rays), axis=1).reshape(-1, 3)


def map_triangles(map_of_hits: ProbabilityMap) -> tuple[np.ndarray, np.ndarray]:
    """Return triangles (6 k, 3) float, m, and colours (6 k, 4) at their corners, for the k cells that any run hit.

    The colour is by the share of the runs that hit the cell, from 0 to 1.
    """
    rows, columns = np.nonzero(map_of_hits.hits)
    xs, ys = map_of_hits.cells.xs_m, map_of_hits.cells.ys_m
    left, right, low, high = xs[columns], xs[columns + 1], ys[rows], ys[rows + 1]
    heights = np.full(len(rows), _ABOVE_M)
    corners = np.stack(
        [np.column_stack([x, y, heights]) for x, y in ((left, low), (right, low), (right, high), (left, high))], axis=1
    )
    screen = np.column_stack((colours(COLOUR_MAP, map_of_hits.shares[rows, columns]), np.full(len(rows), OPACITY)))
    return corners[:, _TWO_TRIANGLES].reshape(-1, 3), np.repeat(screen, len(_TWO_TRIANGLES), axis=0)


def outline_lines(area: CrossSection) -> np.ndarray:
    """Return the outlines of an area as lines (2 k, 3) float, m, from corner to corner."""
    lines = [np.zeros((0, 2, 2))]
    for ring in outlines(area):
        lines.append(np.stack((ring, np.roll(ring, -1, axis=0)), axis=1))
    flat = np.concatenate(lines).reshape(-1, 2)
    return np.column_stack((flat, np.full(len(flat), _ABOVE_M)))
