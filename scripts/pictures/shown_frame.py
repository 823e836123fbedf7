# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame of a run that the picture of a preset shows."""

import numpy as np

from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.motion import without_removed

LITTLE_M = 0.3
"""Where no shard has moved farther by the key frame, a picture of it shows a bridge that stands."""

LITTLE_SHARE = 0.25
"""The same, as a part of how far any shard moves in the run: a deck that has begun to come down still looks whole."""


def shown_frame(results: Results, key_frame: int) -> int:
    """Return the frame that shows most: the key frame of a run, or that in which what comes down is fastest.

    The latter is for runs with neither ball nor blast in which hardly anything has moved by the key frame: connections
    crack there long before anything comes down.
    """
    frames, inventory = results.frames, results.inventory
    if len(inventory.of_kind("ball")) or frames.blast_impulses_ns.any():
        return key_frame
    staying = without_removed(results)[0]
    shards = staying.inventory.of_kind("shard")
    shards = shards[staying.inventory.masses_kg[shards] > 0.0]
    places_m, speeds_m_s = staying.frames.positions_m[:, shards], staying.frames.velocities_m_s[:, shards]
    moved_m = np.linalg.norm(places_m - places_m[0], axis=2).max(axis=1, initial=0.0)
    row = int(np.argmin(np.abs(frames.number - key_frame)))
    if moved_m[row] > max(LITTLE_M, LITTLE_SHARE * moved_m.max()) or moved_m.max() <= LITTLE_M:
        return key_frame
    energies_j = np.square(speeds_m_s).sum(axis=2) @ staying.inventory.masses_kg[shards] / 2.0
    return int(frames.number[energies_j.argmax()])
