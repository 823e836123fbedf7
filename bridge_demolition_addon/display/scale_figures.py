"""A lorry and a person to compare a bridge with; for looks only."""

from __future__ import annotations

import numpy as np

from ..engineering.arrays import FloatArray, IntArray
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box, cylinder
from .dressing import DrawnPart, Stuff
from .swept import swept

LORRY_M = (8.0, 2.5, 3.5)
"""Length, width and height of the lorry."""

PERSON_M = 1.75
"""Height of the person, with helmet."""

_WHEEL_M, _TYRE_M, _AXLES_M = 1.0, 0.32, (1.1, 5.6, 6.8)
_CAB_M, _FLOOR_M = 2.0, 1.1
_SIDES = 10


def lorry(begin_m: float, y_m: float) -> list[DrawnPart]:
    """Return a lorry that stands at height 0, its front at x = `begin_m`, as long, wide and high as `LORRY_M`."""
    length, width, height = LORRY_M
    load_long = length - _CAB_M - 0.2
    load = box(
        (load_long, width, height - _FLOOR_M), (begin_m + length - load_long / 2.0, y_m, (height + _FLOOR_M) / 2.0)
    )
    roof = height - 0.5
    sill, eaves = np.array((0.0, 1.7)), np.array((0.3, roof))
    front = _across(np.array((sill, (0.0, 0.5), (_CAB_M, 0.5), (_CAB_M, roof), eaves)), begin_m, y_m, width - 0.1)
    low, high = sill + 0.08 * (eaves - sill), sill + 0.9 * (eaves - sill)
    glass = _across(np.array((low, high, high - (0.02, 0.0), low - (0.02, 0.0))), begin_m, y_m, width - 0.4)
    windows = box((0.9, width - 0.06, 0.7), (begin_m + 0.9, y_m, roof - 0.5))
    frame = box((length - 0.6, 0.9, 0.3), (begin_m + 0.3 + (length - 0.6) / 2.0, y_m, 0.85))
    wheels = [_wheel(begin_m + axle, y_m + side * (width - _TYRE_M) / 2.0) for axle in _AXLES_M for side in (-1.0, 1.0)]
    return [
        DrawnPart(Stuff.WHITE, load),
        DrawnPart(Stuff.RED, front),
        *(DrawnPart(Stuff.BLACK, one) for one in (glass, windows, frame, *wheels)),
    ]


def person(x_m: float, y_m: float) -> list[DrawnPart]:
    """Return a person who stands at height 0, `PERSON_M` high, in a yellow vest and with a white helmet."""
    sides = (-1.0, 1.0)
    legs = [_limb((0.1 * side, 0.0, 0.0), (0.08 * side, 0.0, 0.9), (0.07, 0.09), (0.09, 0.1)) for side in sides]
    trunk = _limb((0.0, 0.0, 0.82), (0.0, 0.0, 1.46), (0.18, 0.12), (0.23, 0.13))
    arms = [_limb((0.33 * side, 0.02, 0.8), (0.25 * side, 0.0, 1.43), (0.045, 0.05), (0.07, 0.07)) for side in sides]
    head = _limb((0.0, 0.0, 1.44), (0.0, 0.0, 1.66), (0.07, 0.08), (0.09, 0.1))
    helmet = _limb((0.0, 0.0, 1.62), (0.0, 0.0, PERSON_M), (0.13, 0.15), (0.07, 0.08))
    of_stuff = {Stuff.BLACK: legs, Stuff.YELLOW: [trunk, *arms], Stuff.SKIN: [head], Stuff.WHITE: [helmet]}
    place = np.array((x_m, y_m, 0.0))
    return [
        DrawnPart(stuff, TriangleMesh(solid.vertices + place, solid.triangles))
        for stuff, solids in of_stuff.items()
        for solid in solids
    ]


def _across(outline: FloatArray, begin_m: float, y_m: float, width_m: float) -> TriangleMesh:
    """Return a solid with a convex outline (c, 2) of x from `begin_m` and z, as wide as it says across the road."""
    along = swept(np.array((-width_m / 2.0, width_m / 2.0)), np.stack((outline, outline)))
    vertices = along.vertices[:, [1, 0, 2]] + (begin_m, y_m, 0.0)
    return _turned(vertices, along.triangles)


def _wheel(x: float, y: float) -> TriangleMesh:
    upright = cylinder(_WHEEL_M / 2.0, _TYRE_M, 2 * _SIDES)
    vertices = upright.vertices[:, [0, 2, 1]] + (x, y - _TYRE_M / 2.0, _WHEEL_M / 2.0)
    return _turned(vertices, upright.triangles)


def _limb(
    low: tuple[float, float, float],
    high: tuple[float, float, float],
    thick_low: tuple[float, float],
    thick_high: tuple[float, float],
) -> TriangleMesh:
    """Return what is round and tapers from one height to another, with half its thicknesses along x and y there."""
    turns = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    ring = np.column_stack((np.cos(turns), np.sin(turns)))
    outlines = np.stack([ring * thick + end[:2] for end, thick in ((low, thick_low), (high, thick_high))])
    upright = swept(np.array((low[2], high[2])), outlines)
    return _turned(upright.vertices[:, [1, 2, 0]], upright.triangles)


def _turned(vertices: FloatArray, triangles: IntArray) -> TriangleMesh:
    """Return a solid whose axes were exchanged, with its faces outwards."""
    mesh = TriangleMesh(vertices, triangles)
    return mesh if mesh.volume > 0.0 else mesh.flipped()
