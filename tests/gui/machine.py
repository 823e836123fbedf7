# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Blender runs: on this system, or in a folder with a Debian of its own."""

import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[2]

NEEDED = ("Xvfb", "import")
"""Programs beside Blender: a screen that nobody sees, and ImageMagick's screenshots."""

DEBIAN_PACKAGES = (
    *("blender", "python3-numpy", "python3-requests", "python3-zstandard", "python3-urllib3", "python3-cattr"),
    *("python3-pil", "xvfb", "imagemagick", "fonts-dejavu-core", "ca-certificates"),
    *("libgl1-mesa-dri", "libegl1", "libgl1", "libglx-mesa0", "mesa-vulkan-drivers"),
)

ENTER = """
root=$1 checkout=$2 output=$3; shift 3
mkdir -p "$root/dev/shm" "$root/tmp" "$root$checkout" "$root$output"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --bind -o ro "$checkout" "$root$checkout"
mount --bind "$output" "$root$output"
exec chroot "$root" "$@"
"""
"""Checkout and output folder are seen from inside at their own paths; all mounts end with the process."""


class SetupError(Exception):
    """The test cannot be set up; the message says why and what helps."""


@dataclass(frozen=True)
class System:
    """This system itself."""

    blender: str

    def command(self, *command: str, output: Path) -> list[str]:
        """A command as it is started from here; it may write to the output folder."""
        return list(command)


@dataclass(frozen=True)
class DebianRoot:
    """A folder with a Debian, entered as root and without a network."""

    folder: Path
    blender: str = "/usr/bin/blender"

    def command(self, *command: str, output: Path) -> list[str]:
        """A command as it is started from here; it may write to the output folder."""
        enter = ["unshare", "--mount", "--pid", "--net", "--fork", "--kill-child", "sh", "-euc", ENTER, "enter"]
        return [*enter, str(self.folder), str(CHECKOUT), str(output), *command]


def found_system(blender: str | None) -> System | None:
    """This system, where it has a Blender and what else is needed; None where it has no Blender."""
    path = shutil.which(blender or "blender")
    if path is None:
        if blender:
            raise SetupError(f"{blender} is no Blender that can be started")
        return None
    if missing := [program for program in NEEDED if not shutil.which(program)]:
        raise SetupError(f"needs {' and '.join(missing)}: on Debian, apt-get install xvfb imagemagick")
    return System(path)


def debian_root(folder: Path, suite: str) -> DebianRoot:
    """The Debian in a folder, made there where it is missing."""
    if os.geteuid() != 0:
        raise SetupError(
            "found no Blender; to make and enter a Debian that has one, run this as root, or give --blender"
        )
    if not (folder / "usr/bin/blender").exists():
        make_debian(folder, suite)
    return DebianRoot(folder)


def make_debian(folder: Path, suite: str) -> None:
    if not shutil.which("mmdebstrap"):
        raise SetupError("found no Blender, and no mmdebstrap to make a Debian with: install either, or give --blender")
    if folder.exists() and any(folder.iterdir()):
        raise SetupError(f"{folder} is there and has no Blender; choose another folder with --root")
    print(f"Making a Debian {suite} with Blender in {folder}: 1.4 GB, a minute or two", flush=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    options = [
        "--variant=minbase",
        '--aptopt=APT::Install-Recommends "false"',
        f"--include={','.join(DEBIAN_PACKAGES)}",
    ]
    if suite == "unstable":
        options.append('--aptopt=Acquire::Check-Valid-Until "false"')
    result = subprocess.run(["mmdebstrap", "--quiet", *options, suite, str(folder)])
    if result.returncode:
        raise SetupError(
            f"mmdebstrap could not make a Debian {suite} in {folder}; remove that folder before trying again"
        )
