# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages that say how to install the project and which commands it has say what is there."""

import re
import tomllib

from support.checkout import ROOT

from bridge_demolition_addon.cli.main import COMMANDS

README = (ROOT / "README.md").read_text(encoding="utf-8")
INSTALL = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")


def commands_in_blocks(text):
    return [line for block in re.findall(r"^```sh\n(.*?)^```", text, flags=re.S | re.M) for line in block.splitlines()]


def test_what_is_to_be_installed_can_be():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    assert set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (`.*?) \|", INSTALL, flags=re.M)))) == set(extras)


def test_its_commands_are_those_of_the_readme_which_a_test_runs():
    with_tables = [
        *commands_in_blocks(README),
        *re.findall(r"python -m pip install (?:\"[^\"]+\"|\.)", README),
        "bda --version",
    ]
    assert set(commands_in_blocks(INSTALL)) <= set(with_tables)


def test_pages_name_commands_that_are_there_and_one_names_all():
    named = {}
    for name in ("install", "from_drawings", "first_charges", "exclusion_zone", "choosing", "commands"):
        text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
        named[name] = set(re.findall(r"\bbda ([a-z]\w+)", text))
        assert named[name] <= set(COMMANDS), name
    assert named["commands"] == set(COMMANDS)
