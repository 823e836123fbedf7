# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the files of the checkout are."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
I235_FILE = EXAMPLES / "i235_one_span.toml"
TESTS = ROOT / "tests"
SMALL = TESTS / "gui" / "small.toml"
"""Scenario of a bridge so small that it is built in no time."""
