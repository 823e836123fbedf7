"""Vectors, matrices and rotations with the same bits on every processor.

Sums run in a fixed order, component by component. Products by numpy's `@`, `dot`, `einsum` or `linalg` go through
libraries that choose another order by processor, and one bit is enough for another fracture and another collapse.

The arguments' leading axes are broadcast against each other.

Arrays whose components lie together in memory, all x and then all y, are worked on in a third of the time. `dot`,
`length` and `transformed` keep that order, `by_component` and `cross_by_component` give it.
"""

from __future__ import annotations

import math

import numpy as np

from ..arithmetic import arctangent, cosine, sine
from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Struct, WrittenDoubles


class Matrices(Struct):
    """Matrices that become diagonal, and others that turn along: `bda_matrices`."""

    _fields_ = (("count", Count), ("matrices", WrittenDoubles), ("followed", WrittenDoubles))


def dot(first: FloatArray, second: FloatArray) -> FloatArray:
    """Dot products (...) of vectors (..., k)."""
    total = first[..., 0] * second[..., 0]
    for axis in range(1, first.shape[-1]):
        total = total + first[..., axis] * second[..., axis]
    return total


def length(vectors: FloatArray) -> FloatArray:
    """Lengths (...) of vectors (..., k)."""
    return np.sqrt(dot(vectors, vectors))


def distance(first: FloatArray, second: FloatArray) -> FloatArray:
    """Distances (...) between points (..., k), without an array of their differences."""
    squares = np.square(first[..., 0] - second[..., 0])
    for axis in range(1, first.shape[-1]):
        squares = squares + np.square(first[..., axis] - second[..., axis])
    return np.sqrt(squares)


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors (..., k) of length 1 in the same directions; 0 where there is no length."""
    lengths = length(vectors)[..., None]
    return np.divide(vectors, lengths, out=np.zeros(np.shape(vectors)), where=lengths > 0.0)


def cross_2d(first: FloatArray, second: FloatArray) -> FloatArray:
    """Cross products (...) of plane vectors (..., 2), positive where the second lies to the left of the first."""
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Cross products (k, 3) of vectors (k, 3), in a third of the time of `numpy.cross`."""
    (x, y, z), (a, b, c) = first.T, second.T
    return np.column_stack((y * c - z * b, z * a - x * c, x * b - y * a))


