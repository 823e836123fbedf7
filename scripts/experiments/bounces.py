# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how much of its speed a falling sphere keeps in Bullet, for the table in README.md.

Spheres of 1 m with a restitution of 0.5 on flat ground fall from 40 heights within 10 % of each of some, with some
sub-steps in a frame of 1/24 s. Each row is printed as the page has it.
"""

import os
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "tests"))

import bpy
from support.blocks import Blocks

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

SUBSTEPS, HEIGHTS_M = (10, 20, 40), (0.5, 2.0, 5.0)
RESTITUTION, SPHERES, SPREAD, APART_M, FRAMES = 0.5, 40, 0.1, 4.0, 60


def kept_shares(substeps: int, heights_m: np.ndarray) -> np.ndarray:
    """Return the part of its speed that each sphere keeps, by how high it rises again."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    blocks = Blocks(substeps_per_frame=substeps)
    blocks.block((0.0, 0.0, -0.5), size_m=(400.0, 400.0, 1.0)).rigid_body.restitution = 1.0
    for number, height in enumerate(heights_m.tolist()):
        position = (APART_M * (number % 10) - 20.0, APART_M * (number // 10) - 8.0, 0.5 + height)
        sphere = blocks.block(position, 100.0)
        sphere.rigid_body.collision_shape, sphere.rigid_body.restitution = "SPHERE", RESTITUTION
    with tempfile.TemporaryDirectory() as folder:
        frames = blocks.play(Path(folder), FRAMES).frames
    hits = np.searchsorted(frames.time_s, np.sqrt(2.0 * heights_m / STANDARD_GRAVITY_M_S2)) + 1
    risen = [frames.positions_m[hit:, row, 2].max() - 0.5 for row, hit in enumerate(hits.tolist(), start=1)]
    return np.sqrt(np.maximum(risen, 0.0) / heights_m)


def main() -> None:
    """Print the rows of the table."""
    random = np.random.default_rng(1)
    for substeps in SUBSTEPS:
        cells = []
        for height in HEIGHTS_M:
            shares = kept_shares(substeps, height * random.uniform(1.0 - SPREAD, 1.0 + SPREAD, SPHERES))
            cells.append(f"{shares.mean():.2f} ({shares.min():.2f} to {shares.max():.2f})")
        print(f"| {substeps} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
    os._exit(0)
