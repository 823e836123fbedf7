# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of the menu Presets, realistic ones of the moment that shows most of each preset's own run.

Usage: preset_pictures.py [NAME ...], by default of all presets. Runs are those in runs/gallery, which `scripts/gallery`
leaves, and in runs/presets; presets that have none are run. They are too small for words: the button below each says
what of it is for looks only. Pictures of steel, arches and frames in docs/pictures are made of the same runs.
"""

import json
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
from PIL import Image, ImageOps
from shown_frame import shown_frame

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bridge_demolition_addon.display.moved_surfaces import boxes_of_bodies
from bridge_demolition_addon.model.results.arrays import Results, load_results
from bridge_demolition_addon.model.results.motion import without_removed
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.scene.rendering.stills import prepare_scene_for_pictures
from bridge_demolition_addon.scene.rendering.surroundings import show_points
from bridge_demolition_addon.simulation.display.pictures import run_renderer

ROOT = Path(__file__).resolve().parents[2]
PRESETS = ROOT / "bridge_demolition_addon" / "ui" / "scenario" / "presets"
GALLERY_RUNS, RUNS = ROOT / "runs" / "gallery", ROOT / "runs" / "presets"
EXAMPLES = ROOT / "examples"
FOLDERS = (
    PRESETS,
    PRESETS / "steel",
    *(EXAMPLES / name for name in ("", "arches_and_frames", "steel", "prestressed", "report_2019")),
)
"""Where the scenarios of presets are."""

STEEL_BRIDGES = (
    "truss_severed",
    "deck_truss_severed",
    "composite_span_dropped",
    "rolled_beams_severed",
    "steel_box_girder_dropped",
    "beam_cut_in_stages",
)
ARCHES = ("arch_severed", "frame_leg_blasted")
IN_DOCUMENTS, LARGE_PX = ROOT / "docs" / "pictures", (480, 300)

RENDERED_PX, SIZE_PX, QUALITY = (320, 240), (256, 192), 85
"""How large a picture is rendered, and how large it is kept: edges are smoother then."""


def main(names: list[str]) -> int:
    """Write a picture for each preset that is named, and return the exit status."""
    files = {path.stem: path for folder in FOLDERS for path in sorted(folder.glob("*.toml"))}
    if unknown := sorted(set(names) - set(files)):
        print(f"preset_pictures: there is no preset {', '.join(unknown)}", file=sys.stderr)
        return 2
    for name in names or files:
        run = run_of(files[name])
        with tempfile.TemporaryDirectory(prefix="bda_") as folder:
            rendered = Path(folder) / "preset.png"
            take(run, rendered, RENDERED_PX, is_close=True)
            with Image.open(rendered) as picture:
                smaller = ImageOps.fit(picture.convert("RGB"), SIZE_PX, Image.Resampling.LANCZOS)
            smaller.save(PRESETS / f"{name}.jpg", quality=QUALITY, optimize=True)
    for group, columns, target in ((STEEL_BRIDGES, 3, "steel_bridges.jpg"), (ARCHES, 2, "arches_and_frames.jpg")):
        if not names or set(group) & set(names):
            side_by_side([run_of(files[name]) for name in group], columns, IN_DOCUMENTS / target)
    return 0


def run_of(scenario: Path) -> Path:
    """Return the folder of a run of a scenario, which is run where there is none."""
    for folder in (GALLERY_RUNS / scenario.stem, RUNS / scenario.stem):
        if (folder / "summary.json").is_file():
            return folder
    command = [sys.executable, "-m", "bridge_demolition_addon", "run", str(scenario), "--no-pictures"]
    subprocess.run([*command, "--output", str(RUNS / scenario.stem)], check=True, cwd=ROOT)
    return RUNS / scenario.stem


def take(run: Path, target: Path, size_px: tuple[int, int], *, is_close: bool) -> None:
    """Render the frame of a run that shows most: close up and without words, or as pictures of a run are."""
    results = load_results(run)
    key_frame = int(json.loads((run / "summary.json").read_text(encoding="utf-8"))["key_frame"]["frame"])
    frame = shown_frame(results, key_frame)
    view = read_scenario(run / "scenario_as_run.toml").pictures
    view = replace(view, renderer="realistic", width_px=size_px[0], height_px=size_px[1])
    bpy.ops.wm.open_mainfile(filepath=str(run / "scene.blend"))
    scene = bpy.context.scene
    if is_close:
        show_points(scene, points_of(results, frame))
    prepare_scene_for_pictures(scene, view)
    with run_renderer(scene, run, view, is_captioned=not is_close) as render:
        render(frame, target)


def points_of(results: Results, frame: int) -> np.ndarray:
    """Return the corners (8, 3), m, of the box around the bridge as it was, and around all that moves in a frame.

    Shards that are removed in the run are left out: they lie far below the ground then.
    """
    inventory = without_removed(results)[0].inventory
    moving = np.flatnonzero(inventory.masses_kg > 0.0)
    shards = np.intersect1d(moving, inventory.of_kind("shard"))
    row = int(np.argmin(np.abs(results.frames.number - frame)))
    boxes = np.concatenate((boxes_of_bodies(results, 0)[shards], boxes_of_bodies(results, row)[moving]))
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    return np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def side_by_side(runs: list[Path], columns: int, target: Path) -> None:
    """Put pictures of runs side by side, for the documents."""
    width, height = LARGE_PX
    sheet = Image.new("RGB", (columns * width, len(runs) // columns * height))
    with tempfile.TemporaryDirectory(prefix="bda_") as folder:
        for number, run in enumerate(runs):
            rendered = Path(folder) / f"{number}.png"
            take(run, rendered, LARGE_PX, is_close=False)
            row, column = divmod(number, columns)
            with Image.open(rendered) as picture:
                sheet.paste(picture.convert("RGB"), (column * width, row * height))
    sheet.save(target, quality=QUALITY, optimize=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
