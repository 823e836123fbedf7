# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams of concrete in irregular shards, as files of scenarios, and the stages of these."""

import numpy as np
import trimesh

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge

DEPTH_M, WIDTH_M, BLOCK_M, HEIGHT_M = 0.5, 1.0, 0.5, 10.0
DENSITY_KG_M3 = 2400.0
WEIGHT_N_M = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * DEPTH_M * WIDTH_M
MODULUS_M3 = WIDTH_M * DEPTH_M**2 / 6.0
STRENGTH_PA = MATERIALS["concrete"].bending_pa

SCENARIO = """
[scenario]
title = "Beam"
seed = 2
[time]
duration_s = 1.0
frames_per_second = 24
[fracture]
shards = {shards}
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
[shards]
use_deactivation = false
start_deactivated = false
"""


def beam_file(folder, length_m, held=("start",), shards=60, more=""):
    """Write the scenario of a beam that is fixed at its ends in blocks that never move, and its meshes."""
    folder.mkdir(exist_ok=True)
    positions = {"beam": (0.0, length_m)}
    positions |= {"start": (-BLOCK_M, 0.0)} if "start" in held else {}
    positions |= {"end": (length_m, length_m + BLOCK_M)} if "end" in held else {}
    text = SCENARIO.format(shards=shards)
    for name, (low, high) in positions.items():
        mesh = trimesh.creation.box((high - low, WIDTH_M, DEPTH_M))
        mesh.apply_translation(((low + high) / 2.0, 0.0, HEIGHT_M))
        mesh.export(folder / f"{name}.stl")
        text += f'[[geometry]]\nname = "{name}"\nfile = "{name}.stl"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
        text += f'[[supports]]\nmember = "{name}"\n' if name != "beam" else ""
    path = folder / "beam.toml"
    path.write_text(text + more, encoding="utf-8")
    return path


def staged(path):
    """The stages of a scenario, and what worked them out."""
    scenario = read_scenario(path)
    bridge = StandingBridge(checked_model(scenario), scenario.joints)
    return stages_of(scenario, bridge, lambda done, total: None), bridge


def largest_stress_pa(stage):
    """Bending stress by the utilisation of the connection that is used most; shear adds less than 2 % here."""
    return float(np.nanmax(stage.standing.used)) * STRENGTH_PA
