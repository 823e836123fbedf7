# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the picture of docs/ground.md: a bridge over a valley with a river, before and after, and its map.

Usage: terrain_picture.py FOLDER, a new folder for terrain, scenario and run.
"""

import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]

PICTURE = ROOT / "docs" / "pictures" / "ground.jpg"
QUALITY = 85
STEP_M, HALF_M = 2.0, 280.0
EASTING, NORTHING, LEVEL = 448_300.0, 4_607_200.0, 262.0
"""Of the scenario's origin, at the foot of the first pier."""

SCENARIO = """
[scenario]
title = "Two spans over a valley"
seed = 11

[time]
duration_s = 4.0
frames_per_second = 24
substeps_per_frame = 20

[bridge]
span_lengths_m = [15.0, 15.0]
density_kg_m3 = 2400.0

[bridge.deck]
width_m = 7.0
thickness_m = 0.45

[bridge.piers]
columns = 2
column_length_m = 0.8
column_width_m = 0.8
height_m = 3.5

[bridge.pier_caps]
length_m = 1.0
width_m = 7.0
height_m = 0.6

[ground]
file = "valley.asc"
origin = [448300.0, 4607200.0, 262.0]
bearing_deg = 75.0

[[ground.surfaces]]
name = "river"
kind = "water"
height_m = -4.6
corners_m = [[2.0, -120.0], [30.0, -120.0], [30.0, 120.0], [2.0, 120.0]]

[fracture]
shards = 150
margin_m = 0.005

[connections]
material = "concrete"
method = "face"
type = "FIXED"

[ball]
mass_kg = 12000
diameter_m = 1.4
target_m = [7.5, 0.0]
drop_height_m = 8.0
release_time_s = 0.2

[pictures]
renderer = "realistic"
width_px = 640
height_px = 360
"""


def main(arguments: list[str]) -> int:
    """Write terrain and scenario, run it, and put pictures and map side by side."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    folder = Path(arguments[0])
    folder.mkdir(parents=True)
    write_valley(folder / "valley.asc")
    (folder / "valley.toml").write_text(SCENARIO.lstrip(), encoding="utf-8")
    command = [sys.executable, "-m", "bridge_demolition_addon"]
    subprocess.run([*command, "check", str(folder / "valley.toml")], check=True, cwd=ROOT)
    run = [*command, "run", str(folder / "valley.toml"), "--output", str(folder / "run")]
    subprocess.run(run, check=True, cwd=ROOT)
    draw(folder / "run")
    return 0


def write_valley(path: Path) -> None:
    """Write a valley 6.5 m deep that winds below the middle of the bridge, with hills beside it."""
    count = int(2 * HALF_M / STEP_M) + 1
    numbers = STEP_M * np.arange(count) - HALF_M
    east, north = np.meshgrid(numbers, numbers)
    turn = np.radians(75.0 - 90.0)
    x, y = east * np.cos(turn) - north * np.sin(turn), east * np.sin(turn) + north * np.cos(turn)
    from_river = x - 16.0 - 4.0 * np.sin(y / 25.0)
    heights = LEVEL - 6.5 * np.exp(-np.square(from_river / 11.0)) + 1.5 * np.sin(x / 30.0) * np.cos(y / 35.0) - 0.2
    head = f"ncols {count}\nnrows {count}\nxllcenter {EASTING - HALF_M}\nyllcenter {NORTHING - HALF_M}\n"
    rows = "\n".join(" ".join(f"{height:.2f}" for height in row) for row in heights[::-1])
    path.write_text(f"{head}cellsize {STEP_M}\nNODATA_value -9999\n{rows}\n", encoding="utf-8")


def draw(run: Path) -> None:
    """Put two pictures of a run and the map of its debris into one."""
    import matplotlib.pyplot as plt

    from bridge_demolition_addon.charts.plan_maps import debris_map
    from bridge_demolition_addon.model.debris.throws import debris_of
    from bridge_demolition_addon.model.results.arrays import load_results
    from bridge_demolition_addon.model.results.motion import without_removed

    results = without_removed(load_results(run))[0]
    figure = plt.figure(figsize=(9.6, 7.6), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(2.8, 4.8))
    for axes, name in zip(above.subplots(1, 2), ("before", "after"), strict=True):
        axes.imshow(plt.imread(run / "frames" / f"{name}.png"))
        axes.axis("off")
    debris_map(below, results, debris_of(results))
    figure.savefig(PICTURE, dpi=100, pil_kwargs={"quality": QUALITY, "optimize": True})


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
