"""Solids in place of meshes that cannot be cut: turned, closed, or of a simpler shape with the same volume."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np
from manifold3d import CrossSection, Error, FillRule, Manifold, Mesh64

from ..engineering.elasticity.equations import connected_parts
from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..engineering.geometry.plan_areas import distances_outside, outlines, signed_area
from ..engineering.geometry.repair import Repaired, loops_of_open_edges, repaired_solid
from ..engineering.geometry.solids import box, contains, from_manifold, union
from ..engineering.geometry.vectors import dot, length, transformed, transformed_back, turn_in_plane
from ..engineering.terrain.surface import Surface
from ..errors import GeometryError

MOST_OFF = 0.05
"""Part of an element's own volume by which that of a solid in its place may differ."""

_INWARDS_M = 0.02
_HEALED_M = 0.01
"""Distances in plan: how far within an outline its heights are looked up, and of slivers that are healed."""

_SIMPLER_M = 0.002
"""By how much faces may move that are made larger again."""

_FINEST_STEP_M, _MOST_NODES = 0.25, 2000

_MOST_RIM = 0.25
"""Extent of a hole that is not plane, by that of its mesh, up to which it is closed from its middle."""


def sound_solid(mesh: TriangleMesh, name: str, volume_m3: float | None) -> Repaired:
    """Return an element's mesh as a solid, or one in its place, with what was done to it.

    `volume_m3` is what the file says that the element has; without it the mesh's own counts. A `GeometryError` says why
    the mesh cannot be used where nothing in its place has its volume.
    """
    try:
        return repaired_solid(mesh, name)
    except GeometryError as error:
        refusal = error
    own = volume_m3 or abs(replace(mesh, vertices=mesh.vertices - mesh.vertices.mean(axis=0)).volume)
    for make, said in _WAYS:
        try:
            made = repaired_solid(make(mesh), name)
        except (GeometryError, ValueError):  # of the libraries that triangulate: what it makes is no solid either
            continue
        if volume_m3 is None and make is outwards:
            own = made.solid.volume  # of a mesh whose bodies look both ways, the volumes cancel
        off = made.solid.volume / own - 1.0 if own > 0.0 else math.inf
        if abs(off) <= MOST_OFF:
            why = re.split(r" near |[,;]", str(refusal).removeprefix(f"{name}: "))[0].rstrip(".")
            source = "the file gives" if volume_m3 else "its own mesh has"
            note = f"{said}, as {why}; its volume is {100.0 * off:+.1f} % of what {source}"
            return Repaired(made.solid, (*made.repairs, note))
    raise refusal


