# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure at which load a slab with elastic connections comes down, by its number of shards, for docs/elastic.md.

A slab of concrete, 5.1 m long, 1.5 m wide and 0.3 m deep, grows heavier until it comes down. The plain one is fixed
between two blocks; its load is over that at which beam theory has it crack at its ends, w L² / 12. The reinforced one
lies on two bearings that let it rotate, one of which lets it slide. Its reinforcement is spread evenly over the
section, and yields under as much as the concrete carries in tension; its load is over that at which plastic theory has
a hinge in the middle: w L² / 8 = A_s f_y h / 2, with all bars yielding about the pressed edge. Each slab has a process
of its own.

Usage: breaking_loads.py plain|reinforced [SEEDS] writes docs/data; breaking_loads.py plain|reinforced SHARDS SEED
prints one.
"""

from __future__ import annotations

import csv
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario

DATA = Path(__file__).resolve().parents[2] / "docs" / "data"
LENGTH_M, WIDTH_M, DEPTH_M, DENSITY_KG_M3 = 5.1, 1.5, 0.3, 2400.0
BLOCK_M = 0.5
"""Length of the blocks that the plain slab is fixed between."""

BEARING_M = 0.02
"""Length and height of the bearings, at the very ends: short, so that they do not hold the slab's rotation."""

SHARE, OPENING_M = 1.0, 0.03
"""Force at which reinforcement yields, by the tensile strength of concrete, and how far cracks open at most."""

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
{connections}
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
REINFORCED = f"""
ductile_share = {SHARE}
ductile_elongation_m = {OPENING_M}
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
"""


@dataclass(frozen=True, slots=True)
class Slab:
    """A slab to break.

    Attributes
    ----------
    file
        Table in docs/data.
    shards, seeds
        Numbers of shards, and how many seeds of each by default.
    connections
        What the scenario says of connections besides.
    end_m, end_x_m, end_z_m
        Size of what holds its ends, and where their centres are from the slab's: along it, and up.
    growth
        Times in s, and how many times as heavy the slab is then; evenly between.
    load_over_theory
        Load at which results have it come down, over that of theory; None where it stands.
    """

    file: str
    shards: tuple[int, ...]
    seeds: int
    connections: str
    end_m: tuple[float, float, float]
    end_x_m: float
    end_z_m: float
    growth: tuple[tuple[float, float], ...]
    load_over_theory: Callable[[Slab, Results], float | None]

    def weight_at(self, time_s: float) -> float:
        """How many times as heavy the slab is."""
        return float(np.interp(time_s, *zip(*self.growth, strict=True)))


def plain_load(slab: Slab, results: Results) -> float | None:
    """Load of the last frame before the median shard has fallen by many times the deflection of a slab that stands."""
    heights = results.frames.positions_m[:, results.inventory.moves, 2]
    fallen = np.median(heights[0] - heights, axis=1) > 0.02
    if not fallen.any():
        return None
    load = slab.weight_at(results.frames.time_s[np.argmax(fallen) - 1])
    stress_pa = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * LENGTH_M**2 / (2.0 * DEPTH_M)
    return float(load * stress_pa / MATERIALS["concrete"].bending_pa)


def reinforced_load(slab: Slab, results: Results) -> float | None:
    """Load when the middle, which is down by 15 cm at last, last was slower than 10 cm/s."""
    frames = results.frames
    middle = results.inventory.moves & (abs(frames.positions_m[0, :, 0]) < LENGTH_M / 10.0)
    deflection_m = (frames.positions_m[0] - frames.positions_m)[:, middle, 2].mean(axis=1)
    if not (deflection_m > 0.15).any():
        return None
    fallen = int(np.argmax(deflection_m > 0.15))
    speed_m_s = np.diff(deflection_m[: fallen + 1]) / np.diff(frames.time_s[: fallen + 1])
    began = int(np.flatnonzero(speed_m_s < 0.1)[-1]) + 1
    load = slab.weight_at(frames.time_s[began])
    weight_n_m = load * DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * WIDTH_M * DEPTH_M
    yield_n = SHARE * MATERIALS["concrete"].tension_pa * WIDTH_M * DEPTH_M
    span_m = LENGTH_M - BEARING_M
    # Beside the middles of the bearings, half of one each hangs over.
    moment_nm = weight_n_m * (span_m**2 - BEARING_M**2) / 8.0
    return float(moment_nm / (yield_n * DEPTH_M / 2.0))


