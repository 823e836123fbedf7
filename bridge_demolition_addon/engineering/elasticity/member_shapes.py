"""How the shape of a member decides by what part of a face two shards resist turning against each other.

Shards are rigid, and a bridge of them bends in its faces. Where a member bends about an axis k, its shards turn by the
curvature times how far they are apart along the longer (p) of the two directions across k, and its section resists with
its depth along the shorter one (q). So a face resists that turning with ∫ q² dA about its own middle. The rest of its
second moment, ∫ p² dA, is the slope of a face that is not at right angles to the member, and resists nothing: it is
left out. For the same reason what slides along q is measured half-way between the two shards' points along p, not at
the middle of the face: there the rotations of both shards shift it by the same. With both a bar, a wall or a slab in
any number of irregular shards bends as beam and plate theory say.

A member that is as long as wide has no such direction. Over all directions of faces two thirds of the second moment
are bending. About the axis of a bar that is as deep as wide, a twist θ' shears each shard by an energy of G θ'² times
its polar second moment. A part is in the faces along the bar: where faces slide by Poisson's effect, shards at y
are inclined by G/E θ' y against each other, and at z, too, which faces there resist with E (G/E)². The rest,
G (1 - G/E), is left for the faces across.

A face that is not a whole section may be a sliver. What the rotations of its shards do to it says nothing of the stress
there: its levers are short, and its second moment is that of a face of a moderate slenderness.

Springs that are as stiff along faces as across them make a material without Poisson's effect: its shear modulus is E/2,
not E / (2 (1 + ν)). Bars and plates in it twist by 1 / (1 + ν) of what they should.

**Bars** are stretched along one axis alone. With springs of E along that axis, and of k in the two directions across,
whatever the normal of the face, an even shear slides the faces across by τ/k and those along by τ/E, so that
1/G = 1/E + 1/k: k = E / (1 + 2 ν). Irregular cells still deform evenly, and stretching and bending stay as they are.
The same holds for the shear of plates along their thickness.

**Plates** are stretched both ways. Let springs in their plane have a E across faces and b E along them, and let faces
resist turning about their trace in the plane by a E, and about their normal by b E. Summed over all directions of
faces, the energy of an evenly bent plate gives its stiffness D and Poisson's ratio, by E I of a unit of its width:
(3 a + b) / 4 = 1 / (1 - ν²) and (a - b) / 4 = ν / (1 - ν²), so that a = 1 / (1 - ν) and b = (1 - 3 ν) / (1 - ν²).
Stretching has the same sums. Lattices with two stiffnesses are in J. E. Bolander and S. Saito (1998), Fracture analyses
using spring networks with random geometry, Engineering Fracture Mechanics 61, 569-591. Irregular cells no longer deform
evenly, and yield a little more than on average: with `_UNEVEN` of the difference from 1, plates of concrete bend and
twist within a tenth of theory, and stretch within 3 %. One row of shards has none beside it to contract against.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.mesh import TriangleMesh
from ..geometry.vectors import product, symmetric_eigenvectors

BENDING_SHARE = 2.0 / 3.0
"""Part of the turning of two cells against each other that is bending: ⟨nx² z²⟩ / ⟨nx² (x² + z²)⟩ over all directions
of normals n, of round faces that a bar along x is cut into, which bends about y."""

SLENDEREST = 4.0
"""Ratio of its sides up to which a face that is not a whole section resists turning with all of its length."""

_FILLED = 0.6
"""Part of its box that a member fills at least whose shape is that of a bar or a plate."""

_SLENDER = 2.0
"""Ratio of two extents from which on a member bends along the longer alone."""

_ALONG = (0.8, 0.95)
"""Share of a normal, squared, that lies in the shorter direction: up to the first, shards turn by bending along the
longer one; from the second on, they lie on each other, and turn as a block does."""


@dataclass(frozen=True, slots=True, eq=False)
class MemberShapes:
    """Shapes of k members.

    Attributes
    ----------
    axes : (k, 3, 3) float
        Principal axes, the columns of each matrix, along the shortest extent first.
    extents_m : (k, 3) float
        Extents of the box with the same volume and moments of inertia; 1 for a member that is no bar or plate.
    are_filled : (k,) bool
        Whether each is a bar or a plate.
    """

    axes: FloatArray
    extents_m: FloatArray
    are_filled: BoolArray

    def only(self, rows: IntArray) -> MemberShapes:
        """Return the shapes of some members (r,)."""
        return MemberShapes(*(getattr(self, item.name)[rows] for item in fields(self)))


def member_shapes(solids: list[TriangleMesh]) -> MemberShapes:
    """Return the shapes of members with these solids."""
    moments = np.array([_second_moments(solid) for solid in solids]).reshape(-1, 3, 3)
    squares, axes = symmetric_eigenvectors(moments)
    extents = np.sqrt(12.0 * np.maximum(squares, 0.0))
    filled = np.array([solid.volume for solid in solids]) >= _FILLED * extents.prod(axis=1)
    return MemberShapes(axes, np.where(filled[:, None], extents, 1.0), filled)


def turning_inertias(
    shapes: MemberShapes, inertias_m4: FloatArray, normals: FloatArray, shear_over_young: FloatArray
) -> FloatArray:
    """Return the second moments (m, 3, 3) with which faces resist turning, in the axes of the world.

    Parameters
    ----------
    shapes : MemberShapes
        Of the member that each face is in.
    inertias_m4, normals : (m, 3, 3), (m, 3) float
        ∫ r rᵀ dA of the faces about their own middles, and their normals.
    shear_over_young : (m,) float
        Ratio of the moduli of the material.
    """
    own, along = in_axes(shapes.axes, inertias_m4), _components(shapes.axes, normals)
    turning = np.zeros_like(own)
    for axis in range(3):
        shorter, longer = _across(axis)
        slender = slenderness(shapes.extents_m, longer, shorter)
        lying = 1.0 - _bends_along(along, shorter)
        twisted = slenderness(shapes.extents_m, axis, longer) if axis == 2 else np.zeros(len(own))
        share = (1.0 - twisted) * BENDING_SHARE + twisted * shear_over_young * (1.0 - shear_over_young)
        of_shorter, of_longer = own[:, shorter, shorter], own[:, longer, longer]
        turning[:, axis, axis] = slender * (of_shorter + lying * of_longer) + (1.0 - slender) * share * (
            of_shorter + of_longer
        )
    turning[:, 0, 1] = turning[:, 1, 0] = -own[:, 0, 1] * slenderness(shapes.extents_m, 2, 1)
    return in_axes(np.swapaxes(shapes.axes, -1, -2), turning)


def moderate_second_moments(second_moments_m4: FloatArray) -> FloatArray:
    """Return second moments (m, 2, 2) of faces, those of slivers as if these were no longer than `SLENDEREST` says."""
    smaller, larger = principal_moments(second_moments_m4)
    most = SLENDEREST * SLENDEREST * smaller
    share = np.divide(larger - most, larger - smaller, out=np.zeros_like(most), where=larger > most)
    # What is left of the larger one: M - share (M - smaller).
    rest = second_moments_m4 - smaller[:, None, None] * np.eye(2)
    return np.asarray(second_moments_m4 - share[:, None, None] * rest)


def turning_levers(
    shapes: MemberShapes, to_middles_m: FloatArray, normals: FloatArray, longest_m: FloatArray
) -> FloatArray:
    """Return by how much shifts are to be larger for each turn (m, 3, 3), in the axes of the world.

    Parameters
    ----------
    to_middles_m : (m, 3) float
        From the middle of each face to half-way between the points of its two shards.
    longest_m : (m,) float
        Of the levers, either way.
    """
    away, along = _components(shapes.axes, to_middles_m), _components(shapes.axes, normals)
    levers = np.zeros((len(away), 3, 3))
    for axis in range(3):
        shorter, longer = _across(axis)
        counts = slenderness(shapes.extents_m, longer, shorter) * _bends_along(along, shorter)
        sign = 1.0 if (longer - axis) % 3 == 1 else -1.0  # axis × longer = ± shorter
        levers[:, shorter, axis] = sign * counts * np.clip(away[:, longer], -longest_m, longest_m)
    return in_axes(np.swapaxes(shapes.axes, -1, -2), levers)


def principal_moments(second_moments_m4: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the smaller and the larger principal second moments (m,) of faces, from those about two axes (m, 2, 2)."""
    one, beside, other = second_moments_m4[:, 0, 0], second_moments_m4[:, 0, 1], second_moments_m4[:, 1, 1]
    mean, spread = (one + other) / 2.0, np.sqrt(np.square((one - other) / 2.0) + np.square(beside))
    return np.maximum(mean - spread, 0.0), np.maximum(mean + spread, 0.0)


