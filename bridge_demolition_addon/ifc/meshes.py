"""Bodies of elements as closed meshes, in metres and in the axes of the IFC file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.repair import Repaired, repaired_solid
from ..errors import GeometryError, IfcError
from .elements import Element
from .library import library
from .source import IfcSource

CHORD_M = 0.001
"""Largest distance of the middle of a chord from its curve."""

_LISTED = 5


def element_solids(source: IfcSource, elements: Sequence[Element]) -> tuple[list[Repaired], np.ndarray]:
    """Return the bodies of elements as solids, and a point (3,), m, near them that their coordinates start at.

    A bridge may lie thousands of kilometres from the origin of its file, where numbers have coarse steps.
    """
    meshes = _meshes(source, elements)
    missing = [element.title for element in elements if element.entity.id() not in meshes]
    if missing:
        more = f" and {len(missing) - _LISTED} more" if len(missing) > _LISTED else ""
        raise IfcError(
            f"{source.path}: the geometry of {', '.join(missing[:_LISTED])}{more} cannot be worked out; mend it in "
            "the program that it was made with, or leave such elements out by --without NAME"
        )
    origin = np.floor(np.mean([mesh.bounds.mean(axis=0) for mesh in meshes.values()], axis=0))
    solids, wrong = [], []
    for element in elements:
        mesh = meshes[element.entity.id()]
        try:
            solids.append(repaired_solid(replace(mesh, vertices=mesh.vertices - origin), element.facts.name))
        except GeometryError as error:
            wrong.append(f"{element.title}: {str(error).removeprefix(element.facts.name + ': ')}")
    if wrong:
        more = f" And so for {len(wrong) - _LISTED} more." if len(wrong) > _LISTED else ""
        raise IfcError(f"{source.path}: {' '.join(wrong[:_LISTED])}{more} Or leave it out by --without NAME")
    return solids, origin


def _meshes(source: IfcSource, elements: Sequence[Element]) -> dict[int, TriangleMesh]:
    """Return the triangles of elements by the number that the file gives them."""
    geometry = library("geom")
    settings = geometry.settings()
    settings.set("use-world-coords", True)
    settings.set("weld-vertices", True)
    settings.set("mesher-linear-deflection", CHORD_M)
    iterator = geometry.iterator(settings, source.model, 1, include=[element.entity for element in elements])
    return {number: mesh for number, mesh in _shapes(iterator, source.scale) if len(mesh.triangles)}


def _shapes(iterator: Any, scale: float) -> Iterator[tuple[int, TriangleMesh]]:
    if not iterator.initialize():
        return
    while True:
        shape = iterator.get()
        vertices = np.array(shape.geometry.verts, dtype=float).reshape(-1, 3) * scale
        yield shape.id, TriangleMesh(vertices, np.array(shape.geometry.faces, dtype=np.int64).reshape(-1, 3))
        if not iterator.next():
            return
