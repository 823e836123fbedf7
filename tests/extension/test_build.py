# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension's zips for every Python that a Blender brings, built with whichever Python this is."""

import io
import re
import subprocess
import sys
import tomllib
import zipfile
from hashlib import sha256
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType

import build_core
import pytest
from packaging.requirements import Requirement
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


@pytest.fixture
def script() -> ModuleType:
    loader = SourceFileLoader("build_extension", str(SCRIPT))
    module = sys.modules[loader.name] = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def test_the_lock_has_all_that_the_extension_asks_for_in_versions_that_it_takes(script: ModuleType) -> None:
    asked = [Requirement(text) for text in script.requirements()]
    assert {"trimesh", "manifold3d", "matplotlib"} <= {requirement.name for requirement in asked}
    locked = tomllib.loads(script.LOCK.read_text(encoding="utf-8"))
    assert (
        {f"{python} {PLATFORM}" for python in OF_EACH} >= {name for name in locked if name.endswith(PLATFORM)} != set()
    )
    for wheels in locked.values():
        versions = {name.split("-")[0].lower().replace("_", "-"): name.split("-")[1] for name in wheels}
        wrong = [str(one) for one in asked if versions.get(one.name.lower(), "") not in one.specifier]
        assert not wrong and "numpy" not in versions
        assert all(re.fullmatch("[0-9a-f]{64}", known) for known in wheels.values())


def test_a_wheel_that_is_not_the_locked_one_is_in_no_zip(
    script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """SHA-256 of "abc": FIPS 180-2, appendix B.1."""
    monkeypatch.setattr(script, "ROOT", tmp_path)
    monkeypatch.setattr(script, "LOCK", tmp_path / "lock.toml")
    known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    script.LOCK.write_text(f'["3.13 linux-x64"]\n"one-1.0-py3-none-any.whl" = "{known}"\n')
    series, digest = script.SERIES["3.13"], sha256(repr({"one-1.0-py3-none-any.whl": known}).encode()).hexdigest()[:8]
    wheel = tmp_path / "build" / "wheels" / f"python3.13-linux-x64-{digest}" / "one-1.0-py3-none-any.whl"
    wheel.parent.mkdir(parents=True)
    wheel.write_bytes(b"abc")
    assert script.wheels_for(series, "linux-x64") == [wheel]
    wheel.write_bytes(b"abd")
    with pytest.raises(script.BuildError, match=r"differs from lock\.toml in one-1\.0-py3-none-any\.whl: remove"):
        script.wheels_for(series, "linux-x64")
    wheel.write_bytes(b"abc")
    wheel.with_name("two-1.0-py3-none-any.whl").touch()
    with pytest.raises(script.BuildError, match=r"in two-1\.0"):
        script.wheels_for(series, "linux-x64")


@pytest.mark.long
def test_what_cannot_be_got_is_said_and_the_rest_is_built(tmp_path: Path) -> None:
    # Blender with Python 3.14 is Debian's, which is no Windows; that with 3.11 is there.
    result = build("--output", tmp_path, "--platform", "macos-x64", "--python", "3.14", "--python", "3.11")
    assert result.returncode == 1
    assert "Blender with Python 3.14 does not run on macos-x64" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == [path.name for path in tmp_path.glob("*-to-5.0.zip")] != []
