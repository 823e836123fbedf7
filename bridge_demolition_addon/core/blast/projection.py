"""How much of a body a blast wave meets: its area as the source sees it, which changes as the body turns."""

import numpy as np

from .hulls import ConvexHulls

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
    in_body_axes = np.einsum("nji,ncj->nci", rotations, directions)
    bodies = hulls.bodies
    cosines = np.einsum("fi,fci->fc", hulls.normals, in_body_axes[bodies])
    seen = np.maximum(-cosines, 0.0) if facing_only else abs(cosines) / 2.0
    areas = seen * hulls.areas[:, None]
    columns = [np.bincount(bodies, column, len(hulls)) for column in areas.T]
    return np.column_stack(columns) if columns else np.zeros((len(hulls), 0))
