# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw docs/pictures/ifc_two_spans.jpg: the bridge of tests/support/ifc_bridges.py, read from IFC and hit by a ball."""

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
PICTURE = ROOT / "docs" / "pictures" / "ifc_two_spans.jpg"

MOMENTS = ("before", "impact", "after")
PICTURE_PX, GAP_PX, QUALITY = (640, 360), 10, 85

BALL = """\
[scenario]
based_on = "bridge/scenario.toml"
title = "Two spans from IFC, wrecking ball"

[time]
duration_s = 2.5

[ball]
mass_kg = 10000
diameter_m = 1.34
target_m = [5.5, 0.0]
drop_height_m = 6.0
release_time_s = 0.2
"""


def main() -> None:
    """Write the bridge as IFC, import and run it, and put its pictures side by side."""
    sys.path.insert(0, str(ROOT / "tests"))
    from support.ifc_bridges import whole_bridge

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = whole_bridge().written(folder / "bridge.ifc")
        bda("import", path, "--output", folder / "bridge", "--shards", "200")
        (folder / "ball.toml").write_text(BALL, encoding="utf-8")
        bda("run", folder / "ball.toml", "--output", folder / "run")
        images = [Image.open(folder / "run" / "frames" / f"{moment}.png") for moment in MOMENTS]
        beside_each_other(images).save(PICTURE, quality=QUALITY, optimize=True)
    print(PICTURE)


def bda(*arguments: object) -> None:
    """Run a command of the add-on."""
    subprocess.run([sys.executable, "-m", "bridge_demolition_addon", *map(str, arguments)], cwd=ROOT, check=True)


def beside_each_other(images: list[Image.Image]) -> Image.Image:
    """Return pictures in a row."""
    width, height = PICTURE_PX
    whole = Image.new("RGB", (len(images) * (width + GAP_PX) - GAP_PX, height), "white")
    for number, image in enumerate(images):
        whole.paste(image.convert("RGB").resize(PICTURE_PX, Image.Resampling.LANCZOS), (number * (width + GAP_PX), 0))
    return whole


if __name__ == "__main__":
    main()
