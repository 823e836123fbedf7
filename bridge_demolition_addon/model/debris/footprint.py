"""The area that bodies cover in plan, how far they get, and where falling ones would land if nothing stopped them."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from manifold3d import CrossSection, OpType

from ...engineering.arrays import Rows
from ...engineering.geometry.plan_areas import distances_outside, ends_of_straight_parts, path_of_corners, united
from ...engineering.geometry.vectors import distance, transformed
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import OutputError
from ..results.arrays import Results
from ..results.motion import MOVED_M

_STRAIGHT_SIDE_M = 1e-5
"""What leaves a straight line by no more is one."""

_STRAIGHT_M = 0.01
"""How far corners may stray from a position, or from a straight way, whose hull is then too large by no more."""


def corners_at(results: Results, step: int, bodies: Rows) -> list[np.ndarray]:
    """Return vertices (v, 3) of each of the bodies in the world at a recorded step, m."""
    if not len(bodies):
        return []
    own = results.inventory.vertices_by_body()
    chosen = [own[body] for body in bodies]
    counts = [len(corners) for corners in chosen]
    of = np.repeat(bodies, counts)
    turned = transformed(results.frames.rotations[step][of], np.concatenate(chosen))
    return np.split(turned + results.frames.positions_m[step][of], np.cumsum(counts)[:-1])


def footprint(results: Results, bodies: Rows, step: int) -> CrossSection:
    """Return the area that the convex hulls of bodies cover in plan at a recorded step, overlaps once."""
    return united(plan_hulls(results, bodies, step))


def plan_hulls(results: Results, bodies: Rows, step: int) -> list[CrossSection]:
    """Return the area that the convex hull of each body covers in plan at a recorded step."""
    return [CrossSection.hull_points(corners[:, :2]) for corners in corners_at(results, step, bodies)]


def check_covers_ground(results: Results) -> None:
    """Check that a bridge covers an area in plan at first, which distances are measured from."""
    shards = results.inventory.of_kind("shard")
    if len(shards) and footprint(results, shards, 0).is_empty():
        raise OutputError("vertices_m: expected shards that cover an area in plan, found lines and points")


def swept_footprint(results: Results, bodies: Rows) -> CrossSection:
    """Return the area that the convex hulls of bodies cover in plan at any time.

    Between two recorded steps the hull of both positions is taken: all that a body sweeps which keeps its direction,
    and a little more of one that rotates.
    """
    own = results.inventory.vertices_by_body()
    at_first = footprint(results, bodies, 0)
    # Body by body first: thousands of areas that all overlap take a hundred times as long at once.
    areas = [at_first]
    for body in bodies:
        plans = plans_of(results, body, own[body])
        if not _covers_box(at_first, plans):  # most debris falls down within what the bridge covered
            areas.append(CrossSection.batch_boolean(_sweeps(plans), OpType.Add))
    return united(areas)


def plans_of(results: Results, body: int, corners: np.ndarray) -> np.ndarray:
    """Return the corners (k, v, 2) of a body in plan at all recorded steps."""
    return path_of_corners(results.frames.rotations[:, body], results.frames.positions_m[:, body], corners)


def straightened(area: CrossSection) -> CrossSection:
    """Return an area with fewer sides: the edge of a deck is a line of a thousand, one for each shard at it."""
    fewer = area.simplify(_STRAIGHT_SIDE_M)
    return area if fewer.is_empty() else fewer


def _covers_box(area: CrossSection, points: np.ndarray) -> bool:
    """Return whether an area covers the box around points (..., 2)."""
    lowest, highest = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    bounds = np.array(area.bounds())
    if (lowest < bounds[:2] - _STRAIGHT_SIDE_M).any() or (highest > bounds[2:] + _STRAIGHT_SIDE_M).any():
        return False  # without cutting the box
    box = CrossSection.square((highest - lowest).tolist()).translate(lowest.tolist())
    return (box - area).is_empty()


def _sweeps(plans: np.ndarray) -> list[CrossSection]:
    """Return the areas that plans (k, v, 2) cover on each straight part of a path, and at rest."""
    steps = ends_of_straight_parts(plans, _STRAIGHT_M)
    return [CrossSection.hull_points(np.concatenate(plans[start : end + 1])) for start, end in pairwise(steps)]


def bodies_that_moved(results: Results, bodies: np.ndarray) -> np.ndarray:
    """Return the bodies that were farther than `MOVED_M` from their first position at a recorded time."""
    positions = results.frames.positions_m[:, bodies]
    return bodies[distance(positions, positions[0]).max(axis=0, initial=0.0) > MOVED_M]


def reaches_on_the_way(results: Results, bodies: Rows, plan: CrossSection) -> np.ndarray:
    """Return the debris distance of each body from a plan at any recorded time, m (b,); 0 within it."""
    own, sides = results.inventory.vertices_by_body(), straightened(plan)
    farthest = np.zeros(len(bodies))
    for row, body in enumerate(bodies):
        points = plans_of(results, body, own[body])[_steps_with_news(results, body)]
        farthest[row] = distances_outside(sides, points.reshape(-1, 2)).max()
    return farthest


def _steps_with_news(results: Results, body: int) -> np.ndarray:
    """Return which recorded steps (k,) show a body in another position or rotation than the one before."""
    positions, rotations = results.frames.positions_m[:, body], results.frames.rotations[:, body]
    news = np.ones(len(positions), bool)
    news[1:] = (np.diff(positions, axis=0) != 0.0).any(axis=1) | (np.diff(rotations, axis=0) != 0.0).any(axis=(1, 2))
    return news


SINKS_M_S = 2.0
"""A shard that sinks as fast is taken to fall: it has fallen freely by 0.2 m then, and what stands sways less."""

_LANDED_M = 0.1
"""Height above the ground below which a shard has landed."""


def falling(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Return the shards (f,) that fall in the last frame of a run, and how high (f,) above the ground each is, m."""
    shards, frames = results.inventory.of_kind("shard"), results.frames
    sinking = shards[frames.velocities_m_s[-1, shards, 2] < -SINKS_M_S]
    corners, ground = corners_at(results, -1, sinking), results.ground()
    heights_m = np.array([(own[:, 2] - ground.heights_at(own[:, :2])).min() for own in corners])
    return sinking[heights_m > _LANDED_M], heights_m[heights_m > _LANDED_M]


def landed(results: Results) -> tuple[Results, int]:
    """Return a run in whose last frame all that falls has landed, and how many shards these are.

    Each flies on by itself, without rotating, and stays where its lowest corner meets the height of the ground that is
    below it now; it meets no other, and does not roll. Air resists nothing. The ground has to rest.
    """
    bodies, heights_m = falling(results)
    if not len(bodies):
        return results, 0
    frames = results.frames
    positions_m, velocities = np.array(frames.positions_m, float), frames.velocities_m_s[-1, bodies].astype(float)
    rises = velocities[:, 2]
    times_s = (rises + np.sqrt(rises * rises + 2.0 * STANDARD_GRAVITY_M_S2 * heights_m)) / STANDARD_GRAVITY_M_S2
    positions_m[-1, bodies, :2] += times_s[:, None] * velocities[:, :2]
    positions_m[-1, bodies, 2] -= heights_m
    return replace(results, frames=replace(frames, positions_m=positions_m)), len(bodies)
