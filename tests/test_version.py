# SPDX-License-Identifier: GPL-3.0-or-later
"""The version stands in one place of the code, and everything that gives one gives the same."""

import re
import tomllib

from support.checkout import ROOT

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.version import VERSION


def test_the_command_line_gives_it(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"bda {VERSION}\n"


def test_the_package_takes_it_from_there():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert settings["project"]["dynamic"] == ["version"] and "version" not in settings["project"]
    attribute = settings["tool"]["setuptools"]["dynamic"]["version"]["attr"]
    assert attribute == "bridge_demolition_addon.version.VERSION"


def test_the_extension_the_core_and_the_citation_give_the_same():
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    assert manifest["version"] == VERSION
    core = tomllib.loads((ROOT / "core" / "pyproject.toml").read_text(encoding="utf-8"))
    assert core["project"]["version"] == VERSION
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.findall(r'^version: "(.+)"$', citation, flags=re.M) == [VERSION]
