# SPDX-License-Identifier: GPL-3.0-or-later
"""What blast loads cost in a frame, next to Blender's bare step and to the way of 2019, in the same run.

The deck hangs in 250 to 2000 shards, with two charges below it. Its motion is recorded, as in a run of a study, without
charges and with: then all shards are loaded at once, as in a frame of a 24th of a second, or a twentieth of them, as in
slow motion, or none, which is what every other frame of a run costs.
"""

import tempfile
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from unittest.mock import patch

import bpy
import numpy as np
from benches.deck import SMALLEST, build_scene, deck, frame_seconds, make_world, ratios_to_bare_step, recorded
from benches.way_of_2019 import blast_by_fields

from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.explosion import Explosion
from bridge_demolition_addon.model.blast.settings import Apply, BlastSettings
from bridge_demolition_addon.scene import run_setup
from bridge_demolition_addon.scene.blast.charges import create_charges, keep_blast
from bridge_demolition_addon.scene.blast.force_fields import build_force_objects
from bridge_demolition_addon.scene.bodies import bodies_of

FRAMES, ROUNDS = 5, 5
"""Of each way."""

SIZES = (250, 500, 1000, 2000)
WAY_OF_2019_UP_TO = 500
"""Shards; with 1000, its 3000 fields take minutes for a frame."""

LOADED = {"all loaded": 1, "one in 20": 20, "none": 0}
"""One shard in so many is loaded."""

CHARGES = (
    Charge(name="west", position_m=(7.0, 0.0, 1.0), mass_kg=1e-6),
    Charge(name="east", position_m=(22.0, 0.0, 1.0), mass_kg=1e-6),
)
"""So small that they load every shard and move none: the frames to compare do the same work otherwise."""


class SteadyLoads(Explosion):
    """Loads some bodies in every sub-step, as if charges went off in each, and counts the steps."""

    every = 1
    steps = 0

    def loads(self, start_s, end_s, centres, rotations):
        SteadyLoads.steps += 1
        loads = super().loads(0.0, 1.0, centres, rotations)
        if self.every == 1:
            return loads
        chosen = loads.bodies % self.every == 0 if self.every else np.zeros(len(loads), bool)
        return replace(loads, **{name: getattr(loads, name)[chosen] for name in loads.__dataclass_fields__})

    def is_quiet(self, start_s, end_s):
        return not self.every


def main(smallest: bool) -> dict[str, float]:
    """Play every way in turn for each number of shards, print and return ratios to the bare step."""
    ratios = {}
    for shards in (SMALLEST,) if smallest else SIZES:
        seconds: dict[str, list[float]] = {}
        for _ in range(1 if smallest else ROUNDS):
            for name, way in _ways(shards).items():
                seconds.setdefault(name, []).append(way())
        print(f"{shards} shards")
        for name, ratio in ratios_to_bare_step(seconds).items():
            ratios[f"{name}, over bare step, {shards} shards"] = ratio
    return ratios


def _ways(shards: int) -> dict[str, Callable[[], float]]:
    """Ways to play the deck, by what they are: each builds it, and returns the seconds of a frame."""
    ways = {"bare step": partial(_seconds, shards), "motion recorded": partial(_seconds, shards, record=True)}
    for apply in Apply:
        for name, every in LOADED.items():
            ways[f"{apply.value}, {name}"] = partial(_with_blast, shards, apply, every)
    if shards <= WAY_OF_2019_UP_TO:
        ways["way of 2019"] = partial(_in_the_way_of_2019, shards)
    return ways


def _in_the_way_of_2019(shards: int) -> float:
    scene = build_scene(deck(shards))
    with blast_by_fields(scene, np.array(CHARGES[0].position_m)):
        return _least(scene)


def _with_blast(shards: int, apply: Apply, every: int) -> float:
    SteadyLoads.every, SteadyLoads.steps = every, 0
    with patch.object(run_setup, "Explosion", SteadyLoads):
        seconds = _seconds(shards, apply, record=True)
    if every and SteadyLoads.steps < FRAMES:
        raise AssertionError(f"loaded in {SteadyLoads.steps} steps of {FRAMES} frames")
    return seconds


def _seconds(shards: int, apply: Apply | None = None, *, record: bool = False) -> float:
    scene = build_scene(deck(shards))
    if apply:
        create_charges(scene, CHARGES)
        keep_blast(scene, BlastSettings(start_s=0.0, apply=apply.value))
        if apply is Apply.FIELDS:
            build_force_objects(scene, bodies_of(scene))
    with (
        tempfile.TemporaryDirectory() as folder,
        recorded(scene, Path(folder), loads=False) if record else nullcontext(),
    ):
        return _least(scene)


def _least(scene: bpy.types.Scene) -> float:
    make_world(scene)
    return frame_seconds(scene, FRAMES).min()  # what else the machine does only ever adds
