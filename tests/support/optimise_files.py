# SPDX-License-Identifier: GPL-3.0-or-later
"""An optimisation: a block that hangs, and the charges beside it that tear it off."""

import trimesh

SCENARIO = """
[scenario]
title = "A block that hangs"
[time]
duration_s = 0.3
frames_per_second = 24
[fracture]
shards = 2
[[geometry]]
name = "hook"
file = "hook.obj"
density_kg_m3 = 2400
[[geometry]]
name = "block"
file = "block.obj"
density_kg_m3 = 400
[connections]
type = "FIXED"
method = "face"
material = "concrete"
[[supports]]
member = "hook"
[shards]
use_deactivation = false
start_deactivated = false
[blast]
start_s = 0.1
apply = "direct"
[[charges]]
name = "one"
position_m = [3.0, 0.0, 9.5]
mass_kg = 1.0
[[charges]]
name = "other"
position_m = [-3.0, 0.0, 9.5]
mass_kg = 1.0
delay_ms = 20.0
[[neighbours]]
name = "house"
position_m = [50.0, 0.0, 0.0]
"""
OPTIMISE = """
[optimise]
scenario = "scenario.toml"
objective = "charge"
probability = 0.9
confidence = 0.8
candidates = 20
runs_each = 1
finalists = 2
finalist_runs = 3
confirmation_runs = 16
seed = 4

[[quantities]]
key = "charges.mass_kg"
lowest = 0.001
highest = 100.0
logarithmic = true

[[places]]
key = "charges.one.position_m"
lowest_corner_m = [1.0, 0.0, 9.5]
highest_corner_m = [9.0, 0.0, 9.5]

[[orders]]
keys = ["charges.one.delay_ms", "charges.other.delay_ms"]

[[vary]]
key = "connections.strength_factor"
distribution = "lognormal"
median = 1.0
variation = 0.2

[[criteria]]
name = "it falls"
kind = "collapsed"
share = 0.01
"""


def optimise_file(folder, *changes):
    """Write an optimisation with changes, the scenario and its meshes."""
    folder.mkdir(exist_ok=True)
    for name, size_m, height_m in (("hook", 0.1, 10.05), ("block", 1.0, 9.5)):
        mesh = trimesh.creation.box((size_m, size_m, size_m))
        mesh.apply_translation((0.0, 0.0, height_m))
        mesh.export(folder / f"{name}.obj")
    (folder / "scenario.toml").write_text(SCENARIO, encoding="utf-8")
    text = OPTIMISE
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    path = folder / "optimise.toml"
    path.write_text(text, encoding="utf-8")
    return path
