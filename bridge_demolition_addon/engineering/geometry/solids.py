"""Solids: closed triangle meshes, checked on the way in and handed to the boolean engine in double precision."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import Error, Manifold, Mesh64, OpType

from ...errors import GeometryError
from ..arithmetic import arctangent, cosine, sine
from ..arrays import BoolArray, FloatArray, IntArray
from .mesh import TriangleMesh, joined_meshes
from .vectors import cross, distance, dot, length

OVERLAP_TOLERANCE = 1e-9
"""Part of a solid's volume that its bodies may have in common before they count as overlapping."""

SMALLEST_VOLUME = 1e-14
"""Part of the cube of its longest extent that a mesh has to enclose: rounding alone gives a flat one some 1e-16."""

_THINNEST_M = 1e-4
"""Mean thickness below which a body is a film that rounding left: in single precision, in which Blender and most files
hold coordinates, it makes 0.06 mm at a kilometre from the origin."""

_PAIRS_PER_BLOCK = 200_000
"""Point-triangle pairs that `contains` looks at in one go; bounds its memory to some tens of megabytes."""

_ROUND_SIDES = 16

_BOX_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_BOX_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_BOX_TRIANGLES = _BOX_QUADS[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def box(size_m: Sequence[float], centre_m: Sequence[float] = (0.0, 0.0, 0.0)) -> TriangleMesh:
    """An axis-parallel box, by its edge lengths along x, y and z."""
    size, centre = np.asarray(size_m, dtype=float), np.asarray(centre_m, dtype=float)
    if not (np.isfinite(size).all() and np.isfinite(centre).all() and (size > 0).all()):
        raise GeometryError(
            f"A box needs three positive edge lengths and a finite centre, not {size.tolist()} at {centre.tolist()}."
        )
    return TriangleMesh(_BOX_CORNERS * size + centre, _BOX_TRIANGLES)


def sphere(radius_m: float, segments: int) -> TriangleMesh:
    """A sphere around the origin, of triangles with corners on it; a great circle has that many, a multiple of 4."""
    return from_manifold(Manifold.sphere(radius_m, segments))


def cylinder(radius_m: float, height_m: float, sides: int) -> TriangleMesh:
    """An upright prism with corners on a circle, which stands on the origin."""
    return from_manifold(Manifold.cylinder(height_m, radius_m, radius_m, sides))


def round_column(diameter_m: float, height_m: float, centre_m: Sequence[float]) -> TriangleMesh:
    """An upright prism of 16 sides with the section of a round column; two pairs of them look along x and y.

    Its second moment of area agrees with the circle's to 0.02 %.
    """
    angles = math.tau / _ROUND_SIDES * (np.arange(_ROUND_SIDES) + 0.5)
    radius = 0.5 * across_flats_m(diameter_m) / float(cosine(math.pi / _ROUND_SIDES))
    ring = np.column_stack((radius * cosine(angles), radius * sine(angles)))
    ends = [np.column_stack((ring, np.full(_ROUND_SIDES, height))) for height in (-0.5 * height_m, 0.5 * height_m)]
    first = np.arange(_ROUND_SIDES)
    second, fan = np.roll(first, -1), first[1:-1]
    sides = [np.column_stack((first, second, second + _ROUND_SIDES))]
    sides += [np.column_stack((first, second + _ROUND_SIDES, first + _ROUND_SIDES))]
    lids = [np.column_stack((np.zeros_like(fan), fan + 1, fan)), np.column_stack((np.zeros_like(fan), fan, fan + 1))]
    triangles = np.concatenate([*sides, lids[0], lids[1] + _ROUND_SIDES])
    return TriangleMesh(np.concatenate(ends) + np.asarray(centre_m, dtype=float), triangles)


def across_flats_m(diameter_m: float) -> float:
    """Return the distance of opposite sides of the prism that stands for a round column: its area is the circle's."""
    half_angle = math.pi / _ROUND_SIDES
    share = math.pi / (_ROUND_SIDES * float(sine(half_angle)) / float(cosine(half_angle)))
    return diameter_m * math.sqrt(share)


def union(solids: Sequence[TriangleMesh]) -> TriangleMesh:
    """Volume inside at least one of the solids, as one solid."""
    if not len(solids):
        raise GeometryError("There are no solids to unite; give at least one.")
    operands = [to_manifold(solid, f"solid {number} of {len(solids)}") for number, solid in enumerate(solids, 1)]
    return from_manifold(Manifold.batch_boolean(operands, OpType.Add))


def difference(solid: TriangleMesh, others: Sequence[TriangleMesh]) -> TriangleMesh:
    """Volume inside the solid and inside none of the others; without faces where there is none."""
    operands = [to_manifold(operand) for operand in (solid, *others)]
    return from_manifold(Manifold.batch_boolean(operands, OpType.Subtract))


def checked_solid(mesh: TriangleMesh, name: str) -> TriangleMesh:
    """The mesh as a closed solid of positive volume that can be cut, turned where all its faces look inwards.

    Error messages begin with the user's name for it. Surfaces that cross themselves within one body pass: the boolean
    engine cannot tell them from sound ones.
    """
    _check_surface(mesh, name)
    if mesh.volume < 0.0:
        mesh = mesh.flipped()
    if mesh.volume <= SMALLEST_VOLUME * mesh.cube_volume:
        raise GeometryError(f"{name}: encloses no volume; give it a thickness.")
    separate = bodies(to_manifold(mesh, name), name=name)
    if any(map(is_film, separate)):
        which = "is" if len(separate) == 1 else "one of its bodies is"
        raise GeometryError(
            f"{name}: {which} thinner than {1e3 * _THINNEST_M:g} mm; give it a thickness, in metres, or delete it."
        )
    _check_bodies(separate, name)
    return mesh


def to_manifold(
    mesh: TriangleMesh, name: str = "The solid", original: int | None = None, face_ids: IntArray | None = None
) -> Manifold:
    """The closed mesh in the boolean engine, in double precision.

    Triangles that stem from this mesh keep the number `original`, reserved in the engine, and their numbers `face_ids`
    (t,). An error message begins with `name`.
    """
    marks = {}
    if original is not None and face_ids is not None:
        marks = {
            "run_index": np.array([0, mesh.triangles.size], dtype=np.uint64),
            "run_original_id": np.array([original], dtype=np.uint32),
            "face_id": face_ids.astype(np.uint64),
        }
    # Mesh64, because the engine's plain Mesh is single precision and loses volumes in the seventh digit.
    vertices = np.array(mesh.vertices, dtype=np.float64, order="C")
    manifold = Manifold(Mesh64(vertices, np.array(mesh.triangles, dtype=np.uint64, order="C"), **marks))
    if manifold.status() != Error.NoError:
        raise GeometryError(
            f"{name}: not a closed solid for the boolean engine ({manifold.status().name}); close its holes and give "
            "every edge exactly two faces."
        )
    return manifold


def from_manifold(*shells: Manifold) -> TriangleMesh:
    """The engine's shells as one mesh."""
    meshes = [shell.to_mesh64() for shell in shells]
    return joined_meshes(
        [TriangleMesh(mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)) for mesh in meshes]
    )


