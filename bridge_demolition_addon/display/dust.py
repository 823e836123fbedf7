"""Dust: where connections break, and how large its clouds become."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..model.results.arrays import Results

MOST_PUFFS = 60
"""Clouds that a renderer still draws in a reasonable time."""

_LEAST_RADIUS_M, _RADIUS_OF_AREA = 0.6, 1.2
"""Radius of a fully grown cloud: at least, and for a square of broken area of 1 m²."""


@dataclass(frozen=True, slots=True)
class Puff:
    """A cloud of dust: the frame in which it appears, its middle, and its radius when fully grown."""

    frame: int
    place_m: tuple[float, float, float]
    radius_m: float


def puffs(results: Results, most: int = MOST_PUFFS) -> list[Puff]:
    """Return the clouds where connections broke, the largest ones where there would be more than `most`.

    Connections that break in one frame and in one cube of space make one cloud. How large it becomes goes with the
    broken area; that is a picture, and no forecast of dust.
    """
    frames, inventory = results.frames, results.inventory
    intact = np.asarray(frames.intact)
    if len(intact) < 2 or not intact.shape[1]:
        return []
    rows, broken = np.nonzero(intact[:-1] & ~intact[1:])
    span = np.ptp(inventory.points_m, axis=0).max(initial=1.0)
    cell = max(span / 12.0, 1.0)
    cubes: dict[tuple, list[int]] = {}
    positions = _places(results, rows, broken)
    for number, (row, position) in enumerate(zip(rows.tolist(), positions, strict=True)):
        cubes.setdefault((row, *np.floor(position / cell).astype(int).tolist()), []).append(number)
    clouds = [
        Puff(
            int(frames.number[row + 1]),
            tuple(positions[members].mean(axis=0).tolist()),
            max(_LEAST_RADIUS_M, _RADIUS_OF_AREA * float(inventory.areas_m2[broken[members]].sum()) ** 0.5),
        )
        for (row, *_), members in cubes.items()
    ]
    largest = sorted(clouds, key=lambda cloud: -cloud.radius_m)[:most]
    return sorted(largest, key=lambda cloud: cloud.frame)


def _places(results: Results, rows: np.ndarray, broken: np.ndarray) -> np.ndarray:
    """Return where connections were in the last frames in which they held, (b, 3) float, m."""
    first, points = results.frames[0], results.inventory.points_m
    bodies = results.inventory.pairs[broken, 0]
    arms = points[broken] - first.positions_m[bodies]
    turns = results.frames.rotations[rows, bodies] @ first.rotations[bodies].transpose(0, 2, 1)
    return results.frames.positions_m[rows, bodies] + np.einsum("bij,bj->bi", turns, arms)
