"""Average stress in a body, from the loads on its surface alone: no mesh, no elasticity."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.vectors import cross_by_component, symmetric_eigenvalues
from .compiled_mechanics import frame_loops


def average_stress(
    bodies: IntArray, forces: FloatArray, points: FloatArray, centres: FloatArray, volumes: FloatArray
) -> FloatArray:
    """Average stress tensor (n, 3, 3), Pa, of every body: (1/V) Σ f ⊗ r, tension positive (Love-Weber).

    Point loads (k, 3), N, act on `bodies` (k,) at points (k, 3), m. The tensor is symmetric; nan for a body without a
    volume, and for one with a load that is nan.

    The lever arms r start at the centre of mass: gravity and any common acceleration of the whole body, such as that of
    a free fall or a hit through the centre, then add nothing, and the formula is exact. It leaves out the inertia of
    turning. Where the loads make a body turn ever faster, the sum has a part that is not symmetric, half their moment;
    it turns the body and is no stress, so only the symmetric part is taken. Of a long body, the same turning takes some
    of the symmetric part too, and an angular velocity adds a tension of about density × ω² L² / 12, which is 0.02 N/mm²
    for a shard of concrete of 1 m at 10 rad/s. Neither is allowed for.

    A. E. H. Love (1927), A Treatise on the Mathematical Theory of Elasticity, 4th edition, § 123: mean stress from the
    forces on the surface. J. Weber (1966), Recherches concernant les contraintes intergranulaires dans les milieux
    pulvérulents, Bulletin de Liaison des Ponts et Chaussées 20. On inertia: F. Nicot, N. Hadda, M. Guessasma, J.
    Fortin, O. Millet (2013), On the definition of the stress tensor in granular media, International Journal of Solids
    and Structures 50, 2508-2517.
    """
    return _averaged(bodies, forces, points - centres[bodies], volumes)


def average_stress_of_moments(
    bodies: IntArray, moments: FloatArray, normals: FloatArray, volumes: FloatArray
) -> FloatArray:
    """Part (n, 3, 3), Pa, of the average stress of bodies that moments (k, 3), N·m, about connections' points add.

    A couple by itself says nothing about a symmetric tensor; how it is spread over its face does. A bending moment is
    spread as stress at right angles to the face: with n the normal, which may point either way, n ⊗ (n × M), whatever
    the shape of the face and however the stress varies over it. Torsion is spread as circular shear, which adds nothing
    symmetric on a face whose two second moments of area are equal, and is left out on all others.

    Without this part, a block of a beam would show half of its shear stress V/A: the other half comes from the
    difference between the bending moments at its two ends.

    Love (1927), § 123: (1/V) ∮ t ⊗ r dA. With tractions t = s n and M = ∫ r × s n dA, ∫ s r dA = n × M within the face.
    """
    return _averaged(bodies, normals, cross_by_component(normals, moments), volumes)


def von_mises(stresses: FloatArray) -> FloatArray:
    """Equivalent stress (n,) of tensors (n, 3, 3), Pa: √(3/2 s:s) with the deviator s (R. von Mises, 1913)."""
    mean = np.trace(stresses, axis1=-2, axis2=-1) / 3.0
    deviators = stresses - mean[..., None, None] * np.eye(3)
    equivalent: FloatArray = np.sqrt(1.5 * np.square(deviators).sum(axis=(-2, -1)))
    return equivalent


def principal_stresses(stresses: FloatArray) -> FloatArray:
    """Largest and smallest principal stress (n, 2) of symmetric tensors (n, 3, 3), Pa; nan for tensors with a nan."""
    known = np.isfinite(stresses).all(axis=(-2, -1))
    values = symmetric_eigenvalues(np.where(known[..., None, None], stresses, 0.0))
    return np.where(known[..., None], values[..., [2, 0]], np.nan)


def _averaged(bodies: IntArray, first: FloatArray, second: FloatArray, volumes: FloatArray) -> FloatArray:
    """Symmetric part of Σ first ⊗ second (k, 3) over the loads of each body, divided by its volume, (n, 3, 3)."""
    sums = _products_on_bodies(np.asarray(bodies), first, second, len(volumes))
    solid = np.where(np.asarray(volumes) > 0.0, volumes, np.nan)
    return (sums + sums.transpose(0, 2, 1)) / (2.0 * solid[:, None, None])


def _products_on_bodies(bodies: IntArray, first: FloatArray, second: FloatArray, count: int) -> FloatArray:
    """Σ first ⊗ second (k, 3) over the loads of each of n bodies, (n, 3, 3)."""
    rows, columns, loops = np.ascontiguousarray(first.T), np.ascontiguousarray(second.T), frame_loops()
    if loops is not None:
        found: FloatArray = loops.products_on_bodies(bodies, rows, columns, count)
        return found
    sums = np.empty((count, 3, 3))
    for row, column in np.ndindex(3, 3):
        sums[:, row, column] = np.bincount(bodies, rows[row] * columns[column], count)
    return sums
