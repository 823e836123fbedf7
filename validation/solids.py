# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids that the cases are made of, in metres."""

import numpy as np

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    """A box from one corner to the other."""
    profile = [(low[0], low[2]), (high[0], low[2]), (high[0], high[2]), (low[0], high[2])]
    return prism(np.array(profile), low[1], high[1])


def prism(profile: np.ndarray, front: float, back: float) -> TriangleMesh:
    """A convex profile (k, 2) in x and z, anticlockwise as seen from negative y, from y = front to y = back."""
    count = len(profile)
    vertices = np.array([(x, y, z) for y in (front, back) for x, z in profile])
    fan = [(0, corner, corner + 1) for corner in range(1, count - 1)]
    caps = [*fan, *((count + a, count + c, count + b) for a, b, c in fan)]
    sides = []
    for corner in range(count):
        following = (corner + 1) % count
        sides += [(corner, corner + count, following), (following, corner + count, following + count)]
    return TriangleMesh(vertices, np.array([*caps, *sides]))
