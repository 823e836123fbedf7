# SPDX-License-Identifier: GPL-3.0-or-later
"""Print a digest of every bit of the loads of charges on blocks that turn, by each model and with shielding."""

import hashlib
import os
import sys

import numpy as np

from bridge_demolition_addon.engineering.blast.pulses import BlastModel
from bridge_demolition_addon.engineering.geometry.hulls import convex_hulls
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.explosion import Explosion
from bridge_demolition_addon.model.blast.settings import BlastSettings

if "one core" in sys.argv[2:] and hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
count = int(sys.argv[1])
random = np.random.default_rng(5)
shards = convex_hulls([random.uniform(-1.0, 1.0, (12, 3)) for _ in range(count)])
centres = random.uniform(-20.0, 20.0, (count, 3))
axes = random.integers(0, 3, count)
quarter_turns = np.array(
    [[[1, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 1, 0], [-1, 0, 0]], [[0, -1, 0], [1, 0, 0], [0, 0, 1]]]
)
charges = [
    Charge(position_m=(0.0, 0.0, 1.0), mass_kg=40.0),
    Charge(position_m=(6.0, 2.0, 0.0), mass_kg=15.0, explosive="C-4", delay_ms=9.0, burst="surface"),
]
digest = hashlib.sha256()
for model in BlastModel:
    for loading in ("incident", "reflected"):
        settings = BlastSettings(start_s=0.0, model=model.value, loading=loading, shielding=True)
        explosion = Explosion(charges, shards, settings)
        for step in range(40):
            loads = explosion.loads(0.001 * step, 0.001 * (step + 1), centres, quarter_turns[(axes + step) % 3] * 1.0)
            for array in (loads.scaled_distances, loads.areas_m2, loads.peaks_pa, loads.vectors(count)):
                digest.update(np.ascontiguousarray(array).tobytes())
print(digest.hexdigest())
