"""The law of springs between two bodies: what footings on soil and pads of bearings resist (`core/src/springs.h`).

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Struct


class _Law(Struct):
    _fields_ = (
        ("count", Count),
        *((name, Doubles) for name in ("vertical", "sideways", "capacity", "friction", "pressed")),
        ("pulls", Flags),
    )


@dataclass(frozen=True, eq=False)
class PressedSprings:
    """Resistance of q springs: they press upwards, and hold sideways by their stiffness up to friction."""

    vertical_n_m: FloatArray  # (q,), stiffness
    sideways_n_m: FloatArray  # (2, q), stiffness along x and y
    capacity_n: FloatArray  # (q,), largest pressing force; may be infinite
    friction: FloatArray  # (q,), largest force sideways by the pressing force; infinite where they do not slide
    pulls: BoolArray  # (q,), whether they hold what is lifted
    pressed_n: FloatArray  # (q,), pressing force by which they hold sideways

    def only(self, which: IntArray) -> PressedSprings:
        """Return some of the springs."""
        return PressedSprings(*(getattr(self, item.name)[..., which] for item in fields(self)))

    @property
    def whole(self) -> FloatArray:
        """Stiffness (3, 3, q) of springs that neither lift off, nor slide, nor yield."""
        tangents = np.zeros((3, 3, len(self.vertical_n_m)))
        tangents[0, 0], tangents[1, 1], tangents[2, 2] = *self.sideways_n_m, self.vertical_n_m
        return tangents

    def resisted(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return forces (3, q) on what lies above gaps (3, q), and by how much these fall with them, (3, 3, q)."""
        count = len(self.vertical_n_m)
        forces, tangents = np.empty((3, count)), np.empty((3, 3, count))
        call("bda_springs_resisted", self._core, self._of_all(gaps_m), forces, tangents)
        return forces, tangents

    def stored_j(self, gaps_m: FloatArray) -> FloatArray:
        """Return the energy (q,) that springs across gaps (3, q) would give back."""
        stored = np.empty(len(self.vertical_n_m))
        call("bda_springs_stored", self._core, self._of_all(gaps_m), stored)
        return stored

    def _of_all(self, gaps_m: FloatArray) -> FloatArray:
        if gaps_m.shape != (3, len(self.vertical_n_m)):
            raise ValueError(f"gaps have shape {gaps_m.shape}: expected (3, {len(self.vertical_n_m)})")
        return np.ascontiguousarray(gaps_m)

    @cached_property
    def _core(self) -> _Law:
        count = len(self.vertical_n_m)
        law = _Law(count=count)
        for name, array in (
            ("vertical", self.vertical_n_m),
            ("sideways", self.sideways_n_m),
            ("capacity", self.capacity_n),
            ("friction", self.friction),
            ("pressed", self.pressed_n),
            ("pulls", self.pulls),
        ):
            law.point(name, np.ascontiguousarray(array), 2 * count if name == "sideways" else count)
        return law
