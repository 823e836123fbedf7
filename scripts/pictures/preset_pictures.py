# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of the menu Presets: from the gallery's, and from runs in runs/presets for those not there.

Those of steel, and the prestressed beam, are also in docs/pictures, and so are those of an arch and a frame.
"""

import subprocess
import sys
from pathlib import Path

from PIL import Image, ImageOps

ROOT = Path(__file__).resolve().parents[2]
PRESETS = ROOT / "bridge_demolition_addon" / "ui" / "scenario" / "presets"
GALLERY, RUNS = ROOT / "docs" / "pictures" / "gallery", ROOT / "runs" / "presets"
EXAMPLES = ROOT / "examples"
RUN = (PRESETS, PRESETS / "steel", EXAMPLES / "arches_and_frames", EXAMPLES / "steel", EXAMPLES / "prestressed")
"""Folders of presets that are not in the gallery."""

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

SIZE_PX, QUALITY = (256, 192), 85
MOMENT, MOMENTS = 1, 3
"""Which of the gallery's pictures side by side: the impact, or the blast."""


def main() -> int:
    """Write a picture for each preset and return the exit status."""
    for path in sorted(GALLERY.glob("*.jpg")):
        with Image.open(path) as strip:
            width = strip.width / MOMENTS
            keep(strip.crop((round(MOMENT * width), 0, round((MOMENT + 1) * width), strip.height)), path.stem)
    for path in sorted(path for folder in RUN for path in folder.glob("*.toml")):
        run(path, RUNS / path.stem)
        with Image.open(picture_of(path.stem)) as picture:
            keep(picture, path.stem)
    side_by_side(STEEL_BRIDGES, 3, IN_DOCUMENTS / "steel_bridges.jpg")
    side_by_side(ARCHES, 2, IN_DOCUMENTS / "arches_and_frames.jpg")
    return 0


def picture_of(name: str) -> Path:
    """The picture of a run, at its impact or as its pieces come down."""
    return RUNS / name / "frames" / "impact.png"


def side_by_side(names: tuple[str, ...], columns: int, path: Path) -> None:
    """Put the pictures of runs side by side, for the documents."""
    width, height = LARGE_PX
    sheet = Image.new("RGB", (columns * width, len(names) // columns * height))
    for number, name in enumerate(names):
        row, column = divmod(number, columns)
        with Image.open(picture_of(name)) as picture:
            sheet.paste(ImageOps.fit(picture.convert("RGB"), LARGE_PX), (column * width, row * height))
    sheet.save(path, quality=QUALITY)


def keep(picture: Image.Image, name: str) -> None:
    """Write a picture as small as the menu shows it."""
    ImageOps.fit(picture.convert("RGB"), SIZE_PX).save(PRESETS / f"{name}.jpg", quality=QUALITY)


def run(scenario: Path, folder: Path) -> None:
    """Run a scenario with its pictures, where that was not done before."""
    if not (folder / "frames").is_dir():
        command = [sys.executable, "-m", "bridge_demolition_addon", "run", str(scenario), "--output", str(folder)]
        subprocess.run(command, check=True, cwd=ROOT)


if __name__ == "__main__":
    sys.exit(main())
