# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast a deck is broken into shards, next to the plain way of doing it, in the same run.

The plain way trims the whole solid by the planes halfway to the nearest 64 points, one cell and one plane at a time,
and stops when the next point is further away than twice the cell's radius. It gives bare solids: no arrays, no faces.
Ours is timed with all a `Fracture` holds. The search for the nearest points is not counted against the plain way.
"""

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from manifold3d import Manifold

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.solids import box, to_manifold

DECK_M = (30.0, 12.0, 1.0)
SIZES = (200, 1000, 3000)
NEIGHBOURS = 64


def main(smallest: bool) -> None:
    """Print the seconds of both ways for each number of shards, the best of some runs, and how often faster we are."""
    print(f"{'shards':>8}{'ours, s':>10}{'plain, s':>10}{'ratio':>8}{'volume error':>14}")
    deck, repeats = box(DECK_M), 1 if smallest else 2
    for count in (20,) if smallest else SIZES:
        ours, broken = _best_time(lambda count=count: fracture(deck, count, seed=0), repeats)
        nearest = _nearest_points(broken.points)
        plain, _ = _best_time(lambda points=broken.points, near=nearest: _plain_cells(deck, points, near), repeats)
        error = abs(float(broken.volumes.sum()) / np.prod(DECK_M) - 1)
        print(f"{count:>8}{ours:>10.2f}{plain:>10.2f}{plain / ours:>8.1f}{error:>14.0e}", flush=True)


def _best_time(work: Callable[[], Any], repeats: int) -> tuple[float, Any]:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        times.append(time.perf_counter() - start)
    return min(times), result


def _nearest_points(points: np.ndarray) -> np.ndarray:
    """Indices (n, up to 64) of the points nearest to each, itself left out, nearest first."""
    squares = np.zeros((len(points), len(points)))
    for axis in range(3):
        squares += (points[:, None, axis] - points[None, :, axis]) ** 2
    return np.argsort(squares, axis=1)[:, 1 : NEIGHBOURS + 1]


def _plain_cells(deck: Any, points: np.ndarray, nearest: np.ndarray) -> list[Manifold]:
    whole = to_manifold(deck)
    return [_plain_cell(whole, point, points[others]) for point, others in zip(points, nearest, strict=True)]


def _plain_cell(whole: Manifold, point: np.ndarray, others: np.ndarray) -> Manifold:
    cell = whole
    for other in others:
        distance = np.linalg.norm(other - point)
        corners = cell.to_mesh64().vert_properties[:, :3]
        if distance > 2 * np.linalg.norm(corners - point, axis=1).max():
            break
        inwards = (point - other) / distance
        cell = cell.trim_by_plane(inwards.tolist(), float(inwards @ (point + other) / 2))
    return cell
