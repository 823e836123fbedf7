# SPDX-License-Identifier: GPL-3.0-or-later
"""Recipes for servers that test and release: they call scripts that are there, with the Pythons that bpy is for."""

import re
import tomllib
from typing import Any

import pytest
import yaml
from support.checkout import ROOT

WORKFLOWS = ROOT / ".github" / "workflows"


def recipe(name: str) -> dict[str, Any]:
    return yaml.safe_load((WORKFLOWS / name).read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", ["test.yml", "release.yml"])
def test_scripts_that_it_calls_are_there(name: str) -> None:
    steps = [step for job in recipe(name)["jobs"].values() for step in job.get("steps", ())]
    named = re.findall(r"\bscripts/\w+(?:\.py)?", "\n".join(step.get("run", "") for step in steps))
    assert f"scripts/{name.removesuffix('.yml')}" in named
    assert [path for path in named if not (ROOT / path).is_file()] == []


def test_each_system_has_the_pythons_that_bpy_is_for() -> None:
    matrix = recipe("test.yml")["jobs"]["test"]["strategy"]["matrix"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    needed = [name for name in project["dependencies"] if name.startswith("bpy")]
    assert sorted(matrix["python"]) == sorted(re.search(r"python_version == '(.+)'", name)[1] for name in needed)
    assert {system.split("-")[0] for system in matrix["system"]} == {"ubuntu", "windows", "macos"}


def test_a_release_is_tested_first() -> None:
    jobs = recipe("release.yml")["jobs"]
    assert jobs["release"]["needs"] == "test"
    assert (ROOT / jobs["test"]["uses"]).is_file()
