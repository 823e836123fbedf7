"""Elements of an IFC file that are straight bars of steel of one section: their axes, sections and grades.

An axis is read from the body's extrusion, or from its placement where the material has a profile. A body that is given
by its faces alone has it along its longest edges. Then all is compared with the body as the geometry library works it
out: what lies elsewhere, or is cut out of it, is no bar.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..engineering.arithmetic import arctangent
from ..engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals, volumes_and_centres
from ..engineering.geometry.plan_areas import outlines
from ..engineering.geometry.solids import to_manifold
from ..engineering.geometry.vectors import dot, length, transformed, unit
from ..engineering.steelwork.bars import bar_axes
from ..engineering.steelwork.catalogue import section_named
from ..engineering.steelwork.named_sections import PlacedSection, section_of_outline
from ..engineering.steelwork.resistance import GRADES
from ..engineering.steelwork.sections import SteelSection
from ..errors import GeometryError
from .element_materials import ElementMaterial
from .elements import NO_BODIES, Element
from .library import library
from .missing_references import CONTRADICTIONS, representations_of
from .placement import Placement
from .profiles import section_of_profile
from .source import IfcSource

_CLASSES = ("IfcBeam", "IfcMember", "IfcColumn")
_NO_BARS = ("parapet", "footing", "approach slab", "fill", "bearing")
"""Kinds of elements that stay as they are, whatever their shape."""

STEEL = "steel"
"""Strength of the table of materials that bars have."""

_SHORTEST = 2.0
"""Length of a bar by the size of its section, below which it is a piece of a section, and no bar."""

_BESIDE_M, _BESIDE = 0.003, 0.02
"""How far a body may reach beyond its section, or not reach its edges, in m and by the size of that: chords of rounded
corners, and plates that are rounded to mm."""

_CUT = 1.5
"""How far a bar's body may reach beyond its mean length, by the size of its section: ends that are cut at up to 45°."""

_SQUARE = 1e-3
"""Part of its length, from an end, at which a body that is cut square has its section, but for such a part of that."""

_THICKEST_FLAT_M = 0.1
"""Thinner side up to which a solid rectangle of steel is a flat or square bar, and no block."""

_THINNED = 0.03
"""Part of the area by which the middle of a body may differ from its section, beside that of roots and corners."""

_BY_FACES = (
    *("IfcFacetedBrep", "IfcFacetedBrepWithVoids", "IfcAdvancedBrep", "IfcTriangulatedFaceSet"),
    *("IfcPolygonalFaceSet", "IfcFaceBasedSurfaceModel", "IfcShellBasedSurfaceModel"),
)
"""Bodies that say nothing of how they are swept."""

_FLAT, _PARALLEL = 0.99, 0.9999
"""Cosines: of the angle between the faces beside an edge, and of that between edges that run along a bar."""

_GRADE = re.compile(
    r"\b(?:S ?(235|275|355|450)|ST ?(37|44|52)|FE ?(360|430|510)|E ?(24|28|36))(?![0-9])", re.IGNORECASE
)
_OLDER = {
    **{"37": "S235", "44": "S275", "52": "S355"},
    **{"360": "S235", "430": "S275", "510": "S355"},
    **{"24": "S235", "28": "S275", "36": "S355"},
}
"""Grades that replaced those of DIN 17100 (St), EN 10025:1990 (Fe) and NF A 35-501 (E)."""


@dataclass(frozen=True, slots=True, eq=False)
class SteelElement:
    """A bar of steel in a file, where it stands in the scenario.

    Attributes
    ----------
    number : int
        Of its element in the file.
    section : str
        Name of its section.
    begin_m, end_m : (3,) float
        Ends of its axis, through the centre of its section.
    y_axis : (3,) float
        Unit vector along the y axis of its section.
    grade : str or None
        Of its steel, where the name of its material says it.
    """

    number: int
    section: str
    begin_m: np.ndarray
    end_m: np.ndarray
    y_axis: np.ndarray
    grade: str | None

    @property
    def steel_section(self) -> SteelSection:
        return section_named(self.section)

    @property
    def length_m(self) -> float:
        return float(length(self.end_m - self.begin_m))

    @property
    def along(self) -> np.ndarray:
        """Unit vector (3,) along it."""
        return (self.end_m - self.begin_m) / self.length_m

    @property
    def roll_deg(self) -> float:
        """Turn of its section, as `steelwork.members.roll_deg`, from -180° to 180°."""
        level = bar_axes(self.begin_m, self.end_m, 0.0)
        y = self.y_axis
        return float(np.degrees(arctangent(float(dot(y, level[:, 2])), float(dot(y, level[:, 1])))))


