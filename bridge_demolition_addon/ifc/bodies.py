"""Bodies of elements as solids, in metres and in the axes of the IFC file, with the digits that a mesh file holds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.repair import repaired_solid
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..errors import GeometryError, IfcError
from .elements import Element
from .gaps import keeps_volume_when_cut
from .shapes import FAILED, KeptShapes
from .source import IfcSource
from .substitutes import sound_solid

_LISTED = 5


@dataclass(frozen=True, slots=True)
class Bodies:
    """Solids of elements and notes on how they were mended, by their numbers in the file, and why others have none.

    Coordinates of solids start at the point `origin` (3,), m, near them: a bridge may lie thousands of kilometres from
    the origin of its file, where numbers have coarse steps.
    """

    solids: dict[int, TriangleMesh]
    repairs: dict[int, tuple[str, ...]]
    missing: dict[int, str]
    origin: np.ndarray
    unsound: dict[int, TriangleMesh] = field(default_factory=dict)
    """Meshes of those that have a shape, but no body."""


def bodies_of(
    source: IfcSource,
    elements: Sequence[Element],
    shapes: Mapping[int, TriangleMesh],
    kept: KeptShapes,
    volumes: Mapping[int, float],
    *,
    strict: bool,
) -> Bodies:
    """Return the bodies of elements with shapes, maybe with volumes that the file gives them, m³.

    Shapes, volumes and bodies go by the elements' numbers in the file.

    Where this is `strict`, those that fail are refused; otherwise a solid of about the same volume may stand for them.
    """
    if strict and not shapes:
        _check_all(source, elements, kept.failed)
    if not shapes:
        why = f", as later schemas have no {', '.join(source.lost_classes)}" if source.lost_classes else ""
        how = "export it as IFC4X3" if source.lost_classes else "export it again"
        reasons = "; ".join(list(dict.fromkeys(kept.failed.values()))[:_LISTED])
        raise IfcError(f"{source.path}: no element has a shape that can be worked out ({reasons}){why}; {how}")
    origin = np.floor(np.mean([mesh.bounds.mean(axis=0) for mesh in shapes.values()], axis=0))
    bodies = Bodies({}, {}, dict(kept.failed), origin)
    for done, element in enumerate(elements):
        number = element.entity.id()
        if number not in shapes:
            continue
        kept.begins(done, len(elements), element)
        mesh = replace(shapes[number], vertices=shapes[number].vertices - origin)
        try:
            if strict:
                repaired = repaired_solid(mesh, element.facts.name)
            else:
                repaired = sound_solid(mesh, element.facts.name, volumes.get(number))
        except GeometryError as error:
            bodies.missing[number] = str(error).removeprefix(f"{element.facts.name}: ")
            bodies.unsound[number] = mesh
            continue
        bodies.solids[number], bodies.repairs[number] = repaired.solid, repaired.repairs
    kept.begins(len(elements), len(elements), None)
    if strict:
        _check_all(source, elements, bodies.missing)
    return bodies


def _check_all(source: IfcSource, elements: Sequence[Element], missing: Mapping[int, str]) -> None:
    """Refuse a file with elements that have no body, and say why for each."""
    wrong = {element.title: missing[number] for element in elements if (number := element.entity.id()) in missing}
    failed = [title for title, why in wrong.items() if why == FAILED]
    others = [f"{title}: {why.rstrip('.')}." for title, why in wrong.items() if why != FAILED]
    texts = []
    if failed:
        more = f" and {len(failed) - _LISTED} more" if len(failed) > _LISTED else ""
        texts.append(
            f"the geometry of {', '.join(failed[:_LISTED])}{more} cannot be worked out; mend it in the program that it "
            "was made with, or leave such elements out by --without NAME"
        )
    if others:
        more = f" And so for {len(others) - _LISTED} more." if len(others) > _LISTED else ""
        texts.append(f"{' '.join(others[:_LISTED])}{more} Or leave it out by --without NAME")
    if texts:
        raise IfcError(f"{source.path}: {'. '.join(texts)}")


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
