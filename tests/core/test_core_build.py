# SPDX-License-Identifier: GPL-3.0-or-later
"""The core gives the same bits by every compiler, keeps to what it may call, and passes the sanitizers."""

import ctypes
import os
import re
import shutil
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path

import build_core
import numpy as np
import pytest
from support.checkout import TESTS
from support.sanitized import sanitized_core

HERE = build_core.here()
CALLED = {"calloc", "free", "malloc", "memcmp", "memcpy", "memmove", "memset", "realloc", "sqrt"}
"""Functions of the C library that the core may call: all of them do the same everywhere."""

OF_COMPILER = re.compile(
    r"_ITM_|__gmon_start__|__cxa_finalize|__stack_chk_fail|__mem\w+_chk|dyld_stub_binder|_?_dso_handle"
)

STEPPED = {
    "elasticity": ("substep", "sparse_system", "joint_forces"),
    "mechanics": ("overloads", "sums_of_frames", "touches"),
    "blast": ("blast_projection", "blast_pulses"),
    "geometry": ("vectors",),
}
"""Tests that call what the core has, with random numbers and with such as are out of range."""

needs_own_compiler = pytest.mark.skipif(build_core.own_compiler() is None, reason="this machine has no C compiler")


def compilers():
    """Commands that compile for this machine."""
    found = {"own": build_core.own_compiler(), "zig": build_core.zig(HERE)}
    return {name: command for name, command in found.items() if command}


@pytest.mark.slow
@pytest.mark.parametrize("name", compilers())
def test_arithmetic_is_that_of_numpy_to_the_bit(tmp_path, name):
    options = [f"-I{build_core.SOURCES}", str(TESTS / "core" / "rounding.c")]
    path = build_core.compile_to(tmp_path / HERE.library, command=compilers()[name], options=options)
    generator = np.random.default_rng(1)
    a, b, c = generator.standard_normal((3, 10_007)) * 10.0 ** generator.integers(-8, 8, (3, 10_007))
    found = np.empty((3, a.size))
    function = ctypes.CDLL(str(path))["rounding"]
    function.argtypes = [ctypes.c_int64, *4 * [ctypes.c_void_p]]
    function(a.size, *(array.ctypes.data for array in (a, b, c, found)))
    # Each operation of numpy rounds once, and accumulate adds one number after the other.
    expected = np.array([a * b + c, np.sqrt(np.abs(a)) / b - a * c, np.add.accumulate(a * b)])
    assert found.tobytes() == expected.tobytes()


@pytest.mark.slow
@pytest.mark.skipif(not build_core.zig(HERE), reason="zig is not installed")
def test_no_product_and_sum_are_rounded_once_on_arm(tmp_path):
    command = build_core.zig(build_core.PLATFORMS["linux-arm64"])
    for source in (*build_core.SOURCES.glob("*.c"), TESTS / "core" / "rounding.c"):
        options = ['-DBDA_CORE_SOURCES=""', f"-I{build_core.SOURCES}", "-S", str(source), "-o", f"{tmp_path}/assembly"]
        subprocess.run([*command, *build_core.FLAGS, *options], check=True)
        assembly = (tmp_path / "assembly").read_text(encoding="utf-8")
        assert not re.findall(r"^\s+v?(?:fn?m(?:add|sub|la|ls)\S*)\s.*", assembly, flags=re.M)


@needs_own_compiler
@pytest.mark.skipif(sys.platform != "linux" or not shutil.which("nm"), reason="nm lists what a library calls")
def test_the_core_calls_no_function_that_differs_between_systems():
    listed = subprocess.run(
        ["nm", "-D", "--undefined-only", build_core.update()], capture_output=True, text=True, check=True
    ).stdout
    called = {line.split()[-1].partition("@")[0] for line in listed.splitlines()}
    assert {name for name in called if not OF_COMPILER.match(name)} <= CALLED


