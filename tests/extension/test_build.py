# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension's zips for every Python that a Blender brings, built with whichever Python this is."""

import io
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import build_core
import pytest
from support.checkout import ROOT

PLATFORM = {"linux": "linux-x64", "darwin": "macos-arm64", "win32": "windows-x64"}[sys.platform]
SCRIPT = ROOT / "scripts" / "build_extension"
OF_EACH = {
    "3.11": "bridge_demolition_addon-{}-blender-4.2-to-5.0-*.zip",
    "3.13": "bridge_demolition_addon-{}-blender-5.1-and-later-*.zip",
    "3.14": "bridge_demolition_addon-{}-python-3.14-*.zip",
}
NATIVE = {"contourpy", "kiwisolver", "manifold3d", "matplotlib", "pillow"}
"""Packages with compiled code, of which each Python needs its own."""

MOST_MB = 40


def build(*options: object) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, SCRIPT, *map(str, options)], capture_output=True, text=True)


@pytest.mark.long
@pytest.mark.parametrize("python", OF_EACH)
def test_every_zip_has_wheels_of_its_own_python(built: Path, python: str) -> None:
    (path,) = built.glob(OF_EACH[python].format("*"))
    assert path.stat().st_size < MOST_MB * 1e6
    archive = zipfile.ZipFile(path)
    names = [Path(name).name for name in archive.namelist() if name.endswith(".whl")]
    tag = "cp" + python.replace(".", "")
    found = {name.split("-")[0].lower(): name for name in names}
    assert found.keys() >= NATIVE and "numpy" not in found and "bpy" not in found
    for package in NATIVE:
        assert f"-{tag}-" in found[package] or "-abi3-" in found[package], found[package]
    core = zipfile.ZipFile(io.BytesIO(archive.read(f"wheels/{found['bridge_demolition_core']}")))
    assert f"bridge_demolition_core/{build_core.PLATFORMS[PLATFORM].library}" in core.namelist()
    assert not [name for name in archive.namelist() if "bda_core" in name]  # in its wheel alone
    manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    assert sorted(manifest["wheels"]) == sorted(f"./wheels/{name}" for name in names)


@pytest.mark.long
def test_what_cannot_be_got_is_said_and_the_rest_is_built(tmp_path: Path) -> None:
    # Blender with Python 3.14 is Debian's, which is no Windows; that with 3.11 is there.
    result = build("--output", tmp_path, "--platform", "macos-x64", "--python", "3.14", "--python", "3.11")
    assert result.returncode == 1
    assert "Blender with Python 3.14 does not run on macos-x64" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == [path.name for path in tmp_path.glob("*-to-5.0.zip")] != []
