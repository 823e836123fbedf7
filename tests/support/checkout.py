# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the files of the checkout are."""

import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
REPORT_2019 = EXAMPLES / "report_2019"
"""Demolitions with the settings of the 2019 report."""

DEMOLITIONS = {path.stem: path for folder in (EXAMPLES, REPORT_2019) for path in sorted(folder.glob("*.toml"))}
"""Files of all demolitions by their names, as in the gallery: bridges as they are, then those of 2019."""

DRILLED = {f"drilled_{path.stem}": path for path in sorted((EXAMPLES / "drilled").glob("*.toml"))}
"""Files of demolitions by drilled charges, by their names."""

OTHERS = {
    path.stem: path
    for folder in ("ground_motion", "stages", "imported", "steel", "prestressed", "arches_and_frames")
    for path in sorted((EXAMPLES / folder).glob("*.toml"))
}
"""Files of the other examples that are run, by their names."""

OTHERS["overbridge"] = EXAMPLES / "overbridge" / "charges.toml"

SEEDED = DEMOLITIONS | DRILLED | OTHERS
"""Files of all examples that `scripts/seeds` runs."""

PRESETS = ROOT / "bridge_demolition_addon" / "ui" / "scenario" / "presets"
I235_FILE = REPORT_2019 / "i235_one_span.toml"
TESTS = ROOT / "tests"
SMALL = TESTS / "gui" / "small.toml"
"""Scenario of a bridge so small that it is built in no time."""


def said_of(example: Path) -> str:
    """What the gallery says of an example, in one line."""
    texts = tomllib.loads((ROOT / "scripts" / "gallery_texts.toml").read_text(encoding="utf-8"))
    return " ".join(texts[example.relative_to(EXAMPLES).as_posix()]["text"].split())
