# SPDX-License-Identifier: GPL-3.0-or-later
"""The deck that benches simulate: it hangs between its piers, all awake, so that Bullet has all of it to solve."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bridge_demolition_addon.model.scenario import (
    Bridge,
    ConnectionSettings,
    Deck,
    FractureSettings,
    Piers,
    Scenario,
    ShardSettings,
    TimeSettings,
)

DECK = Scenario(
    title="bench",
    time=TimeSettings(duration_s=10.0),
    bridge=Bridge(
        span_lengths_m=(29.0,),
        density_kg_m3=2400.0,
        deck=Deck(width_m=12.0, thickness_m=1.0, overhang_m=0.5),
        piers=Piers(column_length_m=1.0, column_width_m=12.0, height_m=3.0),
    ),
    fracture=FractureSettings(shards=1000),
    connections=ConnectionSettings(type="FIXED", method="face", limit_per_shard=10, breaking_force_n=1e9),
    shards=ShardSettings(use_deactivation=False, start_deactivated=False),
)
