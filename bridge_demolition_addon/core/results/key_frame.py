"""The moment of a run that tells most in one picture."""

from __future__ import annotations

import numpy as np

from .arrays import Results
from .summary import impact_step

_FLYING_S = 0.5
"""How long after the last load of a blast: what falls has come down by 1.2 m, what flies is not yet out of sight."""


def telling_step(results: Results, gravity_m_s2: np.ndarray) -> int:
    """Recorded step that tells most.

    It is the impact of the ball; without one, shortly after the blast; without that, when half of all connections that
    broke in the course of the run had broken; where none did, that of the largest force on a shard.

    Parameters
    ----------
    results
        What was recorded.
    gravity_m_s2
        (3,) acceleration of gravity.
    """
    impact = impact_step(results, gravity_m_s2)
    if impact is not None:
        return impact
    loaded = np.flatnonzero(results.frames.blast_impulses_ns.any(axis=(1, 2)))
    if len(loaded):
        after = np.searchsorted(results.frames.time_s, results.frames.time_s[loaded[-1]] + _FLYING_S)
        return min(int(after), len(results.frames.time_s) - 1)
    broken = (~results.frames.intact).sum(axis=1)
    if len(broken) and broken[-1]:
        return int(np.argmax(broken >= broken[-1] / 2.0))
    forces = results.frames.loads.body_peak_sums_n[:, results.inventory.of_kind("shard")]
    largest = np.where(np.isfinite(forces), forces, 0.0).max(axis=1, initial=0.0)
    return int(largest.argmax())