SLABS = {
    "plain": Slab(
        file="breaking_loads.csv",
        shards=(40, 120, 200, 1000),
        seeds=8,
        connections="",
        end_m=(BLOCK_M, WIDTH_M, DEPTH_M),
        end_x_m=(LENGTH_M + BLOCK_M) / 2.0,
        end_z_m=0.0,
        growth=((0.1, 1.0), (2.5, 5.6)),
        load_over_theory=plain_load,
    ),
    "reinforced": Slab(
        file="tied_breaking_loads.csv",
        shards=(40, 120, 200),
        seeds=6,
        connections=REINFORCED,
        end_m=(BEARING_M, WIDTH_M, BEARING_M),
        end_x_m=(LENGTH_M - BEARING_M) / 2.0,
        end_z_m=-(DEPTH_M + BEARING_M) / 2.0,
        growth=((0.1, 1.0), (1.0, 6.0), (5.0, 12.0)),
        load_over_theory=reinforced_load,
    ),
}


def main(arguments: list[str]) -> int:
    """Measure one slab, or all of a kind."""
    kind, *numbers = arguments
    slab = SLABS[kind]
    if len(numbers) == 2:
        print(measured(slab, int(numbers[0]), int(numbers[1])), flush=True)
        os._exit(0)  # Blender's own end may hang.
    seeds = range(1, 1 + int(numbers[0] if numbers else slab.seeds))
    rows = [(shards, seed, load_of(kind, shards, seed)) for shards in slab.shards for seed in seeds]
    with (DATA / slab.file).open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("shards", "seed", "load_over_theory"), *rows])
    for shards in slab.shards:
        loads = [load for count, _, load in rows if count == shards]
        print(f"{shards} shards: median {statistics.median(loads):.2f}, {min(loads):.2f} to {max(loads):.2f}")
    return 0


def load_of(kind: str, shards: int, seed: int) -> float:
    """Load at which a slab comes down, measured in a process of its own."""
    command = [sys.executable, __file__, kind, str(shards), str(seed)]
    return round(float(subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1]), 3)


def measured(slab: Slab, shards: int, seed: int) -> float:
    """Load at which a slab comes down, over that of theory."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_scenario(slab, folder, shards, seed)
        results = simulated(read_scenario(folder / "slab.toml"), slab, folder)
    load = slab.load_over_theory(slab, results)
    if load is None:
        raise SystemExit(f"breaking_loads: {shards} shards with seed {seed} stand at {slab.growth[-1][1]} their weight")
    return load


def simulated(scenario: Scenario, slab: Slab, folder: Path) -> Results:
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
    # As keyframes: Blender begins its simulation again after any change of a setting.
    for time_s, factor in reversed(slab.growth):
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


def write_scenario(slab: Slab, folder: Path, shards: int, seed: int) -> None:
    """Write the slab, what holds its ends, and the scenario, ``slab.toml``."""
    import trimesh

    members = {
        "slab": ((LENGTH_M, WIDTH_M, DEPTH_M), (0.0, 0.0, 10.0)),
        "start": (slab.end_m, (-slab.end_x_m, 0.0, 10.0 + slab.end_z_m)),
        "end": (slab.end_m, (slab.end_x_m, 0.0, 10.0 + slab.end_z_m)),
    }
    for name, (size_m, centre_m) in members.items():
        mesh = trimesh.creation.box(size_m)
        mesh.apply_translation(centre_m)
        mesh.export(folder / f"{name}.stl")
    text = SCENARIO.format(
        seed=seed,
        duration_s=slab.growth[-1][0],
        members="".join(MEMBER.format(name=name, density=DENSITY_KG_M3) for name in members),
        shards=shards,
        connections=slab.connections,
    )
    (folder / "slab.toml").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
