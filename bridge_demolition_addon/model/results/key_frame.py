"""Key frame: the moment of a run that shows most in one picture."""

from __future__ import annotations

import numpy as np

from ...engineering.geometry.vectors import length
from ...texts import Text
from .arrays import Results
from .motion import first_hit

_FLYING_S = 0.5
"""How long after the last load of a blast: what falls has come down by 1.2 m, what flies is not yet out of sight."""

RESTING_WEIGHTS = 3.0
"""A ball that rests or rolls is pressed with about its weight; a hit presses with more than this many times as much."""


def key_step(results: Results, gravity_m_s2: np.ndarray) -> tuple[int, str]:
    """Return the recorded step that shows most, and which moment it is, with the acceleration of gravity (3,).

    It is the impact of the ball; without one, shortly after the blast; without that, when half of all connections that
    broke in the run had broken; where none did, that of the largest force on a shard.
    """
    frames = results.frames
    impact = impact_step(results, gravity_m_s2)
    if impact is not None:
        return impact, Text("At the impact of the ball")
    loaded = np.flatnonzero(frames.blast_impulses_ns.any(axis=(1, 2)))
    if len(loaded):
        after = np.searchsorted(frames.time_s, frames.time_s[loaded[-1]] + _FLYING_S)
        return min(int(after), len(frames.time_s) - 1), Text("Shortly after the blast")
    broken = (~frames.intact).sum(axis=1)
    if len(broken) and broken[-1]:
        half = int(np.argmax(broken >= broken[-1] / 2.0))
        return half, Text("When half of the connections that broke had broken")
    forces = frames.loads.body_peak_sums_n[:, results.inventory.of_kind("shard")]
    largest = np.where(np.isfinite(forces), forces, 0.0).max(axis=1, initial=0.0)
    return int(largest.argmax()), Text("At the largest force")


def impact_step(results: Results, gravity_m_s2: np.ndarray) -> int | None:
    """Return the recorded step in which the ball, once it falls, is first stopped; None where it never is."""
    for ball in results.inventory.of_kind("ball"):
        moving = np.flatnonzero(results.frames.velocities_m_s[:, ball].any(axis=1))
        if len(moving):
            if len(results.inventory.of_kind("crane")):
                return _first_push(results, ball, gravity_m_s2)
            released = max(0, moving[0] - 1)  # a ball that falls a few centimetres is hit in its very first step
            hit = first_hit(
                results.frames.velocities_m_s[released:, ball], results.frames.time_s[released:], gravity_m_s2
            )
            return None if hit is None else int(released) + hit
    return None


def _first_push(results: Results, ball: int, gravity_m_s2: np.ndarray) -> int | None:
    """Return the first recorded step in which contacts push a ball on a cable more than its rest would."""
    resting_force = RESTING_WEIGHTS * results.inventory.masses_kg[ball] * length(gravity_m_s2)
    pushes = length(results.frames.loads.body_contact_impulses_ns[:, ball])
    steps = np.flatnonzero(pushes > resting_force * np.diff(results.frames.time_s, prepend=results.frames.time_s[0]))
    return int(steps[0]) if len(steps) else None
