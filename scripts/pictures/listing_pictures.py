# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of docs/listing.md: the icon, drawn here, and previews from a run's pictures of 1920 x 1080.

`bda run` a scenario with `width_px = 1920` and `height_px = 1080` in `[pictures]`, and give its folder.
"""

import sys
from pathlib import Path

from PIL import Image, ImageDraw

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures" / "listing"
ICON_PX, PICTURE_PX = 256, (1920, 1080)
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


def main(run: str) -> int:
    """Write all pictures and return the exit status."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    icon().save(PICTURES / "icon.png", optimize=True)
    for name, moment in (("featured", "after"), ("preview_before", "before"), ("preview_impact", "impact")):
        with Image.open(Path(run) / "frames" / f"{moment}.png") as picture:
            fitted = picture.convert("RGB").resize(PICTURE_PX, Image.Resampling.LANCZOS)
        fitted.save(PICTURES / f"{name}.jpg", quality=85, optimize=True)
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
