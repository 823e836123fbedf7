"""Voronoi fracture of a solid into shards, with the faces the shards share.

The Voronoi cells of points in the solid are worked out for all points together (`core.voronoi`); the boolean engine then
cuts each out of the solid. In a concave or holed solid a cell can come out in several pieces. The piece that holds the
cell's own point is the shard; every other piece goes to the neighbour it shares most area with, the largest common area
first. So there are exactly as many shards as points, each is connected, and nothing is lost. (Counting every piece as a
shard of its own would not give the number asked for, and would leave slivers that no longer hang on anything.)
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import Error, Manifold, Mesh64, OpType
from trimesh import Trimesh

from .errors import GeometryError
from .shared_faces import SharedFaces, overlaps, ranges, shared_faces, touching_faces, triangle_areas_and_normals
from .solids import bodies, contains, from_manifold, to_manifold, volumes_and_centres
from .voronoi import ConvexCell, convex_cells

__all__ = ["Fracture", "Shard", "SharedFaces", "fracture", "random_points", "touching_faces", "voronoi_cells"]

VOLUME_TOLERANCE = 1e-9
"""Part of the solid's volume by which the sum of the shards may differ from it."""

SMALLEST_FACE = 1e-10
"""Part of a mean shard's cross-section, (volume / shards)^(2/3), that a common face must exceed to be counted."""

SMALLEST_PIECE = 1e-14
"""Part of the solid's volume below which a loose piece of a cell is rounding and is dropped."""

_BOX_MARGIN = 1e-3
"""The box that bounds the cells is larger than the solid by this part of its longest edge, so that its sides cut nothing."""


@dataclass(frozen=True, eq=False, slots=True)
class Shard:
    """A closed mesh: `vertices` (v, 3) float64 in m, `triangles` (t, 3) int32, counter-clockwise seen from outside."""

    vertices: np.ndarray
    triangles: np.ndarray


@dataclass(frozen=True, eq=False, slots=True)
class Fracture:
    """A solid in shards; row i of every array is shard i.

    Attributes
    ----------
    shards : n Shard
        Closed and connected.
    volumes : (n,) float
        In m³, all positive.
    centres : (n, 3) float
        Centres of mass for uniform density, in m.
    points : (n, 3) float
        The points whose Voronoi cells the shards are, in m.
    faces : SharedFaces
        Where the shards were cut apart.
    """

    shards: tuple[Shard, ...]
    volumes: np.ndarray
    centres: np.ndarray
    points: np.ndarray
    faces: SharedFaces

    def __len__(self) -> int:
        return len(self.shards)


@dataclass(frozen=True, eq=False, slots=True)
class _Piece:
    """A connected part of a cell within the solid; `facing` (t,) is the point beyond each triangle, -1 at the surface."""

    cell: int
    body: Manifold
    shard: Shard
    facing: np.ndarray


def fracture(solid: Trimesh, shard_count: int, seed: int = 0) -> Fracture:
    """The solid in exactly `shard_count` shards, around points drawn uniformly from its volume.

    Parameters
    ----------
    solid : Trimesh
        Closed, as `core.solids.checked_solid` returns it; convex or not, with holes or cavities.
    shard_count : int
        How many shards. Each separate body of the solid takes at least one.
    seed : int
        The same seed gives the same shards, bit for bit.

    Raises
    ------
    GeometryError
        When fewer shards are asked for than the solid has bodies, or none, or when the solid cannot be cut.

    Examples
    --------
    >>> from bridge_demolition_addon.core.solids import box
    >>> deck = fracture(box([30.0, 12.0, 1.0]), 200, seed=1)
    >>> len(deck), round(deck.volumes.sum(), 9)
    (200, 360.0)
    """
    return _fractured(solid, random_points(solid, shard_count, np.random.default_rng(seed)))


def voronoi_cells(solid: Trimesh, points: np.ndarray) -> Fracture:
    """The solid in one shard per point: its part nearest to that point.

    Parameters
    ----------
    solid : Trimesh
        Closed, as `core.solids.checked_solid` returns it; convex or not, with holes or cavities.
    points : (n, 3) float
        Inside the solid, at least one in each of its separate bodies, no two alike.

    Raises
    ------
    GeometryError
        When there are no points, when one lies outside or two coincide, when a body has none, or when the solid cannot be
        cut.
    """
    points = np.array(points, dtype=float).reshape(-1, 3)
    if not len(points):
        raise GeometryError("A solid cannot be cut into no shards; give at least one point.")
    outside = np.flatnonzero(~contains(solid, points))
    if len(outside):
        raise GeometryError(f"{len(outside)} of {len(points)} points lie outside the solid, the first is {outside[0]}.")
    return _fractured(solid, points)


