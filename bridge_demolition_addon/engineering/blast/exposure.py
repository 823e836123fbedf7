"""Exposure of bodies to charges: stand-offs, projected areas, and the share of each body that a charge sees.

Areas change as the bodies turn. For the shares, rays go from every charge to every body: to its centre of mass, and to
the points half-way from there to the vertices of its hull. The convex hull of another body stops a ray that passes
through it; the other rays make the visible share. A wave also bends round edges, which is not modelled: behind anything
narrow the load is more than this share. A body that contains the charge stops nothing: the charge breaks it.
"""

from itertools import pairwise

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct, WrittenDoubles
from ..geometry.hulls import ConvexHulls
from ..geometry.proximity import ranges
from ..geometry.vectors import dot, length, transformed, transformed_back

UPWARDS = np.array([0.0, 0.0, 1.0])
"""Direction in which a charge in the very centre of a body pushes it: away from the ground, as none other is marked."""

GRAZING_M = 1e-3
"""Hulls stop rays this much inside their faces, so that none is stopped between bodies that touch, or by rounding."""

_HALF_WAY = 0.5
"""End of rays between centre and vertices: well inside the body, so that no body that touches it hides it."""

PAIRS_AT_ONCE = 1_000_000
"""Ray-and-body or ray-and-face pairs in one array operation: some tens of megabytes."""


class ShownAreas(Struct):
    """Hulls, and directions from charges: `bda_shown_areas`."""

    _fields_ = (
        *((name, Count) for name in ("bodies", "charges", "faces", "most_faces")),
        ("face_vectors", Doubles),
        ("starts", Indices),
        ("rotations", Doubles),
        ("directions", Doubles),
        ("shown", WrittenDoubles),
        ("areas", WrittenDoubles),
    )


