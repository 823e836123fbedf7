"""What connections do to bodies: resultants, sums of magnitudes, and moments at the connections themselves."""

from __future__ import annotations

import numpy as np

from ..geometry.vectors import cross


def resultants(pairs: np.ndarray, forces: np.ndarray, body_count: int) -> np.ndarray:
    """Return the vector sum of the connection forces on every body.

    Parameters
    ----------
    pairs : (m, 2) int
        Indices of the connected bodies.
    forces : (m, 3) float
        Force on the first body of each pair, N; the second gets the opposite (Newton's third law).
    body_count : int
        Number of bodies n.

    Returns
    -------
    (n, 3) float
        In N.
    """
    first, second = pairs.T
    components = [
        np.bincount(first, forces[:, axis], body_count) - np.bincount(second, forces[:, axis], body_count)
        for axis in range(3)
    ]
    return np.column_stack(components)


def magnitude_sums(pairs: np.ndarray, magnitudes: np.ndarray, body_count: int) -> np.ndarray:
    """Return the sum of the magnitudes (m,) of the forces between pairs of bodies, for every body (n,), in N.

    The measure of how hard a body is held from all sides, where the resultant of a body at rest is only its weight.
    """
    first, second = pairs.T
    return np.bincount(first, magnitudes, body_count) + np.bincount(second, magnitudes, body_count)


def moments_at(points: np.ndarray, forces: np.ndarray, torques: np.ndarray, centres: np.ndarray) -> np.ndarray:
    """Return the moments of connections about their own points.

    Parameters
    ----------
    points : (m, 3) float
        Where the connections sit, m.
    forces, torques : (m, 3) float
        Force on a body in N, and the torque of the whole load about that body's centre in N·m.
    centres : (m, 3) float
        That body's centre, m.

    Returns
    -------
    (m, 3) float
        In N·m: the torque less what the force makes by its lever arm.
    """
    return torques - cross(points - centres, forces)
