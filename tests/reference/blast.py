# SPDX-License-Identifier: GPL-3.0-or-later
"""Impulses of pulses, and areas that bodies show to charges, by numpy: what the compiled core has for a sub-step."""

from __future__ import annotations

from math import factorial

import numpy as np

from bridge_demolition_addon.engineering.arithmetic import exponential
from bridge_demolition_addon.engineering.blast.pulses import Pulses
from bridge_demolition_addon.engineering.geometry.hulls import ConvexHulls


def impulse_between(pulses: Pulses, start_s: float, end_s: float) -> np.ndarray:
    """Return the impulse per area of every pulse."""
    duration, decay = pulses.durations_s, pulses.decays

    def passed(time: np.ndarray) -> np.ndarray:
        part = np.divide(time, duration, out=np.full(time.shape, np.inf), where=duration > 0.0)
        return np.clip(part, 0.0, 1.0)

    first = passed(start_s - pulses.arrivals_s)
    length = passed(end_s - pulses.arrivals_s) - first
    exponent = decay * length
    whole, centre = (np.where(exponent < 0.5, *ways) for ways in zip(_series(exponent), _closed(exponent), strict=True))
    mean = (1.0 - first) * whole - length * centre
    return pulses.peaks_pa * duration * exponential(-decay * first) * length * mean


def _series(exponent: np.ndarray) -> list[np.ndarray]:
    """Return ∫₀¹ uⁿ e^(-y u) du for n of 0 and 1, y < 0.5."""
    small, sums = np.minimum(exponent, 0.5), [np.zeros_like(exponent), np.zeros_like(exponent)]
    for term in reversed(range(15)):
        sums = [1.0 / (factorial(term) * (term + order + 1)) - small * sums[order] for order in range(2)]
    return sums


def _closed(exponent: np.ndarray) -> list[np.ndarray]:
    """Return the same by its closed form, y ≥ 0.5."""
    large = np.maximum(exponent, 0.5)
    left = exponential(-large)
    whole = (1.0 - left) / large
    return [whole, (whole - left) / large]


def projected_areas(hulls: ConvexHulls, rotations: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Return the bodies' areas (n, c) projected along directions (n, c, 3)."""
    x, y, z = directions.transpose(2, 1, 0)
    matrices = rotations.transpose(1, 2, 0)[:, :, None]
    in_bodies = matrices[0] * x + matrices[1] * y + matrices[2] * z
    vectors = hulls.face_vectors
    shown = vectors[0] * in_bodies[0][:, hulls.bodies]
    for axis in (1, 2):
        shown = shown + vectors[axis] * in_bodies[axis][:, hulls.bodies]
    return np.add.reduceat(np.ascontiguousarray(np.abs(shown) / 2.0), hulls.starts[:-1], axis=1).T
