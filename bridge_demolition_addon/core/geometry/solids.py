"""Solids: closed triangle meshes, checked on the way in and handed to the boolean engine in double precision."""

from collections.abc import Sequence

import numpy as np
from manifold3d import Error, Manifold, Mesh64, OpType
from trimesh import Trimesh

from ..errors import GeometryError

OVERLAP_TOLERANCE = 1e-9
"""Part of a solid's volume that its bodies may have in common before they count as overlapping."""

SMALLEST_VOLUME = 1e-14
"""Part of the cube of its longest extent that a mesh has to enclose: rounding alone gives a flat one some 1e-16."""

_PAIRS_PER_BLOCK = 200_000
"""Point-triangle pairs that `contains` looks at in one go; bounds its memory to some tens of megabytes."""

_BOX_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_BOX_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_BOX_TRIANGLES = _BOX_QUADS[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def mesh_of(vertices: np.ndarray, triangles: np.ndarray) -> Trimesh:
    """A mesh of exactly these vertices (v, 3) in m and triangles (t, 3): nothing merged, dropped or reordered."""
    return Trimesh(vertices=vertices, faces=triangles, process=False, validate=False)


def box(size_m: Sequence[float], centre_m: Sequence[float] = (0.0, 0.0, 0.0)) -> Trimesh:
    """An axis-parallel box.

    Parameters
    ----------
    size_m : (3,) float
        Edge lengths along x, y and z.
    centre_m : (3,) float
        Where its centre is.

    Raises
    ------
    GeometryError
        When an edge length is not a positive number.
    """
    size, centre = np.asarray(size_m, dtype=float), np.asarray(centre_m, dtype=float)
    if not (np.isfinite(size).all() and np.isfinite(centre).all() and (size > 0).all()):
        raise GeometryError(
            f"A box needs three positive edge lengths and a finite centre, not {size.tolist()} at {centre.tolist()}."
        )
    return mesh_of(_BOX_CORNERS * size + centre, _BOX_TRIANGLES)


def union(solids: Sequence[Trimesh]) -> Trimesh:
    """What is inside at least one of the solids, as one solid.

    Raises
    ------
    GeometryError
        When there is nothing to unite or one of the solids is not closed.
    """
    if not len(solids):
        raise GeometryError("There are no solids to unite; give at least one.")
    operands = [to_manifold(each, f"solid {index + 1} of {len(solids)}") for index, each in enumerate(solids)]
    return from_manifold(Manifold.batch_boolean(operands, OpType.Add))


def difference(solid: Trimesh, others: Sequence[Trimesh]) -> Trimesh:
    """What is inside the solid and inside none of the others; without faces where nothing is.

    Raises
    ------
    GeometryError
        When one of them is not closed.
    """
    operands = [to_manifold(each) for each in (solid, *others)]
    return from_manifold(Manifold.batch_boolean(operands, OpType.Subtract))


def checked_solid(mesh: Trimesh, name: str) -> Trimesh:
    """The mesh as a solid that can be cut, turned outside-out where all its faces look inwards.

    Surfaces that cross themselves within one body are not found: the boolean engine cannot tell them from sound ones.

    Parameters
    ----------
    mesh : Trimesh
        Of any origin. It is not changed.
    name : str
        What the user calls it; the error messages begin with it.

    Returns
    -------
    Trimesh
        Closed, consistently wound, of positive volume.

    Raises
    ------
    GeometryError
        When it has no faces, is not finite, is not closed, is wound inconsistently or has no volume, or when its bodies
        overlap or are inside out.
    """
    vertices, triangles = np.array(mesh.vertices, dtype=float), np.array(mesh.faces, dtype=np.int64)
    _check_surface(vertices, triangles, name)
    volume = float(volumes_and_centres([vertices], [triangles])[0][0])
    if volume < 0:
        triangles, volume = triangles[:, ::-1].copy(), -volume
    _check_volume(vertices, volume, name)
    result = mesh_of(vertices, triangles)
    _check_bodies(bodies(to_manifold(result, name), name=name), name)
    return result


def to_manifold(mesh: Trimesh, name: str = "The solid") -> Manifold:
    """The mesh in the boolean engine, in double precision.

    Raises
    ------
    GeometryError
        When the engine refuses it, which it does unless every edge has exactly two, oppositely wound, faces.
    """
    vertices = np.array(mesh.vertices, dtype=np.float64, order="C")
    triangles = np.array(mesh.faces, dtype=np.uint64, order="C")
    # Mesh64, because the engine's plain Mesh is single precision and loses volumes in the seventh digit.
    manifold = Manifold(Mesh64(vertices, triangles))
    if manifold.status() != Error.NoError:
        raise GeometryError(
            f"{name}: not a closed solid for the boolean engine ({manifold.status().name}); close its holes and give "
            "every edge exactly two faces."
        )
    return manifold


def from_manifold(*shells: Manifold) -> Trimesh:
    """The engine's shells as one mesh."""
    return mesh_of(*arrays_of(*shells))


def arrays_of(*shells: Manifold) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (v, 3) and triangles (t, 3) of the engine's shells, one after the other."""
    meshes = [shell.to_mesh64() for shell in shells]
    firsts = np.cumsum([0] + [len(mesh.vert_properties) for mesh in meshes[:-1]])
    vertices = np.concatenate([mesh.vert_properties[:, :3] for mesh in meshes])
    triangles = [mesh.tri_verts.astype(np.int64) + first for mesh, first in zip(meshes, firsts, strict=True)]
    return vertices, np.concatenate(triangles)


def bodies(manifold: Manifold, smallest_volume: float = 0.0, name: str = "The solid") -> list[list[Manifold]]:
    """The separate bodies of a solid, each as its outer shell followed by the cavities inside it.

    Parameters
    ----------
    manifold : Manifold
    smallest_volume : float
        Shells that enclose no more than this, in m³, are left out, unless there is only one.
    name : str
        What the user calls the solid.

    Raises
    ------
    GeometryError
        When an inside-out shell lies in no body, and so is no cavity.
    """
    shells = manifold.decompose()
    if len(shells) <= 1:
        return [shells] if shells else []
    volumes = np.array([shell.volume() for shell in shells])
    outer = np.flatnonzero(volumes > smallest_volume)
    outer_meshes = [from_manifold(shells[index]) for index in outer]
    found = [[shells[index]] for index in outer]
    for cavity in np.flatnonzero(volumes < -smallest_volume):
        found[_enclosing(shells[cavity], outer_meshes, volumes[outer], name)].append(shells[cavity])
    return found


def contains(mesh: Trimesh, points: np.ndarray) -> np.ndarray:
    """Which points lie inside a closed mesh, by its winding number around each.

    Parameters
    ----------
    mesh : Trimesh
        Closed; concave, holed and hollow are fine. A point on the surface may go either way.
    points : (n, 3) float

    Returns
    -------
    (n,) bool

    References
    ----------
    A. van Oosterom, J. Strackee (1983), The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 125-126.
    """
    corners = np.asarray(mesh.vertices, dtype=float)[np.asarray(mesh.faces)]
    points = np.asarray(points, dtype=float).reshape(-1, 3)
    rows = max(1, _PAIRS_PER_BLOCK // max(1, len(corners)))
    blocks = [_winding_numbers(corners, points[first : first + rows]) for first in range(0, len(points), rows)]
    return np.concatenate(blocks) > 0.5 if blocks else np.zeros(0, dtype=bool)


def volumes_and_centres(
    vertices: Sequence[np.ndarray], triangles: Sequence[np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Volumes and centres of mass of closed meshes of uniform density, by Gauss's theorem.

    Parameters
    ----------
    vertices : n arrays (v, 3) float, m
    triangles : n arrays (t, 3) int

    Returns
    -------
    volumes : (n,) float, m³
        Negative for a mesh that is inside out.
    centres : (n, 3) float, m
        The mean of the vertices for a mesh without volume.
    """
    if not len(vertices):
        return np.zeros(0), np.zeros((0, 3))
    # About its own middle, because a small mesh far from the origin would lose its volume in rounding.
    middles = np.array([each.mean(axis=0) for each in vertices])
    corners = np.concatenate([v[t] - m for v, t, m in zip(vertices, triangles, middles, strict=True)])
    starts = np.cumsum([0] + [len(each) for each in triangles[:-1]])
    six_volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    moments = six_volumes[:, None] * corners.sum(axis=1) / 24
    volumes = np.add.reduceat(six_volumes / 6, starts)
    first_moments = np.add.reduceat(moments, starts)
    has_volume = volumes != 0
    offsets = np.divide(first_moments, volumes[:, None], out=np.zeros_like(middles), where=has_volume[:, None])
    return volumes, middles + offsets


def _check_surface(vertices: np.ndarray, triangles: np.ndarray, name: str) -> None:
    if not len(triangles):
        raise GeometryError(f"{name}: has no faces; give it a closed surface.")
    if not np.isfinite(vertices).all():
        raise GeometryError(f"{name}: has vertices that are not finite numbers; delete or move them.")
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, faces_of_edge = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    if (faces_of_edge == 1).any():
        raise GeometryError(
            f"{name}: not closed, {int((faces_of_edge == 1).sum())} edges have a face on one side only; fill the holes "
            "and merge doubled vertices."
        )
    if (faces_of_edge % 2 == 1).any():
        raise GeometryError(f"{name}: not closed, some edges have an odd number of faces; delete the inner faces.")
    # Sound where every edge is walked as often one way as the other.
    code = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    _, edge = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    if np.bincount(edge.ravel(), weights=code).any():
        raise GeometryError(
            f"{name}: some faces look inwards and some outwards; recalculate the normals to the outside."
        )


def _check_volume(vertices: np.ndarray, volume: float, name: str) -> None:
    if volume <= SMALLEST_VOLUME * np.ptp(vertices, axis=0).max() ** 3:
        raise GeometryError(f"{name}: encloses no volume; give it a thickness.")


def _check_bodies(found: list[list[Manifold]], name: str) -> None:
    if len(found) < 2:
        return
    separate = [to_manifold(from_manifold(*shells), name) for shells in found]
    total = sum(body.volume() for body in separate)
    if Manifold.batch_boolean(separate, OpType.Add).volume() < total * (1 - OVERLAP_TOLERANCE):
        raise GeometryError(f"{name}: its {len(found)} separate bodies overlap; unite them into one first.")


def _enclosing(cavity: Manifold, outer_meshes: list[Trimesh], volumes: np.ndarray, name: str) -> int:
    """Index of the smallest of the meshes that the cavity lies in."""
    corner = cavity.to_mesh64().vert_properties[:1, :3]
    around = [index for index, mesh in enumerate(outer_meshes) if contains(mesh, corner)[0]]
    if not around:
        raise GeometryError(f"{name}: one of its bodies is inside out; recalculate the normals to the outside.")
    return min(around, key=lambda index: volumes[index])


def _winding_numbers(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    """How often triangles (t, 3, 3) wind around each of the points (n, 3): 1 inside, 0 outside."""
    a, b, c = (corners[None, :, index] - points[:, None] for index in range(3))
    length_a, length_b, length_c = (np.sqrt(np.einsum("ijk,ijk->ij", side, side)) for side in (a, b, c))
    numerator = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
    denominator = (
        length_a * length_b * length_c
        + np.einsum("ijk,ijk->ij", a, b) * length_c
        + np.einsum("ijk,ijk->ij", b, c) * length_a
        + np.einsum("ijk,ijk->ij", c, a) * length_b
    )
    return np.arctan2(numerator, denominator).sum(axis=1) / (2 * np.pi)
