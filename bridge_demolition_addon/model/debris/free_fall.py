"""Where falling shards would land if nothing stopped them on the way: a forecast for a run that has not ended."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..results.arrays import Results
from .footprint import corners_at

SINKS_M_S = 2.0
"""A shard that sinks as fast is taken to fall: it has fallen freely by 0.2 m then, and what stands sways less."""

_LANDED_M = 0.1
"""Height above the ground below which a shard has landed."""


def falling(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Return the shards (f,) that fall in the last frame of a run, and how high (f,) above the ground each is, m."""
    shards, frames = results.inventory.of_kind("shard"), results.frames
    sinking = shards[frames.velocities_m_s[-1, shards, 2] < -SINKS_M_S]
    corners, ground = corners_at(results, -1, sinking), results.ground()
    heights_m = np.array([(own[:, 2] - ground.heights_at(own[:, :2])).min() for own in corners])
    return sinking[heights_m > _LANDED_M], heights_m[heights_m > _LANDED_M]


def landed(results: Results) -> tuple[Results, int]:
    """Return a run in whose last frame all that falls has landed, and how many shards these are.

    Each flies on by itself, without rotating, and stays where its lowest corner meets the height of the ground that is
    below it now; it meets no other, and does not roll. Air resists nothing. The ground has to rest.
    """
    bodies, heights_m = falling(results)
    if not len(bodies):
        return results, 0
    frames = results.frames
    positions_m, velocities = np.array(frames.positions_m, float), frames.velocities_m_s[-1, bodies].astype(float)
    rises = velocities[:, 2]
    times_s = (rises + np.sqrt(rises * rises + 2.0 * STANDARD_GRAVITY_M_S2 * heights_m)) / STANDARD_GRAVITY_M_S2
    positions_m[-1, bodies, :2] += times_s[:, None] * velocities[:, :2]
    positions_m[-1, bodies, 2] -= heights_m
    return replace(results, frames=replace(frames, positions_m=positions_m)), len(bodies)
