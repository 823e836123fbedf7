# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure at which load a slab with elastic connections comes down, by its number of shards, for its README.

A slab of plain concrete, 5.1 m long, 1.5 m wide and 0.3 m deep, is fixed between two blocks and grows heavier until it
comes down; its load is over that at which beam theory has it crack at its ends, w L² / 12. Each slab has a process of
its own. A reinforced one is a case of the validation, `reinforced_slab`.

Usage: breaking_loads.py [SEEDS] writes docs/data; breaking_loads.py SHARDS SEED prints one.
"""

from __future__ import annotations

import csv
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "tests"))

from support.growing_weight import animate_gravity

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario

DATA = Path(__file__).resolve().parents[2] / "docs" / "data"
LENGTH_M, WIDTH_M, DEPTH_M, DENSITY_KG_M3 = 5.1, 1.5, 0.3, 2400.0
BLOCK_M = 0.5
"""Length of the blocks that the plain slab is fixed between."""

SHARDS, SEEDS = (40, 120, 200, 1000), 8
GROWTH = ((0.1, 1.0), (2.5, 5.6))
"""Times in s, and how many times as heavy the slab is then; evenly between."""

SCENARIO = """
[scenario]
title = "Slab"
seed = {seed}
[time]
duration_s = {duration_s}
frames_per_second = 24
substeps_per_frame = 20
solver_iterations = 10
{members}
[fracture]
shards = {shards}
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
[[supports]]
member = "start"
[[supports]]
member = "end"
[shards]
use_deactivation = false
start_deactivated = false
"""
MEMBER = """
[[geometry]]
name = "{name}"
file = "{name}.stl"
density_kg_m3 = {density}
"""


def weight_at(time_s: float) -> float:
    """How many times as heavy the slab is."""
    return float(np.interp(time_s, *zip(*GROWTH, strict=True)))


def load_over_theory(results: Results) -> float | None:
    """Load of the last frame before the median shard has fallen by many times the deflection of a slab that stands."""
    heights = results.frames.positions_m[:, results.inventory.moves, 2]
    fallen = np.median(heights[0] - heights, axis=1) > 0.02
    if not fallen.any():
        return None
    load = weight_at(results.frames.time_s[np.argmax(fallen) - 1])
    stress_pa = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * LENGTH_M**2 / (2.0 * DEPTH_M)
    return float(load * stress_pa / MATERIALS["concrete"].bending_pa)


def main(arguments: list[str]) -> int:
    """Measure one slab, or all."""
    numbers = [int(argument) for argument in arguments]
    if len(numbers) == 2:
        print(measured(*numbers), flush=True)
        os._exit(0)  # Blender's own end may hang.
    seeds = range(1, 1 + (numbers[0] if numbers else SEEDS))
    rows = [(shards, seed, load_of(shards, seed)) for shards in SHARDS for seed in seeds]
    with (DATA / "breaking_loads.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("shards", "seed", "load_over_theory"), *rows])
    for shards in SHARDS:
        loads = [load for count, _, load in rows if count == shards]
        print(f"{shards} shards: median {statistics.median(loads):.2f}, {min(loads):.2f} to {max(loads):.2f}")
    return 0


def load_of(shards: int, seed: int) -> float:
    """Load at which a slab comes down, measured in a process of its own."""
    command = [sys.executable, __file__, str(shards), str(seed)]
    return round(float(subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1]), 3)


def measured(shards: int, seed: int) -> float:
    """Load at which a slab comes down, over that of theory."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_scenario(folder, shards, seed)
        results = simulated(read_scenario(folder / "slab.toml"), folder)
    load = load_over_theory(results)
    if load is None:
        raise SystemExit(f"breaking_loads: {shards} shards with seed {seed} stand at {GROWTH[-1][1]} their weight")
    return load


def simulated(scenario: Scenario, folder: Path) -> Results:
    """Results of a scenario whose gravity grows."""
    import bpy

    from bridge_demolition_addon.model.sequence.checked_model import checked_model
    from bridge_demolition_addon.scene.demolition import build_demolition
    from bridge_demolition_addon.simulation.playback import Playing
    from bridge_demolition_addon.simulation.recording.recorder import Recording

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    build_demolition(scene, scenario, checked_model(scenario))
    frames_per_second = scenario.time.frames_per_second
    animate_gravity(scene, {scene.frame_start + time_s * frames_per_second: factor for time_s, factor in GROWTH})
    playing = Playing(Recording(scene, folder))
    while not playing.finished:
        playing.step()
    playing.end()
    return playing.recording.results()


def write_scenario(folder: Path, shards: int, seed: int) -> None:
    """Write the slab, what holds its ends, and the scenario, ``slab.toml``."""
    import trimesh

    block_m, middle_m = (BLOCK_M, WIDTH_M, DEPTH_M), (LENGTH_M + BLOCK_M) / 2.0
    members = {
        "slab": ((LENGTH_M, WIDTH_M, DEPTH_M), (0.0, 0.0, 10.0)),
        "start": (block_m, (-middle_m, 0.0, 10.0)),
        "end": (block_m, (middle_m, 0.0, 10.0)),
    }
    for name, (size_m, centre_m) in members.items():
        mesh = trimesh.creation.box(size_m)
        mesh.apply_translation(centre_m)
        mesh.export(folder / f"{name}.stl")
    text = SCENARIO.format(
        seed=seed,
        duration_s=GROWTH[-1][0],
        members="".join(MEMBER.format(name=name, density=DENSITY_KG_M3) for name in members),
        shards=shards,
    )
    (folder / "slab.toml").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
