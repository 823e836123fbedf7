"""Solids in place of meshes that cannot be cut: turned, closed, or of a simpler shape with the same volume."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np
from manifold3d import CrossSection, Error, FillRule, Manifold, Mesh64

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..engineering.geometry.plan_areas import outlines, signed_area
from ..engineering.geometry.repair import Repaired, repaired_solid
from ..engineering.geometry.rotations import turn_in_plane
from ..engineering.geometry.seams import loops_of_open_edges
from ..engineering.geometry.solids import box, contains, from_manifold, union
from ..engineering.geometry.vectors import length, transformed, transformed_back
from ..engineering.terrain.surface import Surface
from ..errors import GeometryError

MOST_OFF = 0.05
"""Part of an element's own volume by which that of a solid in its place may differ."""

_INWARDS_M = 0.02
_HEALED_M = 0.01
"""Distances in plan: how far within an outline its heights are looked up, and of slivers that are healed."""

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
    """Return which body each of so many vertices belongs to, (v,), by triangles (t, 3) that share them."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    edges = triangles[:, [0, 1, 1, 2]].reshape(-1, 2)
    links = coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count))
    labels: np.ndarray = connected_components(links, directed=False)[1]
    return labels


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

    Its nodes are 0.25 m apart, or as many as 2000 on a larger plan.
    """
    from scipy.spatial import Delaunay  # few files need it

    middle = np.append(mesh.vertices[:, :2].mean(axis=0), 0.0)
    moved = replace(mesh, vertices=mesh.vertices - middle)
    plan = _plan_of(moved)
    if plan.is_empty():
        raise GeometryError("has no area in plan")
    step = max(_FINEST_STEP_M, math.sqrt(plan.area() / _MOST_NODES))
    rings = [_divided(ring, step) for ring in outlines(plan)]
    rim = np.concatenate(rings)
    inside = np.concatenate([ring + _INWARDS_M * _inward(ring) for ring in rings])
    within = _grid_within(plan, step)
    nodes = np.concatenate([rim, within])
    triangles = Delaunay(nodes).simplices
    kept = contains_plan(plan, nodes[triangles].mean(axis=1))
    triangles = triangles[kept]
    turned = signed_area(nodes[triangles]) < 0.0
    triangles[turned] = triangles[turned][:, ::-1]
    looked_up = np.concatenate([inside, within])
    top = Surface(moved).heights_at(looked_up)
    upside_down = Surface(TriangleMesh(moved.vertices * (1.0, 1.0, -1.0), moved.triangles))
    bottom = -upside_down.heights_at(looked_up)
    if not (np.isfinite(top) & np.isfinite(bottom) & (top > bottom)).all():
        raise GeometryError("has no height somewhere")
    return TriangleMesh(_between(nodes, top, bottom) + middle, _prism_faces(triangles, len(nodes)))


def contains_plan(plan: CrossSection, points: np.ndarray) -> np.ndarray:
    """Return which points (n, 2) lie in an area, by the number of its sides that lie ahead of each along x."""
    inside = np.zeros(len(points), bool)
    for ring in outlines(plan):
        starts, ends = ring, np.roll(ring, -1, axis=0)
        for (x0, y0), (x1, y1) in zip(starts.tolist(), ends.tolist(), strict=True):
            crosses = (y0 > points[:, 1]) != (y1 > points[:, 1])
            if crosses.any():
                at = x0 + (points[:, 1] - y0) * (x1 - x0) / (y1 - y0)
                inside ^= crosses & (points[:, 0] < at)
    return inside


def _plan_of(mesh: TriangleMesh) -> CrossSection:
    corners = mesh.corners[:, :, :2]
    areas = signed_area(corners)
    upright = np.abs(areas) <= 1e-9
    flat, areas = corners[~upright], areas[~upright]
    polygons = [ring if area > 0.0 else ring[::-1] for ring, area in zip(flat, areas, strict=True)]
    plan = CrossSection(polygons, FillRule.Positive)
    return plan.offset(_HEALED_M).offset(-_HEALED_M).simplify(_HEALED_M)


def _divided(ring: np.ndarray, step: float) -> np.ndarray:
    """Return a ring (k, 2) with sides no longer than a step."""
    pieces = []
    for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        count = max(1, math.ceil(float(length(end - start)) / step))
        pieces.append(start + (end - start) * (np.arange(count) / count)[:, None])
    return np.concatenate(pieces)


def _inward(ring: np.ndarray) -> np.ndarray:
    """Return unit vectors (k, 2) at the corners of a ring into the area to its left."""
    along = np.roll(ring, -1, axis=0) - np.roll(ring, 1, axis=0)
    long = np.maximum(length(along), 1e-12)
    return np.column_stack((-along[:, 1], along[:, 0])) / long[:, None]


def _grid_within(plan: CrossSection, step: float) -> np.ndarray:
    inner = plan.offset(-0.5 * step)
    if inner.is_empty():
        return np.zeros((0, 2))
    x0, y0, x1, y1 = inner.bounds()
    x, y = np.meshgrid(np.arange(x0, x1, step), np.arange(y0, y1, step))
    points = np.column_stack((x.ravel(), y.ravel()))
    return points[contains_plan(inner, points)]


def _between(nodes: np.ndarray, top: np.ndarray, bottom: np.ndarray) -> np.ndarray:
    return np.concatenate([np.column_stack((nodes, top)), np.column_stack((nodes, bottom))])


def _prism_faces(triangles: np.ndarray, count: int) -> np.ndarray:
    """Return the faces of a prism over triangles (t, 3) of nodes: top, bottom (`count` further) and sides."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    back = {(end, start) for start, end in edges.tolist()}
    rim = np.array([edge for edge in edges.tolist() if tuple(edge) not in back], np.int64)
    start, end = rim.T
    sides = [np.column_stack((start, start + count, end + count)), np.column_stack((start, end + count, end))]
    return np.concatenate([triangles, triangles[:, ::-1] + count, *sides]).astype(np.int64)


_WAYS: tuple[tuple[Callable[[TriangleMesh], TriangleMesh], str], ...] = (
    (outwards, "bodies that were inside out are turned"),
    (closed_from_middles, "small holes are closed from their middles"),
    (bodies_apart, "its bodies are made solids one by one"),
    (hull_of, "its hull stands for it"),
    (slab_between_heights, "the space between its lowest and highest faces stands for it"),
    (box_around, "a box stands for it"),
)
"""Ways to a solid, the one first that keeps most of the mesh."""
