"""Effects of connections on bodies, and the average stress in a body from the loads on its surface: no mesh."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct, WrittenDoubles
from ..geometry.vectors import by_component, symmetric_eigenvalues


class SurfaceLoads(Struct):
    """Loads of k pairs on the surfaces of n bodies: `bda_surface_loads`."""

    _fields_ = (
        ("count", Count),
        ("bodies", Count),
        ("pairs", Indices),
        *((name, Doubles) for name in ("forces", "points", "moments", "normals", "centres", "volumes")),
        *((name, WrittenDoubles) for name in ("of_forces", "of_moments", "stresses")),
    )


def average_stress(
    pairs: IntArray,
    forces: FloatArray,
    points: FloatArray,
    centres: FloatArray,
    volumes: FloatArray,
    moments: FloatArray | None = None,
    normals: FloatArray | None = None,
) -> FloatArray:
    """Average stress tensor (n, 3, 3), Pa, of every body: (1/V) Σ f ⊗ r, tension positive (Love-Weber).

    Point loads (k, 3), N, act at points (k, 3), m, on the first bodies of pairs (k, 2), and the opposite on the second.
    The tensor is symmetric; 0 for a body without a volume, and nan for one with a load that is nan.

    The lever arms r start at the centre of mass: gravity and any common acceleration of the whole body, such as in a
    free fall or a hit through the centre, then add nothing, and the formula is exact. It leaves out the inertia of
    turning. Where the loads make a body turn ever faster, the sum has a part that is not symmetric, half their moment;
    it turns the body and is no stress, so only the symmetric part is taken. Of a long body, the same turning takes some
    of the symmetric part too, and an angular velocity adds a tension of about density × ω² L² / 12, which is 0.02 N/mm²
    for a shard of concrete of 1 m at 10 rad/s. Neither is allowed for.

    Moments (k, 3), N·m, about the points act on faces with unit normals (k, 3). A couple by itself says nothing about a
    symmetric tensor; how it is spread over its face does. A bending moment is spread as stress at right angles to the
    face: with n the normal, which may point either way, n ⊗ (n × M), whatever the shape of the face and however the
    stress varies over it. Torsion is spread as circular shear, which adds nothing symmetric on a face whose two second
    moments of area are equal, and is left out on all others. Without this part, a block of a beam would show half of
    its shear stress V/A: the other half comes from the difference between the bending moments at its two ends.

    A. E. H. Love (1927), A Treatise on the Mathematical Theory of Elasticity, 4th edition, § 123: mean stress from the
    forces on the surface, (1/V) ∮ t ⊗ r dA; with tractions t = s n and M = ∫ r × s n dA, ∫ s r dA = n × M within the
    face. J. Weber (1966), Recherches concernant les contraintes intergranulaires dans les milieux pulvérulents,
    Bulletin de Liaison des Ponts et Chaussées 20. On inertia: F. Nicot, N. Hadda, M. Guessasma, J. Fortin, O. Millet
    (2013), On the definition of the stress tensor in granular media, International Journal of Solids and Structures 50,
    2508-2517.
    """
    count, bodies = len(pairs), len(volumes)
    of_forces, of_moments, stresses = np.zeros((3, bodies, 3, 3))
    loads = SurfaceLoads(count=count, bodies=bodies).take(
        pairs=(pairs, 2 * count),
        forces=(forces, 3 * count),
        points=(points, 3 * count),
        centres=(centres, 3 * bodies),
        volumes=(volumes, bodies),
        of_forces=(of_forces, 9 * bodies),
        of_moments=(of_moments, 9 * bodies),
        stresses=(stresses, 9 * bodies),
    )
    if moments is not None and normals is not None:
        loads.take(moments=(moments, 3 * count), normals=(normals, 3 * count))
    call("bda_stresses", loads)
    return stresses


def von_mises(stresses: FloatArray) -> FloatArray:
    """Equivalent stress (n,) of tensors (n, 3, 3), Pa: √(3/2 s:s) with the deviator s (R. von Mises, 1913)."""
    mean = np.trace(stresses, axis1=-2, axis2=-1) / 3.0
    deviators = stresses - mean[..., None, None] * np.eye(3)
    equivalent: FloatArray = np.sqrt(1.5 * np.square(deviators).sum(axis=(-2, -1)))
    return equivalent


def principal_stresses(stresses: FloatArray) -> FloatArray:
    """Largest and smallest principal stress (n, 2) of symmetric tensors (n, 3, 3), Pa; nan for tensors with a nan."""
    known = np.isfinite(stresses).all(axis=(-2, -1))
    found = np.full((*known.shape, 2), np.nan)
    if known.any():  # where none is, there may be no core
        found[known] = symmetric_eigenvalues(stresses[known])[:, [2, 0]]
    return found


class PairSums:
    """Sums over the pairs of n bodies in each of s sub-steps, all at once. `shape` is (s, n).

    The sum of the magnitudes of the forces on a body measures how hard it is held from all sides, where the resultant
    of a body at rest is only its weight.

    `pairs` (k, 2) are bodies, `substeps` (k,) the sub-step of each pair; None where all pairs are in all sub-steps, and
    values are (s, k). `first` and `second` are the pairs' bodies as rows (s n,), sub-step after sub-step.
    """

    def __init__(self, pairs: IntArray, substeps: IntArray | None, shape: tuple[int, int]):
        self.shape = shape
        rows = np.arange(shape[0])[:, None] if substeps is None else substeps
        self.first, self.second = ((shape[1] * rows + bodies).ravel() for bodies in pairs.T)

    def sums(self, values: FloatArray) -> FloatArray:
        """Sums (s, n) of values over the pairs of every body."""
        return self._of(self.first, values) + self._of(self.second, values)

    def differences(self, values: FloatArray) -> FloatArray:
        """Sums (s, n) of values over pairs with a body as the first, less those with it as the second."""
        return self._of(self.first, values) - self._of(self.second, values)

    def resultants(self, forces: FloatArray) -> FloatArray:
        """Vector sums (s, n, 3) of forces (..., 3) on the first body of each pair; the second gets the opposite.

        That is Newton's third law.
        """
        return by_component(*(self.differences(forces[..., axis]) for axis in range(3)))

    def _of(self, rows: IntArray, values: FloatArray) -> FloatArray:
        if not len(rows):
            return np.zeros(self.shape)
        substeps, bodies = self.shape
        return np.bincount(rows, values.ravel(), substeps * bodies).reshape(self.shape)
