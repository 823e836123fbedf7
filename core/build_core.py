#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the compiled core: one shared library from all of `src`, for this machine or by zig for another.

Without arguments the library of this checkout is built, where it is of other sources than these. Everything that builds
the core is here: pip and scripts/environment call it, and so do tests and releases. It is also how the package
`bridge_demolition_core` is built from this folder alone (the hooks of PEP 517 at the end).
"""

import argparse
import base64
import hashlib
import importlib.util
import os
import platform as machine
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from io import BytesIO
from pathlib import Path

from source_digest import SOURCES, digest

FOLDER = Path(__file__).resolve().parent
PACKAGE = "bridge_demolition_core"
ROOM = FOLDER.parent / "bridge_demolition_addon" / "engineering" / "core"
"""Where a checkout has its library."""

PROJECT_FILES = ("pyproject.toml", "README.md", "build_core.py", "source_digest.py", f"{PACKAGE}/__init__.py")
"""What the package is built from, beside the sources."""

CACHE = FOLDER.parent / "build" / "core"
"""Libraries for other machines, by what they were built from."""

FLAGS = ("-std=c11", "-O3", "-ffp-contract=off", "-fno-math-errno", "-fvisibility=hidden")
"""Arithmetic stays as it is written: nothing is contracted or reordered, and every processor rounds the same. Without
errno, sqrt is one instruction. Processors need no more than the first of their kind had."""

SHARED = "-shared"
ZIG = "ziglang"
"""The wheel that brings a compiler where there is none."""

EXAMPLE = "#include <math.h>\n#include <stdlib.h>\n#include <string.h>\ndouble example(double x) { return sqrt(x); }\n"


class BuildError(Exception):
    """The core cannot be built; the message says why."""


@dataclass(frozen=True)
class Platform:
    """A system with its processor."""

    name: str
    """As Blender names it."""
    target: str
    """As zig names it, with the oldest system that will do."""
    tag: str
    """As wheels name it."""
    ending: str
    """Of a shared library."""

    @property
    def library(self) -> str:
        """Name of the file."""
        return f"bda_core{self.ending}"


PLATFORMS = {
    platform.name: platform
    for platform in (
        Platform("linux-x64", "x86_64-linux-gnu.2.28", "manylinux_2_28_x86_64", ".so"),
        Platform("linux-arm64", "aarch64-linux-gnu.2.28", "manylinux_2_28_aarch64", ".so"),
        Platform("windows-x64", "x86_64-windows-gnu", "win_amd64", ".dll"),
        Platform("windows-arm64", "aarch64-windows-gnu", "win_arm64", ".dll"),
        Platform("macos-x64", "x86_64-macos.11.0", "macosx_11_0_x86_64", ".dylib"),
        Platform("macos-arm64", "aarch64-macos.11.0", "macosx_11_0_arm64", ".dylib"),
    )
}


def here() -> Platform:
    """Return this machine, as its Python sees it."""
    system = {"linux": "linux", "win32": "windows", "darwin": "macos"}.get(sys.platform, sys.platform)
    tag = sysconfig.get_platform()
    processor = machine.machine().lower() if system == "macos" else tag.rpartition("-")[2]
    processor = {"amd64": "x64", "x86_64": "x64", "aarch64": "arm64"}.get(processor, processor)
    known = PLATFORMS.get(f"{system}-{processor}")
    tag = tag.replace("universal2", machine.machine()).replace("-", "_").replace(".", "_")
    return Platform(f"{system}-{processor}", known.target if known else "", tag, known.ending if known else ".so")


def mark(platform: Platform) -> str:
    """Return the text that a library holds, by which it is known to be up to date."""
    return f"{digest()} {platform.tag}"


def zig(platform: Platform) -> list[str] | None:
    """Return the command of zig for a platform; None where its wheel is not installed, or the platform not known."""
    if not platform.target or importlib.util.find_spec(ZIG) is None:
        return None
    # It would make debug information, and trap where the C standard leaves something undefined.
    command = [sys.executable, "-m", ZIG, "cc", "-target", platform.target, "-g0", "-fno-sanitize=undefined"]
    return [*command, *without_runtime()] if platform.ending == ".dll" else command


def without_runtime() -> list[str]:
    """Return what has zig link the C library that Windows comes with, and nothing of its own.

    It would first build a runtime from hundreds of files, for minutes. The core has nothing to initialise, and calls
    only what allocates, copies and fills memory: so it needs no entry point either.
    """
    (folder,) = importlib.util.find_spec(ZIG).submodule_search_locations
    headers = Path(folder, "lib", "libc", "include", "any-windows-any")
    return ["-nostdlib", "-isystem", str(headers), "-lucrtbase", "-Wl,--no-entry"]


@cache
def own_compiler() -> tuple[str, ...] | None:
    """Return the command of a C compiler that is on this machine, tried out; None where there is none."""
    if named := os.environ.get("CC"):
        if not works(command := with_processor(shlex.split(named))):
            raise BuildError(f"CC={named} builds no library that this Python loads: set another compiler, or none")
        return command
    commands = (with_processor([name]) for name in ("cc", "gcc", "clang") if shutil.which(name))
    return next((command for command in commands if works(command)), None)


def with_processor(command: Sequence[str]) -> tuple[str, ...]:
    """Add the processor of this Python, which on macOS may be another than that of the compiler."""
    return (*command, "-arch", machine.machine()) if sys.platform == "darwin" else tuple(command)


def works(command: Sequence[str]) -> bool:
    """Return whether this Python loads what a compiler builds: some lack headers, or are of another system."""
    with tempfile.TemporaryDirectory(prefix="bda-core-", ignore_cleanup_errors=True) as name:
        source, library = Path(name, "example.c"), Path(name, f"example{here().ending}")
        source.write_text(EXAMPLE, encoding="ascii")
        load = [sys.executable, "-c", "import ctypes, sys; ctypes.CDLL(sys.argv[1])", library]
        try:
            compiled = [*command, *FLAGS, *system_flags(here()), source, "-o", library, SHARED]
            return all(subprocess.run(step, capture_output=True).returncode == 0 for step in (compiled, load))
        except OSError:
            return False


def system_flags(platform: Platform) -> list[str]:
    """Return what a system needs to load a library from wherever it lies; on Windows it is nothing."""
    return {
        ".so": ["-fPIC"],
        ".dylib": ["-fPIC", f"-Wl,-install_name,@rpath/{platform.library}"],  # else it holds the folder of the build
    }.get(platform.ending, [])


def compiler_for(platform: Platform) -> Sequence[str]:
    """Return the command that compiles for a platform: of this machine for itself, otherwise zig."""
    command = (own_compiler() if platform == here() else None) or zig(platform)
    if command is None:
        raise BuildError(f"no C compiler for {platform.name}: install gcc or clang, or: python -m pip install {ZIG}")
    return command


def compile_to(
    target: Path, platform: Platform | None = None, command: Sequence[str] | None = None, options: Sequence[str] = ()
) -> Path:
    """Compile all sources into one library, which is in its place only once it is complete, and return its path."""
    platform = platform or here()
    command = command or compiler_for(platform)
    target.parent.mkdir(parents=True, exist_ok=True)
    # zig leaves more than the library. The folder is beside the target, so that a file is moved as a whole.
    with tempfile.TemporaryDirectory(prefix=".bda-core-", dir=target.parent) as name:
        library = Path(name, target.name)
        words = [*command, *FLAGS, *system_flags(platform), f'-DBDA_CORE_SOURCES="{mark(platform)}"', *options]
        done = subprocess.run(
            [*words, *sorted(SOURCES.glob("*.c")), "-o", library, SHARED], capture_output=True, text=True
        )
        if done.returncode:
            raise BuildError(f"{command[0]} could not build the core for {platform.name}:\n{done.stderr.strip()}")
        library.replace(target)
    return target


def is_up_to_date(library: Path, platform: Platform) -> bool:
    """Return whether a library is of these sources and for a platform, by the text that it holds."""
    return library.is_file() and mark(platform).encode() in library.read_bytes()


def update(folder: Path = ROOM, platform: Platform | None = None) -> Path:
    """Build the library in a folder where it is missing or not of these sources, and return its path."""
    platform = platform or here()
    library = folder / platform.library
    return library if is_up_to_date(library, platform) else compile_to(library, platform)


def kept(platform: Platform) -> Path:
    """Return the library for a platform, for which zig builds it once."""
    command = zig(platform)
    if command is None:
        raise BuildError(f"libraries for other machines are built by zig: python -m pip install {ZIG}")
    library = CACHE / platform.name / platform.library
    return library if is_up_to_date(library, platform) else compile_to(library, platform, command)


def wheel(folder: Path, platform: Platform, library: Path, local: str = "") -> Path:
    """Write the wheel that holds nothing but a library and where it is; `local` follows the version after a +."""
    project = tomllib.loads((FOLDER / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    version = project["version"] + (f"+{local}" if local else "")
    info = f"{PACKAGE}-{version}.dist-info"
    metadata = {
        "Metadata-Version": "2.4",
        "Name": project["name"],
        "Version": version,
        "Summary": project["description"],
        "License-Expression": project["license"],
        "License-File": "LICENSE",
        "Requires-Python": project["requires-python"],
        "Description-Content-Type": "text/markdown",
    }
    files = {
        f"{PACKAGE}/__init__.py": (FOLDER / PACKAGE / "__init__.py").read_bytes(),
        f"{PACKAGE}/{library.name}": library.read_bytes(),
        f"{info}/licenses/LICENSE": licence().read_bytes(),
        f"{info}/METADATA": fields(metadata) + b"\n" + (FOLDER / "README.md").read_bytes(),
        f"{info}/WHEEL": fields(
            {
                "Wheel-Version": "1.0",
                "Generator": "build_core",
                "Root-Is-Purelib": "false",
                "Tag": f"py3-none-{platform.tag}",
            }
        ),
    }
    files[f"{info}/RECORD"] = record(files, f"{info}/RECORD")
    path = folder / f"{PACKAGE}-{version}-py3-none-{platform.tag}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            # Without times: the same library gives the same wheel.
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED)
    return path


def licence() -> Path:
    """Return the file of the licence: of this folder, or of the checkout around it."""
    return next(path for path in (FOLDER / "LICENSE", FOLDER.parent / "LICENSE") if path.is_file())


def fields(values: Mapping[str, str]) -> bytes:
    """Return lines of names and values, as the files of a wheel have them."""
    return "".join(f"{name}: {value}\n" for name, value in values.items()).encode()


def record(files: Mapping[str, bytes], own: str) -> bytes:
    """Return the list of a wheel's files with their digests, but for its own."""
    lines = []
    for name, content in files.items():
        hashed = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={hashed},{len(content)}\n")
    return "".join([*lines, f"{own},,\n"]).encode()


