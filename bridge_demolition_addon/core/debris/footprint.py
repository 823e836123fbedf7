"""The ground plan of bodies: what their convex hulls cover, before, after and on the way."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection, OpType

from ..errors import OutputError
from ..geometry.plan_areas import united
from ..geometry.vectors import transformed
from ..results.arrays import Results


def corners_at(results: Results, step: int, bodies: Sequence[int]) -> list[np.ndarray]:
    """Vertices (v, 3) of each of the bodies in the world at a recorded step, m."""
    if not len(bodies):
        return []
    own = results.inventory.vertices_by_body()
    chosen = [own[body] for body in bodies]
    counts = [len(corners) for corners in chosen]
    of = np.repeat(bodies, counts)
    turned = transformed(results.frames.rotations[step][of], np.concatenate(chosen))
    return np.split(turned + results.frames.positions_m[step][of], np.cumsum(counts)[:-1])


def footprint(results: Results, bodies: Sequence[int], step: int) -> CrossSection:
    """What the convex hulls of bodies cover in plan at a recorded step; where they overlap it counts once."""
    return united(plan_hulls(results, bodies, step))


def plan_hulls(results: Results, bodies: Sequence[int], step: int) -> list[CrossSection]:
    """What the convex hull of each of the bodies covers in plan at a recorded step."""
    return [CrossSection.hull_points(corners[:, :2]) for corners in corners_at(results, step, bodies)]


def check_covers_ground(results: Results) -> None:
    """Make sure that a bridge covers an area in plan at first, which distances are measured from.

    Raises
    ------
    OutputError
        All its shards are flat or points in plan.
    """
    shards = results.inventory.of_kind("shard")
    if len(shards) and footprint(results, shards, 0).is_empty():
        raise OutputError("vertices_m: expected shards that cover an area in plan, found lines and points")


def swept_footprint(results: Results, bodies: Sequence[int]) -> CrossSection:
    """What the convex hulls of bodies cover in plan at any time.

    Between two recorded steps the hull of both positions is taken: all that a body sweeps which keeps its direction,
    and a little more of one that turns.
    """
    own = results.inventory.vertices_by_body()
    # Body by body first: thousands of areas that all overlap take a hundred times as long at once.
    return united(CrossSection.batch_boolean(_sweeps(results, body, own[body]), OpType.Add) for body in bodies)


def _sweeps(results: Results, body: int, corners: np.ndarray) -> list[CrossSection]:
    places, rotations = results.frames.positions_m[:, body, :2], results.frames.rotations[:, body, :2]
    moved = (np.diff(places, axis=0) != 0.0).any(axis=1) | (np.diff(rotations, axis=0) != 0.0).any(axis=(1, 2))
    steps = np.flatnonzero(moved) if moved.any() else np.zeros(1, int)
    plans = transformed(rotations[:, None], corners) + places[:, None]
    following = plans[np.minimum(steps + 1, len(plans) - 1)]
    return [CrossSection.hull_points(both) for both in np.concatenate([plans[steps], following], axis=1)]
