# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the animated picture at the top of the README: a run of the gallery, from its scene.

Usage: animation.py [NAME [SECONDS]] takes the run in runs/gallery/NAME, which `scripts/gallery NAME` leaves, and writes
docs/pictures/NAME.webp: the first so many seconds of the run (all), in real time, by a camera that moves slowly.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import bpy
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.scene.rendering.stills import prepare_scene_for_pictures
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.display.pictures import run_renderer

ROOT = Path(__file__).resolve().parents[2]
SIZE_PX = 640, 360
PICTURES_PER_SECOND = 6
STAYS_MS = 2000
"""How long the last picture is shown before all begins again."""
QUALITY = 60
ORBIT_DEG = 16.0
"""How far the camera goes round the bridge during the run: slowly."""


def main(name: str = "drilled_two_spans", seconds: str = "inf") -> int:
    """Render the run and write its animated picture; the exit status."""
    run = ROOT / "runs" / "gallery" / name
    view = read_scenario(run / "scenario_as_run.toml").pictures
    view = replace(view, renderer="realistic", width_px=SIZE_PX[0], height_px=SIZE_PX[1])
    view = replace(view, camera="orbiting", orbit_deg=ORBIT_DEG)
    bpy.ops.wm.open_mainfile(filepath=str(run / "scene.blend"))
    scene = bpy.context.scene
    step = round(scene.render.fps / PICTURES_PER_SECOND)
    last = min(scene.frame_end, START_FRAME + int(min(float(seconds), 1e6) * scene.render.fps))
    prepare_scene_for_pictures(scene, view)
    with tempfile.TemporaryDirectory(prefix="bda_") as folder, run_renderer(scene, run, view) as render:
        paths = []
        for frame in range(START_FRAME, last + 1, step):
            paths.append(Path(folder) / f"{frame:06d}.png")
            render(frame, paths[-1])
        write(paths, ROOT / "docs" / "pictures" / f"{name}.webp", 1000 * step // scene.render.fps)
    return 0


def write(paths: list[Path], target: Path, each_ms: int) -> None:
    """Write pictures as an animated one that goes on for ever."""
    pictures = []
    for path in paths:
        with Image.open(path) as picture:
            pictures.append(picture.convert("RGB"))
    durations_ms = [each_ms] * (len(pictures) - 1) + [STAYS_MS]
    first, *others = pictures
    first.save(target, save_all=True, append_images=others, duration=durations_ms, loop=0, quality=QUALITY, method=6)


if __name__ == "__main__":
    raise SystemExit(main(*sys.argv[1:]))
