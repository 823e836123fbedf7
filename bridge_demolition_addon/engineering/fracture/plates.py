"""Plates, such as slabs and walls, and shards that go through their thickness."""

from __future__ import annotations

from ..geometry.mesh import TriangleMesh
from ..geometry.solids import hull

_THINNEST = 0.5
"""Least length by the next one up to which a solid is a plate. Slabs and walls of EN 1992-1-1, 5.3.1, are wider than
four times their thickness; strips of them are not, and skewed ones are longer along the axes."""

_FULL = 0.9
"""Part of its convex hull that a plate fills: box girders, T-sections and frames do not."""

_THROUGH = 100.0
"""So long are shards along the thickness that none ends within it."""


def through_thickness(solid: TriangleMesh) -> tuple[float, float, float] | None:
    """Return the stretch of shards that go through the whole thickness of a plate, None for any other solid."""
    lower, upper = solid.bounds
    lengths = upper - lower
    thickness, width, _ = sorted(lengths.tolist())
    if thickness > _THINNEST * width or solid.volume < _FULL * hull(solid.vertices).volume():
        return None
    x, y, z = (_THROUGH if axis == lengths.argmin() else 1.0 for axis in range(3))
    return x, y, z
