"""What the bodies of a run look like elsewhere, and where they and their connections are in each frame."""

from __future__ import annotations

import numpy as np
from scipy.spatial import Delaunay

from ..core.geometry.hulls import THINNEST
from ..core.geometry.mesh import TriangleMesh
from ..core.geometry.rotations import carried_points
from ..core.geometry.solids import from_manifold, hull
from ..core.geometry.vectors import transformed_back
from ..core.results.arrays import Results
from ..core.results.frames import Frame
from ..core.results.inventory import Inventory

_NO_TRIANGLES = np.zeros((0, 3), np.int64)


def body_meshes(inventory: Inventory) -> list[TriangleMesh]:
    """Return the surface of every body in its own axes, from its origin.

    It is the convex hull, which is what Bullet lets collide, or the triangles of ground that is not flat. Any other
    body that never moves, and has one height above each place, is that surface. A body of which none of these can be
    had has no triangles.
    """
    found = []
    for body, (vertices, moves) in enumerate(zip(inventory.vertices_by_body(), inventory.moves, strict=True)):
        if len(triangles := inventory.triangles_of(body)):
            found.append(TriangleMesh(vertices, triangles.astype(np.int64)))
        else:
            found.append(_hull(vertices) if moves or not _is_surface(vertices) else _surface(vertices))
    return found


def _hull(vertices: np.ndarray) -> TriangleMesh:
    if len(vertices) >= 4:
        mesh = from_manifold(hull(vertices))
        if len(mesh.triangles) and mesh.volume > THINNEST * mesh.cube_volume:
            return mesh
    return TriangleMesh(vertices, _NO_TRIANGLES)


def _is_surface(vertices: np.ndarray) -> bool:
    """Return whether vertices spread over an area in plan, with one of them at each place."""
    plan = vertices[:, :2] - vertices[0, :2]
    return len(np.unique(plan, axis=0)) == len(plan) and np.linalg.matrix_rank(plan) == 2


def _surface(vertices: np.ndarray) -> TriangleMesh:
    triangles = Delaunay(vertices[:, :2]).simplices.astype(np.int64)
    sides = vertices[triangles[:, 1:], :2] - vertices[triangles[:, :1], :2]
    downwards = sides[:, 0, 0] * sides[:, 1, 1] < sides[:, 0, 1] * sides[:, 1, 0]
    triangles[downwards] = triangles[downwards, ::-1]
    return TriangleMesh(vertices, triangles)


class ConnectionPlaces:
    """Where connections are as they move with their first bodies.

    Parameters
    ----------
    results
        The run.
    """

    def __init__(self, results: Results):
        inventory, first = results.inventory, results.frames[0]
        self._bodies, self._points_m = inventory.pairs[:, 0], inventory.points_m
        arms_m = self._points_m - first.positions_m[self._bodies]
        self._local_m = transformed_back(first.rotations[self._bodies].astype(float), arms_m)

    def at(self, frame: Frame) -> np.ndarray:
        """Return the places (m, 3) in a frame, m; one without a first body stays where it was."""
        turns = frame.rotations[self._bodies].astype(float)
        carried = carried_points(self._local_m, frame.positions_m[self._bodies].astype(float), turns)
        return np.where(self._bodies[:, None] < 0, self._points_m, carried)


def quaternions(rotations: np.ndarray) -> np.ndarray:
    """Return unit quaternions (k, …, 4), w first, of rotation matrices (k, …, 3, 3).

    Of the two quaternions of a rotation it is the one that is nearer to that before, along the first axis.

    References
    ----------
    S. W. Shepperd (1978), Quaternion from rotation matrix, Journal of Guidance and Control 1(3), 223-224.
    """
    r = np.asarray(rotations, float)
    trace = r[..., 0, 0] + r[..., 1, 1] + r[..., 2, 2]
    squares = np.stack([trace, r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]], axis=-1)
    products = np.empty((*trace.shape, 4, 4))  # of each component with each other one, times four
    for row in range(4):
        products[..., row, row] = 1.0 + 2.0 * squares[..., row] - trace
    products[..., 0, 0] = 1.0 + trace
    for axis, (one, other) in enumerate(((1, 2), (2, 0), (0, 1)), start=1):
        products[..., 0, axis] = products[..., axis, 0] = r[..., other, one] - r[..., one, other]
        products[..., one + 1, other + 1] = products[..., other + 1, one + 1] = r[..., one, other] + r[..., other, one]
    largest = squares.argmax(axis=-1)
    found = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    found /= np.linalg.norm(found, axis=-1, keepdims=True)
    turned_over = (found[1:] * found[:-1]).sum(axis=-1) < 0.0
    signs = np.concatenate([np.ones((1, *turned_over.shape[1:])), np.where(turned_over, -1.0, 1.0)]).cumprod(axis=0)
    return found * signs[..., None]


def needed_keys(values: np.ndarray) -> np.ndarray:
    """Return which of k keys with values (k, c) are enough: of equal ones that follow each other, first and last."""
    changes = (values[1:] != values[:-1]).any(axis=1)
    if not changes.any():
        return np.zeros(1, int)
    inner = np.flatnonzero(changes[1:] | changes[:-1]) + 1
    return np.concatenate([[0], inner, [len(values) - 1]])
