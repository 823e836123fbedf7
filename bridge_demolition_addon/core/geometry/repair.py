"""Meshes of any origin made into solids that can be cut, where that leaves no doubt about what was meant."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
from manifold3d import triangulate
from trimesh import Trimesh

from ..errors import GeometryError
from .seams import loops_of_open_edges, welded
from .self_intersection import first_crossing
from .solids import (
    OVERLAP_TOLERANCE,
    SMALLEST_VOLUME,
    bodies,
    checked_solid,
    contains,
    from_manifold,
    mesh_of,
    to_manifold,
    union,
    volumes_and_centres,
)

WELDING_TOLERANCE = 1e-6
"""Part of the mesh's longest extent within which corners on open edges are one: single precision keeps seven digits."""

FLATNESS_TOLERANCE = 1e-3
"""Part of a hole's extent by which its rim may leave a plane and the hole still be closed by it."""


@dataclass(frozen=True, slots=True)
class Repaired:
    """A solid that can be cut, and what was done to the mesh for it, in words; nothing for a sound mesh."""

    solid: Trimesh
    repairs: tuple[str, ...]


def repaired_solid(mesh: Trimesh, name: str) -> Repaired:
    """The mesh as a solid: corners merged, plane holes closed, faces turned outwards, overlapping bodies united.

    Parameters
    ----------
    mesh : Trimesh
        Of any origin. It is not changed.
    name : str
        What the user calls it; the error messages begin with it.

    Raises
    ------
    GeometryError
        It encloses no volume, has a hole that is not plane, edges with more than two faces that cannot be told apart,
        or a body that crosses itself.
    """
    vertices, triangles = np.array(mesh.vertices, dtype=float), np.array(mesh.faces, dtype=np.int64)
    if not len(triangles):
        raise GeometryError(f"{name}: has no faces; give it a closed surface.")
    if not np.isfinite(vertices).all():
        raise GeometryError(f"{name}: has vertices that are not finite numbers; delete or move them.")
    repairs: list[str] = []
    vertices, triangles = _merged(vertices, triangles)
    triangles = _without_doubles(triangles, repairs)
    triangles = _welded(vertices, triangles, repairs)
    triangles = _wound_alike(vertices, triangles, repairs)
    triangles = _closed(vertices, triangles, repairs, name)
    _check_some_volume(vertices, triangles, name)
    solid = _united(mesh_of(vertices, triangles), repairs, name)
    crossing = first_crossing(np.asarray(solid.vertices)[np.asarray(solid.faces)])
    if crossing is not None:
        place = ", ".join(f"{coordinate:.4g}" for coordinate in crossing)
        raise GeometryError(
            f"{name}: its surface crosses itself near ({place}) m, and it cannot be told what is inside; model it as "
            "separate closed bodies, which are united."
        )
    return Repaired(checked_solid(solid, name), tuple(repairs))


