"""Bodies and elastic connections as symmetric linear equations, which the compiled core factors; first frequencies."""

from __future__ import annotations

import ctypes
import weakref
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.library import function
from ..core.structs import Doubles, Indices
from .joint_rows import JointRows, matrix_products, transposed

_BLOCK = 6

_POINTER = ctypes.c_void_p


class BlockSystem:
    """Equations of bodies, coupled in pairs by c connections, whose numbers change while their pattern does not.

    `first` and `second` (c,) are the bodies of each connection; -1 for one whose motion is known.

    Attributes
    ----------
    address : int
        Where the core has them.
    """

    def __init__(self, body_count: int, first: IntArray, second: IntArray):
        self._count = body_count
        new = function("bda_equations_new", *[ctypes.c_int64] * 2, *[_POINTER] * 2, returns=_POINTER)
        ends = [np.ascontiguousarray(bodies, np.int64) for bodies in (first, second)]
        if len(first) != len(second):
            raise ValueError(f"there are {len(first)} first and {len(second)} second bodies")
        if any(((bodies < -1) | (bodies >= body_count)).any() for bodies in ends):
            raise ValueError(f"a connection has a body that is not one of {body_count}")
        address = new(body_count, len(first), *(bodies.ctypes.data for bodies in ends))
        if not address:
            raise MemoryError(f"there is no room for the equations of {body_count} bodies")
        self.address = int(address)
        weakref.finalize(self, function("bda_equations_free", _POINTER, returns=None), self.address)

    def assemble(self, of_bodies: FloatArray, connections: IntArray, *blocks: FloatArray) -> None:
        """Take over the numbers of each body (6, 6, b), and what some connections (k,) add, three (6, 6, k).

        A connection adds to its first body, its second, and between them, with rows for the first body.
        """
        own = Doubles.checked("blocks of bodies", _matrices(of_bodies), _BLOCK * _BLOCK * self._count)
        connections, added = _handed(connections, blocks)
        call = function("bda_equations_assemble", _POINTER, _POINTER, ctypes.c_int64, _POINTER, _POINTER)
        answer = call(self.address, own.ctypes.data, len(connections), connections.ctypes.data, added.ctypes.data)
        if answer:
            raise ValueError(f"there are no connections {connections} in the equations")

    def factor(self, connections: IntArray | None = None, *blocks: FloatArray) -> None:
        """Factor what was assembled, with what other connections (k,) add; the next time that is forgotten."""
        rows, added = _handed(np.zeros(0, int) if connections is None else connections, blocks)
        call = function("bda_equations_factor", _POINTER, ctypes.c_int64, _POINTER, _POINTER)
        if call(self.address, len(rows), rows.ctypes.data, added.ctypes.data):
            raise ValueError(f"there are no connections {rows} in the equations")

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the unknowns (6, b) for a right-hand side (6, b)."""
        right, unknowns = np.ascontiguousarray(right), np.empty((_BLOCK, self._count))
        right = Doubles.checked("the right-hand side", right, unknowns.size)
        solve = function("bda_equations_solve", _POINTER, _POINTER, _POINTER, returns=None)
        solve(self.address, right.ctypes.data, unknowns.ctypes.data)
        return unknowns


def _handed(connections: IntArray, blocks: Sequence[FloatArray]) -> tuple[IntArray, FloatArray]:
    """Return connections (k,), and three blocks (6, 6, k) of each as (k, 3, 6, 6)."""
    added = np.stack([_matrices(block) for block in blocks], axis=1) if blocks else np.zeros(0)
    size = 3 * _BLOCK * _BLOCK * len(connections)
    return Indices.checked("connections", connections, len(connections)), Doubles.checked("blocks", added, size)


def _matrices(blocks: FloatArray) -> FloatArray:
    """Return blocks (6, 6, k) as (k, 6, 6)."""
    return np.ascontiguousarray(np.moveaxis(blocks, 2, 0))


@dataclass(frozen=True, slots=True, eq=False)
class RigidBodies:
    """n bodies of known mass, where no connection is deformed. Those that never move have mass and inertia 0."""

    masses_kg: FloatArray  # (n,)
    inertias_kg_m2: FloatArray  # (3, 3, n), in the axes of the bodies
    positions_m: FloatArray  # (3, n), centres of mass
    rotations: FloatArray  # (3, 3, n)

    def __len__(self) -> int:
        return len(self.masses_kg)

    @property
    def moves(self) -> BoolArray:
        """Whether each body (n,) can move."""
        return self.masses_kg > 0.0

    def mass_matrices(self, rotations: FloatArray, bodies: IntArray) -> FloatArray:
        """Return mass and inertia (6, 6, b) in the axes of the world, of some bodies (b,) in rotations (3, 3, n)."""
        turned = rotations[..., bodies]
        matrices = np.zeros((6, 6, len(bodies)))
        matrices[[0, 1, 2], [0, 1, 2]] = self.masses_kg[bodies]
        of_bodies = self.inertias_kg_m2[..., bodies]
        matrices[3:, 3:] = matrix_products(matrix_products(turned, of_bodies), transposed(turned))
        return matrices


def summed_on_bodies(first: IntArray, second: IntArray, loads: tuple[FloatArray, FloatArray], count: int) -> FloatArray:
    """Return the sums (6, n) of loads (6, m) on first and second bodies (m,), for n bodies."""
    bodies = np.concatenate((first, second))
    return np.stack([np.bincount(bodies, component, count) for component in np.concatenate(loads, axis=1)])


def without(stiffness: FloatArray, rows: IntArray) -> FloatArray:
    """Return stiffness (6, 6, m) with nothing of connections (r,)."""
    left = stiffness.copy()
    left[..., rows] = 0.0
    return left


def connected_parts(moves: BoolArray, first: IntArray, second: IntArray) -> IntArray:
    """Return the part (n,) of each body, by the bodies (m,) of connections; -1 for those that do not move."""
    free = moves[first] & moves[second]
    first, second = first[free], second[free]
    lowest = np.arange(len(moves))  # index of the lowest body that each is known to hang together with
    while len(apart := np.flatnonzero(lowest[first] != lowest[second])):
        ends = lowest[first[apart]], lowest[second[apart]]
        np.minimum.at(lowest, np.concatenate(ends), np.tile(np.minimum(*ends), 2))
        while (lowest[lowest] != lowest).any():
            lowest = lowest[lowest]
    return np.where(moves, np.unique(lowest, return_inverse=True)[1], -1)


def spring_forces(stiffness: FloatArray, strains: FloatArray) -> FloatArray:
    """Return the amounts (6, m) in rows, by stiffness (6, 6, m), of deformations (6, m)."""
    amounts: FloatArray = stiffness[:, 0] * strains[0]
    for column in range(1, 6):
        amounts += stiffness[:, column] * strains[column]
    return amounts


def stiffness_blocks(rows: JointRows, stiffness: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return what connections add to the equations of their first and second bodies, and between: (6, 6, m) each."""
    first, second = rows.matrices()
    first_stressed, second_stressed = (matrix_products(stiffness, matrices) for matrices in (first, second))
    return (
        matrix_products(transposed(first), first_stressed),
        matrix_products(transposed(second), second_stressed),
        matrix_products(transposed(first), second_stressed),
    )