def main(arguments: Sequence[str] | None = None) -> int:
    """Build what is asked for; the exit status."""
    parser = argparse.ArgumentParser(prog="build_core", description=__doc__.splitlines()[0])
    parser.add_argument("--platform", choices=PLATFORMS, help="for another machine, by zig, into this checkout")
    options = parser.parse_args(arguments)
    try:
        if options.platform and options.platform != here().name:
            platform = PLATFORMS[options.platform]
            shutil.copy(kept(platform), ROOM / platform.library)
        else:
            update()
    except BuildError as error:
        print(f"build_core: {error}", file=sys.stderr)
        return 1
    return 0


# What pip calls where this folder is a project of its own (PEP 517).


def get_requires_for_build_wheel(config_settings: Mapping[str, str] | None = None) -> list[str]:
    """Return the compiler as a wheel, where there is no other."""
    return [] if own_compiler() else [ZIG]


def build_wheel(
    wheel_directory: str, config_settings: Mapping[str, str] | None = None, metadata_directory: str | None = None
) -> str:
    """Build the wheel for this machine, or for that of `--config-setting platform=NAME`."""
    chosen = (config_settings or {}).get("platform")
    with tempfile.TemporaryDirectory(prefix="bda-core-") as name:
        platform = PLATFORMS[chosen] if chosen else here()
        library = compile_to(Path(name, platform.library), platform, zig(platform) if chosen else None)
        return wheel(Path(wheel_directory), platform, library).name


def build_sdist(sdist_directory: str, config_settings: Mapping[str, str] | None = None) -> str:
    """Build the source distribution."""
    project = tomllib.loads((FOLDER / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    name = f"{PACKAGE}-{project['version']}"
    metadata = fields({"Metadata-Version": "2.4", "Name": project["name"], "Version": project["version"]})
    sources = sorted(SOURCES.glob("*.[ch]"))
    files = [FOLDER / part for part in PROJECT_FILES]
    with tarfile.open(Path(sdist_directory, f"{name}.tar.gz"), "w:gz") as archive:
        for path in (*files, *sources):
            archive.add(path, f"{name}/{path.relative_to(FOLDER).as_posix()}")
        archive.add(licence(), f"{name}/LICENSE")
        about = tarfile.TarInfo(f"{name}/PKG-INFO")
        about.size = len(metadata)
        archive.addfile(about, BytesIO(metadata))
    return f"{name}.tar.gz"


if __name__ == "__main__":
    sys.exit(main())