def in_axes(axes: FloatArray, matrices: FloatArray) -> FloatArray:
    """Return matrices (m, 3, 3) in other axes (m, 3, 3), the columns of each: aᵀ M a, summed in a fixed order."""
    half = (axes[:, :, :, None] * matrices[:, :, None, :]).sum(axis=1)
    return np.asarray((half[:, :, :, None] * axes[:, None, :, :]).sum(axis=2))


def _components(axes: FloatArray, vectors: FloatArray) -> FloatArray:
    return np.asarray((axes * vectors[:, :, None]).sum(axis=1))


def _across(axis: int) -> tuple[int, int]:
    """The shorter and the longer of the two extents across an axis."""
    shorter, longer = (other for other in range(3) if other != axis)
    return shorter, longer


def slenderness(extents_m: FloatArray, longer: int, shorter: int) -> FloatArray:
    """0 where two extents are the same, 1 where the longer is at least so many times the shorter."""
    ratio = extents_m[:, longer] / np.maximum(extents_m[:, shorter], 1e-12)
    return np.clip((ratio - 1.0) / (_SLENDER - 1.0), 0.0, 1.0)


def _bends_along(normals: FloatArray, shorter: int) -> FloatArray:
    """1 for faces across which shards bend along the longer direction, 0 for those that lie on each other."""
    share = np.square(normals[:, shorter])
    return np.asarray(1.0 - np.clip((share - _ALONG[0]) / (_ALONG[1] - _ALONG[0]), 0.0, 1.0))


