# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of scripts/README.md: the icon, drawn here, and three realistic pictures of a run.

Usage: listing_pictures.py [RUN [SECONDS]] takes the run in a folder, by default that of the preset drilled_spans which
`python scripts/pictures/preset_pictures.py drilled_spans` leaves. The featured picture is of the time that is given.
"""

import json
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import bpy
from PIL import Image, ImageDraw

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.scene.rendering.stills import prepare_scene_for_pictures
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.display.pictures import run_renderer

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures" / "listing"
ICON_PX, PICTURE_PX, QUALITY = 256, (1920, 1080), 80
RENDERED_PX = 1280, 720
"""Smaller than shown: without a graphics card each takes a minute of a processor so, and two and a half otherwise."""
FINER = 4
"""How many times as large the icon is drawn, for smooth edges."""
CONCRETE, STEEL, CRACK = (214, 209, 200, 255), (52, 60, 72, 255), (226, 88, 34, 255)
DECK = [
    (16, 116),
    (112, 116),
    (128, 150),
    (144, 116),
    (240, 116),
    (240, 144),
    (146, 144),
    (128, 182),
    (110, 144),
    (16, 144),
]
PIERS = [(40, 144, 68, 232), (188, 144, 216, 232)]
CABLE, BALL = (122, 0, 134, 50), (92, 44, 164, 116)


def main(folder_of_run: str = str(ROOT / "runs" / "presets" / "drilled_spans"), seconds: str = "2.38") -> int:
    """Write all pictures and return the exit status."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    icon().save(PICTURES / "icon.png", optimize=True)
    run = Path(folder_of_run)
    view = read_scenario(run / "scenario_as_run.toml").pictures
    view = replace(view, renderer="realistic", width_px=RENDERED_PX[0], height_px=RENDERED_PX[1])
    bpy.ops.wm.open_mainfile(filepath=str(run / "scene.blend"))
    scene = bpy.context.scene
    prepare_scene_for_pictures(scene, view)
    frames = {
        "featured": START_FRAME + 1 + round(float(seconds) * scene.render.fps),
        "preview_before": START_FRAME,
        "preview_impact": json.loads((run / "summary.json").read_text(encoding="utf-8"))["key_frame"]["frame"],
    }
    with tempfile.TemporaryDirectory(prefix="bda_") as folder, run_renderer(scene, run, view) as render:
        for picture, frame in frames.items():
            path = Path(folder) / f"{picture}.png"
            render(frame, path)
            with Image.open(path) as rendered:
                shown = rendered.convert("RGB").resize(PICTURE_PX, Image.Resampling.LANCZOS)
            shown.save(PICTURES / f"{picture}.jpg", quality=QUALITY, optimize=True)
    return 0


def icon() -> Image.Image:
    """Draw a ball that breaks a deck on two piers, on nothing."""
    image = Image.new("RGBA", (ICON_PX * FINER, ICON_PX * FINER), (0, 0, 0, 0))
    draw = ImageDraw.Draw(image)
    draw.polygon([(x * FINER, y * FINER) for x, y in DECK], fill=CONCRETE)
    for pier in PIERS:
        draw.rectangle([length * FINER for length in pier], fill=CONCRETE)
    draw.rectangle([length * FINER for length in CABLE], fill=STEEL)
    draw.ellipse([length * FINER for length in BALL], fill=STEEL)
    draw.line(
        [(x * FINER, y * FINER) for x, y in ((128, 150), (118, 162), (134, 170), (128, 182))], fill=CRACK, width=16
    )
    return image.resize((ICON_PX, ICON_PX), Image.Resampling.LANCZOS)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