SLACK = 1.0 / np.square(60.0 / (2.0 * np.pi))
"""Square of the angular frequency with a period of 60 s: parts that are held by less are mechanisms.

So much of the mass is added to the stiffness, so that the equations of mechanisms have a solution.
"""

_SLIDING = 0.02
"""Frequency over that of swinging up and down, up to which a part slides: bearings that tilt as the bridge deforms
hold it a little."""

_ITERATIONS = 60
_SAME_FREQUENCY = 1e-6


def first_frequency(system: BlockSystem, masses: FloatArray) -> float:
    """Return the first frequency in Hz; of what is free to slide, that of its swinging up and down.

    `system` has the factors of K + `SLACK` M, with mass matrices M (6, 6, b) of the bodies.
    """
    lowest, upright = _lowest_square(system, masses) - SLACK, _square_by_weight(system, masses)
    if lowest <= max(SLACK, _SLIDING * _SLIDING * upright):  # it slides, or sways like a pendulum
        lowest = upright
    return float(np.sqrt(max(lowest, 0.0)) / (2.0 * np.pi))


def _square_by_weight(system: BlockSystem, own: FloatArray) -> float:
    """Square of the angular frequency of the shape (z alone) that the weight bends it to: Lord Rayleigh (1877)."""
    masses = own[2, 2]
    weights = np.zeros((6, len(masses)))
    weights[2] = masses
    down = system.solve(weights)[2]
    return float((masses * down).sum() / (masses * down * down).sum())


def _lowest_square(system: BlockSystem, own: FloatArray) -> float:
    """Square of the lowest angular frequency, by inverse iteration from an even motion in all directions."""
    shape = np.zeros((6, own.shape[2]))
    shape[:3] = 1.0
    square = 0.0
    for _ in range(_ITERATIONS):
        inert = own[:, 0] * shape[0]
        for column in range(1, 6):
            inert = inert + own[:, column] * shape[column]
        answer = system.solve(inert)
        before, square = square, float((shape * inert).sum() / (answer * inert).sum())
        shape = answer / abs(answer).max()
        if abs(square - before) <= _SAME_FREQUENCY * abs(square):
            break
    return square
