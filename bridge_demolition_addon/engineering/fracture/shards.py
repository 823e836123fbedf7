"""Voronoi fracture of a solid into shards, with the faces the shards share.

The Voronoi cells of points in the solid are worked out for all points together (`voronoi`); the boolean engine then
cuts each out of the solid. In a concave or holed solid a cell can be in several pieces. The piece that holds the cell's
own point is the shard; every other piece goes to the neighbour it shares most area with, the largest common area first,
and is sewn on (`seams`). So there are exactly as many shards as points, each is connected, and nothing is lost.
Counting every piece as a shard of its own would give another number of shards, and slivers.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from manifold3d import Manifold

from ...errors import GeometryError
from ..arithmetic import cube_root, power
from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.mesh import TriangleMesh, joined_meshes, triangle_areas_and_normals, volumes_and_centres
from ..geometry.proximity import ranges
from ..geometry.repair import sewn
from ..geometry.solids import bodies, contains, from_manifold, to_manifold
from .options import PLAIN, FractureOptions, Recursion, through_thickness
from .seeds import moved_points, random_points
from .shared_faces import NO_FACES, SharedFaces, joined_faces, overlaps, shared_faces, touching_faces
from .voronoi import convex_cells

VOLUME_TOLERANCE = 1e-9
"""Part of the solid's volume by which the sum of the shards may differ from it."""

SMALLEST_FACE = 1e-10
"""Part of a mean shard's cross-section, (volume / shards)^(2/3), that a common face must exceed to be counted."""

SMALLEST_PIECE = 1e-14
"""Part of the solid's volume below which a loose piece of a cell is rounding and is dropped."""

RIM_TOLERANCE = 1e-9
"""Part of the solid's longest extent within which corners of two pieces are the same corner, cut twice."""

_EVEN = (1.0, 1.0, 1.0)

_BOX_MARGIN = 1e-3
"""The box around the cells is larger than the solid by this part of its longest extent: its sides must cut nothing."""

_SAME_CUT_M = 1e-7
"""Largest distance of the two sides of one cut: only rounding is between them."""


@dataclass(frozen=True, eq=False, slots=True)
class Fracture:
    """A solid in shards; row i of every array is shard i."""

    shards: tuple[TriangleMesh, ...]  # closed and connected
    volumes: FloatArray  # (n,), m³, all positive
    centres: FloatArray  # (n, 3), centres of mass for uniform density, m
    points: FloatArray  # (n, 3), the points whose Voronoi cells the shards are, m
    faces: SharedFaces  # where the shards were cut apart

    def __len__(self) -> int:
        return len(self.shards)


@dataclass(frozen=True, eq=False, slots=True)
class _Piece:
    """A connected part of a cell within the solid; each triangle is `facing` (t,) another cell, or -1, the outside."""

    cell: int
    mesh: TriangleMesh
    facing: BoolArray


@dataclass(frozen=True, eq=False, slots=True)
class _Triangles:
    """All triangles of some pieces: the piece and cell each is of and the cell it faces (t,), its corners (t, 3, 3),
    its area (t,) and normal (t, 3)."""

    piece: IntArray
    cell: IntArray
    facing: IntArray
    corners: FloatArray
    areas: FloatArray
    normals: FloatArray

    @classmethod
    def of(cls, pieces: Sequence[_Piece]) -> "_Triangles":
        owner = np.repeat(np.arange(len(pieces)), [len(piece.facing) for piece in pieces])
        cell = np.array([piece.cell for piece in pieces])[owner]
        facing = np.concatenate([piece.facing for piece in pieces])
        corners = np.concatenate([piece.mesh.corners for piece in pieces])
        return cls(owner, cell, facing, corners, *triangle_areas_and_normals(corners))


