# SPDX-License-Identifier: GPL-3.0-or-later
"""What rigid connections that break by a material's strength cost in a frame, next to the bare step in the same run.

The deck is connected by steel, so that nothing breaks and Bullet has the same work each time. A run of a study records
no loads. CPU time, so that other programs weigh less. The bench `elastic` has connections that deform.
"""

import tempfile
import time
from contextlib import nullcontext
from pathlib import Path

from benches.deck import (
    SMALLEST,
    build_scene,
    deck,
    frame_s,
    frames_and_rounds,
    make_world,
    ratios_to_bare_step,
    recorded,
)

from bridge_demolition_addon.model.scenario import ConnectionSettings

SIZES = (200, 1000)
SETTINGS = ConnectionSettings(type="FIXED", method="face", limit_per_shard=10, material="steel", stiffness="rigid")
WAYS = {
    "every sub-step": {"every_substep": True},
    "last sub-step": {"every_substep": False},
    "as in a study": {"every_substep": True, "loads": False},
    "every sub-step, in a window": {"every_substep": True, "in_window": True},
}


def main(smallest: bool) -> dict[str, float]:
    """Build the deck in each number of shards, play it every way in turn, print and return ratios."""
    ratios = {}
    for shards in (SMALLEST,) if smallest else SIZES:
        scene = build_scene(deck(shards, connections=SETTINGS))
        frames, rounds = frames_and_rounds(shards)
        seconds: dict[str, list[float]] = {}
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(rounds):
                for name, settings in ({"bare step": None} | WAYS).items():
                    with nullcontext() if settings is None else recorded(scene, Path(folder), **settings):
                        make_world(scene)
                        seconds.setdefault(name, []).append(frame_s(scene, frames, time.process_time))
        print(f"{shards} shards, {len(scene.rigidbody_world.constraints.objects)} connections")
        for way, ratio in ratios_to_bare_step(seconds).items():
            ratios[f"{way} over bare step, {shards} shards"] = ratio
    return ratios
