"""Springs between two bodies by loops that are compiled, where Numba is installed; the same bits without it."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any

from ..arrays import FloatArray
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


@cache
def spring_loops() -> Any | None:
    """Return the module of compiled loops, loaded when springs first need it; None without Numba."""
    if find_spec("numba") is None:
        return None
    from . import spring_loops  # it takes a third of a second, and most calls of the program need none

    return spring_loops
