# SPDX-License-Identifier: GPL-3.0-or-later
"""The core is found and is the one that is needed; else a sentence says what to do."""

import ctypes
import re
import shutil
import subprocess
import sys

import build_core
import pytest
from support.checkout import ROOT

from bridge_demolition_addon.engineering.core import library as core
from bridge_demolition_addon.errors import CoreError

BUILDER = ROOT / "core" / "build_core.py"


def test_version_is_that_of_the_header():
    header = (ROOT / "core" / "src" / "core.h").read_text(encoding="utf-8")
    assert int(re.search(r"#define BDA_CORE_VERSION (\d+)", header)[1]) == core.VERSION
    assert core.function("bda_core_version")() == core.VERSION


def test_a_missing_core_is_named_with_what_to_do(tmp_path):
    missing = tmp_path / core.FILE
    with pytest.raises(CoreError, match=re.escape(f"core is missing ({missing}): run: ") + ".*build_core.py$"):
        core.load(missing, BUILDER)
    with pytest.raises(CoreError, match=r"core is missing .*: install the program again$"):
        core.load(missing)


def test_what_is_no_library_is_named(tmp_path):
    broken = tmp_path / core.FILE
    broken.write_bytes(b"no library")
    with pytest.raises(CoreError, match=r"core cannot be loaded \(.*\): install the program again$"):
        core.load(broken)


@pytest.mark.skipif(sys.platform != "linux", reason="the mark of the processor is that of ELF")
def test_a_core_for_another_processor_is_named(tmp_path):
    other = bytearray((core.FOLDER / core.FILE).read_bytes())
    other[18:20] = b"\x15\x00"  # e_machine: PowerPC, 64 bits (System V ABI, chapter 4)
    (tmp_path / core.FILE).write_bytes(other)
    with pytest.raises(CoreError, match=r"core cannot be loaded \(.*\): install the program again$"):
        core.load(tmp_path / core.FILE)


def test_another_version_is_named(tmp_path):
    newer = build_core.compile_to(tmp_path / core.FILE, options=["-DBDA_CORE_VERSION=999"])
    with pytest.raises(CoreError, match=rf"has version 999, and version {core.VERSION} is needed \(.*\): install"):
        core.load(newer)


def test_a_core_of_other_sources_is_found_in_a_checkout(tmp_path):
    checkout = tmp_path / "core"
    shutil.copytree(ROOT / "core", checkout)
    (checkout / "src" / "version.c").open("a", encoding="utf-8").write("/* changed */\n")
    with pytest.raises(CoreError, match=r"is of other sources than those in .*: run: "):
        core.load(core.FOLDER / core.FILE, checkout / "build_core.py")
    rebuilt = tmp_path / "bridge_demolition_addon" / "engineering" / "core"
    subprocess.run([sys.executable, checkout / "build_core.py"], check=True)
    core.load(rebuilt / core.FILE, checkout / "build_core.py")


def test_the_package_of_its_own_is_found(tmp_path, monkeypatch):
    library = build_core.compile_to(tmp_path / "built" / core.FILE)
    wheel = build_core.wheel(tmp_path, build_core.here(), library)
    shutil.unpack_archive(wheel, tmp_path / "packages", "zip")
    monkeypatch.delitem(sys.modules, core.PACKAGE, raising=False)  # that of the checkout, which has no library
    monkeypatch.syspath_prepend(tmp_path / "packages")
    found = core.load(tmp_path / "nowhere" / core.FILE)
    monkeypatch.delitem(sys.modules, core.PACKAGE)
    assert isinstance(found, ctypes.CDLL) and found["bda_core_version"]() == core.VERSION