def _second_moments(solid: TriangleMesh) -> FloatArray:
    """∫ r rᵀ dV / V (3, 3) of a solid about its centre."""
    corners = solid.corners - solid.vertices.mean(axis=0)
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    volumes = (a * np.cross(b, c)).sum(axis=1) / 6.0
    volume = volumes.sum()
    centre = (volumes[:, None] * corners.sum(axis=1)).sum(axis=0) / (4.0 * volume)
    # ∫ u v dV over a tetrahedron with a corner at 0 is V/20 (Σ u v + Σ u Σ v), sums over its corners.
    sums = corners.sum(axis=1)
    products = (corners[:, :, :, None] * corners[:, :, None, :]).sum(axis=1) + sums[:, :, None] * sums[:, None, :]
    return np.asarray((volumes[:, None, None] * products).sum(axis=0) / (20.0 * volume) - centre[:, None] * centre)


_UNEVEN = 0.65
"""Part of a - 1 and b - 1 with which plates of concrete in 40 to 600 irregular shards are nearest to theory, as
measured: with all of it, they stretch by 4 to 8 % too much."""

_ACUTE, _MOST_ALONG = 0.02, 2.0
"""Cosine of an angle from which on a triangle of a lattice is acute, and most b over a."""

_LARGEST = 0.3
"""Poisson's ratio up to which plates have its effect: beyond 1/3, b would be less than 0."""

_ROWS = 3.0
"""Rows of shards side by side from which on a plate has its effect in full: in one there is none to contract beside."""


def contraction_shares(shapes: MemberShapes, shards: IntArray) -> FloatArray:
    """Return what part (k,) of Poisson's effect members have in their plane that are cut into so many shards (k,).

    0 for bars and for plates in one row of shards, 1 for plates in three rows and more.
    """
    rows = np.sqrt(shards * shapes.extents_m[:, 1] / shapes.extents_m[:, 2])
    return np.asarray(slenderness(shapes.extents_m, 1, 0) * np.clip((rows - 1.0) / (_ROWS - 1.0), 0.0, 1.0))


def shifting_moduli(
    shapes: MemberShapes,
    ratios: tuple[FloatArray, FloatArray],
    normals: FloatArray,
    young_pa: FloatArray,
    shear_pa: FloatArray,
) -> FloatArray:
    """Return the moduli (m, 3, 3) with which faces within members resist shifts, Pa, in the axes of the world.

    Parameters
    ----------
    shapes, ratios : MemberShapes, two (m,) float
        Of the member that each face is in, and a and b of it.
    normals : (m, 3) float
        Of the faces.
    young_pa, shear_pa : (m,) float
        Moduli of the material.
    """
    across = shear_pa / (1.0 - shear_pa / young_pa)
    is_bar = slenderness(shapes.extents_m, 2, 1) * (1.0 - slenderness(shapes.extents_m, 1, 0))
    moduli = np.zeros((len(young_pa), 3, 3))
    for axis, share in ((0, slenderness(shapes.extents_m, 2, 0)), (1, is_bar), (2, np.zeros(len(young_pa)))):
        moduli[:, axis, axis] = young_pa + share * (across - young_pa)
    scales = _scales(shapes, normals, *map(np.sqrt, ratios))
    return product(product(scales, in_axes(np.swapaxes(shapes.axes, 1, 2), moduli)), scales)


