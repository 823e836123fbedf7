"""The rows of constraints: frames in which they are written, and the relative motion that the solver is to expect.

A row of a btGeneric6DofSpring2Constraint whose two limits are equal holds a shift or a rotation at that limit. With all
of an error corrected in one sub-step, the limit says how fast the bodies part in it. Where they move so without the
solver, its rows do nothing; they only resist changes by contacts, with the softness that they were set to.
"""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ..errors import LayoutError
from .layout import ALL_ROWS_SET, SPRING_CORRECTION, SPRING_TYPE, Layout
from .memory import DOUBLES, INTEGERS, field_loops, gather_doubles, read, read_value

_ROTATION = 1e-4
"""How far elements of two rotation matrices in single precision may differ."""

_POSITION = 1e-6
"""Relative spacing of positions in single precision, with room for one rounding more."""

_SAME_VALUE = 1e-6

_SOFTEST = 0.5
"""Largest softness of a row: Bullet's solver diverges from 1 on."""

_FREE_FROM = 2.0
"""Softness from which on a row is freer if it is left free than if it is as soft as rows can be."""

_SIGNS = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
"""Bullet takes limits of rotations with the opposite sign."""

_AS_THEY_ARE = np.ones(6)


class ConstraintRows:
    """Rows of the constraints at addresses (k,) of a world that was bound just now, before any time passes.

    `held` (6, k) marks the rows that hold a shift or a rotation; the others leave it free.
    """

    def __init__(self, layout: Layout, addresses: np.ndarray, names: Sequence[str]):
        self._layout, self._addresses = layout, addresses
        for address, name in zip(addresses.tolist(), names, strict=True):
            self._check(address, name)
        self._limits = self._doubles(layout.spring.lower)
        self.held = self._limits == self._doubles(layout.spring.upper)
        self._resists = self.held.copy()
        self._starts = layout.spring.frame_a, layout.spring.frame_b
        self._built = [gather_doubles(addresses + np.uint64(start), 15) for start in self._starts]  # by Blender
        self._moved = np.zeros(len(addresses), bool)
        offsets = (np.array(fields, np.int64) // DOUBLES.size for fields in (layout.spring.lower, layout.spring.upper))
        self._places = (DOUBLES.indices(addresses), *offsets)  # where limits are among all doubles

    def frame_components(self) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
        """Return axes (3, 3, k) and positions (3, k) of the frames in Bullet's body A, and of those in its body B."""
        frames = [values.T for values in self._built]
        return tuple((values[:12].reshape(3, 4, -1)[:, :3].copy(), values[12:].copy()) for values in frames)

    def move_frames(self, rows: np.ndarray, axes: Sequence[np.ndarray], points_m: Sequence[np.ndarray]) -> None:
        """Put the frames of existing constraints (r,) elsewhere in Bullet's bodies A and B; `restore` puts them back.

        Axes (3, 3, r), as columns, and positions (3, r) are those in each of the two bodies.
        """
        self._moved[rows] = True
        for start, built, of_body, points in zip(self._starts, self._built, axes, points_m, strict=True):
            frames = built[rows]
            frames[:, :12].reshape(-1, 3, 4)[..., :3] = np.moveaxis(of_body, -1, 0)
            frames[:, 12:] = points.T
            _write_frames(self._addresses[rows] + np.uint64(start), frames)

    def soften(self, rows: np.ndarray, softness: np.ndarray) -> None:
        """Have all of an error of existing constraints (r,) corrected in a sub-step, with a softness (6, r).

        That is the rows' effective masses by their stiffness against impulses. Rows that are softer than the solver can
        calculate are left free: they hardly resist in a sub-step.
        """
        self._resists[:, rows] = self.held[:, rows] & (softness < _FREE_FROM)
        self._write(rows, 1.0, np.minimum(softness, _SOFTEST), ALL_ROWS_SET)

    def restore(self, rows: np.ndarray) -> None:
        """Leave constraints (r,) as Blender made them."""
        moved = rows[self._moved[rows]]
        for start, built in zip(self._starts, self._built, strict=True):
            _write_frames(self._addresses[moved] + np.uint64(start), built[moved])
        self._resists[:, rows] = self.held[:, rows]
        self._hold_at(rows, self._limits[:, rows], _AS_THEY_ARE)
        self._write(rows, SPRING_CORRECTION, 0.0, 0)

    def expect(self, rows: np.ndarray, deformations: np.ndarray) -> None:
        """Set how constraints (r,) will be deformed (6, r) at the end of the coming sub-step, if nothing else acts."""
        self._hold_at(rows, deformations, _SIGNS)

    def _hold_at(self, rows: np.ndarray, limits: np.ndarray, signs: np.ndarray) -> None:
        """Write limits (6, r) times signs (6,)."""
        spring, loops = self._layout.spring, field_loops()
        if loops is not None:
            held = self.held, self._resists, np.ascontiguousarray(limits), signs
            loops.write_limits(DOUBLES.everywhere, *self._places, rows, *held)
            return
        limits = limits * signs[:, None]
        held, resists = self.held.take(rows, axis=-1), self._resists.take(rows, axis=-1)
        for offsets, when_free in ((spring.lower, 1.0), (spring.upper, -1.0)):
            DOUBLES.write(self._fields(offsets, rows)[held], np.where(resists, limits, when_free)[held])

    def _write(self, rows: np.ndarray, correction: float, softness: np.ndarray | float, flags: int) -> None:
        spring = self._layout.spring
        DOUBLES.write(self._fields(spring.correction, rows), correction)
        DOUBLES.write(self._fields(spring.softness, rows), softness)
        INTEGERS.write(self._addresses[rows] + np.uint64(spring.flags), flags)

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
        for field, offsets, expected in (
            ("correction", layout.spring.correction, SPRING_CORRECTION),
            ("softness", layout.spring.softness, 0.0),
        ):
            for offset in offsets:
                value = read_value(address + offset, "d")
                if not abs(value - expected) <= _SAME_VALUE:
                    raise LayoutError(f"{field} of connection {name!r} is {value:g}, not {expected:g}")


def _write_frames(addresses: np.ndarray, frames: np.ndarray) -> None:
    DOUBLES.everywhere[DOUBLES.indices(addresses)[:, None] + np.arange(15)] = frames


def check_frames(axes: np.ndarray, positions_m: np.ndarray, connections: Sequence[bpy.types.Object]) -> None:
    """Check that frames with axes (k, 3, 3) at positions (k, 3) are where Blender shows their connections."""
    shown = [connection.matrix_world.decompose() for connection in connections]
    shown_m = np.array([position for position, _, _ in shown]).reshape(-1, 3)
    rotations = np.array([rotation.to_matrix() for _, rotation, _ in shown], float).reshape(-1, 3, 3)
    off = abs(positions_m - shown_m).max(axis=1) > _POSITION * (1.0 + abs(shown_m).max(axis=1))
    off |= ~(abs(axes - rotations).max(axis=(1, 2)) <= _ROTATION)
    if off.any():
        raise LayoutError(
            f"the frame of connection {connections[int(off.argmax())].name!r} is not where the connection is"
        )
