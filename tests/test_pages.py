# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages that say how to install the project and which commands it has say what is there."""

import re
import shlex
import tomllib
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.cli.main import COMMANDS

README = (ROOT / "README.md").read_text(encoding="utf-8")
INSTALL = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")


def commands_in_blocks(text):
    return [line for block in re.findall(r"^```sh\n(.*?)^```", text, flags=re.S | re.M) for line in block.splitlines()]


def test_what_is_to_be_installed_can_be():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    assert set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (`.*?) \|", INSTALL, flags=re.M)))) == set(extras)


def test_what_its_commands_name_is_there():
    """Extras, programs of the project, and commands of `bda`, which a test of the README runs."""
    extras = {row[0] for row in re.findall(r"^\| `(\w+)`(.*)\|$", INSTALL, flags=re.M)}
    named = set(re.findall(r'pip install "\.\[(\w+)\]"', INSTALL))
    assert named and named <= extras
    for program, *arguments in map(shlex.split, commands_in_blocks(INSTALL)):
        if program == "bda":
            assert arguments == ["--version"] or f"bda {shlex.join(arguments)}" in commands_in_blocks(README)
        else:
            assert arguments[:2] == ["-m", "pip"] or (ROOT / arguments[0]).is_file()


def test_zips_are_called_as_they_are_built():
    loader = SourceFileLoader("build_extension", str(ROOT / "scripts" / "build_extension"))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(__import__("sys").modules, loader.name, module)
        loader.exec_module(module)
    named = set(re.findall(r"`(blender-[\w.-]+)`", INSTALL))
    assert named == {series.name for series in module.SERIES.values() if series.name.startswith("blender")}


def test_pages_name_commands_that_are_there_and_one_names_all():
    named = {}
    for name in ("install", "from_drawings", "first_charges", "exclusion_zone", "choosing", "commands"):
        text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
        named[name] = set(re.findall(r"\bbda ([a-z]\w+)", text))
        assert named[name] <= set(COMMANDS), name
    assert named["commands"] == set(COMMANDS)
