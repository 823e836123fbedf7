"""Areas of bodies as a blast wave meets them, which change as the bodies turn."""

import numpy as np

from ..geometry.hulls import ConvexHulls
from ..geometry.vectors import length, transformed_back

UPWARDS = np.array([0.0, 0.0, 1.0])
"""Where a charge in the very centre of a body pushes it: away from the ground, as no other direction is marked."""


def lines_of_blast(sources: np.ndarray, centres: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return stand-offs and directions from sources to bodies.

    Parameters
    ----------
    sources : (c, 3) float
        Positions of the charges, m.
    centres : (n, 3) float
        Centres of mass of the bodies, m.

    Returns
    -------
    stand_offs : (n, c) float
        Distances, m.
    directions : (n, c, 3) float
        Unit vectors from source to body; `UPWARDS` where a source is in the very centre of a body.
    """
    differences = centres[:, None] - sources[None]
    stand_offs = length(differences)
    apart = stand_offs[..., None] > 0.0
    directions = np.divide(
        differences, stand_offs[..., None], out=np.broadcast_to(UPWARDS, differences.shape).copy(), where=apart
    )
    return stand_offs, directions


def projected_areas(hulls: ConvexHulls, rotations: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Return the bodies' areas projected along directions, the report's equation 6: ½ Σ |n̂ · n̂ᵢ| Sᵢ over the faces.

    Parameters
    ----------
    hulls : ConvexHulls
        Convex hulls of n bodies.
    rotations : (n, 3, 3) float
        From the axes of each body to those of the world.
    directions : (n, c, 3) float
        Unit vectors from the sources to the bodies.

    Returns
    -------
    (n, c) float
        Areas, m².
    """
    if not len(hulls):
        return np.zeros(directions.shape[:2])
    in_body_axes = transformed_back(rotations[:, None], directions).transpose(1, 2, 0)
    of_faces = np.repeat(in_body_axes, np.diff(hulls.starts), axis=2)
    # One axis after the other, in rows that lie together in memory: this is computed in every sub-step.
    x, y, z = hulls.face_vectors
    shown = x * of_faces[:, 0]
    shown += y * of_faces[:, 1]
    shown += z * of_faces[:, 2]
    return np.add.reduceat(abs(shown) / 2.0, hulls.starts[:-1], axis=1).T
