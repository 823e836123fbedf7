"""Springs between two bodies by loops that are compiled, where Numba is installed; the same bits without it."""

from __future__ import annotations

from types import ModuleType

from ..arrays import FloatArray
from ..compilation import where_compiled
from .gaps import Gaps
from .spring_law import PressedSprings


def resisted(law: PressedSprings, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return forces (3, q) on what lies above gaps (3, q), and by how much these fall with them, (3, 3, q)."""
    loops = spring_loops()
    if loops is None:
        return law.resisted(gaps_m)
    found: tuple[FloatArray, FloatArray] = loops.resisted(
        law.vertical_n_m, law.sideways_n_m, law.capacity_n, law.friction, law.pulls, law.pressed_n, gaps_m
    )
    return found


def rates(gaps: Gaps, velocities: FloatArray) -> FloatArray:
    """Return how fast gaps (3, q) open, with velocities and angular velocities (6, n) of the bodies."""
    loops = spring_loops()
    if loops is None:
        return gaps.rates(velocities)
    found: FloatArray = loops.rates(velocities, gaps.first, gaps.second, gaps.first_arms_m, gaps.second_arms_m)
    return found


@where_compiled
def spring_loops() -> ModuleType:
    """Loops over springs."""
    from . import spring_loops

    return spring_loops