def hull(points: FloatArray) -> Manifold:
    """Convex hull of points (n, 3); without volume where all lie in one plane."""
    return Manifold.hull_points(np.ascontiguousarray(points, dtype=float))


def bodies(manifold: Manifold, smallest_volume: float = 0.0, name: str = "The solid") -> list[list[Manifold]]:
    """The separate bodies of a solid, each as its outer shell followed by the cavities inside it.

    Shells that enclose no more than `smallest_volume`, m³, are left out, unless there is only one.
    """
    shells = manifold.decompose()
    if len(shells) <= 1:
        return [shells] if shells else []
    volumes = np.array([shell.volume() for shell in shells])
    outer = np.flatnonzero(volumes > smallest_volume)
    outer_meshes = [from_manifold(shells[index]) for index in outer]
    separate = [[shells[index]] for index in outer]
    for cavity in np.flatnonzero(volumes < -smallest_volume):
        separate[_enclosing(shells[cavity], outer_meshes, volumes[outer], name)].append(shells[cavity])
    return separate


def is_film(shells: Sequence[Manifold]) -> bool:
    """Whether a body, given as its outer shell and cavities, is nowhere near as thick as anything that is built."""
    volume, area = math.fsum(shell.volume() for shell in shells), math.fsum(shell.surface_area() for shell in shells)
    return bool(2.0 * volume < _THINNEST_M * area)