def _merged(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices at the very same place as one, which is no repair: STL has no shared vertices."""
    unique, index = np.unique(vertices, axis=0, return_inverse=True)
    return unique, index.ravel()[triangles]


def _without_doubles(triangles: np.ndarray, repairs: list[str]) -> np.ndarray:
    """Without triangles that have a corner twice, and with one of each set of equal ones; opposite ones cancel."""
    kept = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    _, first, group = np.unique(np.sort(kept, axis=1), axis=0, return_index=True, return_inverse=True)
    net = np.bincount(group.ravel(), weights=_parity(kept))
    chosen = np.sort(first[net != 0])
    if dropped := len(kept) - len(chosen):
        repairs.append(f"dropped {dropped} doubled faces")
    return kept[chosen]


def _parity(triangles: np.ndarray) -> np.ndarray:
    """1 for triangles that walk their corners in rising order, -1 for the other way round, (t,)."""
    a, b, c = triangles.T
    return np.where((a < b).astype(int) + (b < c) + (c < a) == 2, 1, -1)


def _welded(vertices: np.ndarray, triangles: np.ndarray, repairs: list[str]) -> np.ndarray:
    rim = np.unique(_edges_of_one_face(triangles))
    if not len(rim):
        return triangles
    tolerance = WELDING_TOLERANCE * np.ptp(vertices, axis=0).max()
    one = welded(vertices, rim, tolerance)
    if merged := int((one != np.arange(len(vertices))).sum()):
        repairs.append(f"merged {merged} doubled vertices")
    triangles = one[triangles]
    return triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]


def _edges_of_one_face(triangles: np.ndarray) -> np.ndarray:
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    return unique[counts == 1]


def _wound_alike(vertices: np.ndarray, triangles: np.ndarray, repairs: list[str]) -> np.ndarray:
    """Triangles turned so that neighbours agree; surfaces that had to be turned look outwards, cavities inwards."""
    part, flipped = _agreement(triangles)
    uneven = [index for index in range(part.max(initial=-1) + 1) if len(set(flipped[part == index].tolist())) > 1]
    if not uneven:
        return triangles
    result = np.where(flipped[:, None], triangles[:, ::-1], triangles)
    result[~np.isin(part, uneven)] = triangles[~np.isin(part, uneven)]
    surfaces = {index: mesh_of(vertices, result[part == index]) for index in range(part.max() + 1)}
    for index in uneven:
        surface = surfaces[index]
        corner = vertices[result[part == index][:1, 0]]
        depth = sum(_encloses(other, corner) for number, other in surfaces.items() if number != index)
        volume = volumes_and_centres([np.asarray(surface.vertices)], [np.asarray(surface.faces)])[0][0]
        if (volume < 0) != (depth % 2 == 1):
            result[part == index] = result[part == index][:, ::-1]
    turned = int((result != triangles).any(axis=1).sum())
    repairs.append(f"turned {turned} faces")
    return result


def _encloses(surface: Trimesh, corner: np.ndarray) -> bool:
    inverted = mesh_of(np.asarray(surface.vertices), np.asarray(surface.faces)[:, ::-1])
    return bool(contains(surface, corner)[0] or contains(inverted, corner)[0])


def _agreement(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Part (t,) of each triangle, connected over edges of two faces, and whether it is turned against its first."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    forwards = edges[:, 0] < edges[:, 1]
    _, edge, counts = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(edge.ravel(), kind="stable")
    pairs = order[np.repeat(counts == 2, counts)].reshape(-1, 2)
    neighbours: list[list[tuple[int, bool]]] = [[] for _ in triangles]
    for one, other in pairs.tolist():
        against = bool(forwards[one] == forwards[other])
        neighbours[one // 3].append((other // 3, against))
        neighbours[other // 3].append((one // 3, against))
    part, flipped = np.full(len(triangles), -1), np.zeros(len(triangles), dtype=bool)
    for start in range(len(triangles)):
        if part[start] >= 0:
            continue
        part[start] = part.max() + 1
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for there, against in neighbours[here]:
                if part[there] < 0:
                    part[there], flipped[there] = part[start], flipped[here] ^ against
                    waiting.append(there)
    return part, flipped


def _closed(vertices: np.ndarray, triangles: np.ndarray, repairs: list[str], name: str) -> np.ndarray:
    holes = loops_of_open_edges(vertices, triangles)
    if not holes:
        return triangles
    lids = [_lid(vertices, np.array(hole), name) for hole in holes]
    repairs.append(f"closed {len(holes)} hole{'s' if len(holes) > 1 else ''}")
    return np.concatenate([triangles, *lids])


def _lid(vertices: np.ndarray, rim: np.ndarray, name: str) -> np.ndarray:
    """Triangles (t, 3) that close a hole with this rim (r,), which surrounding faces walk in this order."""
    if len(rim) < 3:
        raise GeometryError(f"{name}: not closed, an edge has faces that do not belong together; rebuild it there.")
    corners = vertices[rim]
    middle = corners.mean(axis=0)
    _, _, axes = np.linalg.svd(corners - middle)
    plane = (corners - middle) @ axes.T
    if len(rim) > 3 and np.abs(plane[:, 2]).max() > FLATNESS_TOLERANCE * np.ptp(corners, axis=0).max():
        raise GeometryError(
            f"{name}: not closed, the hole with {len(rim)} edges around {np.round(middle, 3).tolist()} m is not plane; "
            "close it in the program that it was made with."
        )
    # The lid walks the rim against the faces around it; the triangulation wants its polygons counter-clockwise.
    backwards, flat = rim[::-1], plane[::-1, :2]
    clockwise = np.sum(flat[:, 0] * np.roll(flat[:, 1], -1) - np.roll(flat[:, 0], -1) * flat[:, 1]) < 0
    order = np.arange(len(rim))[::-1] if clockwise else np.arange(len(rim))
    found = order[np.asarray(triangulate([flat[order]]), dtype=np.int64).reshape(-1, 3)]
    return backwards[found[:, ::-1] if clockwise else found]


def _check_some_volume(vertices: np.ndarray, triangles: np.ndarray, name: str) -> None:
    extent = np.ptp(vertices, axis=0).max()
    volume = volumes_and_centres([vertices], [triangles])[0][0] if len(triangles) else 0.0
    if abs(volume) <= SMALLEST_VOLUME * extent**3:
        raise GeometryError(f"{name}: encloses no volume; give it a thickness.")


def _united(mesh: Trimesh, repairs: list[str], name: str) -> Trimesh:
    """Bodies of the mesh as one solid without overlap; those that are inside out as a whole are turned."""
    volume = volumes_and_centres([np.asarray(mesh.vertices)], [np.asarray(mesh.faces)])[0][0]
    if volume < 0:
        mesh = mesh_of(np.asarray(mesh.vertices), np.asarray(mesh.faces)[:, ::-1])
    separate = [from_manifold(*shells) for shells in bodies(to_manifold(mesh, name), name=name)]
    if len(separate) < 2:
        return mesh
    whole = union(separate)
    if whole.volume >= sum(each.volume for each in separate) * (1.0 - OVERLAP_TOLERANCE):
        return mesh
    repairs.append(f"united {len(separate)} overlapping bodies")
    return whole
