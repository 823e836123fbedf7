# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast a deck is broken into shards, next to the plain way of doing it, in the same run.

The plain way trims the whole solid by the planes halfway to the nearest 64 points, one cell and one plane at a time,
and stops when the next point is further away than twice the cell's radius. It gives bare solids: no arrays, no faces.
Ours is timed with all a `Fracture` holds. The search for the nearest points is not counted against the plain way.
"""

import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import Manifold

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.solids import box, to_manifold

DECK_M = (30.0, 12.0, 1.0)
SHARD_COUNTS = (200, 1000, 3000)
NEIGHBOURS = 64


def figures(shard_counts: Sequence[int] = SHARD_COUNTS, repeats: int = 2) -> dict[str, float]:
    """Seconds for each number of shards, ours and the plain way's, the best of some runs, and how often faster we are.

    Returns
    -------
    dict
        `fracture_<n>_s`, `fracture_<n>_plain_s`, `fracture_<n>_ratio` and `fracture_<n>_volume_error`, the latter as a
        part of the deck's volume.
    """
    result: dict[str, float] = {}
    deck = box(DECK_M)
    for count in shard_counts:
        ours, broken = _best_time(lambda count=count: fracture(deck, count, seed=0), repeats)
        nearest = _nearest_points(broken.points)
        plain, _ = _best_time(lambda points=broken.points, near=nearest: _plain_cells(deck, points, near), repeats)
        result |= {
            f"fracture_{count}_s": ours,
            f"fracture_{count}_plain_s": plain,
            f"fracture_{count}_ratio": plain / ours,
            f"fracture_{count}_volume_error": abs(float(broken.volumes.sum()) / np.prod(DECK_M) - 1),
        }
    return result


def table(measured: dict[str, float]) -> str:
    """The figures as lines for a person."""
    counts = sorted(int(key.split("_")[1]) for key in measured if key.endswith("_ratio"))
    lines = [f"{'shards':>8}{'ours, s':>10}{'plain, s':>10}{'ratio':>8}{'volume error':>14}"]
    for count in counts:
        ours, plain, ratio, error = (
            measured[f"fracture_{count}_{what}"] for what in ("s", "plain_s", "ratio", "volume_error")
        )
        lines.append(f"{count:>8}{ours:>10.2f}{plain:>10.2f}{ratio:>8.1f}{error:>14.0e}")
    return "\n".join(lines)


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


if __name__ == "__main__":
    print(table(figures()))
