"""The rows of constraints: frames in which they are written, and the relative motion that the solver is to expect.

A row of a btGeneric6DofSpring2Constraint whose two limits are equal holds a shift or a rotation at that limit. With all
of an error corrected in one sub-step, the limit says how fast the bodies part in it. Where they move so without the
solver, its rows do nothing; they only resist changes by contacts, with the softness that they were set to.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import bpy
import numpy as np

from ..engineering.core.structs import Addresses, Count, Flags, Indices, Struct, WrittenFlags
from ..errors import LayoutError
from .layout import ALL_ROWS_SET, SPRING_CORRECTION, SPRING_TYPE, Layout, SpringLayout
from .memory import DOUBLES, INTEGERS, gather_doubles, read, read_value

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

_FRAME = 8 * np.arange(15, dtype=np.uint64)
"""Offsets of the numbers of a frame: three rows of its axes, each with one that is not used, and its position."""


class BulletRows(Struct):
    """Rows of k springs: `bda_bullet_rows`."""

    _OFFSETS = ("lower", "upper", "correction", "softness")
    _fields_ = (
        ("count", Count),
        ("addresses", Addresses),
        *((name, Indices) for name in _OFFSETS),
        ("flags", Count),
        ("held", Flags),
        ("resists", WrittenFlags),
    )

    @classmethod
    def of(cls, layout: SpringLayout, addresses: np.ndarray, held: np.ndarray, resists: np.ndarray) -> BulletRows:
        """Return the rows of springs at addresses (k,), of which some (6, k) are held, and some (6, k) resist."""
        made = cls(count=len(addresses), flags=layout.flags)
        made.point("addresses", addresses, len(addresses))
        for name in cls._OFFSETS:
            made.point(name, np.array(getattr(layout, name), np.int64), 6)
        made.point("held", held, held.size)
        made.point("resists", resists, resists.size)
        return made


class Softness(Struct):
    """How soft rows may be, and where frames are: `bda_softness`."""

    _fields_ = (
        *((name, ctypes.c_double) for name in ("softest", "free_from")),
        *((name, Count) for name in ("flags", "frame_a", "frame_b")),
    )


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
        self._built = self._frames()  # by Blender
        self._moved = np.zeros(len(addresses), bool)
        self.softness = Softness(
            softest=_SOFTEST, free_from=_FREE_FROM, flags=ALL_ROWS_SET, frame_a=self._starts[0], frame_b=self._starts[1]
        )
        self.core = BulletRows.of(layout.spring, addresses, self.held, self._resists)

    def frame_components(self) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
        """Return axes (3, 3, k) and positions (3, k) of the frames in Bullet's body A, and of those in its body B."""
        frames = [values.T for values in self._frames()]
        return tuple((values[:12].reshape(3, 4, -1)[:, :3].copy(), values[12:].copy()) for values in frames)

    def _frames(self) -> list[np.ndarray]:
        """Axes and positions (k, 15) of both frames, as they are in memory."""
        return [gather_doubles(self._addresses + np.uint64(start), 15) for start in self._starts]

    def let_resist_as_cracks(self, rows: np.ndarray) -> None:
        """Take note that the core has constraints (r,) resist as cracks do: `restore` undoes it."""
        self._moved[rows] = True

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
        for start, frames in zip(self._starts, self._built, strict=True):
            DOUBLES.write((self._addresses[moved] + np.uint64(start))[:, None] + _FRAME, frames[moved])
        self._resists[:, rows] = self.held[:, rows]
        self._hold_at(rows, self._limits[:, rows])
        self._write(rows, SPRING_CORRECTION, np.zeros((6, len(rows))), 0)

    def expect(self, rows: np.ndarray, deformations: np.ndarray) -> None:
        """Set how constraints (r,) will be deformed (6, r) at the end of the coming sub-step, if nothing else acts."""
        self._hold_at(rows, deformations * _SIGNS[:, None])

    def _hold_at(self, rows: np.ndarray, limits: np.ndarray) -> None:
        """Write limits (6, r) of rows that are held, both alike: crossed ones leave a row free."""
        held, resists, spring = self.held[:, rows], self._resists[:, rows], self._layout.spring
        for offsets, free in ((spring.lower, 1.0), (spring.upper, -1.0)):
            DOUBLES.write(self._fields(offsets, rows)[held], np.where(resists, limits, free)[held])

    def _write(self, rows: np.ndarray, correction: float, softness: np.ndarray, flags: int) -> None:
        spring = self._layout.spring
        DOUBLES.write(self._fields(spring.correction, rows), correction)
        DOUBLES.write(self._fields(spring.softness, rows), softness)
        INTEGERS.write(self._addresses[rows] + np.uint64(spring.flags), flags)

    def _fields(self, offsets: Sequence[int], rows: np.ndarray) -> np.ndarray:
        """Addresses (6, r) of fields of constraints (r,)."""
        return np.array(offsets, np.uint64)[:, None] + self._addresses[rows]

    def _doubles(self, offsets: Sequence[int]) -> np.ndarray:
        return DOUBLES.gather(self._fields(offsets, np.arange(len(self._addresses))))

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
