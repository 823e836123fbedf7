"""Triangles of elements as IfcOpenShell works them out, kept so that a crash costs no more than one element."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.vectors import transformed
from ..errors import GeometryError
from .elements import Element
from .extrusions import extruded_mesh
from .library import library
from .representations import CONTRADICTIONS
from .sectioned_solids import swept_mesh
from .source import IfcSource

CHORD_M = 0.001
"""Largest distance of the middle of a chord from its curve."""

FAILED = "its geometry cannot be worked out"


@dataclass(slots=True)
class KeptShapes:
    """What is known of the shapes of elements before they are worked out, and where they are kept.

    Attributes
    ----------
    folder
        Where shapes are kept for a process that goes on after a crash; None to keep none.
    failed
        Why elements have no shape, by their numbers in the file. Those in it at first are not tried.
    begins
        Called before each element, with how many are done, how many there are, and the element; with None after the
        last one.
    says
        Called with what is done once all shapes are known.
    """

    folder: Path | None = None
    failed: dict[int, str] = field(default_factory=dict)
    begins: Callable[[int, int, Element | None], None] = lambda _done, _total, _element: None
    says: Callable[[str], None] = lambda _text: None

    def load(self, number: int) -> TriangleMesh | None:
        """Return the shape that is kept of an element, by its number in the file."""
        path = self._path(number)
        if path is None or not path.exists():
            return None
        with np.load(path) as arrays:
            return TriangleMesh(arrays["vertices"], arrays["triangles"])

    def save(self, number: int, mesh: TriangleMesh) -> None:
        """Keep the shape of an element."""
        if path := self._path(number):
            np.savez(path, vertices=mesh.vertices, triangles=mesh.triangles)

    def _path(self, number: int) -> Path | None:
        return None if self.folder is None else self.folder / f"{number}.npz"


def shapes_of(source: IfcSource, elements: Iterable[Element], kept: KeptShapes) -> dict[int, TriangleMesh]:
    """Return the triangles of elements by the number that the file gives them, m, in the axes of the file.

    Elements without a shape are in `kept.failed`, with the reason.
    """
    wanted, shapes, settings = list(elements), {}, _settings()
    for done, element in enumerate(wanted):
        number = element.entity.id()
        if number in kept.failed:
            continue
        if number in source.unknown:
            kept.failed[number] = source.unknown[number]
            continue
        mesh = kept.load(number)
        if mesh is None:
            kept.begins(done, len(wanted), element)
            try:
                mesh = _own_or_none(source, element.entity) or _shape(element.entity, settings, source.scale)
            except CONTRADICTIONS:
                kept.failed[number] = "its geometry contradicts its schema"
                continue
            if mesh is None:
                kept.failed[number] = FAILED
                continue
            kept.save(number, mesh)
        shapes[number] = mesh
    kept.begins(len(wanted), len(wanted), None)
    return shapes


def _own_or_none(source: IfcSource, entity: Any) -> TriangleMesh | None:
    """Return a body that is worked out here, as the geometry library leaves those of its kind unsound."""
    for made in (swept_mesh, extruded_mesh):
        with suppress(GeometryError):  # it is of another kind
            return made(source, entity)
    return None


def single_shape(source: IfcSource, entity: Any) -> TriangleMesh | None:
    """Return the triangles of a product as the geometry library works them out; None where it finds none."""
    return _shape(entity, _settings(), source.scale)


def _settings() -> Any:
    settings = library("geom").settings()
    settings.set("weld-vertices", True)
    settings.set("mesher-linear-deflection", CHORD_M)
    return settings


def _shape(entity: Any, settings: Any, scale: float) -> TriangleMesh | None:
    """Return the triangles of an element; None where IfcOpenShell finds none.

    They are placed here, in double precision, so that elements far from the origin keep their digits.
    """
    try:
        shape = library("geom").create_shape(settings, entity)
    except RuntimeError:  # its text is that of the entity, without a reason
        return None
    triangles = np.array(shape.geometry.faces, dtype=np.int64).reshape(-1, 3)
    if not len(triangles):
        return None
    vertices = np.array(shape.geometry.verts, dtype=float).reshape(-1, 3)
    placing = np.array(shape.transformation.matrix, dtype=float).reshape(4, 4).T
    placed = transformed(placing[:3, :3], vertices) + placing[:3, 3]
    return TriangleMesh(placed * scale, triangles) if np.isfinite(placed).all() else None
