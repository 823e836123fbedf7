"""Products that stand at a distance along an alignment get plain placements, worked out here.

The geometry library crashes on some alignments, and does not know others.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..engineering.geometry.vectors import unit
from ..errors import GeometryError
from .alignments import curve_of, place_along
from .representations import CONTRADICTIONS, items_of


def place_along_curves(model: Any, unit_m: float) -> tuple[str, ...]:
    """Give products of a file, an `ifcopenshell.file`, plain placements, and return what was assumed."""
    if not model.schema.startswith("IFC4X3"):
        return ()
    counted = 0
    for placement in model.by_type("IfcLinearPlacement"):
        for product in placement.PlacesObject:
            if _swept_along(product) and _swept_along(product) == {getattr(_location(placement), "BasisCurve", None)}:
                counted += 1
                product.ObjectPlacement = None
        plain = _plain(model, placement, unit_m)
        if plain is None:
            continue
        for product in placement.PlacesObject:
            product.ObjectPlacement = plain
        for other in placement.ReferencedByPlacements:
            other.PlacementRelTo = plain
    if not counted:
        return ()
    return (f"{counted} elements that are swept along an alignment and placed along it as well are placed once",)


def _swept_along(product: Any) -> set[Any]:
    """Return the curves along which a product is swept; none where a part of it is of another kind."""
    items = items_of(product, "IfcSolidModel")
    swept = {item.Directrix for item in items if item.is_a("IfcSectionedSolidHorizontal")}
    return swept if all(item.is_a("IfcSectionedSolidHorizontal") for item in items) else set()


def _location(placement: Any) -> Any:
    return getattr(placement.RelativePlacement, "Location", None)


def _plain(model: Any, placement: Any, unit_m: float) -> Any:
    """Return a placement without its curve; None where the curve is not known and the file has no position."""
    point = _location(placement)
    try:
        along, left, up = place_along(point, unit_m)
        frame = curve_of(point.BasisCurve, unit_m).at(float(along))
        axis, way = frame.up, frame.along
        if placement.RelativePlacement.Axis or placement.RelativePlacement.RefDirection:
            axis, way = _turned(placement.RelativePlacement, frame.along, frame.left, frame.up)
    except (GeometryError, *CONTRADICTIONS):
        at = placement.CartesianPosition
        return model.create_entity("IfcLocalPlacement", placement.PlacementRelTo, at) if at else None
    origin = (frame.point + left * frame.left + up * frame.up) / unit_m
    location = model.create_entity("IfcCartesianPoint", tuple(map(float, origin)))
    directions = [model.create_entity("IfcDirection", tuple(map(float, one))) for one in (axis, way)]
    at = model.create_entity("IfcAxis2Placement3D", location, *directions)
    return model.create_entity("IfcLocalPlacement", placement.PlacementRelTo, at)


def _turned(relative: Any, along: np.ndarray, left: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return z and x of a placement that is turned against the curve, whose directions its own are given in."""

    def in_file(direction: Any, otherwise: np.ndarray) -> np.ndarray:
        if direction is None:
            return otherwise
        x, y, z = (*direction.DirectionRatios, 0.0)[:3]
        return unit(x * along + y * left + z * up)

    return in_file(relative.Axis, up), in_file(relative.RefDirection, along)
