"""The versions that calculate a run: what its result depends on apart from its inputs."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from ..errors import SimulationError
from ..model.run_folder.own_code import own_code

_LIBRARIES = ("numpy", "manifold3d", "trimesh")


def installed_blender() -> str:
    """Return the version of Blender's module, without loading it."""
    try:
        return version("bpy")
    except PackageNotFoundError as error:
        raise SimulationError("Blender is not there: install the bpy package or run inside Blender") from error


def versions_with(blender: str) -> dict[str, str]:
    """Return all versions, a Blender's included; versions of this package and its libraries are the ones here."""
    return {"blender": blender, "bridge_demolition_addon": own_code(), **{name: version(name) for name in _LIBRARIES}}
