"""How far bodies get from the bridge's plan on their whole way, not only where they come to rest."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection

from ...engineering.arrays import Rows
from ...engineering.geometry.plan_areas import distances_outside
from ...engineering.geometry.vectors import distance
from ..results.arrays import Results
from ..results.motion import MOVED_M
from .footprint import plans_of, straightened


def bodies_that_moved(results: Results, bodies: np.ndarray) -> np.ndarray:
    """Return the bodies that were farther than `MOVED_M` from their first position at a recorded time."""
    places = results.frames.positions_m[:, bodies]
    return bodies[distance(places, places[0]).max(axis=0, initial=0.0) > MOVED_M]


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
    places, rotations = results.frames.positions_m[:, body], results.frames.rotations[:, body]
    news = np.ones(len(places), bool)
    news[1:] = (np.diff(places, axis=0) != 0.0).any(axis=1) | (np.diff(rotations, axis=0) != 0.0).any(axis=(1, 2))
    return news
