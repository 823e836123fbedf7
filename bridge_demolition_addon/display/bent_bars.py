"""Bars that stick out of cracks, bent: where connections with bars broke, on both sides; for looks only."""

from __future__ import annotations

import numpy as np

from ..engineering.geometry.mesh import joined_meshes
from ..model.results.arrays import Results
from .dressing import DrawnPart, Stuff, rod

_MOST_CONNECTIONS = 80
_BARS_PER_FACE = 3
_THICKNESS_M = 0.03
"""Somewhat thicker than a bar, so that it is seen."""

_STRAIGHT_M, _BENT_M = 0.12, 0.28
_SEED = 11


def bent_bars(results: Results, opened: np.ndarray) -> list[DrawnPart]:
    """Return bars out of the faces of connections within a member that have opened (m,), where they were at first."""
    inventory = results.inventory
    if not len(inventory.pairs):
        return []
    first, second = inventory.pairs.T
    members = inventory.body_members
    wanted = opened & (members[first] == members[second]) & (members[first] != "")
    largest = np.flatnonzero(wanted)
    largest = largest[np.argsort(-inventory.areas_m2[largest], kind="stable")]
    broken = largest[:_MOST_CONNECTIONS].tolist()
    parts = []
    for connection in broken:
        random = np.random.default_rng((_SEED, connection))
        side = 0.35 * float(inventory.areas_m2[connection]) ** 0.5
        for body, out in zip(inventory.pairs[connection].tolist(), (1.0, -1.0), strict=True):
            normal = out * np.asarray(inventory.normals[connection], float)
            parts.append(_bars(random, np.asarray(inventory.points_m[connection], float), normal, side, body))
    return parts


def _bars(random: np.random.Generator, middle: np.ndarray, normal: np.ndarray, side: float, body: int) -> DrawnPart:
    rods = []
    for _ in range(_BARS_PER_FACE):
        offset = random.uniform(-side, side, 3)
        start = middle + offset - normal * float(offset @ normal)
        elbow = start + _STRAIGHT_M * normal
        bent = normal + 0.9 * random.normal(size=3)
        end = elbow + _BENT_M * bent / np.linalg.norm(bent)
        rods += [rod(start - 0.05 * normal, elbow, _THICKNESS_M), rod(elbow, end, _THICKNESS_M)]
    return DrawnPart(Stuff.RUST, joined_meshes(rods), body)
