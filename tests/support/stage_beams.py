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
        mesh.export(folder / f"{name}.obj")
        text += f'[[geometry]]\nname = "{name}"\nfile = "{name}.obj"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
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


def add_block(folder, name, size_m, centre_m, *, fixed=False):
    """Write a box, and return its tables of the scenario."""
    mesh = trimesh.creation.box(size_m)
    mesh.apply_translation(centre_m)
    mesh.export(folder / f"{name}.obj")
    table = f'[[geometry]]\nname = "{name}"\nfile = "{name}.obj"\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
    return table + (f'[[supports]]\nmember = "{name}"\n' if fixed else "")


PIN = '[[connections.between]]\nmembers = ["{}", "{}"]\nmaterial = "concrete"\ntype = "GENERIC"\nfree = [{}]\n'
TURNS, SLIDES = '"turn y"', '"turn y", "move x"'


def beam_of_blocks(folder, blocks, *, prop=None, with_end=True):
    """A beam of blocks, each one shard, on a bearing at its start, maybe on sliding ones at its end and under a block.

    So every bearing is one face, about whose middle it turns, and there is one face between two blocks.
    """
    length_m, bearings, text = blocks * BLOCK_M, [], ""
    for number in range(blocks):
        centre_m = ((number + 0.5) * BLOCK_M, 0.0, HEIGHT_M)
        text += add_block(folder, f"block {number}", (BLOCK_M, WIDTH_M, DEPTH_M), centre_m)
    supports = {"start": (-BLOCK_M / 2.0, HEIGHT_M, 0, TURNS)}
    if with_end:
        supports["end"] = (length_m + BLOCK_M / 2.0, HEIGHT_M, blocks - 1, SLIDES)
    if prop is not None:
        supports["prop"] = ((prop + 0.5) * BLOCK_M, HEIGHT_M - DEPTH_M, prop, SLIDES)
    for name, (x_m, height_m, block, free) in supports.items():
        text += add_block(folder, name, (BLOCK_M, WIDTH_M, DEPTH_M), (x_m, 0.0, height_m), fixed=True)
        bearings.append(PIN.format(f"block {block}", name, free))
    path = folder / "beam.toml"
    text = SCENARIO.format(shards=blocks + len(supports)) + text + "".join(bearings)
    path.write_text(text, encoding="utf-8")
    return path
