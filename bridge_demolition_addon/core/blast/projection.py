"""How much of a body a blast wave meets: its area as the source sees it, which changes as the body turns."""

import numpy as np

from ..geometry.hulls import ConvexHulls

UPWARDS = np.array([0.0, 0.0, 1.0])
"""Where a charge in the very centre of a body pushes it: away from the ground, as no other direction is marked."""


def lines_of_blast(sources: np.ndarray, centres: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stand-offs and directions from sources to bodies.

    Parameters
    ----------
    sources
        (c, 3) places of the charges, m.
    centres
        (n, 3) centres of mass of the bodies, m.

    Returns
    -------
    stand_offs, directions
        (n, c) distances in m, and (n, c, 3) unit vectors from source to body; `UPWARDS` where a source is in the very
        centre of a body.
    """
    differences = centres[:, None] - sources[None]
    stand_offs = np.linalg.norm(differences, axis=2)
    apart = stand_offs[..., None] > 0.0
    directions = np.divide(
        differences, stand_offs[..., None], out=np.broadcast_to(UPWARDS, differences.shape).copy(), where=apart
    )
    return stand_offs, directions


def projected_areas(
    hulls: ConvexHulls, rotations: np.ndarray, directions: np.ndarray, *, facing_only: bool = False
) -> np.ndarray:
    """Areas of the bodies projected along directions, the report's equation 6: ½ Σ |n̂ · n̂ᵢ| Sᵢ over the hull's faces.

    Parameters
    ----------
    hulls
        Convex hulls of n bodies.
    rotations
        (n, 3, 3) from the axes of each body to those of the world.
    directions
        (n, c, 3) unit vectors from the sources to the bodies.
    facing_only
        Add up only the faces turned to the source, whole instead of half. A closed hull shows as much area to one side
        as to the other, so the result is the same.

    Returns
    -------
    numpy.ndarray
        (n, c) in m².
    """
    if not len(hulls):
        return np.zeros(directions.shape[:2])
    in_body_axes = np.matmul(directions, rotations).transpose(1, 2, 0)
    of_faces = np.repeat(in_body_axes, np.diff(hulls.starts), axis=2)
    # One axis after the other, in rows that lie together in memory: this is reckoned in every sub-step.
    x, y, z = hulls.face_vectors
    shown = x * of_faces[:, 0]
    shown += y * of_faces[:, 1]
    shown += z * of_faces[:, 2]
    shown = np.maximum(-shown, 0.0) if facing_only else abs(shown) / 2.0
    return np.add.reduceat(shown, hulls.starts[:-1], axis=1).T
