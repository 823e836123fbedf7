"""The ground plan of bodies: what their convex hulls cover, before, after and on the way."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from manifold3d import CrossSection

from ..errors import OutputError
from ..geometry.plan_areas import united
from ..geometry.vectors import transformed
from ..results.arrays import Results


def corners_at(results: Results, step: int, body: int) -> np.ndarray:
    """Vertices (v, 3) of a body in the world at a recorded step, m."""
    turned = transformed(results.frames.rotations[step, body], results.inventory.vertices_of(body))
    return turned + results.frames.positions_m[step, body]


def footprint(results: Results, bodies: Iterable[int], step: int) -> CrossSection:
    """What the convex hulls of bodies cover in plan at a recorded step; where they overlap it counts once."""
    return united(CrossSection.hull_points(corners_at(results, step, body)[:, :2]) for body in bodies)


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


def swept_footprint(results: Results, bodies: Iterable[int]) -> CrossSection:
    """What the convex hulls of bodies cover in plan at any time.

    Between two recorded steps the hull of both positions is taken: all that a body sweeps which keeps its direction,
    and a little more of one that turns.
    """
    # Body by body first: thousands of areas that all overlap take a hundred times as long at once.
    return united(united(_sweeps(results, body)) for body in bodies)


def _sweeps(results: Results, body: int) -> list[CrossSection]:
    corners = results.inventory.vertices_of(body)
    places, rotations = results.frames.positions_m[:, body], results.frames.rotations[:, body]
    moved = (np.diff(places, axis=0) != 0.0).any(axis=1) | (np.diff(rotations, axis=0) != 0.0).any(axis=(1, 2))
    steps = np.flatnonzero(moved)
    if not len(steps):
        return [CrossSection.hull_points(corners_at(results, 0, body)[:, :2])]
    plans = (transformed(rotations[:, None], corners) + places[:, None])[:, :, :2]
    return [CrossSection.hull_points(np.concatenate(plans[step : step + 2])) for step in steps]
