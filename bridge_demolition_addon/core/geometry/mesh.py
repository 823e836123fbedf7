"""The mesh of the project: arrays of vertices and triangles."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np


@dataclass(frozen=True, eq=False, slots=True)
class Shard:
    """A closed mesh: `vertices` (v, 3) float64 in m, `triangles` (t, 3) int32, counter-clockwise seen from outside."""

    vertices: np.ndarray
    triangles: np.ndarray


class Mesh(Protocol):
    """Anything with `vertices` (v, 3) in m and `triangles` (t, 3)."""

    @property
    def vertices(self) -> np.ndarray: ...

    @property
    def triangles(self) -> np.ndarray: ...


def triangle_areas_and_normals(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Areas (t,) and unit normals (t, 3) of triangles (t, 3, 3); a zero normal where there is no area."""
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(doubled, axis=1)
    return length / 2, np.divide(doubled, length[:, None], out=np.zeros_like(doubled), where=length[:, None] > 0)
