# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how fast a slab creeps that lies on others by contact alone, by sub-steps and iterations.

Usage: creep.py [FILE.csv], by default docs/data/creep.csv. A slab of concrete, 6 m × 1 m × 0.5 m, lies on a plane that
is inclined by 15°, or on two loose blocks on a level plane. Friction is 0.36. Measured is the mean speed of the fastest
shard in the last half second of 1.5 s, with 24 frames a second.
"""

import csv
import os
import sys
import tempfile
from pathlib import Path

import numpy as np
import trimesh

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "docs" / "data" / "creep.csv"
COLUMNS = ("case", "connections", "shards", "substeps_per_frame", "iterations", "fastest_mm_s", "mean_mm_s")
SUBSTEPS, ITERATIONS = (10, 20, 40, 80), (10, 20, 50, 200)
SHARDS, SLOPE_DEG, FROM_S, HEIGHT_M = 30, 15.0, 1.0, 6.0

SCENARIO = """
[scenario]
title = "A slab on contacts"
seed = 3
[time]
duration_s = 1.5
stop_at_rest = false
frames_per_second = 24
substeps_per_frame = {substeps}
solver_iterations = {iterations}
[fracture]
shards = {shards}
margin_m = 0.0
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "{stiffness}"
strength_factor = 100.0
foundation = false
[shards]
use_deactivation = false
start_deactivated = false
"""
MEMBER = '[[geometry]]\nname = "{0}"\nfile = "{0}.stl"\ndensity_kg_m3 = 2400\n'
MEMBER += '[[fracture.members]]\nmember = "{0}"\nshards = {1}\n'
LOOSE = '[[connections.between]]\nmembers = ["{}", "{}"]\nnone = true\n'

BOXES = {
    "slope": {"plane": ((10, 3, 1), (0, 0, -0.5)), "slab": ((6, 1, 0.5), (0, 0, 0.25))},
    "blocks": {
        "plane": ((10, 3, 1), (0, 0, -0.5)),
        "block 1": ((0.7, 1, 0.4), (-2.5, 0, 0.2)),
        "block 2": ((0.7, 1, 0.4), (2.5, 0, 0.2)),
        "slab": ((6, 1, 0.5), (0, 0, 0.65)),
    },
}
"""Sizes and middles of the members of each case, m, before the plane is inclined."""


def main(arguments: list[str]) -> int:
    """Measure all cases."""
    cases = [(case, "elastic", SHARDS, *steps) for case in BOXES for steps in _steps()]
    cases += [("slope", "elastic", 1, 40, 20), ("slope", "rigid", SHARDS, 40, 20)]
    with Path(*(arguments or [DATA])).open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for case in cases:
            table.writerow((*case, *(f"{speed:.2f}" for speed in measured(*case))))
            file.flush()
    return 0


def _steps() -> list[tuple[int, int]]:
    return [(substeps, iterations) for substeps in SUBSTEPS for iterations in ITERATIONS]


def measured(case: str, stiffness: str, shards: int, substeps: int, iterations: int) -> tuple[float, float]:
    """Return the speeds of the fastest shard, and of all in the mean, mm/s."""
    from bridge_demolition_addon.model.scenario.file import read_scenario
    from bridge_demolition_addon.model.sequence.checked_model import checked_model
    from bridge_demolition_addon.simulation.motion_run import motion_run

    with tempfile.TemporaryDirectory() as name:
        path = _scenario(Path(name), case, stiffness, shards, substeps, iterations)
        scenario = read_scenario(path)
        with motion_run(scenario, checked_model(scenario), Path(name)) as (results, _):
            bodies = np.flatnonzero(results.inventory.moves & (results.inventory.body_kinds == "shard"))
            times_s = results.frames.time_s
            begin = np.searchsorted(times_s, FROM_S)
            ways = results.frames.positions_m[-1, bodies] - results.frames.positions_m[begin, bodies]
            speeds = 1e3 * np.linalg.norm(ways, axis=1) / (times_s[-1] - times_s[begin])
    return float(speeds.max()), float(speeds.mean())


def _scenario(folder: Path, case: str, stiffness: str, shards: int, substeps: int, iterations: int) -> Path:
    """Write a case and its meshes."""
    turn = trimesh.transformations.rotation_matrix(np.radians(SLOPE_DEG if case == "slope" else 0.0), [0, 1, 0])
    boxes, text = BOXES[case], ""
    for name, (size, middle) in boxes.items():
        mesh = trimesh.creation.box(size)
        mesh.apply_translation(middle)
        mesh.apply_transform(turn)
        mesh.apply_translation((0.0, 0.0, HEIGHT_M))
        mesh.export(folder / f"{name}.stl")
        text += MEMBER.format(name, shards if name == "slab" else 1)
    text += '[[supports]]\nmember = "plane"\n'
    names = list(boxes)
    text += "".join(LOOSE.format(one, other) for row, one in enumerate(names) for other in names[row + 1 :])
    steps = {"substeps": substeps, "iterations": iterations, "stiffness": stiffness}
    path = folder / "slab.toml"
    path.write_text(SCENARIO.format(shards=shards + len(boxes) - 1, **steps) + text, encoding="utf-8")
    return path


if __name__ == "__main__":
    status = main(sys.argv[1:])
    sys.stdout.flush()
    os._exit(status)  # Blender's own end may hang