def by_component(x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    """Vectors (..., 3) whose components (...) each lie together in memory."""
    return as_vectors(np.stack((x, y, z)))


def as_vectors(components: FloatArray) -> FloatArray:
    """Vectors (..., 3) with these components (3, ...), without a copy: `numpy.moveaxis`, in a tenth of the time."""
    return components.transpose(*range(1, components.ndim), 0)


def as_components(vectors: FloatArray) -> FloatArray:
    """Components (3, ...) of vectors (..., 3), without a copy."""
    return vectors.transpose(vectors.ndim - 1, *range(vectors.ndim - 1))


def cross_by_component(first: FloatArray, second: FloatArray) -> FloatArray:
    """Cross products (..., 3) of vectors (..., 3), whose components each lie together in memory."""
    product = np.empty((3, *np.broadcast_shapes(first.shape, second.shape)[:-1]))
    taken_off = np.empty(product.shape[1:])
    for axis, (one, other) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.multiply(first[..., one], second[..., other], out=product[axis])
        np.multiply(first[..., other], second[..., one], out=taken_off)
        product[axis] -= taken_off
    return as_vectors(product)


def transformed(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Products (..., i) of matrices (..., i, j) with vectors (..., j)."""
    total = matrices[..., 0] * vectors[..., 0, None]
    for column in range(1, matrices.shape[-1]):
        total = total + matrices[..., column] * vectors[..., column, None]
    return total


def transformed_back(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Products (..., j) of transposed matrices (..., i, j) with vectors (..., i): rotations undone."""
    return transformed(np.swapaxes(matrices, -1, -2), vectors)


def product(first: FloatArray, second: FloatArray) -> FloatArray:
    """Products (..., i, k) of matrices (..., i, j) and (..., j, k)."""
    total = first[..., :, 0, None] * second[..., None, 0, :]
    for middle in range(1, first.shape[-1]):
        total = total + first[..., :, middle, None] * second[..., None, middle, :]
    return total


def outer(first: FloatArray, second: FloatArray) -> FloatArray:
    """Matrices (..., i, j) of the products of components of vectors (..., i) and (..., j)."""
    return first[..., :, None] * second[..., None, :]


def symmetric_eigenvalues(matrices: FloatArray) -> FloatArray:
    """Eigenvalues (..., 3), ascending, of symmetric matrices (..., 3, 3)."""
    return np.sort(_diagonalised(matrices), axis=-1)


def symmetric_eigenvectors(matrices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues (..., 3), ascending, of symmetric matrices (..., 3, 3), and right-handed eigenvectors as columns."""
    rows = np.broadcast_to(np.eye(3), matrices.shape).copy()
    values = _diagonalised(matrices, rows)
    order = np.argsort(values, axis=-1, kind="stable")
    rows = np.take_along_axis(rows, order[..., None], axis=-2)
    rows[..., 2, :] = np.cross(rows[..., 0, :], rows[..., 1, :])
    return np.take_along_axis(values, order, axis=-1), np.swapaxes(rows, -1, -2)


def _diagonalised(matrices: FloatArray, followed: FloatArray | None = None) -> FloatArray:
    """Diagonals (..., 3) of matrices (..., 3, 3) by Jacobi's method; other matrices have their rows rotated along."""
    rest = np.array(matrices, float, order="C")
    core = Matrices(count=rest.size // 9).take(matrices=(rest, rest.size))
    if followed is not None:
        core.take(followed=(followed, rest.size))
    call("bda_diagonalise", core)
    return np.diagonal(rest, axis1=-2, axis2=-1)


def points_along(path_m: np.ndarray, distances_m: np.ndarray) -> np.ndarray:
    """Return the points (k, d) of a path (p, d) at distances (k,) from its beginning; its end beyond it."""
    passed = np.concatenate(([0.0], np.cumsum(length(np.diff(path_m, axis=0)))))
    return np.column_stack([np.interp(distances_m, passed, column) for column in path_m.T])


AXES = ("x", "y", "z")

SIDES = {"start": (0, -1), "end": (0, 1), "right": (1, -1), "left": (1, 1), "bottom": (2, -1), "top": (2, 1)}
"""Axis across each side, and whether the side is where that is lowest or highest."""


_QUARTERS = (
    ((1.0, 0.0), (0.0, 1.0)),
    ((0.0, -1.0), (1.0, 0.0)),
    ((-1.0, 0.0), (0.0, -1.0)),
    ((0.0, 1.0), (-1.0, 0.0)),
)
"""Rotations by none, one, two and three right angles."""

_SMALLEST_SINE = 1e-9
"""Below it an angle and its sine are one."""


def turn_in_plane(angle_rad: float) -> FloatArray:
    """Matrix (2, 2) that turns plane vectors by an angle, anticlockwise."""
    return np.array([[cosine(angle_rad), -sine(angle_rad)], [sine(angle_rad), cosine(angle_rad)]])


def turn_by_degrees(angle_deg: float) -> FloatArray:
    """Matrix (2, 2) that turns plane vectors by an angle in degrees, anticlockwise, exact for right angles."""
    quarters = angle_deg / 90.0
    if quarters.is_integer():
        return np.array(_QUARTERS[int(quarters % 4.0)])
    return turn_in_plane(math.radians(angle_deg))


def rotation_vectors(before: FloatArray, after: FloatArray) -> FloatArray:
    """Rotation vectors (..., 3) in rad that turn rotations (..., 3, 3) into others, in the world's axes.

    The shorter way round: a body that turns by more than half a turn between the two seems to turn backwards. Of a turn
    by exactly half, the axis is not defined, and 0 is given.
    """
    change = product(after, np.swapaxes(before, -1, -2))
    # The skew part of a rotation by θ about a is sin θ a, and its trace 1 + 2 cos θ.
    doubled = np.stack([change[..., 2, 1], change[..., 0, 2], change[..., 1, 0]], axis=-1)
    doubled -= np.stack([change[..., 1, 2], change[..., 2, 0], change[..., 0, 1]], axis=-1)
    sines = length(doubled) / 2.0
    angles = arctangent(sines, (np.trace(change, axis1=-2, axis2=-1) - 1.0) / 2.0)
    factors = np.divide(angles, 2.0 * sines, out=np.full_like(sines, 0.5), where=sines > _SMALLEST_SINE)
    return factors[..., None] * doubled


def rotated(rotations: FloatArray, vectors: FloatArray) -> FloatArray:
    """Rotations (..., 3, 3) turned further by rotation vectors (..., 3) in rad, by Rodrigues' formula."""
    angles = length(vectors)[..., None, None]
    cross = np.zeros(rotations.shape)
    cross[..., 2, 1], cross[..., 0, 2], cross[..., 1, 0] = np.moveaxis(vectors, -1, 0)
    cross -= np.swapaxes(cross, -1, -2)
    by_sine, by_cosine = _sine_by_angle(angles), np.square(_sine_by_angle(angles / 2.0)) / 2.0
    return rotations + product(by_sine * cross + by_cosine * product(cross, cross), rotations)


def carried_points(local_points: FloatArray, centres: FloatArray, rotations: FloatArray) -> FloatArray:
    """Positions (..., m, 3) of points fixed to moving bodies, m, with centre and rotation of the body of each.

    `local_points` (m, 3) are in the axes of their bodies, from the bodies' centres, m.
    """
    return centres + transformed(rotations, local_points)


def axes_in_bodies(axes: FloatArray, bodies: IntArray, rotations: FloatArray) -> FloatArray:
    """Axes (m, 3, 3), as columns, as seen from the bodies (m,) that they turn with, for `carried_axes`."""
    return product(np.swapaxes(rotations[bodies], 1, 2), axes)


def carried_axes(local_axes: FloatArray, bodies: IntArray, rotations: FloatArray) -> FloatArray:
    """Axes (m, 3, 3) in the world that turn with bodies (m,), from `axes_in_bodies`."""
    return product(rotations[bodies], local_axes)


def _sine_by_angle(angles: FloatArray) -> FloatArray:
    return np.divide(sine(angles), angles, out=np.ones(angles.shape), where=angles != 0.0)
