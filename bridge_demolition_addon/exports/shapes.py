"""Shapes and colours of the bodies of a run in other programs, and the positions of bodies and connections."""

from __future__ import annotations

import numpy as np

from ..engineering.geometry.hulls import THINNEST
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import from_manifold, hull
from ..engineering.geometry.vectors import carried_points, transformed_back
from ..model.results.arrays import Results
from ..model.results.frames import Frame, Inventory

_FRAMES_PER_SECOND = 24.0
_NO_TRIANGLES = np.zeros((0, 3), np.int64)
_FEWEST_VERTICES = 4

Colour = tuple[float, float, float]

_COLOURS: dict[str, Colour] = {
    "ball": (0.03, 0.03, 0.03),
    "ground": (0.35, 0.32, 0.26),
    "tool": (0.6, 0.4, 0.0),
    "crane": (0.6, 0.4, 0.0),
    "deck": (0.42, 0.42, 0.41),
    "girder": (0.28, 0.32, 0.38),
    "pier": (0.35, 0.28, 0.22),
    "pier cap": (0.30, 0.24, 0.20),
    "abutment": (0.22, 0.22, 0.22),
}
_OTHER: Colour = (0.4, 0.4, 0.4)


def body_meshes(inventory: Inventory) -> list[TriangleMesh]:
    """Return the colliding surface of every body: its convex hull, or the triangles of ground that is not flat.

    It is in the body's own axes, from its origin. A body without volume has no triangles.
    """
    return [_mesh(vertices, inventory.triangles_of(body)) for body, vertices in enumerate(inventory.vertices_by_body())]


def _mesh(vertices: np.ndarray, triangles: np.ndarray) -> TriangleMesh:
    return TriangleMesh(vertices, triangles) if len(triangles) else _hull(vertices)


def _hull(vertices: np.ndarray) -> TriangleMesh:
    """Return the convex hull; vertices and triangles are in order, so that files are the same each time."""
    mesh = from_manifold(hull(vertices)) if len(vertices) >= _FEWEST_VERTICES else TriangleMesh(vertices, _NO_TRIANGLES)
    if not len(mesh.triangles) or mesh.volume <= THINNEST * mesh.cube_volume:  # all of them in one plane
        return TriangleMesh(vertices, _NO_TRIANGLES)
    corners, places = np.unique(mesh.vertices, axis=0, return_inverse=True)
    triangles = places.ravel()[mesh.triangles]
    first = triangles.argmin(axis=1)[:, None]
    triangles = np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)
    return TriangleMesh(corners, triangles[np.lexsort(triangles.T[::-1])])


class ConnectionPositions:
    """Positions of connections, which move with their first bodies."""

    def __init__(self, results: Results):
        inventory, first = results.inventory, results.frames[0]
        self._bodies, self._points_m = inventory.pairs[:, 0], inventory.points_m
        arms_m = self._points_m - first.positions_m[self._bodies]
        self._local_m = transformed_back(first.rotations[self._bodies].astype(float), arms_m)

    def at(self, frame: Frame) -> np.ndarray:
        """Return the positions (m, 3) in a frame, m; one without a first body stays where it was."""
        turns = frame.rotations[self._bodies].astype(float)
        carried = carried_points(self._local_m, frame.positions_m[self._bodies].astype(float), turns)
        return np.where(self._bodies[:, None] < 0, self._points_m, carried)


def frame_rate(results: Results) -> float:
    """Return frames per second, by the median length of a frame; a film's rate for a run of one frame."""
    lengths_s = np.diff(results.frames.time_s)
    return 1.0 / float(np.median(lengths_s)) if len(lengths_s) else _FRAMES_PER_SECOND


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
    unit = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    unit /= np.linalg.norm(unit, axis=-1, keepdims=True)
    turned_over = (unit[1:] * unit[:-1]).sum(axis=-1) < 0.0
    signs = np.concatenate([np.ones((1, *turned_over.shape[1:])), np.where(turned_over, -1.0, 1.0)]).cumprod(axis=0)
    return unit * signs[..., None]


def needed_keys(values: np.ndarray) -> np.ndarray:
    """Return which of k keys with values (k, c) are enough: of equal ones that follow each other, first and last."""
    changes = (values[1:] != values[:-1]).any(axis=1)
    if not changes.any():
        return np.zeros(1, int)
    inner = np.flatnonzero(changes[1:] | changes[:-1]) + 1
    return np.concatenate([[0], inner, [len(values) - 1]])


def coloured_by(inventory: Inventory) -> list[str]:
    """Return what each body is coloured by: the kind of its member, or its own kind where it is of none."""
    pairs = zip(inventory.body_member_kinds.tolist(), inventory.body_kinds.tolist(), strict=True)
    return [member or body for member, body in pairs]


def colour_of(kind: str) -> Colour:
    """Return red, green and blue from 0 to 1, linear."""
    return _COLOURS.get(kind, _OTHER)