def random_points(solid: Trimesh, count: int, generator: np.random.Generator) -> np.ndarray:
    """Points (count, 3) drawn uniformly from the volume; of several bodies each gets one before the rest is drawn.

    Raises
    ------
    GeometryError
        When there are fewer points than bodies.
    """
    if count < 1:
        raise GeometryError(f"A solid cannot be cut into {count} shards; ask for at least one.")
    separate = bodies(to_manifold(solid))
    if count < len(separate):
        raise GeometryError(
            f"The solid consists of {len(separate)} separate bodies and cannot be cut into {count} shards; ask for at "
            f"least {len(separate)} or unite the bodies."
        )
    firsts = [_uniform(from_manifold(body), 1, generator) for body in separate] if len(separate) > 1 else []
    return np.concatenate([*firsts, _uniform(solid, count - len(firsts), generator)])


def _uniform(solid: Trimesh, count: int, generator: np.random.Generator) -> np.ndarray:
    lower, upper = _extent(solid)
    filled = _volume(solid) / np.prod(upper - lower)
    points = np.zeros((0, 3))
    while len(points) < count:
        tries = int((count - len(points)) / filled * 1.1) + 8
        candidates = lower + generator.random((tries, 3)) * (upper - lower)
        points = np.concatenate([points, candidates[contains(solid, candidates)]])
    return points[:count]


def _fractured(solid: Trimesh, points: np.ndarray) -> Fracture:
    pieces = _pieces(solid, points)
    faces = _faces_between(pieces, len(points))
    shard_of_piece = _joined_to_neighbours(pieces, points, faces)
    shards = _shards(pieces, shard_of_piece, len(points))
    volumes, centres = volumes_and_centres([s.vertices for s in shards], [s.triangles for s in shards])
    volume = _volume(solid)
    if abs(volumes.sum() - volume) > VOLUME_TOLERANCE * volume:
        raise GeometryError(
            f"The {len(shards)} shards hold {volumes.sum():.12g} m³ of the solid's {volume:.12g} m³; it crosses itself or is "
            "too fine to be cut so often."
        )
    smallest = SMALLEST_FACE * (volume / len(points)) ** (2 / 3)
    between_shards = shared_faces(shard_of_piece[faces.pairs], faces.areas, faces.centres, faces.normals, smallest)
    return Fracture(shards, volumes, centres, points, between_shards)


def _pieces(solid: Trimesh, points: np.ndarray) -> list[_Piece]:
    """The connected parts of every cell within the solid, cell by cell."""
    lower, upper = _extent(solid)
    margin = _BOX_MARGIN * np.max(upper - lower)
    whole = to_manifold(solid)
    cut = Manifold.reserve_ids(1)
    crumb = SMALLEST_PIECE * _volume(solid)
    pieces = []
    for index, cell in enumerate(convex_cells(points, lower - margin, upper + margin)):
        parts = bodies(_manifold_of(cell, cut) ^ whole)
        pieces += [_piece(index, part, cut) for part in parts if len(parts) == 1 or part.volume() > crumb]
    return pieces


def _manifold_of(cell: ConvexCell, cut: int) -> Manifold:
    """The cell in the boolean engine, its triangles marked as the original `cut` and numbered by neighbour."""
    manifold = Manifold(
        Mesh64(
            np.ascontiguousarray(cell.vertices),
            cell.triangles.astype(np.uint64),
            run_index=np.array([0, cell.triangles.size], dtype=np.uint64),
            run_original_id=np.array([cut], dtype=np.uint32),
            face_id=cell.neighbours.astype(np.uint64),
        )
    )
    if manifold.status() != Error.NoError:
        raise GeometryError(f"A Voronoi cell is not closed ({manifold.status().name}); its points lie too close together.")
    return manifold


def _piece(cell: int, body: Manifold, cut: int) -> _Piece:
    mesh = body.to_mesh64()
    runs = np.diff(np.asarray(mesh.run_index, dtype=np.int64)) // 3
    is_cut = np.repeat(np.asarray(mesh.run_original_id) == cut, runs)
    facing = np.where(is_cut, np.asarray(mesh.face_id, dtype=np.int64), -1)
    return _Piece(cell, body, _shard(body), facing)


