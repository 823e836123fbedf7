"""The rows of constraints: frames in which they are written, and the relative motion that the solver is to expect.

A row of a btGeneric6DofSpring2Constraint whose two limits are equal holds a shift or a turn at that limit. With all of
an error corrected in one sub-step, the limit says how fast the bodies part in it. Where that is how they move without
the solver, its rows do nothing; they answer to what contacts change, as softly as they are told.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..errors import LayoutError
from .layout import ALL_ROWS_SET, SPRING_CORRECTION, SPRING_TYPE, Layout
from .memory import gather_doubles, read, read_value, write_doubles, write_integers

_ROTATION = 1e-4
"""How far elements of two rotation matrices in single precision may differ."""

_PLACE = 1e-6
"""Relative spacing of places in single precision, with room for one rounding more."""

_SAME_VALUE = 1e-6

_SOFTEST = 0.5
"""Largest softness of a row: Bullet's solver diverges from 1 on."""

_FREE_FROM = 2.0
"""Softness from which on a row is freer if it is left free than if it is as soft as rows can be."""

_TURNS_THE_OTHER_WAY = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])[:, None]
"""Bullet takes limits of turns with the opposite sign."""


class ConstraintRows:
    """Rows of constraints of a world that was bound just now, before any time passes.

    Parameters
    ----------
    layout
        Byte offsets.
    addresses
        (k,) of the constraints.
    names
        What the connections are called.

    Attributes
    ----------
    held
        (6, k) which rows hold a shift or a turn; the others leave it free.
    """

    def __init__(self, layout: Layout, addresses: np.ndarray, names: Sequence[str]):
        self._layout, self._addresses = layout, addresses
        for address, name in zip(addresses.tolist(), names, strict=True):
            self._check(address, name)
        self._limits = self._doubles(layout.spring.lower)
        self.held = self._limits == self._doubles(layout.spring.upper)
        self._answers = self.held.copy()

    def frames(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return axes (3, 3, k) and places (3, k) of the frames in Bullet's body A, and those in its body B."""
        found = []
        for offset in (self._layout.spring.frame_a, self._layout.spring.frame_b):
            values = gather_doubles(self._addresses + np.uint64(offset), 15).T
            found += [values[:12].reshape(3, 4, -1)[:, :3].copy(), values[12:].copy()]
        axes_a, places_a, axes_b, places_b = found
        return axes_a, places_a, axes_b, places_b

    def soften(self, rows: np.ndarray, softness: np.ndarray) -> None:
        """Have all of an error of constraints (r,) corrected in a sub-step, as softly as given.

        What is softer than the solver can be is left free: it hardly answers in a sub-step.

        Parameters
        ----------
        rows
            (r,) constraints that still exist, as for all that is written.
        softness
            (6, r) the rows' effective masses by their stiffness against impulses.
        """
        self._answers[:, rows] = self.held[:, rows] & (softness < _FREE_FROM)
        self._write(rows, 1.0, np.minimum(softness, _SOFTEST), ALL_ROWS_SET)

    def restore(self, rows: np.ndarray) -> None:
        """Leave constraints (r,) as Blender made them."""
        self._answers[:, rows] = self.held[:, rows]
        self._hold_at(rows, self._limits[:, rows])
        self._write(rows, SPRING_CORRECTION, 0.0, 0)

    def expect(self, rows: np.ndarray, deformations: np.ndarray) -> None:
        """Say how constraints (r,) will be deformed (6, r) at the end of the coming sub-step, if nothing else acts.

        Rows that are not held stay free.
        """
        self._hold_at(rows, deformations * _TURNS_THE_OTHER_WAY)

    def _hold_at(self, rows: np.ndarray, limits: np.ndarray) -> None:
        held, answers = self.held[:, rows], self._answers[:, rows]
        for offsets, when_free in ((self._layout.spring.lower, 1.0), (self._layout.spring.upper, -1.0)):
            write_doubles(self._fields(offsets, rows)[held], np.where(answers, limits, when_free)[held])

    def _write(self, rows: np.ndarray, correction: float, softness: np.ndarray | float, flags: int) -> None:
        spring = self._layout.spring
        write_doubles(self._fields(spring.correction, rows), correction)
        write_doubles(self._fields(spring.softness, rows), softness)
        write_integers(self._addresses[rows] + np.uint64(spring.flags), flags)

    def _fields(self, offsets: Sequence[int], rows: np.ndarray | slice = slice(None)) -> np.ndarray:
        return np.array(offsets, np.uint64)[:, None] + self._addresses[rows]

    def _doubles(self, offsets: Sequence[int]) -> np.ndarray:
        return gather_doubles(self._fields(offsets).ravel())[:, 0].reshape(6, -1)

    def _check(self, address: int, name: str) -> None:
        """Rows are as Blender makes them."""
        layout = self._layout
        if read_value(address + layout.constraint.type, "i") != SPRING_TYPE:
            raise LayoutError(f"connection {name!r} is of another type than elastic connections have")
        if read(address, layout.spring.flags + 4) is None:
            raise LayoutError(f"connection {name!r} cannot be read")
        if read_value(address + layout.spring.flags, "i") != 0:
            raise LayoutError(f"flags of connection {name!r} are set")
        for what, offsets, expected in (
            ("correction", layout.spring.correction, SPRING_CORRECTION),
            ("softness", layout.spring.softness, 0.0),
        ):
            for offset in offsets:
                found = read_value(address + offset, "d")
                if not abs(found - expected) <= _SAME_VALUE:
                    raise LayoutError(f"{what} of connection {name!r} is {found:g}, not {expected:g}")


def check_frames(
    axes: np.ndarray, points_m: np.ndarray, positions_m: np.ndarray, rotations: np.ndarray, names: Sequence[str]
) -> None:
    """Check that the frames of connections are where they are said to be.

    Parameters
    ----------
    axes, points_m
        (3, 3, k) and (3, k) frames in the world, by Bullet's memory.
    positions_m, rotations
        (3, k) and (3, 3, k) as Blender shows them.
    names
        What the connections are called.
    """
    size = 1.0 + abs(positions_m).max(axis=0)
    off = abs(points_m - positions_m).max(axis=0) > _PLACE * size
    off |= ~(abs(axes - rotations).max(axis=(0, 1)) <= _ROTATION)
    if off.any():
        raise LayoutError(f"the frame of connection {names[int(off.argmax())]!r} is not where the connection is")
