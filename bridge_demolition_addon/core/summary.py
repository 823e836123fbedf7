"""What a run came to, in the few numbers that a planner asks for first."""

from __future__ import annotations

from typing import Any

import numpy as np

from .motion import first_hit, throw
from .results import Results


def summarise(results: Results, gravity_m_s2: np.ndarray) -> dict[str, Any]:
    """Masses, counts, breaking over time, largest force and largest throw of a run, ready for JSON.

    Parameters
    ----------
    results
        What was recorded.
    gravity_m_s2
        (3,) acceleration of gravity.
    """
    return {
        "frames": len(results.frames),
        "simulated_s": float(results.times_s[-1]),
        "mass_kg": {kind: float(results.masses_kg[results.of_kind(kind)].sum()) for kind in ("shard", "ball")},
        "bodies": {kind: len(results.of_kind(kind)) for kind in ("shard", "ball", "ground")},
        "connections": _connections(results),
        "impact": _moment(results, impact_step(results, gravity_m_s2)),
        "reading": str(results.reading),
        "largest_resultant": _largest_force(results, results.body_peaks_n),
        "largest_force_sum": _largest_force(results, results.body_peak_sums_n),
        "largest_throw": _largest_throw(results),
    }


def impact_step(results: Results, gravity_m_s2: np.ndarray) -> int | None:
    """Recorded step in which the ball, once it falls, is first stopped by anything; None where it never is."""
    for ball in results.of_kind("ball"):
        moving = np.flatnonzero(results.velocities_m_s[:, ball].any(axis=1))
        if len(moving):
            released = max(0, moving[0] - 1)  # a ball that falls a few centimetres is hit in its very first step
            hit = first_hit(results.velocities_m_s[released:, ball], results.times_s[released:], gravity_m_s2)
            return None if hit is None else int(released) + hit
    return None


def _connections(results: Results) -> dict[str, Any]:
    intact = results.intact.sum(axis=1)
    return {
        "count": len(results.connection_names),
        "intact": int(intact[-1]),
        "broken": int(len(results.connection_names) - intact[-1]),
        "over_time": {
            "time_s": results.times_s.tolist(),
            "intact": intact.tolist(),
            "broken": (len(results.connection_names) - intact).tolist(),
        },
    }


def _moment(results: Results, step: int | None) -> dict[str, Any] | None:
    if step is None:
        return None
    return {"frame": int(results.frames[step]), "time_s": float(results.times_s[step])}


def _largest_force(results: Results, magnitudes: np.ndarray) -> dict[str, Any] | None:
    """Largest of the magnitudes (k, n) on any shard, in any frame whose forces are known."""
    known = np.flatnonzero(np.isfinite(magnitudes).all(axis=1))
    shards = results.of_kind("shard")
    candidates = magnitudes[np.ix_(known, shards)]
    if not candidates.size:
        return None
    step, body = np.unravel_index(candidates.argmax(), candidates.shape)
    return {
        "force_N": float(candidates[step, body]),
        "body": str(results.body_names[shards[body]]),
        **_moment(results, int(known[step])),
    }


def _largest_throw(results: Results) -> dict[str, Any] | None:
    shards = results.of_kind("shard")
    if not len(shards):
        return None
    throws = throw(results.places_m[0, shards], results.places_m[-1, shards])
    return {"throw_m": float(throws.max()), "body": str(results.body_names[shards[throws.argmax()]])}
