"""Moments of a run that a timeline marks."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..model.results.arrays import Results
from ..model.results.key_frame import impact_step

_NOISE_S = 1e-6


def moments(
    results: Results, gravity_m_s2: np.ndarray, detonations_s: Mapping[str, float], came_to_rest_s: float | None
) -> list[tuple[int, str]]:
    """Return frames of a run and what happens in them: release and hit of a ball, charges, first break, rest.

    Detonations later than the run are left out. `came_to_rest_s` is None where the run does not come to rest, or this
    is not known.
    """
    frames = results.frames
    numbers, times_s = np.asarray(frames.number), np.asarray(frames.time_s)
    marked = []
    for ball in results.inventory.of_kind("ball"):
        moving = np.flatnonzero(np.asarray(frames.velocities_m_s[:, ball]).any(axis=1))
        if len(moving):
            marked.append((int(numbers[max(moving[0] - 1, 0)]), "Release"))
    hit = impact_step(results, gravity_m_s2)
    if hit is not None:
        marked.append((int(numbers[hit]), "Hit"))
    at_rest = {} if came_to_rest_s is None else {"At rest": came_to_rest_s}
    for name, time_s in [*detonations_s.items(), *at_rest.items()]:
        row = int(np.searchsorted(times_s, time_s - _NOISE_S))
        if row < len(numbers):
            marked.append((int(numbers[row]), name))
    broken = np.flatnonzero(~np.asarray(frames.intact).all(axis=1))
    if len(broken):
        marked.append((int(numbers[broken[0]]), "First break"))
    return sorted(marked)
