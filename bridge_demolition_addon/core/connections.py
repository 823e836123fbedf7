"""Which shards are connected, and where: neighbours by distance or by shared face, and foundations on the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from .fracture import Shard, SharedFaces

GROUND = -1
"""Stands for the ground where a connection names its second body."""

_LEVEL_TOLERANCE_M = 1e-6
"""How far a face may lie off the ground and still stand on it: rounding of coordinates of some hundred metres."""

_DISTANCES_AT_ONCE = 4_000_000
"""Distances computed in one array operation: their differences in three axes take 100 MB."""


@dataclass(frozen=True, slots=True)
class Connections:
    """Connections between shards, structure of arrays.

    Attributes
    ----------
    pairs
        (m, 2) indices of the connected shards; the second is `GROUND` for a foundation.
    points
        (m, 3) where each connection sits, m: the centre of the face that the two share, or half-way between their
        centres of mass where they share none.
    areas
        (m,) area of the shared face, m²; 0 where the two share none.
    normals
        (m, 3) unit vectors from the first body to the second, at right angles to the shared face.
    """

    pairs: np.ndarray
    points: np.ndarray
    areas: np.ndarray
    normals: np.ndarray

    def __len__(self) -> int:
        return len(self.pairs)


def connect(
    centres: np.ndarray, faces: SharedFaces, pairs: np.ndarray, distances: np.ndarray, limit_per_shard: int
) -> Connections:
    """Connections of neighbouring shards, nearest first, until a shard has as many as allowed.

    Parameters
    ----------
    centres
        (n, 3) centres of mass of the shards, m.
    faces
        All faces that two shards share.
    pairs, distances
        (k, 2) neighbouring shards and (k,) how far apart they are, in m or in any other order of preference.
    limit_per_shard
        How many connections a shard may have.
    """
    pairs = limited(pairs, distances, limit_per_shard, len(centres))
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    points = centres[pairs].mean(axis=1)
    normals = _unit(centres[pairs[:, 1]] - centres[pairs[:, 0]])
    areas = np.zeros(len(pairs))
    rows, face_rows = _matching_rows(pairs, faces.pairs, len(centres))
    points[rows] = faces.centres[face_rows]
    normals[rows] = faces.normals[face_rows]
    areas[rows] = faces.areas[face_rows]
    return Connections(pairs, points, areas, normals)


def neighbours_by_face(faces: SharedFaces) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (k, 2) of shards that share a face, and an order (k,) in which the largest face comes first."""
    return faces.pairs, -faces.areas


def neighbours_by_centre(centres: np.ndarray, radius_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (k, 2) of shards whose centres of mass (n, 3) lie within a radius, and their distances (k,) in m."""
    rows = max(1, _DISTANCES_AT_ONCE // max(1, len(centres)))
    found_pairs, found_distances = [np.zeros((0, 2), int)], [np.zeros(0)]
    for start in range(0, len(centres), rows):
        block = centres[start : start + rows]
        distances = np.linalg.norm(block[:, None] - centres[None], axis=2)
        first, second = np.nonzero(distances <= radius_m)
        once = first + start < second
        found_pairs.append(np.column_stack((first + start, second))[once])
        found_distances.append(distances[first, second][once])
    return np.concatenate(found_pairs), np.concatenate(found_distances)


def neighbours_by_vertex(shards: Sequence[Shard], radius_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (k, 2) of shards whose nearest vertices lie within a radius, and their distances (k,) in m."""
    candidates = _boxes_within(shards, radius_m)
    distances = np.array([_vertex_distance(shards[i].vertices, shards[j].vertices) for i, j in candidates])
    near = distances <= radius_m
    return candidates[near], distances[near]


def limited(pairs: np.ndarray, distances: np.ndarray, limit_per_shard: int, shard_count: int) -> np.ndarray:
    """The pairs (k, 2) that remain when, nearest first, no shard may have more than its limit.

    Pairs at the same distance are taken in order of their shards, so that the result is reproducible.
    """
    order = np.lexsort((pairs[:, 1], pairs[:, 0], distances))
    taken = np.zeros(shard_count, int)
    kept = []
    for row in order:
        first, second = pairs[row]
        if taken[first] < limit_per_shard and taken[second] < limit_per_shard:
            taken[first] += 1
            taken[second] += 1
            kept.append(row)
    return pairs[kept]


def foundations(shards: Sequence[Shard]) -> Connections:
    """Connections to the ground of all shards that stand on it, in the middle of the face they stand on."""
    standing = [(index, *_standing_face(shard)) for index, shard in enumerate(shards)]
    standing = [(index, area, centre) for index, area, centre in standing if area > 0.0]
    count = len(standing)
    return Connections(
        pairs=np.array([(index, GROUND) for index, _, _ in standing], int).reshape(count, 2),
        points=np.array([centre for _, _, centre in standing], float).reshape(count, 3),
        areas=np.array([area for _, area, _ in standing], float),
        normals=np.tile([0.0, 0.0, -1.0], (count, 1)),
    )


def joined(parts: Sequence[Connections]) -> Connections:
    """Several sets of connections as one."""
    return Connections(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(Connections)))


def _standing_face(shard: Shard) -> tuple[float, np.ndarray]:
    """Area and centre of what of a shard lies flat on the ground."""
    corners = shard.vertices[shard.triangles]
    flat = corners[(abs(corners[:, :, 2]) <= _LEVEL_TOLERANCE_M).all(axis=1)]
    areas = np.linalg.norm(np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]), axis=1) / 2.0
    total = float(areas.sum())
    centre = areas @ flat.mean(axis=1) / total if total > 0.0 else np.zeros(3)
    return total, centre


def _boxes_within(shards: Sequence[Shard], radius_m: float) -> np.ndarray:
    """Pairs (k, 2) of shards whose bounding boxes come within a radius in every direction."""
    low = np.array([shard.vertices.min(axis=0) for shard in shards])
    high = np.array([shard.vertices.max(axis=0) for shard in shards]) + radius_m
    found = [np.zeros((0, 2), int)]
    for index in range(len(shards) - 1):
        others = np.arange(index + 1, len(shards))
        near = ((low[others] <= high[index]) & (low[index] <= high[others])).all(axis=1)
        found.append(np.column_stack((np.full(near.sum(), index), others[near])))
    return np.concatenate(found)


def _vertex_distance(first: np.ndarray, second: np.ndarray) -> float:
    difference = first[:, None] - second[None]
    return float(np.sqrt(np.einsum("ijk,ijk->ij", difference, difference).min()))


def _matching_rows(pairs: np.ndarray, face_pairs: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows of `pairs` (sorted) that also stand in `face_pairs`, and their rows there."""
    keys, face_keys = pairs[:, 0] * count + pairs[:, 1], face_pairs[:, 0] * count + face_pairs[:, 1]
    _, rows, face_rows = np.intersect1d(keys, face_keys, return_indices=True)
    return rows, face_rows


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]
