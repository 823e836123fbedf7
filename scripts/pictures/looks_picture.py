# SPDX-License-Identifier: GPL-3.0-or-later
"""Put one frame of a run of the gallery side by side: by Workbench in plain colours, and as realistic pictures have it.

Usage: looks_picture.py [NAME], after `scripts/gallery NAME`; writes docs/pictures/looks.jpg.
"""

import json
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import bpy
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.simulation.display.pictures import run_renderer

ROOT = Path(__file__).resolve().parents[2]
SIZE_PX, GAP_PX, QUALITY = (480, 270), 8, 82


def main(name: str = "drilled_two_spans") -> int:
    """Write the picture and return the exit status."""
    run = ROOT / "runs" / "gallery" / name
    frame = json.loads((run / "summary.json").read_text(encoding="utf-8"))["key_frame"]["frame"]
    view = read_scenario(run / "scenario_as_run.toml").pictures
    view = replace(view, renderer="workbench", width_px=SIZE_PX[0], height_px=SIZE_PX[1])
    bpy.ops.wm.open_mainfile(filepath=str(run / "scene.blend"))
    with tempfile.TemporaryDirectory(prefix="bda_") as folder:
        plain = Path(folder) / "plain.png"
        with run_renderer(bpy.context.scene, run, view) as render:
            render(frame, plain)
        beside((plain, run / "frames" / "impact.png"), ROOT / "docs" / "pictures" / "looks.jpg")
    return 0


def beside(paths: tuple[Path, Path], target: Path) -> None:
    """Put two pictures beside each other."""
    both = Image.new("RGB", (2 * SIZE_PX[0] + GAP_PX, SIZE_PX[1]), "white")
    for number, path in enumerate(paths):
        with Image.open(path) as picture:
            both.paste(picture.convert("RGB").resize(SIZE_PX), (number * (SIZE_PX[0] + GAP_PX), 0))
    both.save(target, quality=QUALITY, optimize=True)


if __name__ == "__main__":
    raise SystemExit(main(*sys.argv[1:]))
