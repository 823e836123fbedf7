# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender with nothing but itself: no package of this environment can stand in for one that the extension lacks."""

import os
import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path

from packaging.requirements import Requirement


def run_bare(program: Path, user_folder: Path, packages: Path, *arguments: object) -> None:
    """Run a program in a Python that finds nothing but bpy and what bpy itself needs.

    Its first argument is the folder `packages`, which is empty before, and where bpy is found. Blender keeps its
    settings and extensions in `user_folder`.
    """
    _link_with_requirements("bpy", packages)
    subprocess.run(
        [sys.executable, "-I", "-S", program, packages, *arguments],
        env={"PATH": os.environ["PATH"], "BLENDER_USER_RESOURCES": str(user_folder)},
        check=True,
        timeout=300,
    )


def _link_with_requirements(name: str, folder: Path) -> None:
    """Link an installed distribution and all it requires into a folder."""
    installed = distribution(name)
    for top in {file.parts[0] for file in installed.files or () if file.parts[0] not in ("..", "__pycache__")}:
        if not (folder / top).exists():
            (folder / top).symlink_to(installed.locate_file(top))
    for requirement in map(Requirement, installed.requires or ()):
        if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
            _link_with_requirements(requirement.name, folder)
