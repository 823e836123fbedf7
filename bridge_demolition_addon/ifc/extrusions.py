"""Bodies extruded from profiles whose outlines say of their parts that they run the other way than they do.

The geometry library goes by what they say, and leaves such bodies open. Here parts of an outline are put together by
their ends.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..engineering.geometry.solids import from_manifold
from ..engineering.geometry.vectors import transformed
from ..errors import GeometryError
from .library import library
from .profiles import line_of
from .representations import items_of
from .source import IfcSource


def extruded_mesh(source: IfcSource, entity: Any) -> TriangleMesh:
    """Return the body of an element that is extruded from such profiles, in the axes of the file, m.

    A `GeometryError` says why there is none.
    """
    items = items_of(entity, "IfcSolidModel")
    if not items or not all(_is_misled(item) for item in items) or getattr(entity, "HasOpenings", None):
        raise GeometryError("is not extruded from an outline whose parts are put together here")
    placing = np.array(library("util.placement").get_local_placement(entity.ObjectPlacement), dtype=float)
    mesh = joined_meshes([_extruded(source, item) for item in items])
    placed = transformed(placing[:3, :3], mesh.vertices) + placing[:3, 3] * source.unit_m
    return TriangleMesh(placed, mesh.triangles)


def _is_misled(item: Any) -> bool:
    """Return whether all parts of an item's outline are said to run backwards, where these could not all do so."""
    if not item.is_a("IfcExtrudedAreaSolid") or not item.SweptArea.is_a("IfcArbitraryClosedProfileDef"):
        return False
    outer = item.SweptArea.OuterCurve
    return bool(
        outer.is_a("IfcCompositeCurve")
        and len(outer.Segments) > 1
        and not any(getattr(part, "SameSense", True) for part in outer.Segments)
    )


def _extruded(source: IfcSource, item: Any) -> TriangleMesh:
    unit_m, area = source.unit_m, item.SweptArea
    curves = [area.OuterCurve, *(area.InnerCurves if area.is_a("IfcArbitraryProfileDefWithVoids") else ())]
    outline = CrossSection([line_of(curve, unit_m, source.angle_rad) for curve in curves], FillRule.EvenOdd)
    x, y, z = item.ExtrudedDirection.DirectionRatios
    if outline.is_empty() or not z:
        raise GeometryError("is extruded from no area")
    size = float(np.sqrt(x * x + y * y + z * z))
    depth_m = float(item.Depth) * unit_m * z / size
    body = from_manifold(Manifold.extrude(outline, abs(depth_m)))
    up = body.vertices[:, 2:] * np.sign(depth_m)
    vertices = np.column_stack((body.vertices[:, :2] + up * (x / z, y / z), up))
    mesh = TriangleMesh(vertices, body.triangles if depth_m > 0.0 else body.triangles[:, ::-1])
    if item.Position is None:
        return mesh
    placing = np.array(library("util.placement").get_axis2placement(item.Position), dtype=float)
    return TriangleMesh(transformed(placing[:3, :3], mesh.vertices) + placing[:3, 3] * unit_m, mesh.triangles)
