# SPDX-License-Identifier: GPL-3.0-or-later
"""Print a digest of every bit of a scenario's model: shards, connections, and what makes these break."""

import hashlib
import os
import sys

import numpy as np

from bridge_demolition_addon.engineering.mechanics.strength import rectangular_sections
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model

if "one core" in sys.argv[2:] and hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
model = build_model(read_scenario(sys.argv[1]))
connections = model.connections
sections = rectangular_sections(connections.areas, model.second_moments_m4)
digest = hashlib.sha256()
for array in (
    *(array for shard in model.shards for array in (shard.vertices, shard.triangles)),
    model.masses_kg,
    model.centres_m,
    connections.pairs,
    connections.points,
    connections.areas,
    connections.normals,
    model.second_moments_m4,
    sections.bending_moduli_m3,
    sections.torsion_moduli_m3,
):
    digest.update(np.ascontiguousarray(array).tobytes())
print(digest.hexdigest())