def fracture(solid: TriangleMesh, shard_count: int, seed: int = 0, options: FractureOptions = PLAIN) -> Fracture:
    """Return a closed solid in exactly `shard_count` shards, around points sampled from its volume.

    The points are spread evenly unless `options` say else; with recursion there are more shards, as some are cut again.
    Each separate body of the solid takes at least one. The same seed gives the same shards, bit for bit.

    Examples
    --------
    >>> from bridge_demolition_addon.engineering.geometry.solids import box
    >>> deck = fracture(box([30.0, 12.0, 1.0]), 200, seed=1)
    >>> len(deck), round(float(deck.volumes.sum()), 9)
    (200, 360.0)
    """
    generator = np.random.default_rng(seed)
    points = random_points(solid, shard_count, generator, options.density)
    return _fracture_around(solid, points, generator, options)


def voronoi_cells(solid: TriangleMesh, points: FloatArray, seed: int = 0, options: FractureOptions = PLAIN) -> Fracture:
    """Return a closed solid in one shard per point (n, 3): its part nearest to that point.

    Points lie inside the solid, at least one in each of its separate bodies, no two alike. Of the `options`, the
    density does not count, as the points are chosen already.
    """
    points = np.array(points, dtype=float).reshape(-1, 3)
    if not len(points):
        raise GeometryError("A solid cannot be cut into no shards; give at least one point.")
    outside = np.flatnonzero(~contains(solid, points))
    if len(outside):
        raise GeometryError(f"{len(outside)} of {len(points)} points lie outside the solid, the first is {outside[0]}.")
    return _fracture_around(solid, points, np.random.default_rng(seed), options)


def joined_fractures(parts: Sequence[Fracture]) -> Fracture:
    """Fractures of solids that touch as one, with the faces that shards of two of them have in common."""
    counts = [len(part) for part in parts]
    starts = np.cumsum(counts) - counts
    shards = tuple(shard for part in parts for shard in part.shards)
    within = [replace(part.faces, pairs=part.faces.pairs + start) for part, start in zip(parts, starts, strict=True)]
    between = touching_faces(shards, _SAME_CUT_M, member=np.repeat(np.arange(len(parts)), counts))
    return Fracture(
        shards=shards,
        volumes=np.concatenate([part.volumes for part in parts]),
        centres=np.concatenate([part.centres for part in parts]),
        points=np.concatenate([part.points for part in parts]),
        faces=joined_faces([*within, between]),
    )


def _fracture_around(
    solid: TriangleMesh, points: FloatArray, generator: np.random.Generator, options: FractureOptions
) -> Fracture:
    stretch = _stretch(solid, options)
    if options.noise > 0.0:
        points = moved_points(solid, points, options.noise * float(cube_root(solid.volume / len(points))), generator)
    result = _fractured(solid, points, stretch)
    return _with_recursion(result, generator, options, options.recursion, stretch) if options.recursion else result


def _stretch(solid: TriangleMesh, options: FractureOptions) -> FloatArray | None:
    given = options.stretch or (through_thickness(solid) if options.through_plates else None)
    return None if given is None or given == _EVEN else np.array(given, dtype=float)


def _with_recursion(
    first: Fracture,
    generator: np.random.Generator,
    options: FractureOptions,
    recursion: Recursion,
    stretch: FloatArray | None,
) -> Fracture:
    """A fracture with some shards cut again; faces between their shards are where these touch."""
    large = np.flatnonzero(first.volumes >= recursion.smallest_m3)
    chosen = set(generator.permutation(large)[: round(recursion.share * len(large))].tolist())
    if not chosen or recursion.shards < 2:
        return first
    parts = []
    for index, shard in enumerate(first.shards):
        if index in chosen:
            parts.append(_fractured(shard, random_points(shard, recursion.shards, generator, options.density), stretch))
        else:
            one = slice(index, index + 1)
            parts.append(Fracture((shard,), first.volumes[one], first.centres[one], first.points[one], NO_FACES))
    return joined_fractures(parts)