@dataclass(frozen=True, slots=True)
class SteelElements:
    """Bars of a file by the numbers of their elements, and why other elements of steel are none."""

    bars: dict[int, SteelElement]
    refused: dict[int, str]


def steel_elements(
    source: IfcSource,
    elements: Sequence[Element],
    solids: Mapping[int, TriangleMesh],
    made_of: Mapping[int, ElementMaterial],
    placement: Placement,
) -> SteelElements:
    """Return which elements are bars of steel.

    Solids are where they stand in the scenario, by the numbers of their elements; the placement leads there.
    """
    bars, refused = {}, {}
    for element in elements:
        number = element.entity.id()
        if number not in solids or not _may_be(element, made_of.get(number)):
            continue
        try:
            bar = _bar(source, element, solids[number], placement)
            bars[number] = replace(bar, grade=grade_of(made_of[number].name))
        except GeometryError as error:
            refused[number] = str(error)
        except CONTRADICTIONS:
            refused[number] = "its geometry contradicts its schema"
    return SteelElements(bars, refused)


def _may_be(element: Element, substance: ElementMaterial | None) -> bool:
    of_class = not set(_CLASSES).isdisjoint(element.facts.classes)
    return bool(
        of_class and element.kind not in _NO_BARS and substance is not None and substance.row.strength_name == STEEL
    )


def grade_of(material: str) -> str | None:
    """Return the grade that the name of a steel says, such as S355 of ``S355J2`` or ``Fe 510``; None for no grade."""
    found = _GRADE.search(material)
    if not found:
        return None
    new, *older = found.groups()
    grade = f"S{new}" if new else _OLDER[next(filter(None, older))]
    return grade if grade in GRADES else None


@dataclass(frozen=True, slots=True)
class _Sweep:
    """What sweeps a profile along a straight line: the profile, the axes (3, 3) of its plane as columns, with the last
    along the line, its origin (3,), and how long the line is, m.

    Profile and length are None where the file does not say them.
    """

    profile: Any
    axes: np.ndarray
    origin_m: np.ndarray
    depth_m: float | None


def _bar(source: IfcSource, element: Element, solid: TriangleMesh, placement: Placement) -> SteelElement:
    """Return the bar that an element is; a `GeometryError` says why it is none."""
    sweep = _sweep_of(source, element.entity)
    sweep = _in_scenario(sweep, placement) if sweep else _along_edges(solid)
    local = transformed(sweep.axes.T, solid.vertices - sweep.origin_m)
    upright = TriangleMesh(local, solid.triangles)
    low, high = local.min(axis=0), local.max(axis=0)
    volumes, centres = volumes_and_centres([upright])
    middle = float(centres[0, 2])
    cut = to_manifold(upright).slice(middle)
    rings, area = outlines(cut), float(cut.area())
    placed = section_of_profile(sweep.profile, source.unit_m) if sweep.profile else None
    if placed is None:
        placed = section_of_outline(rings) if rings else None
        if placed is None:
            raise GeometryError("has an outline like that of no section of a bar")
    elif sweep.depth_m is None and rings:
        placed = _over(placed, rings)
    size, least = float(placed.section.size_m.max()), float(placed.section.size_m.min())
    if placed.name.startswith("FLAT") and least > _THICKEST_FLAT_M:
        raise GeometryError(f"is a block, {size:.3g} x {least:.3g} m thick")
    _check_fit(placed, rings, area, size)
    _check_straight(placed, local, size)
    mean_m = float(volumes[0]) / area
    lowest, highest = float(low[2]), float(high[2])
    if highest - lowest - mean_m > _CUT * size:
        raise GeometryError("has more cut out of it than its ends")
    begin, end = _ends(upright, (lowest, highest), middle, mean_m, area)
    if end - begin < _SHORTEST * size:
        raise GeometryError(f"is {end - begin:.2f} m long, no more than {_SHORTEST:g} times as long as its section")
    x, y = placed.centre_m
    centre = sweep.origin_m + x * sweep.axes[:, 0] + y * sweep.axes[:, 1]
    along = sweep.axes[:, 2]
    y_axis = placed.y_axis[0] * sweep.axes[:, 0] + placed.y_axis[1] * sweep.axes[:, 1]
    return SteelElement(element.entity.id(), placed.name, centre + begin * along, centre + end * along, y_axis, None)


