"""Solids with the digits that a mesh file holds: whether they can be read again, and cut."""

from __future__ import annotations

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.repair import repaired_solid
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..errors import GeometryError
from .gaps import keeps_volume_when_cut

_DIGITS = 8
"""Of coordinates in m, that OBJ files have."""

SIMPLER_M = (0.0, 1e-6, 1e-5, 1e-4, 1e-3)
"""By how much a surface may move where it is no solid with these digits."""


def writable(solid: TriangleMesh) -> TriangleMesh | None:
    """Return a solid as a file holds it and can be read again; None where it cannot."""
    for tolerance_m in SIMPLER_M:
        simpler = _simpler(solid, tolerance_m)
        try:
            sound = repaired_solid(_rounded(simpler), "").solid
        except GeometryError:
            continue
        return solid if tolerance_m == 0.0 else sound
    return None


def is_sound(solid: TriangleMesh) -> bool:
    """Return whether a solid needs no repair with the digits that a file holds, and can be cut."""
    try:
        rounded = _rounded(solid)
        return not repaired_solid(rounded, "").repairs and keeps_volume_when_cut(rounded)
    except GeometryError:
        return False


def sound_simplified(solid: TriangleMesh) -> TriangleMesh | None:
    """Return a solid that is sound, simplified by as little as that takes; None where nothing helps."""
    return next((made for tolerance_m in SIMPLER_M if is_sound(made := _simpler(solid, tolerance_m))), None)


def _simpler(solid: TriangleMesh, tolerance_m: float) -> TriangleMesh:
    return solid if tolerance_m == 0.0 else from_manifold(to_manifold(solid).simplify(tolerance_m))


def _rounded(solid: TriangleMesh) -> TriangleMesh:
    return TriangleMesh(solid.vertices.round(_DIGITS), solid.triangles)
