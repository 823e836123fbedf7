# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender and its extension site ask of a manifest."""

import tomllib
from typing import Any

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.version import VERSION


@pytest.fixture(scope="module")
def manifest() -> dict[str, Any]:
    return tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def project() -> dict[str, Any]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_version_is_that_of_the_project(manifest: dict[str, Any]) -> None:
    assert manifest["version"] == VERSION


def test_licence_is_that_of_the_project(manifest: dict[str, Any], project: dict[str, Any]) -> None:
    assert manifest["license"] == [f"SPDX:{project['license']}"]


def test_what_people_read_is_terse(manifest: dict[str, Any]) -> None:
    for text in (manifest["tagline"], *manifest["permissions"].values()):
        assert len(text) <= 64
        assert text[-1].isalnum()


def test_name_and_tagline_leave_blender_out(manifest: dict[str, Any]) -> None:
    assert "blender" not in (manifest["name"] + manifest["tagline"]).lower()


def test_only_files_are_asked_for(manifest: dict[str, Any]) -> None:
    assert list(manifest["permissions"]) == ["files"]
