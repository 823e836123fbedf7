# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the files of the checkout are."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
REPORT_2019 = EXAMPLES / "report_2019"
"""Demolitions with the settings of the 2019 report."""

DEMOLITIONS = {path.stem: path for folder in (EXAMPLES, REPORT_2019) for path in sorted(folder.glob("*.toml"))}
"""Files of all demolitions by their names, as in the gallery: bridges as they are, then those of 2019."""

DRILLED = {f"drilled_{path.stem}": path for path in sorted((EXAMPLES / "drilled").glob("*.toml"))}
"""Files of demolitions by drilled charges, by their names."""

SEEDED = DEMOLITIONS | DRILLED
"""Files of all demolitions that `scripts/seeds` runs."""

SHOWN_ONCE = {
    "span_in_an_earthquake": EXAMPLES / "ground_motion" / "span_in_an_earthquake.toml",
    "excavator_on_the_deck": EXAMPLES / "stages" / "excavator_on_the_deck.toml",
    "lillebruen": EXAMPLES / "imported" / "lillebruen.toml",
}
"""Files of other examples, of which there are no ranges over seeds."""

PRESETS = ROOT / "bridge_demolition_addon" / "ui" / "scenario" / "presets"
I235_FILE = REPORT_2019 / "i235_one_span.toml"
TESTS = ROOT / "tests"
SMALL = TESTS / "gui" / "small.toml"
"""Scenario of a bridge so small that it is built in no time."""