@pytest.mark.slow
@needs_own_compiler
def test_compilers_warn_of_nothing(tmp_path):
    warnings = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    build_core.compile_to(tmp_path / HERE.library, options=warnings)


SANITIZED = """
import sys
from pathlib import Path
import pytest
from bridge_demolition_addon.engineering.core import library
library.FOLDER = Path(sys.argv[1])
sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", "-p", "no:xdist", *sys.argv[2:]]))
"""


@pytest.mark.long
@needs_own_compiler
@pytest.mark.skipif(sys.platform != "linux", reason="only here are sanitizers preloaded")
def test_sanitizers_find_nothing_in_substeps(tmp_path):
    """They end the process at the first fault: random structures with cracks, bearings and bare bars are stepped.

    Random connections are judged and added up, in frames with contacts and charges.
    """
    environment = os.environ | sanitized_core(tmp_path)
    files = [TESTS / "engineering" / room / f"test_{name}.py" for room, names in STEPPED.items() for name in names]
    run = [sys.executable, "-c", SANITIZED, tmp_path, *files, "-k", "not numpy"]
    done = subprocess.run(run, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_wheel_lists_its_files_and_is_the_same_again(tmp_path):
    library = build_core.update()
    (tmp_path / "again").mkdir()
    path, again = (build_core.wheel(folder, HERE, library) for folder in (tmp_path, tmp_path / "again"))
    assert path.read_bytes() == again.read_bytes()
    assert path.name.endswith(f"-py3-none-{HERE.tag}.whl")
    archive = zipfile.ZipFile(path)
    (record,) = (name for name in archive.namelist() if name.endswith("/RECORD"))
    listed = [line.split(",")[0] for line in archive.read(record).decode().splitlines()]
    assert sorted(listed) == sorted(archive.namelist())


@pytest.mark.long
def test_the_core_is_a_project_of_its_own(tmp_path):
    """Its source distribution alone gives the wheel, which pip installs."""
    build_core.build_sdist(str(tmp_path))
    (source,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(source) as archive:
        archive.extractall(tmp_path, filter="data")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    venv.create(tmp_path / "environment", with_pip=False)
    python = tmp_path / "environment" / ("Scripts" if os.name == "nt" else "bin") / "python"
    subprocess.run([*pip, "--python", python, "install", "--quiet", "--no-deps", source], check=True)
    program = "import bridge_demolition_core as core; print(core.library_path())"
    done = subprocess.run([python, "-I", "-c", program], capture_output=True, text=True, check=True, cwd=tmp_path)
    library = Path(done.stdout.strip())
    assert library.is_relative_to(tmp_path / "environment")
    assert ctypes.CDLL(str(library))["bda_core_version"]() >= 1


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="releases are built on Linux")
@pytest.mark.parametrize("platform", build_core.PLATFORMS.values(), ids=build_core.PLATFORMS)
def test_one_machine_builds_for_all(platform):
    begins = {".so": b"\x7fELF", ".dll": b"MZ", ".dylib": b"\xcf\xfa\xed\xfe"}
    library = build_core.kept(platform).read_bytes()
    assert library.startswith(begins[platform.ending])
    assert build_core.mark(platform).encode() in library
    if platform.ending == ".dll":  # no runtime of zig's, which would take minutes to build: the C library of Windows
        assert set(re.findall(rb"[\w-]+\.dll", library, flags=re.IGNORECASE)) == {b"bda_core.dll", b"ucrtbase.dll"}


def test_a_compiler_that_does_not_work_is_passed_over(tmp_path, monkeypatch):
    broken = tmp_path / "cc"
    broken.write_text("#!/bin/sh\nexit 1\n")
    broken.chmod(0o755)
    assert not build_core.works([str(broken)]) and not build_core.works([str(tmp_path / "missing")])
    monkeypatch.setenv("CC", str(broken))
    with pytest.raises(build_core.BuildError, match=f"^CC={re.escape(str(broken))} builds no library"):
        build_core.own_compiler.__wrapped__()
