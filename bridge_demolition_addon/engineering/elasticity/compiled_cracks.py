"""Forces of cracks by loops that are compiled, where Numba is installed; the same bits without it, in more time."""

from __future__ import annotations

from types import ModuleType
from typing import Any, Protocol

from ..arrays import FloatArray
from ..compilation import where_compiled
from .crack_law import DOWEL_SHARE, CrackLaw
from .gaps import stiffness_of_points


class LawOfGaps(Protocol):
    """What gaps resist."""

    def forces(self, gaps_m: FloatArray) -> FloatArray:
        """Return the forces (3, b) across gaps (3, b)."""

    def linear(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the forces (3, b) across gaps (3, b), and how they change with these, (3, 3, b)."""


class CompiledCrackLaw:
    """A `CrackLaw` by compiled loops."""

    def __init__(self, law: CrackLaw, loops: Any):
        bars, rubbing = law.bars, law.rubbing
        self._loops = loops
        self._state = (
            (bars.yield_n, bars.stiffness_n_m, bars.modulus_n_m, bars.resists_n_m),
            law.slips_m,
            law.flows_m,
            law.normals,
            law.directions,
            law.pressed_n_m,
            (rubbing.yield_n, rubbing.stiffness_n_m, rubbing.resists_n_m),
            law.rests_m,
        )

    def forces(self, gaps_m: FloatArray) -> FloatArray:
        """Return the forces (3, b) across gaps (3, b)."""
        result: FloatArray = self._loops.forces(*self._state, gaps_m, DOWEL_SHARE)
        return result

    def linear(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the forces (3, b) across gaps (3, b), and how they change with these, (3, 3, b)."""
        result: tuple[FloatArray, FloatArray] = self._loops.linear(*self._state, gaps_m, DOWEL_SHARE)
        return result


def quickest(law: CrackLaw) -> LawOfGaps:
    """Return a law by compiled loops, where there are any."""
    loops = _loops()
    return law if loops is None else CompiledCrackLaw(law, loops)


def stiffness_of_corners(
    tangents_n_m: FloatArray, first_arms_m: FloatArray, second_arms_m: FloatArray, corners: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the stiffness (6, 6, c) of cracks for their first and second bodies, and between these.

    Tangents (3, 3, q) and arms (3, q) are of all gaps, corner by corner.
    """
    loops = _loops()
    if loops is not None:
        stiffness: tuple[FloatArray, FloatArray, FloatArray] = loops.corner_stiffness(
            tangents_n_m, first_arms_m, second_arms_m, corners
        )
        return stiffness
    return stiffness_of_points(tangents_n_m, first_arms_m, second_arms_m, lambda values: summed(values, corners))


def summed(values: FloatArray, corners: int) -> FloatArray:
    """Return the sums (…, c) of values (…, q) over the corners of each crack."""
    of_corners = values.reshape(*values.shape[:-1], corners, -1)
    total: FloatArray = of_corners[..., 0, :]
    for corner in range(1, corners):
        total = total + of_corners[..., corner, :]
    return total


@where_compiled
def _loops() -> ModuleType:
    """Loops over cracks."""
    from . import crack_loops

    return crack_loops
