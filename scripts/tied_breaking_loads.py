# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure at which load a reinforced slab with elastic connections comes down, by its shards, for docs/elastic.md.

A slab of concrete, 5.1 m long, 1.5 m wide and 0.3 m deep, lies on two bearings that let it turn, one of which lets it
slide. Its reinforcement is spread evenly over the section, and yields under as much as the concrete bears in tension.
Its weight grows until it comes down. The load is over that at which plastic theory has a hinge in the middle:
w L² / 8 = A_s f_y h / 2, with all bars yielding about the pressed edge. Each slab has a process of its own.
Usage: tied_breaking_loads.py [SEEDS] writes docs/data/tied_breaking_loads.csv; tied_breaking_loads.py SHARDS SEED
prints one.
"""

from __future__ import annotations

import csv
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bridge_demolition_addon.model.results.arrays import Results
    from bridge_demolition_addon.model.scenario import Scenario

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

DATA = ROOT / "docs" / "data" / "tied_breaking_loads.csv"
SHARDS = (40, 120, 200)
LENGTH_M, WIDTH_M, DEPTH_M, DENSITY_KG_M3 = 5.1, 1.5, 0.3, 2400.0
BEARING_M = 0.02
"""Length and height of the blocks that it lies on, at its very ends: short, so that they do not hold its turning."""

SHARE, OPENING_M = 1.0, 0.03
"""Force at which reinforcement yields, by the tensile strength of concrete, and how far cracks open at most."""

GROWTH = ((0.1, 1.0), (1.0, 6.0), (5.0, 12.0))
"""Times in s, and how many times as heavy it is then; evenly between."""

FALLEN_M, STANDS_M_S = 0.15, 0.1
"""Of the middle: it is down by so much at last, and began to fall when it last was slower than so much."""

SCENARIO = """
[scenario]
title = "Reinforced slab"
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
ductile_share = {share}
ductile_elongation_m = {opening_m}
ductile_hardening = 1.0
[[materials]]
name = "bearing"
compression_n_mm2 = 1e5
tension_n_mm2 = 1e5
shear_n_mm2 = 1e5
torsion_n_mm2 = 1e5
bending_n_mm2 = 1e5
elastic_modulus_n_mm2 = 210000
[[connections.between]]
members = ["slab", "start"]
type = "GENERIC"
free = ["turn y"]
material = "bearing"
[[connections.between]]
members = ["slab", "end"]
type = "GENERIC"
free = ["move x", "turn y"]
material = "bearing"
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


def main(arguments: list[str]) -> int:
    """Measure one slab, or all of them."""
    if len(arguments) == 2:
        print(measured(int(arguments[0]), int(arguments[1])), flush=True)
        os._exit(0)  # Blender's own end may hang.
    seeds = range(1, 1 + int(arguments[0] if arguments else 6))
    rows = [(shards, seed, load_of(shards, seed)) for shards in SHARDS for seed in seeds]
    with DATA.open("w", newline="", encoding="utf-8") as file:
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
    """Load at which a slab comes down, over that of plastic theory."""
    import numpy as np

    from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
    from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
    from bridge_demolition_addon.model.scenario.file import read_scenario

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        keep_scenario(folder, shards, seed)
        results = played(read_scenario(folder / "slab.toml"), folder)
    frames = results.frames
    middle = results.inventory.moves & (abs(frames.positions_m[0, :, 0]) < LENGTH_M / 10.0)
    sag = (frames.positions_m[0] - frames.positions_m)[:, middle, 2].mean(axis=1)
    if not (sag > FALLEN_M).any():
        raise SystemExit(
            f"tied_breaking_loads: {shards} shards with seed {seed} stand at {GROWTH[-1][1]} times the weight"
        )
    fallen = int(np.argmax(sag > FALLEN_M))
    speed = np.diff(sag[: fallen + 1]) / np.diff(frames.time_s[: fallen + 1])
    began = int(np.flatnonzero(speed < STANDS_M_S)[-1]) + 1
    load = np.interp(frames.time_s[began], *zip(*GROWTH, strict=True))
    weight_n_m = load * DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * WIDTH_M * DEPTH_M
    yield_n = SHARE * MATERIALS["concrete"].tension_pa * WIDTH_M * DEPTH_M
    span_m = LENGTH_M - BEARING_M
    # Beside the middles of the bearings, half of one each hangs over.
    moment_nm = weight_n_m * (span_m**2 - BEARING_M**2) / 8.0
    return float(moment_nm / (yield_n * DEPTH_M / 2.0))


def played(scenario: Scenario, folder: Path) -> Results:
    """Results of a scenario whose gravity grows."""
    import bpy

    from bridge_demolition_addon.model.sequence.checked_model import checked_model
    from bridge_demolition_addon.scene.demolition import build_demolition
    from bridge_demolition_addon.simulation.playback import Playing
    from bridge_demolition_addon.simulation.recording.recorder import Recording

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    build_demolition(scene, scenario, checked_model(scenario))
    weight = scene.gravity[2]
    # As keyframes: Blender begins its simulation anew after any change of a setting.
    for time_s, factor in reversed(GROWTH):
        scene.gravity[2] = factor * weight
        scene.keyframe_insert("gravity", index=2, frame=scene.frame_start + time_s * scenario.time.frames_per_second)
    for curve in scene.animation_data.action.layers[0].strips[0].channelbags[0].fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    playing = Playing(Recording(scene, folder))
    while not playing.finished:
        playing.step()
    playing.end()
    return playing.recording.results()


def keep_scenario(folder: Path, shards: int, seed: int) -> None:
    """Write the slab, the bearings under its ends, and the scenario, ``slab.toml``."""
    import trimesh

    bearing = (BEARING_M, WIDTH_M, BEARING_M)
    sides = {"slab": ((LENGTH_M, WIDTH_M, DEPTH_M), 0.0), "start": (bearing, -1.0), "end": (bearing, 1.0)}
    for name, (size_m, side) in sides.items():
        mesh = trimesh.creation.box(size_m)
        below = abs(side) * (DEPTH_M + BEARING_M) / 2.0
        mesh.apply_translation((side * (LENGTH_M - BEARING_M) / 2.0, 0.0, 10.0 - below))
        mesh.export(folder / f"{name}.stl")
    members = "".join(MEMBER.format(name=name, density=DENSITY_KG_M3) for name in sides)
    text = SCENARIO.format(
        seed=seed, duration_s=GROWTH[-1][0], members=members, shards=shards, share=SHARE, opening_m=OPENING_M
    )
    (folder / "slab.toml").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