def outwards(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh with each of its bodies turned outwards, and their cavities inwards."""
    vertices, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    whole = Manifold(Mesh64(np.ascontiguousarray(vertices), index.ravel()[mesh.triangles].astype(np.uint64)))
    if whole.status() != Error.NoError:
        raise GeometryError("is not closed")
    shells = [from_manifold(shell) for shell in whole.decompose()]
    sound = [shell if shell.volume >= 0.0 else shell.flipped() for shell in shells]
    turned = []
    for number, shell in enumerate(sound):
        corner = shell.vertices[:1]
        depth = sum(bool(contains(other, corner)[0]) for row, other in enumerate(sound) if row != number)
        turned.append(shell.flipped() if depth % 2 else shell)
    return joined_meshes(turned)


def closed_from_middles(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh whose small holes are closed by triangles from the middle of their rim."""
    vertices, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    triangles = index.ravel()[mesh.triangles]
    extra: list[np.ndarray] = []
    lids: list[tuple[int, int, int]] = []
    for rim in loops_of_open_edges(vertices, triangles):
        corners = vertices[rim]
        if np.ptp(corners, axis=0).max() > _MOST_RIM * np.ptp(vertices, axis=0).max():
            raise GeometryError("has a large hole")
        middle = len(vertices) + len(extra)
        extra.append(corners.mean(axis=0))
        lids += [(rim[(row + 1) % len(rim)], corner, middle) for row, corner in enumerate(rim)]
    if not lids:
        raise GeometryError("has no hole")
    return TriangleMesh(np.concatenate([vertices, extra]), np.concatenate([triangles, np.array(lids, np.int64)]))


def bodies_apart(mesh: TriangleMesh) -> TriangleMesh:
    """Return the union of the bodies of a mesh, each made a solid by itself."""
    vertices, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    triangles = index.ravel()[mesh.triangles]
    labels = _parts(len(vertices), triangles)[triangles[:, 0]]
    parts = [TriangleMesh(vertices, triangles[labels == label]) for label in np.unique(labels)]
    if len(parts) < 2:
        raise GeometryError("is one body")
    return union([_made_sound(TriangleMesh(part.corners.reshape(-1, 3), _rows(len(part.triangles)))) for part in parts])


def _rows(count: int) -> np.ndarray:
    return np.arange(3 * count).reshape(-1, 3)


def _made_sound(part: TriangleMesh) -> TriangleMesh:
    """Return a body as a solid, its hull where that has about its volume."""
    with suppress(GeometryError):
        return repaired_solid(part, "").solid
    own = abs(replace(part, vertices=part.vertices - part.vertices.mean(axis=0)).volume)
    for make in (outwards, closed_from_middles, hull_of):
        with suppress(GeometryError, ValueError):
            made = repaired_solid(make(part), "").solid
            if abs(made.volume - own) <= MOST_OFF * own:
                return made
    raise GeometryError("has a body that is not closed")


def _parts(count: int, triangles: np.ndarray) -> np.ndarray:
    """Return the body of each vertex, (v,), by triangles (t, 3) that share them."""
    return connected_parts(np.ones(count, bool), triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel())


def hull_of(mesh: TriangleMesh) -> TriangleMesh:
    """Return the convex hull of a mesh."""
    return from_manifold(Manifold.hull_points(np.ascontiguousarray(mesh.vertices)))


def box_around(mesh: TriangleMesh) -> TriangleMesh:
    """Return the upright box around a mesh that has the smallest area in plan."""
    middle = mesh.vertices.mean(axis=0)
    plan = (mesh.vertices - middle)[:, :2]
    (corners,) = CrossSection.hull_points(plan).to_polygons()
    sides = np.roll(corners, -1, axis=0) - corners
    turns = [turn_in_plane(-float(angle)) for angle in np.arctan2(sides[:, 1], sides[:, 0])]
    turn = min(turns, key=lambda turn: float(np.prod(np.ptp(transformed(turn, plan), axis=0))))
    turned = np.column_stack((transformed(turn, plan), mesh.vertices[:, 2] - middle[2]))
    low, high = turned.min(axis=0), turned.max(axis=0)
    made = box((high - low).tolist(), ((low + high) / 2.0).tolist())
    back = np.column_stack((transformed_back(turn, made.vertices[:, :2]), made.vertices[:, 2]))
    return TriangleMesh(back + middle, made.triangles)


def slab_between_heights(mesh: TriangleMesh) -> TriangleMesh:
    """Return the solid between the lowest and the highest faces of a mesh over its plan: a deck, whatever its inside.

    Heights are looked up at nodes 0.25 m apart, or as many as 2000 on a larger plan.
    """
    middle = np.append(mesh.vertices[:, :2].mean(axis=0), 0.0)
    moved = replace(mesh, vertices=mesh.vertices - middle)
    plan = _plan_of(moved)
    if plan.is_empty():
        raise GeometryError("has no area in plan")
    step = max(_FINEST_STEP_M, math.sqrt(plan.area() / _MOST_NODES))
    plate = from_manifold(Manifold.extrude(plan, 1.0).refine_to_length(step))
    nodes = plate.vertices
    looked_up = _into(plan, nodes[:, :2])
    top = Surface(moved).heights_at(looked_up)
    upside_down = Surface(TriangleMesh(moved.vertices * (1.0, 1.0, -1.0), moved.triangles))
    bottom = -upside_down.heights_at(looked_up)
    if not (np.isfinite(top) & np.isfinite(bottom) & (top > bottom)).all():
        raise GeometryError("has no height somewhere")
    heights = bottom + nodes[:, 2] * (top - bottom)
    simpler = Manifold(_as_mesh64(np.column_stack((nodes[:, :2], heights)), plate.triangles)).simplify(_SIMPLER_M)
    made = from_manifold(simpler)
    return TriangleMesh(made.vertices + middle, made.triangles)


def _as_mesh64(vertices: np.ndarray, triangles: np.ndarray) -> Mesh64:
    return Mesh64(np.ascontiguousarray(vertices), np.ascontiguousarray(triangles.astype(np.uint64)))


def _into(plan: CrossSection, points: np.ndarray) -> np.ndarray:
    """Return points (n, 2) of an area, those at its edge a little within it: the mesh has no height outside it."""
    moved = points.copy()
    inner = plan.offset(-_INWARDS_M)
    outside = np.flatnonzero(distances_outside(inner, points) > 0.0)
    for row in outside.tolist():
        moved[row] = _nearest_on(inner, points[row])
    return moved


def _nearest_on(area: CrossSection, point: np.ndarray) -> np.ndarray:
    """Return the point (2,) of the edge of an area that is nearest to one."""
    best, nearest = math.inf, point
    for ring in outlines(area):
        starts, sides = ring, np.roll(ring, -1, axis=0) - ring
        squares = np.maximum(dot(sides, sides), 1e-24)
        shares = np.clip(dot(point - starts, sides) / squares, 0.0, 1.0)
        feet = starts + shares[:, None] * sides
        away = length(feet - point)
        row = int(away.argmin())
        if away[row] < best:
            best, nearest = float(away[row]), feet[row]
    return nearest


def _plan_of(mesh: TriangleMesh) -> CrossSection:
    corners = mesh.corners[:, :, :2]
    areas = signed_area(corners)
    upright = np.abs(areas) <= 1e-9
    flat, areas = corners[~upright], areas[~upright]
    polygons = [ring if area > 0.0 else ring[::-1] for ring, area in zip(flat, areas, strict=True)]
    plan = CrossSection(polygons, FillRule.Positive)
    return plan.offset(_HEALED_M).offset(-_HEALED_M).simplify(_HEALED_M)


_WAYS: tuple[tuple[Callable[[TriangleMesh], TriangleMesh], str], ...] = (
    (outwards, "bodies that were inside out are turned"),
    (closed_from_middles, "small holes are closed from their middles"),
    (bodies_apart, "its bodies are made solids one by one"),
    (hull_of, "its hull stands for it"),
    (slab_between_heights, "the space between its lowest and highest faces stands for it"),
    (box_around, "a box stands for it"),
)
"""Ways to a solid, the one first that keeps most of the mesh."""
