# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of the menu Presets: from the gallery's, and from runs in runs/presets for those not there."""

import subprocess
import sys
from pathlib import Path

from PIL import Image, ImageOps

ROOT = Path(__file__).resolve().parents[2]
PRESETS = ROOT / "bridge_demolition_addon" / "ui" / "scenario" / "presets"
GALLERY, RUNS = ROOT / "docs" / "pictures" / "gallery", ROOT / "runs" / "presets"
SIZE_PX, QUALITY = (256, 192), 85
MOMENT, MOMENTS = 1, 3
"""Which of the gallery's pictures side by side: the impact, or the blast."""


def main() -> int:
    """Write a picture for each preset and return the exit status."""
    for path in sorted(GALLERY.glob("*.jpg")):
        with Image.open(path) as strip:
            width = strip.width / MOMENTS
            keep(strip.crop((round(MOMENT * width), 0, round((MOMENT + 1) * width), strip.height)), path.stem)
    for path in sorted(PRESETS.glob("*.toml")):
        run(path, RUNS / path.stem)
        with Image.open(RUNS / path.stem / "frames" / "impact.png") as picture:
            keep(picture, path.stem)
    return 0


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