def _shard(body: Manifold) -> Shard:
    mesh = body.to_mesh64()
    return Shard(mesh.vert_properties[:, :3].copy(), mesh.tri_verts.astype(np.int32))


def _faces_between(pieces: Sequence[_Piece], cell_count: int) -> SharedFaces:
    """Common faces of the pieces; the pairs are indices of pieces."""
    cell = np.array([piece.cell for piece in pieces])
    owner = np.repeat(np.arange(len(pieces)), [len(piece.facing) for piece in pieces])
    facing = np.concatenate([piece.facing for piece in pieces])
    corners = np.concatenate([piece.shard.vertices[piece.shard.triangles] for piece in pieces])
    areas, normals = triangle_areas_and_normals(corners)

    whole = np.bincount(cell, minlength=cell_count) == 1
    one_to_one = whole[cell[owner]] & whole[facing]
    near = np.flatnonzero((facing > cell[owner]) & (areas > 0))
    simple, tangled = near[one_to_one[near]], near[~one_to_one[near]]
    # Between two cells in one piece each, everything that faces the other is common; else the two sides are laid over
    # each other.
    far = np.flatnonzero((facing >= 0) & (facing < cell[owner]) & (areas > 0) & ~one_to_one)
    row, position = _matching(
        cell[owner[tangled]] * cell_count + facing[tangled], facing[far] * cell_count + cell[owner[far]]
    )
    first, second = tangled[row], far[position]
    common, common_centres = overlaps(corners[first], corners[second])
    index_of_cell = np.searchsorted(cell, np.arange(cell_count))
    return shared_faces(
        np.concatenate(
            [
                np.column_stack([owner[simple], index_of_cell[facing[simple]]]),
                np.column_stack([owner[first], owner[second]]),
            ]
        ),
        np.concatenate([areas[simple], common]),
        np.concatenate([corners[simple].mean(axis=1), common_centres]),
        np.concatenate([normals[simple], normals[first]]),
    )


def _matching(keys: np.ndarray, others: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Indices into both of all pairs of equal keys."""
    order = np.argsort(others, kind="stable")
    starts = np.searchsorted(others[order], keys, side="left")
    ends = np.searchsorted(others[order], keys, side="right")
    row, position = ranges(starts, ends - starts)
    return row, order[position]


def _joined_to_neighbours(pieces: Sequence[_Piece], points: np.ndarray, faces: SharedFaces) -> np.ndarray:
    """The shard (p,) that each piece belongs to."""
    shard_of_piece = np.full(len(pieces), -1)
    cell = np.array([piece.cell for piece in pieces])
    alone = np.bincount(cell, minlength=len(points))[cell] == 1
    for index, piece in enumerate(pieces):
        if alone[index] or contains(from_manifold(piece.body), points[piece.cell])[0]:
            shard_of_piece[index] = piece.cell
    first, second = faces.pairs.T
    while (shard_of_piece < 0).any():
        one_sided = (shard_of_piece[first] < 0) != (shard_of_piece[second] < 0)
        if not one_sided.any():
            raise GeometryError("A separate body of the solid holds none of the points; give each body one.")
        row = int(np.argmax(np.where(one_sided, faces.areas, -1.0)))
        shard = max(shard_of_piece[first[row]], shard_of_piece[second[row]])
        shard_of_piece[[first[row], second[row]]] = shard
    return shard_of_piece


def _shards(pieces: Sequence[_Piece], shard_of_piece: np.ndarray, count: int) -> tuple[Shard, ...]:
    members: list[list[_Piece]] = [[] for _ in range(count)]
    for piece, shard in zip(pieces, shard_of_piece, strict=True):
        members[shard].append(piece)
    return tuple(_united(parts) for parts in members)


def _united(parts: Sequence[_Piece]) -> Shard:
    if len(parts) == 1:
        return parts[0].shard
    whole = Manifold.batch_boolean([part.body for part in parts], OpType.Add)
    return _shard(whole)


def _extent(solid: Trimesh) -> tuple[np.ndarray, np.ndarray]:
    vertices = np.asarray(solid.vertices, dtype=float)
    return vertices.min(axis=0), vertices.max(axis=0)


def _volume(solid: Trimesh) -> float:
    return float(volumes_and_centres([np.asarray(solid.vertices)], [np.asarray(solid.faces)])[0][0])