def _ends(
    upright: TriangleMesh, extent_m: tuple[float, float], middle_m: float, mean_m: float, area_m2: float
) -> tuple[float, float]:
    """Return where the axis of a body along z begins and ends.

    An end that is cut square is where the body ends. One that is cut at an angle counts at its middle: that follows
    from the volume, and where both are cut so, from the centre.
    """
    (lowest, highest), body = extent_m, to_manifold(upright)
    within = _SQUARE * (highest - lowest)
    square = [
        float(body.slice(level).area()) > (1.0 - _SQUARE) * area_m2 for level in (lowest + within, highest - within)
    ]
    if all(square):
        return lowest, highest
    if square[0]:
        return lowest, lowest + mean_m
    if square[1]:
        return highest - mean_m, highest
    return middle_m - mean_m / 2.0, middle_m + mean_m / 2.0


def _over(placed: PlacedSection, rings: Sequence[np.ndarray]) -> PlacedSection:
    """Return a section moved so that its box has the same middle as an outline's box."""
    points, own = np.concatenate(rings), _corners(placed)
    middle, own_middle = ((low + high) / 2.0 for low, high in (_box(points), _box(own)))
    return replace(placed, centre_m=placed.centre_m + middle - own_middle)


def _check_fit(placed: PlacedSection, rings: Sequence[np.ndarray], area_m2: float, size_m: float) -> None:
    """Refuse a section that a body does not have in its middle."""
    if not rings:
        raise GeometryError("has nothing in its middle")
    off = np.abs(np.array(_box(np.concatenate(rings))) - np.array(_box(_corners(placed)))).max()
    if float(off) > max(_BESIDE_M, _BESIDE * size_m):
        raise GeometryError(f"has another outline than {placed.name}, by {1e3 * float(off):.0f} mm")
    share = area_m2 / placed.section.area_m2 - 1.0
    if abs(share) > _roots(placed) + _THINNED:
        raise GeometryError(f"has {100.0 * share:+.0f} % of the area of {placed.name} more in its middle")


def _check_straight(placed: PlacedSection, local_m: np.ndarray, size_m: float) -> None:
    """Refuse a body with vertices (p, 3) outside the section that it has in its middle: curved, or of several parts."""
    beyond = np.abs(np.array(_box(local_m[:, :2])) - np.array(_box(_corners(placed)))).max()
    if float(beyond) > max(_BESIDE_M, _BESIDE * size_m):
        raise GeometryError(f"is not straight, or reaches {1e3 * float(beyond):.0f} mm beside {placed.name}")


def _roots(placed: PlacedSection) -> float:
    """Part of the area of a section that rounded roots and corners have, which a file may leave out."""
    section = placed.section
    return 0.05 if section.is_rolled or placed.name.startswith(("RHS", "SHS", "L ", "U ", "T ", "I ", "PG ")) else 0.0


def _corners(placed: PlacedSection) -> np.ndarray:
    """Points (p, 2) of the outline of a section in the plane of its profile."""
    points, y = np.concatenate(placed.section.rings), placed.y_axis
    return np.asarray(placed.centre_m + points[:, :1] * y + points[:, 1:] * np.array([-y[1], y[0]]))


