# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension as a person gets it: built, installed into an empty Blender, switched off, removed."""

import json
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest
from support.bare_blender import run_bare

pytestmark = pytest.mark.long  # a release is built, and a Blender started that has nothing

MODULE = "bl_ext.user_default.bridge_demolition_addon"
PYTHON = "{}.{}".format(*sys.version_info)


@pytest.fixture(scope="module")
def archive(built: Path) -> Path:
    """The zip for this Python and system; the build validated it with Blender's own tool."""
    zips = json.loads((built / "index.json").read_text(encoding="utf-8"))["data"]
    (mine,) = (item for item in zips if item["python_versions"] == [PYTHON])
    return built / mine["archive_url"]


@pytest.fixture(scope="module")
def user_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("blender-user")


@pytest.fixture(scope="module")
def record(archive: Path, user_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What install_and_remove.py saw, in a Python that finds nothing but bpy and what bpy itself needs.

    Packages in the environment would hide the wheels of the extension, and so a missing one.
    """
    folder = tmp_path_factory.mktemp("packages")
    result = folder / "record.json"
    run_bare(Path(__file__).with_name("install_and_remove.py"), user_folder, folder, archive, MODULE, result)
    return json.loads(result.read_text(encoding="utf-8"))


def test_zip_has_the_package_and_its_licence(archive: Path) -> None:
    names = zipfile.ZipFile(archive).namelist()
    assert {"__init__.py", "blender_manifest.toml", "LICENSE", "ui/__init__.py"} <= set(names)
    assert not [name for name in names if "__pycache__" in name]


def test_zip_leaves_numpy_to_blender(archive: Path) -> None:
    wheels = [
        name.removeprefix("wheels/").split("-")[0] for name in zipfile.ZipFile(archive).namelist() if "wheels/" in name
    ]
    brought = {
        "trimesh",
        "manifold3d",
        "matplotlib",
        "pymap3d",
        "tifffile",
        "tqdm",
        "xlsxwriter",
        "python_docx",
        "lxml",
    }
    assert brought <= set(wheels)
    assert "numpy" not in wheels


def test_installing_enables_it(record: dict[str, Any]) -> None:
    assert record["enabled"]


def test_bundled_packages_are_used(record: dict[str, Any], user_folder: Path) -> None:
    for path in record["packages"].values():
        assert Path(path).is_relative_to(user_folder / "extensions" / ".local")


def test_it_brings_its_interface(record: dict[str, Any]) -> None:
    brought = set(record["on"][0]["classes"]) - set(record["before"]["classes"])
    assert {name.split("_")[0] for name in brought} == {"BDA"}
    assert "bda" in record["on"][0]["properties"]["Scene"]


@pytest.mark.parametrize("trace", ["handlers", "classes", "properties", "shortcuts"])
def test_switching_it_off_leaves_nothing(record: dict[str, Any], trace: str) -> None:
    for state in (*record["off"], record["removed"]):
        assert state[trace] == record["before"][trace]


def test_switching_it_off_stops_its_timers(record: dict[str, Any]) -> None:
    for state in record["off"]:
        assert not state["enabled"]
        assert state["timers"] == []


def test_switching_it_on_again_is_the_same(record: dict[str, Any]) -> None:
    first, second = record["on"]
    assert first == second


def test_removing_it_takes_its_files(record: dict[str, Any], user_folder: Path) -> None:
    assert not record["removed"]["enabled"]
    assert not list(user_folder.rglob("bridge_demolition_addon"))
