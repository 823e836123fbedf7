"""Solids swept along x: what has one cross-section from station to station, such as a road on its bank."""

from __future__ import annotations

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.mesh import TriangleMesh


def swept(stations_m: FloatArray, outlines_m: FloatArray) -> TriangleMesh:
    """Return the closed solid of convex outlines (n, c, 2) of y and z, m, at n stations along x, m, at least two."""
    outlines = np.asarray(outlines_m, float)
    count, corners = outlines.shape[:2]
    x = np.broadcast_to(np.asarray(stations_m, float)[:, None, None], (count, corners, 1))
    vertices = np.concatenate((x, outlines), axis=2).reshape(-1, 3)
    corner, following = np.arange(corners), (np.arange(corners) + 1) % corners
    quads = np.concatenate(
        [
            np.column_stack((corner, following, following + corners, corner + corners)) + first
            for first in range(0, (count - 1) * corners, corners)
        ]
    )
    inner = np.arange(1, corners - 1)
    cap = np.column_stack((np.zeros(corners - 2, int), inner, inner + 1))
    last = (count - 1) * corners
    mesh = TriangleMesh(vertices, np.concatenate((quads[:, [0, 2, 1]], quads[:, [0, 3, 2]], cap, cap[:, ::-1] + last)))
    return mesh if mesh.volume > 0.0 else mesh.flipped()