def lines_of_blast(sources: FloatArray, centres: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return stand-offs (n, c) and unit vectors (n, c, 3) from sources (c, 3) to bodies' centres of mass (n, 3).

    The direction is `UPWARDS` where a source is in the very centre of a body.
    """
    differences = centres[:, None] - sources[None]
    stand_offs = length(differences)
    apart = stand_offs[..., None] > 0.0
    directions = np.divide(
        differences, stand_offs[..., None], out=np.broadcast_to(UPWARDS, differences.shape).copy(), where=apart
    )
    return stand_offs, directions


def projected_areas(hulls: ConvexHulls, rotations: FloatArray, directions: FloatArray) -> FloatArray:
    """Return the bodies' areas (n, c), m², projected along directions (n, c, 3): ½ Σ |n̂ · n̂ᵢ| Sᵢ over the faces.

    That is the report's equation 6. Rotations (n, 3, 3) turn body axes into world axes.
    """
    (bodies, charges), faces, most = directions.shape[:2], hulls.face_vectors.shape[1], hulls.most_faces
    areas = np.empty((bodies, charges))
    shown = ShownAreas(bodies=bodies, charges=charges, faces=faces, most_faces=most).take(
        face_vectors=(hulls.face_vectors, 3 * faces),
        starts=(hulls.starts, bodies + 1),
        rotations=(rotations, 9 * bodies),
        directions=(directions, 3 * bodies * charges),
        shown=(np.empty(most), most),
        areas=(areas, bodies * charges),
    )
    call("bda_project", shown)
    return areas


def visible_shares(hulls: ConvexHulls, centres: FloatArray, rotations: FloatArray, sources: FloatArray) -> FloatArray:
    """Return the shares (n, c) of the bodies that charges at `sources` (c, 3) see: from 0, hidden, to 1, free.

    Rotations (n, 3, 3) turn body axes into world axes, `centres` (n, 3) are centres of mass.
    """
    owners, targets = _targets(hulls, centres, rotations)
    counts = np.bincount(owners, minlength=len(hulls))
    shares = np.zeros((len(hulls), len(sources)))
    for column, source in enumerate(sources):
        shields = ~_containing(hulls, centres, rotations, source)
        stopped = np.zeros(len(targets), bool)
        for first, last in _blocks(np.full(len(targets), len(hulls))):
            rays, bodies = _near_misses(hulls, centres, source, targets[first:last])
            rays += first
            others = (owners[rays] != bodies) & shields[bodies]
            rays, bodies = rays[others], bodies[others]
            passing = _pass_through(hulls, centres, rotations, source, targets[rays], bodies)
            stopped[rays[passing]] = True
        shares[:, column] = np.bincount(owners, ~stopped, len(hulls)) / counts
    return shares


def _targets(hulls: ConvexHulls, centres: FloatArray, rotations: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return bodies (t,) and positions (t, 3) that rays go to."""
    bodies = np.arange(len(hulls))
    owners = np.repeat(bodies, np.diff(hulls.vertex_starts))
    half_way = centres[owners] + _HALF_WAY * transformed(rotations[owners], hulls.vertices)
    return np.concatenate((bodies, owners)), np.concatenate((centres, half_way))


def _containing(hulls: ConvexHulls, centres: FloatArray, rotations: FloatArray, source: FloatArray) -> BoolArray:
    """Return which bodies (n,) contain a charge."""
    if not len(hulls):
        return np.zeros(0, bool)
    local = transformed_back(rotations, source - centres)
    outside_by = dot(hulls.normals, local[hulls.bodies]) - hulls.offsets
    return np.maximum.reduceat(outside_by, hulls.starts[:-1]) <= 0.0


def _near_misses(
    hulls: ConvexHulls, centres: FloatArray, source: FloatArray, targets: FloatArray
) -> tuple[IntArray, IntArray]:
    """Return rows of targets (t, 3), and the bodies whose bounding spheres the rays to them touch."""
    rays, others = targets - source, centres - source
    along, squares = dot(rays[:, None], others), dot(rays, rays)[:, None]
    nearest = np.clip(np.divide(along, squares, out=np.zeros(along.shape), where=squares > 0.0), 0.0, 1.0)
    distances = dot(others, others) - nearest * (2.0 * along - nearest * squares)
    rows, bodies = np.nonzero(distances < np.square(hulls.radii))
    return rows, bodies


def _pass_through(
    hulls: ConvexHulls,
    centres: FloatArray,
    rotations: FloatArray,
    source: FloatArray,
    targets: FloatArray,
    bodies: IntArray,
) -> BoolArray:
    """Return whether rays to targets (k, 3) pass through the bodies (k,) that they are paired with."""
    rays = transformed_back(rotations[bodies], targets - source)
    origins = transformed_back(rotations[bodies], source - centres[bodies])
    counts = np.diff(hulls.starts)[bodies]
    passing = np.zeros(len(bodies), bool)
    for first, last in _blocks(counts):
        rows, faces = ranges(hulls.starts[bodies[first:last]], counts[first:last])
        passing[first:last] = _cross(hulls, rows, faces, origins[first:last], rays[first:last])
    return passing


def _cross(hulls: ConvexHulls, rows: IntArray, faces: IntArray, origins: FloatArray, rays: FloatArray) -> BoolArray:
    """Return whether rays (k, 3) cross hulls, given as faces with the row of the ray: where all half-spaces overlap."""
    normals = hulls.normals[faces]
    slopes = dot(normals, rays[rows])
    rooms = hulls.offsets[faces] - GRAZING_M - dot(normals, origins[rows])
    # Along a face there is no crossing: either all of the ray is behind it or nothing.
    crossings = np.divide(rooms, slopes, out=np.where(rooms < 0.0, -np.inf, np.inf), where=slopes != 0.0)
    entries = np.where(slopes < 0.0, crossings, 0.0)
    exits = np.where(slopes < 0.0, 1.0, crossings)
    starts = np.searchsorted(rows, np.arange(len(rays)))
    return np.maximum.reduceat(entries, starts).clip(min=0.0) < np.minimum.reduceat(exits, starts).clip(max=1.0)


def _blocks(counts: IntArray) -> list[tuple[int, int]]:
    """Return rows from and to, so that the counts (k,) of each block add up to some `PAIRS_AT_ONCE`."""
    block_of = np.cumsum(counts) // PAIRS_AT_ONCE
    edges = np.flatnonzero(np.diff(block_of)) + 1
    return [(first, last) for first, last in pairwise([0, *edges.tolist(), len(counts)]) if first < last]