def contains(mesh: TriangleMesh, points: FloatArray) -> BoolArray:
    """Which points (n, 3) lie inside a closed mesh, by its winding number around each.

    The mesh may be concave, holed and hollow. A point on the surface may count as inside or outside. A. van Oosterom,
    J. Strackee (1983), The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 125-126.
    """
    corners = mesh.corners
    points = np.asarray(points, dtype=float).reshape(-1, 3)
    rows = max(1, _PAIRS_PER_BLOCK // max(1, len(corners)))
    blocks = [_winding_numbers(corners, points[first : first + rows]) for first in range(0, len(points), rows)]
    return np.concatenate(blocks) > 0.5 if blocks else np.zeros(0, dtype=bool)


def check_faces(mesh: TriangleMesh, name: str) -> None:
    """Raise for a mesh without faces, or with vertices that are not finite numbers."""
    if not len(mesh.triangles):
        raise GeometryError(f"{name}: has no faces; give it a closed surface.")
    if not np.isfinite(mesh.vertices).all():
        raise GeometryError(f"{name}: has vertices that are not finite numbers; delete or move them.")


def _check_surface(mesh: TriangleMesh, name: str) -> None:
    check_faces(mesh, name)
    edges = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, edge, faces_of_edge = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    if (faces_of_edge == 1).any():
        raise GeometryError(
            f"{name}: not closed, {int((faces_of_edge == 1).sum())} edges have a face on one side only; fill the holes "
            "and merge doubled vertices."
        )
    if (faces_of_edge % 2 == 1).any():
        raise GeometryError(f"{name}: not closed, some edges have an odd number of faces; delete the inner faces.")
    # Sound where every edge is walked as often one way as the other.
    code = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    if np.bincount(edge.ravel(), weights=code).any():
        raise GeometryError(
            f"{name}: some faces look inwards and some outwards; recalculate the normals to the outside."
        )


def _check_bodies(separate: list[list[Manifold]], name: str) -> None:
    if len(separate) < 2:
        return
    solids = [to_manifold(from_manifold(*shells), name) for shells in separate]
    total = math.fsum(solid.volume() for solid in solids)
    if Manifold.batch_boolean(solids, OpType.Add).volume() < total * (1 - OVERLAP_TOLERANCE):
        raise GeometryError(f"{name}: its {len(solids)} separate bodies overlap; unite them into one first.")


def _enclosing(cavity: Manifold, outer_meshes: list[TriangleMesh], volumes: FloatArray, name: str) -> int:
    """Index of the smallest of the meshes that the cavity lies in."""
    corner = cavity.to_mesh64().vert_properties[:1, :3]
    around = [index for index, mesh in enumerate(outer_meshes) if contains(mesh, corner)[0]]
    if not around:
        raise GeometryError(f"{name}: one of its bodies is inside out; recalculate the normals to the outside.")
    return min(around, key=lambda index: volumes[index])


def _winding_numbers(corners: FloatArray, points: FloatArray) -> FloatArray:
    """Winding numbers (n,) of triangles (t, 3, 3) around points (n, 3): 1 inside, 0 outside."""
    a, b, c = (corners[None, :, index] - points[:, None] for index in range(3))
    length_a, length_b, length_c = length(a), length(b), length(c)
    numerator = dot(a, np.cross(b, c))
    denominator = length_a * length_b * length_c + dot(a, b) * length_c + dot(b, c) * length_a + dot(c, a) * length_b
    return arctangent(numerator, denominator).sum(axis=1) / (2.0 * np.pi)


_NUDGE_M = np.array((1.1e-6, 1.7e-6, 2.3e-6))
"""The line is looked for this far beside where it is: on an edge of triangles it would be on both of its sides."""

_GAP_M = 1e-4
"""Part of the line up to which it may be in no mesh: by that nudge and by rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class Passages:
    """Where a line passes from mesh to mesh, k times. `gap_m` is how far along it first leaves all of them, or None."""

    first: IntArray  # (k,), meshes that it leaves
    second: IntArray  # (k,), meshes that it enters
    distances_m: FloatArray  # (k,), along the line from its start
    points_m: FloatArray  # (k, 3)
    directions: FloatArray  # (k, 3), of the line there, of length 1
    gap_m: float | None


def passages(path_m: FloatArray, meshes: Sequence[TriangleMesh]) -> Passages:
    """Return where a line through points (p, 3) passes from mesh to mesh."""
    lengths = distance(path_m[1:], path_m[:-1])
    ends = np.concatenate((np.zeros(1), np.cumsum(lengths)))
    stays = sorted(stay for number, mesh in enumerate(meshes) for stay in _stays(path_m, ends, mesh, number))
    first, second, at, gap_m = [], [], [], None
    reached, before = 0.0, -1
    for begin, end, number in stays:
        if begin > reached + _GAP_M:
            break
        if before >= 0 and number != before:
            first.append(before)
            second.append(number)
            at.append(begin)
        reached, before = max(reached, end), number
    if reached < ends[-1] - _GAP_M:
        gap_m = float(reached)
    distances = np.array(at, float)
    segments = np.clip(np.searchsorted(ends, distances, "right") - 1, 0, len(lengths) - 1)
    along = (path_m[segments + 1] - path_m[segments]) / lengths[segments][:, None]
    points = path_m[segments] + (distances - ends[segments])[:, None] * along
    return Passages(np.array(first, int), np.array(second, int), distances, points, along, gap_m)


def _stays(path_m: FloatArray, ends: FloatArray, mesh: TriangleMesh, number: int) -> list[tuple[float, float, int]]:
    """Return from where to where along the line it is in a mesh, with the number of the mesh."""
    lowest, highest = mesh.bounds
    corners = mesh.corners
    begins: list[float] = []
    leaves: list[float] = []
    for start, stop, begin, end in zip(path_m[:-1], path_m[1:], ends[:-1], ends[1:], strict=True):
        low, high = np.minimum(start, stop), np.maximum(start, stop)
        if (low > highest + _GAP_M).any() or (high < lowest - _GAP_M).any():
            continue
        shares, outwards = _pierced(start + _NUDGE_M, stop - start, corners)
        at = begin + shares * (end - begin)
        begins += at[~outwards].tolist()
        leaves += at[outwards].tolist()
    if not begins and not leaves:
        return []
    begins, leaves = sorted(begins), sorted(leaves)
    if leaves and (not begins or leaves[0] < begins[0]):
        begins.insert(0, 0.0)
    if begins and (not leaves or leaves[-1] < begins[-1]):
        leaves.append(float(ends[-1]))
    return [(begin, end, number) for begin, end in zip(begins, leaves, strict=False)]


def _pierced(start: FloatArray, way: FloatArray, corners: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return where on its way (3,) from a point (3,) a line pierces triangles (t, 3, 3), and whether outwards.

    T. Möller and B. Trumbore (1997), Fast, minimum storage ray/triangle intersection, Journal of Graphics Tools 2 (1).
    """
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = cross(np.broadcast_to(way, other.shape), other)
    whole = dot(one, across)
    safe = np.where(whole == 0.0, 1.0, whole)
    away = start - corners[:, 0]
    first = dot(away, across) / safe
    beside = cross(away, one)
    second = dot(np.broadcast_to(way, beside.shape), beside) / safe
    share = dot(other, beside) / safe
    met = (whole != 0.0) & (first >= 0.0) & (second >= 0.0) & (first + second <= 1.0) & (share >= 0.0) & (share < 1.0)
    outwards: BoolArray = whole[met] < 0.0
    return share[met], outwards
