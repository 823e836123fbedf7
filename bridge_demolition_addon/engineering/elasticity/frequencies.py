"""First frequencies of connected bodies, by inverse iteration."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from .sparse_system import BlockSystem

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