def _fractured(solid: TriangleMesh, points: FloatArray, stretch: FloatArray | None = None) -> Fracture:
    pieces = _pieces(solid, points, stretch)
    faces = _faces_between(pieces, len(points))
    shard_of_piece = _joined_to_neighbours(pieces, points, faces)
    shards = tuple(_sewn(parts, solid) for parts in _grouped(pieces, shard_of_piece, len(points)))
    volumes, centres = volumes_and_centres(shards)
    volume = solid.volume
    if abs(volumes.sum() - volume) > VOLUME_TOLERANCE * volume:
        raise GeometryError(
            f"The {len(shards)} shards hold {volumes.sum():.12g} m³ of the solid's {volume:.12g} m³; faces of it lie "
            "on each other somewhere, or are too fine to be cut so often: mend them, or ask for fewer shards."
        )
    smallest = SMALLEST_FACE * float(power(volume / len(points), 2 / 3))
    between_shards = shared_faces(shard_of_piece[faces.pairs], faces.areas, faces.centres, faces.normals, smallest)
    return Fracture(shards, volumes, centres, points, between_shards)


def _pieces(solid: TriangleMesh, points: FloatArray, stretch: FloatArray | None) -> list[_Piece]:
    """The connected parts of every cell within the solid, cell by cell.

    Stretched cells come from a space that is squeezed by as much, in which all directions count the same.
    """
    lower, upper = solid.bounds
    if stretch is not None:
        points, lower, upper = points / stretch, lower / stretch, upper / stretch
    margin = _BOX_MARGIN * np.max(upper - lower)
    whole = to_manifold(solid)
    cut = Manifold.reserve_ids(1)
    smallest = SMALLEST_PIECE * solid.volume
    pieces = []
    for index, cell in enumerate(convex_cells(points, lower - margin, upper + margin)):
        if stretch is not None:
            cell = replace(cell, mesh=replace(cell.mesh, vertices=cell.mesh.vertices * stretch))
        # In the solid its triangles are known by the number `cut`, and by their neighbours.
        convex = to_manifold(cell.mesh, "A Voronoi cell", cut, cell.neighbours)
        parts = bodies(convex ^ whole, smallest_volume=smallest)
        pieces += [
            _Piece(index, from_manifold(*shells), np.concatenate([_facing(shell, cut) for shell in shells]))
            for shells in parts
        ]
    return pieces


def _facing(shell: Manifold, cut: int) -> FloatArray:
    """The point (t,) beyond each triangle that the original `cut` made, -1 on the solid's own surface."""
    mesh = shell.to_mesh64()
    triangles_of_run = np.diff(np.asarray(mesh.run_index, dtype=np.int64)) // 3
    is_cut = np.repeat(np.asarray(mesh.run_original_id) == cut, triangles_of_run)
    return np.where(is_cut, np.asarray(mesh.face_id, dtype=np.int64), -1)


def _faces_between(pieces: Sequence[_Piece], cell_count: int) -> SharedFaces:
    """Common faces of the pieces; the pairs are indices of pieces."""
    triangles = _Triangles.of(pieces)
    cell = np.array([piece.cell for piece in pieces])
    whole = np.bincount(cell, minlength=cell_count) == 1
    one_to_one = whole[triangles.cell] & whole[triangles.facing]
    # Between two cells of one piece each, all that faces the other is common; else the two sides are laid over another.
    simple = np.flatnonzero(one_to_one & (triangles.facing > triangles.cell))
    opposite = np.searchsorted(cell, triangles.facing[simple])
    first, second, common, centres = _laid_over(triangles, np.flatnonzero(~one_to_one))
    return shared_faces(
        np.column_stack(
            [
                np.concatenate([triangles.piece[simple], triangles.piece[first]]),
                np.concatenate([opposite, triangles.piece[second]]),
            ]
        ),
        np.concatenate([triangles.areas[simple], common]),
        np.concatenate([triangles.corners[simple].mean(axis=1), centres]),
        triangles.normals[np.concatenate([simple, first])],
    )


