"""The ground plan of bodies: what their convex hulls cover, before, after and on the way."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from manifold3d import CrossSection, OpType

from .arrays import Results


def corners_at(results: Results, step: int, body: int) -> np.ndarray:
    """Vertices (v, 3) of a body in the world at a recorded step, m."""
    return (
        results.inventory.vertices_of(body) @ results.frames.rotations[step, body].T
        + results.frames.positions_m[step, body]
    )


def footprint(results: Results, bodies: Iterable[int], step: int) -> CrossSection:
    """What the convex hulls of bodies cover in plan at a recorded step; where they overlap it counts once."""
    return united(CrossSection.hull_points(corners_at(results, step, body)[:, :2]) for body in bodies)


def swept_footprint(results: Results, bodies: Iterable[int]) -> CrossSection:
    """What the convex hulls of bodies cover in plan at any time.

    Between two recorded steps the hull of both positions is taken: all that a body sweeps which keeps its direction,
    and a little more of one that turns.
    """
    # Body by body first: thousands of areas that all overlap take a hundred times as long at once.
    return united(united(_sweeps(results, body)) for body in bodies)


def united(areas: Iterable[CrossSection]) -> CrossSection:
    """What at least one of the areas covers."""
    areas = list(areas)
    return CrossSection.batch_boolean(areas, OpType.Add) if areas else CrossSection()


def outlines(area: CrossSection) -> list[np.ndarray]:
    """Closed outlines of an area, each (k, 2) in m: outer ones run anticlockwise, those of holes clockwise."""
    return [np.asarray(each, float) for each in area.to_polygons()]


def distances_outside(area: CrossSection, points: np.ndarray) -> np.ndarray:
    """How far points (p, 2) are outside an area, m (p,); 0 within it.

    Raises
    ------
    ValueError
        The area is empty.
    """
    distances = np.full(len(points), np.inf)
    windings = np.zeros(len(points))
    for outline in outlines(area):
        starts, ends = outline, np.roll(outline, -1, axis=0)
        distances = np.minimum(distances, _distances_to_sides(points, starts, ends).min(axis=1))
        windings += _windings(points, starts, ends)
    if not area.num_contour():
        raise ValueError("an empty area has no distance to anything")
    return np.where(windings > 0.5, 0.0, distances)


def _sweeps(results: Results, body: int) -> list[CrossSection]:
    corners = results.inventory.vertices_of(body)
    places, rotations = results.frames.positions_m[:, body], results.frames.rotations[:, body]
    moved = (np.diff(places, axis=0) != 0.0).any(axis=1) | (np.diff(rotations, axis=0) != 0.0).any(axis=(1, 2))
    steps = np.flatnonzero(moved)
    if not len(steps):
        return [CrossSection.hull_points(corners_at(results, 0, body)[:, :2])]
    plans = (np.einsum("kij,vj->kvi", rotations, corners) + places[:, None])[:, :, :2]
    return [CrossSection.hull_points(np.concatenate(plans[step : step + 2])) for step in steps]


def _distances_to_sides(points: np.ndarray, starts: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Distances (p, s) of points from sides."""
    sides = ends - starts
    lengths_squared = np.maximum((sides**2).sum(axis=1), np.finfo(float).tiny)
    along = np.einsum("psi,si->ps", points[:, None] - starts, sides) / lengths_squared
    nearest = starts + np.clip(along, 0.0, 1.0)[..., None] * sides
    return np.linalg.norm(points[:, None] - nearest, axis=2)


def _windings(points: np.ndarray, starts: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """How often an outline winds around each of the points (p,)."""
    first, second = starts - points[:, None], ends - points[:, None]
    crosses = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return np.arctan2(crosses, (first * second).sum(axis=2)).sum(axis=1) / (2.0 * np.pi)
