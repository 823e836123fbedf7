"""The versions that calculate a run: what its result depends on beside its inputs."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from ..engineering.core.library import core_sources
from ..errors import SimulationError

_LIBRARIES = ("numpy", "manifold3d", "trimesh")
_PACKAGE = Path(__file__).resolve().parents[1]
_CALCULATING = ("bullet", "engineering", "model", "scene", "simulation", "system")
"""Layers of this package that decide the result."""

_SHORT = 12


def installed_blender() -> str:
    """Return the version of Blender's module, without loading it."""
    try:
        return version("bpy")
    except PackageNotFoundError as error:
        raise SimulationError("Blender is not there: install the bpy package or run inside Blender") from error


def versions_with(blender: str) -> dict[str, str]:
    """Return all versions, with that of a Blender; those of this package and its libraries are the ones here."""
    return {"blender": blender, "bridge_demolition_addon": _code(), **{name: version(name) for name in _LIBRARIES}}


@cache
def _code() -> str:
    """Digest of this package's own code and of its compiled core, of which the same version may have many."""
    digest = hashlib.sha256(core_sources().encode())
    for layer in _CALCULATING:
        for path in sorted((_PACKAGE / layer).rglob("*.py")):
            digest.update(path.relative_to(_PACKAGE).as_posix().encode() + b"\0")
            digest.update(path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return digest.hexdigest()[:_SHORT]