def _box(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return points.min(axis=0), points.max(axis=0)


def _in_scenario(sweep: _Sweep, placement: Placement) -> _Sweep:
    def placed(points: np.ndarray) -> np.ndarray:
        flat = transformed(placement.turn, points[:, :2])
        return np.column_stack((flat, points[:, 2]))

    origin = placed((sweep.origin_m - placement.origin_m)[None])[0]
    return replace(sweep, axes=placed(sweep.axes.T).T, origin_m=origin)


def _along_edges(solid: TriangleMesh) -> _Sweep:
    """Return a straight line along which most of a body's edges run; the profile is to be found."""
    sides = np.concatenate([solid.triangles[:, [0, 1]], solid.triangles[:, [1, 2]], solid.triangles[:, [2, 0]]])
    _, normals = triangle_areas_and_normals(solid.corners)
    normals = np.tile(normals, (3, 1))
    order = np.lexsort(np.sort(sides, axis=1).T)
    pairs, normals = np.sort(sides, axis=1)[order].reshape(-1, 2, 2), normals[order].reshape(-1, 2, 3)
    if not (pairs[:, 0] == pairs[:, 1]).all():
        raise GeometryError("has a surface of which edges have more than two faces")
    is_edge = dot(normals[:, 0], normals[:, 1]) < _FLAT
    edges = solid.vertices[pairs[is_edge, 0, 1]] - solid.vertices[pairs[is_edge, 0, 0]]
    if not len(edges):
        raise GeometryError("has no edges")
    longest = unit(edges[int(length(edges).argmax())])
    alike = np.abs(dot(unit(edges), longest)) > _PARALLEL
    ahead = edges[alike] * np.sign(dot(edges[alike], longest))[:, None]
    along = unit(ahead.sum(axis=0))
    along = along if tuple(np.round(along, 6)) > (0.0, 0.0, 0.0) else -along
    return _Sweep(None, bar_axes(np.zeros(3), along, 0.0)[:, [1, 2, 0]], solid.vertices.mean(axis=0), None)


def _sweep_of(source: IfcSource, entity: Any) -> _Sweep | None:
    """Return how a body is swept, in metres and the axes of the file; None for one that is given by its faces."""
    items = list(_items(entity))
    place = _matrix(library("util.placement").get_local_placement(entity.ObjectPlacement))
    if len(items) == 1:
        item, matrix = items[0]
        solid = _uncut(item)
        if solid.is_a() == "IfcExtrudedAreaSolid":
            return _extruded(solid, _product(place, matrix), source.unit_m)
    if profile := _profile_of_material(entity):
        axes, origin = _rigid(place, source.unit_m)
        return _Sweep(profile, axes, origin, None)
    kinds = [_uncut(item).is_a() for item, _ in items]
    if len(items) == 1 and kinds[0] not in _BY_FACES:
        raise GeometryError(f"has a body of the kind {kinds[0]}, which is not swept along a straight line")
    if len(items) != 1:
        raise GeometryError(f"has a body of {len(items)} parts")
    return None


def _items(entity: Any) -> Iterator[tuple[Any, np.ndarray]]:
    """Yield the parts of an element's body, with the matrix (4, 4) from their axes to its own, in units of the file."""
    bodies = [shape for shape in representations_of(entity) if shape.RepresentationIdentifier not in NO_BODIES]
    own = [shape for shape in bodies if shape.RepresentationIdentifier == "Body"] or bodies
    for shape in own:
        for item in shape.Items or ():
            yield from _unmapped(item, np.eye(4))


def _unmapped(item: Any, matrix: np.ndarray) -> Iterator[tuple[Any, np.ndarray]]:
    if not item.is_a("IfcMappedItem"):
        yield item, matrix
        return
    placement = library("util.placement")
    source = item.MappingSource
    target = _matrix(placement.get_cartesiantransformationoperator3d(item.MappingTarget))
    origin = source.MappingOrigin
    if origin.is_a("IfcAxis2Placement3D"):
        back = _inverse(_matrix(placement.get_axis2placement(origin)))
    else:
        raise GeometryError("is mapped from a plane")
    for inner in source.MappedRepresentation.Items or ():
        yield from _unmapped(inner, _product(matrix, _product(target, back)))


def _uncut(item: Any) -> Any:
    """Return what a body is cut from, or the body itself."""
    while item.is_a("IfcBooleanResult") and item.Operator == "DIFFERENCE":
        item = item.FirstOperand
    return item


def _extruded(solid: Any, place: np.ndarray, unit_m: float) -> _Sweep:
    x, y, z = solid.ExtrudedDirection.DirectionRatios
    if abs(x) + abs(y) > 1e-6 * abs(z):
        raise GeometryError("is extruded at an angle to its profile")
    if solid.Position is not None:
        place = _product(place, _matrix(library("util.placement").get_axis2placement(solid.Position)))
    axes, origin = _rigid(place, unit_m)
    return _Sweep(solid.SweptArea, axes, origin, _scale(place) * unit_m * float(solid.Depth))


def _profile_of_material(entity: Any) -> Any:
    """Return the one profile that an element's material has; None for none, or several."""
    material = library("util.element").get_material(entity, should_skip_usage=True)
    if material is None or not material.is_a("IfcMaterialProfileSet"):
        return None
    profiles = [row.Profile for row in material.MaterialProfiles or () if row.Profile]
    return profiles[0] if len(profiles) == 1 and not getattr(material, "CompositeProfile", None) else None


def _matrix(values: Any) -> np.ndarray:
    return np.array(values, float).reshape(4, 4)


def _product(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return np.column_stack([transformed(first, column) for column in second.T])


def _inverse(rigid: np.ndarray) -> np.ndarray:
    made = np.eye(4)
    made[:3, :3] = rigid[:3, :3].T
    made[:3, 3] = -transformed(rigid[:3, :3].T, rigid[:3, 3])
    return made


def _scale(matrix: np.ndarray) -> float:
    return float(length(matrix[:3, 2]))


def _rigid(matrix: np.ndarray, unit_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Return unit axes (3, 3) as columns and origin (3,), m, of a matrix; refuses what makes a profile larger."""
    sizes = length(matrix[:3, :3].T)
    axes = matrix[:3, :3] / sizes
    if float(np.abs(sizes[:2] - 1.0).max()) > 1e-6:
        raise GeometryError("is another element's body made larger")
    if float(dot(np.cross(axes[:, 0], axes[:, 1]), axes[:, 2])) < 0.0:
        raise GeometryError("is another element's body mirrored")
    return axes, matrix[:3, 3] * unit_m