def _laid_over(triangles: _Triangles, candidates: IntArray) -> tuple[IntArray, IntArray, FloatArray, FloatArray]:
    """Pairs of candidates on the two sides of one cut, and areas and centres of what they have in common."""
    candidates = candidates[triangles.areas[candidates] > 0]
    near = candidates[triangles.facing[candidates] > triangles.cell[candidates]]
    far = candidates[(triangles.facing[candidates] >= 0) & (triangles.facing[candidates] < triangles.cell[candidates])]
    columns = int(triangles.cell.max(initial=0) + triangles.facing.max(initial=0)) + 1
    row, position = _matching(
        triangles.cell[near] * columns + triangles.facing[near], triangles.facing[far] * columns + triangles.cell[far]
    )
    first, second = near[row], far[position]
    return first, second, *overlaps(triangles.corners[first], triangles.corners[second])


def _matching(keys: IntArray, others: IntArray) -> tuple[IntArray, IntArray]:
    """Indices into both for each pair of equal keys."""
    order = np.argsort(others, kind="stable")
    starts = np.searchsorted(others[order], keys, side="left")
    ends = np.searchsorted(others[order], keys, side="right")
    row, position = ranges(starts, ends - starts)
    return row, order[position]


def _joined_to_neighbours(pieces: Sequence[_Piece], points: FloatArray, faces: SharedFaces) -> IntArray:
    """The shard (p,) that each piece belongs to."""
    shard_of_piece = np.full(len(pieces), -1)
    cell = np.array([piece.cell for piece in pieces])
    alone = np.bincount(cell, minlength=len(points))[cell] == 1
    for index, piece in enumerate(pieces):
        if alone[index] or contains(piece.mesh, points[piece.cell])[0]:
            shard_of_piece[index] = piece.cell
    first, second = faces.pairs.T
    while (shard_of_piece < 0).any():
        one_sided = (shard_of_piece[first] < 0) != (shard_of_piece[second] < 0)
        if not one_sided.any():
            raise GeometryError("A separate body of the solid holds none of the points; give each body one.")
        row = int(np.argmax(np.where(one_sided, faces.areas, -1.0)))
        shard = max(shard_of_piece[first[row]], shard_of_piece[second[row]])
        shard_of_piece[[first[row], second[row]]] = shard
    empty = np.setdiff1d(np.arange(len(points)), shard_of_piece)
    if len(empty):
        raise GeometryError(
            f"Nothing is left of the cell of point {empty[0]}; it lies on the surface or on another point."
        )
    return shard_of_piece


def _grouped(pieces: Sequence[_Piece], shard_of_piece: IntArray, count: int) -> list[list[_Piece]]:
    members: list[list[_Piece]] = [[] for _ in range(count)]
    for piece, shard in zip(pieces, shard_of_piece, strict=True):
        members[shard].append(piece)
    return members


def _sewn(pieces: Sequence[_Piece], solid: TriangleMesh) -> TriangleMesh:
    """Pieces that touch, as one shard."""
    if len(pieces) == 1:
        return pieces[0].mesh
    all_triangles = _Triangles.of(pieces)
    first, second, common, _ = _laid_over(all_triangles, np.arange(len(all_triangles.areas)))
    covered = np.bincount(np.concatenate([first, second]), np.tile(common, 2), minlength=len(all_triangles.areas))
    # Between two pieces a triangle is covered wholly or not at all; half is only the mark furthest from rounding.
    patch = covered > all_triangles.areas / 2
    whole = sewn(joined_meshes([piece.mesh for piece in pieces]), patch, RIM_TOLERANCE * solid.longest_extent)
    shards = bodies(to_manifold(whole, "A shard sewn from pieces"), smallest_volume=SMALLEST_PIECE * solid.volume)
    if len(shards) != 1:
        raise GeometryError("The pieces of a shard could not be joined; try another seed or number of shards.")
    return from_manifold(*shards[0])