def plate_turning(
    turning_m4: FloatArray, shapes: MemberShapes, ratios: tuple[FloatArray, FloatArray], normals: FloatArray
) -> FloatArray:
    """Return second moments that resist turning (m, 3, 3) with Poisson's effect: more in bending, less in twist."""
    bending, twist = ratios
    scales = _scales(shapes, normals, np.sqrt(twist), np.sqrt(bending))
    return product(product(scales, turning_m4), scales)


def contraction_ratios(shares: FloatArray, shear_over_young: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return a and b (m,) of plates in irregular shards with these parts of the effect."""
    poisson = _poisson_ratios(shear_over_young)
    across, along = 1.0 / (1.0 - poisson), (1.0 - 3.0 * poisson) / (1.0 - poisson * poisson)
    parts = _UNEVEN * shares
    return 1.0 + parts * (across - 1.0), 1.0 + parts * (along - 1.0)


def ratios_in_lattices(
    pairs: IntArray, points_m: FloatArray, shear_over_young: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return a and b (m,) of faces between pairs (m, 2) of shards around points (n, 2) of a lattice in a plate's plane.

    The plate is as stiff as theory says, evenly bent or twisted, in each triangle of points whose angles are acute:
    with a of 1 / (1 - ν) in all three of its faces, Σ w (a - b) κnt² has to be ν / (1 - ν²) of (κx - κy)² + 4 κxy²,
    where w are cotangents of the angles across: b = a + ν / (1 - ν²) cos 2γ / (cos α cos β cos γ), γ across from the
    face. In regular triangles it is the b that holds over all directions.
    """
    poisson = _poisson_ratios(shear_over_young)
    neighbours: dict[int, set[int]] = {}
    for one, other in pairs.tolist():
        neighbours.setdefault(one, set()).add(other)
        neighbours.setdefault(other, set()).add(one)
    shares = np.zeros((2, len(pairs)))
    for row, (one, other) in enumerate(pairs.tolist()):
        for third in sorted(neighbours[one] & neighbours[other]):
            cosines = _cosines(points_m[[third, one, other]])
            if min(cosines) > _ACUTE:
                weight = cosines[0] / math.sqrt(1.0 - cosines[0] * cosines[0])
                twice = 2.0 * cosines[0] * cosines[0] - 1.0
                shares[:, row] += weight, weight * twice / (cosines[0] * cosines[1] * cosines[2])
    across = 1.0 / (1.0 - poisson)
    mean = np.divide(shares[1], shares[0], out=np.full(len(pairs), -4.0), where=shares[0] > 0.0)
    return across, np.clip(across + poisson / (1.0 - poisson * poisson) * mean, 0.0, _MOST_ALONG * across)


def _cosines(corners_m: FloatArray) -> list[float]:
    """Cosines of the angles of a triangle (3, 2) at its corners."""
    found = []
    for corner in range(3):
        one, other = corners_m[corner - 1] - corners_m[corner], corners_m[corner - 2] - corners_m[corner]
        lengths = math.sqrt(float((one * one).sum()) * float((other * other).sum()))
        found.append(float((one * other).sum()) / lengths)
    return found


def _poisson_ratios(shear_over_young: FloatArray) -> FloatArray:
    return np.clip(0.5 / shear_over_young - 1.0, 0.0, _LARGEST)


def _scales(shapes: MemberShapes, normals: FloatArray, normal: FloatArray, aside: FloatArray) -> FloatArray:
    """Matrices (m, 3, 3) that scale vectors along the normals of faces in the planes of plates, and beside these."""
    thickness = shapes.axes[:, :, 0]
    in_plane = normals - (normals * thickness).sum(axis=1)[:, None] * thickness
    lengths = np.sqrt((in_plane * in_plane).sum(axis=1))[:, None]
    # A face in the plane has no direction there, and any will do.
    forth = np.where(lengths > 1e-6, in_plane / np.maximum(lengths, 1e-6), shapes.axes[:, :, 1])
    beside = np.cross(thickness, forth)
    parts = ((np.ones(len(normals)), thickness), (normal, forth), (aside, beside))
    return np.asarray(sum(scale[:, None, None] * axis[:, :, None] * axis[:, None, :] for scale, axis in parts))
