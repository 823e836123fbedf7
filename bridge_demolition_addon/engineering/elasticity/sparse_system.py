"""Symmetric systems of equations with six unknowns a body, which the compiled core factors: `core/src/equations.h`."""

from __future__ import annotations

import ctypes
import weakref
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.library import function
from ..core.structs import Doubles, Indices

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
