"""Poisson's effect on members of rigid shards: how soft they are in shear and in twist.

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

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.vectors import product
from .member_shapes import MemberShapes, in_axes, slenderness

_UNEVEN = 0.65
"""Part of a - 1 and b - 1 with which plates of concrete in 40 to 600 irregular shards are nearest to theory, as
measured: with all of it, they stretch by 4 to 8 % too much."""

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
    shapes: MemberShapes, shares: FloatArray, normals: FloatArray, young_pa: FloatArray, shear_pa: FloatArray
) -> FloatArray:
    """Return the moduli (m, 3, 3) with which faces within members resist shifts, Pa, in the axes of the world.

    Parameters
    ----------
    shapes, shares : MemberShapes, (m,) float
        Of the member that each face is in, and its part of Poisson's effect.
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
    across_faces, along_faces = _ratios(shares, shear_pa / young_pa)
    scales = _scales(shapes, normals, np.sqrt(across_faces), np.sqrt(along_faces))
    return product(product(scales, in_axes(np.swapaxes(shapes.axes, 1, 2), moduli)), scales)


def plate_turning(
    turning_m4: FloatArray, shapes: MemberShapes, shares: FloatArray, normals: FloatArray, shear_over_young: FloatArray
) -> FloatArray:
    """Return second moments that resist turning (m, 3, 3) with Poisson's effect: more in bending, less in twist."""
    bending, twist = _ratios(shares, shear_over_young)
    scales = _scales(shapes, normals, np.sqrt(twist), np.sqrt(bending))
    return product(product(scales, turning_m4), scales)


def _ratios(shares: FloatArray, shear_over_young: FloatArray) -> tuple[FloatArray, FloatArray]:
    """a and b (m,) of plates with these parts of the effect."""
    poisson = np.clip(0.5 / shear_over_young - 1.0, 0.0, _LARGEST)
    across, along = 1.0 / (1.0 - poisson), (1.0 - 3.0 * poisson) / (1.0 - poisson * poisson)
    parts = _UNEVEN * shares
    return 1.0 + parts * (across - 1.0), 1.0 + parts * (along - 1.0)


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
