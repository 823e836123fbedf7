"""Section cuts through a member: the faces of one shard that look the same way, which carry a load together.

Between rigid bodies it is open in statics how several joints share a load, and a solver that knows no stiffness gives a
face of a hand's breadth as much of it as one of a square metre. What all of them carry together is not open. So a face
is judged with the others that look the same way from its shard, as one section whose plane stays plane, and that on
both of its sides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.proximity import ranges
from ..geometry.vectors import dot, transformed_back
from .section_forces import SectionForces, section_forces

SAME_WAY = 0.3
"""Cosine above which two faces of a shard look the same way. The faces of a shard lie at all angles about it; those
within 73° of a direction are what a cut across that direction goes through."""


@dataclass(frozen=True, eq=False, slots=True)
class ConnectedFaces:
    """The faces between bodies that m connections stand for, as they were built.

    Attributes
    ----------
    pairs : (m, 2) int
        Connected bodies.
    points_m, normals : (m, 3) float
        Middles of the faces, and unit vectors from the first body to the second.
    areas_m2, second_moments_m4 : (m,), (m, 2, 2) float
        Of each, the latter in its own axes.
    """

    pairs: IntArray
    points_m: FloatArray
    normals: FloatArray
    areas_m2: FloatArray
    second_moments_m4: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class SectionCuts:
    """Two cuts for each of m connections, through its first and through its second shard.

    Attributes
    ----------
    starts : (2 m + 1,) int
        Where the faces of each cut begin, and the number of all: first all cuts through first shards.
    faces : (e,) int
        Connections whose faces are in a cut.
    signs : (e,) float
        1 where the load of that connection's first body counts, -1 where its opposite does.
    cosines : (e,) float
        Between the normals of a face and of its cut.
    """

    starts: IntArray
    faces: IntArray
    signs: FloatArray
    cosines: FloatArray

    @classmethod
    def between(cls, pairs: IntArray, normals: FloatArray, areas: FloatArray, is_shard: BoolArray) -> SectionCuts:
        """The cuts of connections.

        Parameters
        ----------
        pairs : (m, 2) int
            Connected bodies.
        normals : (m, 3) float
            Unit vectors from the first body to the second.
        areas : (m,) float
            In m².
        is_shard : (n,) bool
            Bodies with faces all around. Through any other, such as the ground, a cut has one face only.
        """
        count = len(pairs)
        # A half is a connection as one of its bodies sees it: first those of the first bodies, then of the second.
        body = pairs.T.ravel()
        outwards = np.concatenate((normals, -normals))
        order = np.argsort(body, kind="stable")
        per_body = np.bincount(body, minlength=len(is_shard))
        first_of_body = np.cumsum(per_body) - per_body
        cut, place = ranges(first_of_body[body], per_body[body])
        half = order[place]
        cosines = dot(outwards[cut], outwards[half])
        own = cut == half
        together = own | (is_shard[body[cut]] & (cosines > SAME_WAY) & (areas[half % count] > 0.0))
        cut, half, cosines = cut[together], half[together], cosines[together]
        starts = np.searchsorted(cut, np.arange(2 * count + 1))
        signs = np.where((cut < count) == (half < count), 1.0, -1.0)
        return cls(starts, half % count, signs, cosines)

    def sections(
        self,
        rows: IntArray,
        intact: BoolArray,
        forces: FloatArray,
        moments: FloatArray,
        points: FloatArray,
        axes: FloatArray,
        areas: FloatArray,
        second_moments: FloatArray,
    ) -> tuple[SectionForces, FloatArray, FloatArray]:
        """Loads and sizes of the two cuts of some intact connections.

        Parameters
        ----------
        rows : (k,) int
            Which connections.
        intact : (m,) bool
            What still holds; a broken face is in no cut.
        forces, moments, points : (m, 3) float
            On the first body of each connection, about the connection's own point, which is also given, in the axes of
            the world; N, N·m, m.
        axes : (k, 3, 3) float
            Of the sections of those connections, as columns.
        areas, second_moments : (m,), (m, 2, 2) float
            Of all faces, each in its own axes, m² and m⁴.

        Returns
        -------
        loads, areas_m2, second_moments_m4
            Of 2 k cuts, first those through the first bodies.
        """
        cuts = np.concatenate((rows, rows + len(intact)))
        owners, entries = ranges(self.starts[cuts], np.diff(self.starts)[cuts])
        holds = intact[self.faces[entries]]
        owners, entries = owners[holds], entries[holds]
        faces, cosines = self.faces[entries], self.cosines[entries]
        axes = np.concatenate((axes, axes))
        return cut_loads(
            owners, faces, self.signs[entries], cosines, forces, moments, points, axes, areas, second_moments
        )


def cut_loads(
    owners: IntArray,
    faces: IntArray,
    signs: FloatArray,
    cosines: FloatArray,
    forces: FloatArray,
    moments: FloatArray,
    points: FloatArray,
    axes: FloatArray,
    areas: FloatArray,
    second_moments: FloatArray,
) -> tuple[SectionForces, FloatArray, FloatArray]:
    """Loads and sizes of k cuts through faces that stay plane together.

    Parameters
    ----------
    owners, faces : (e,) int
        Cuts, from 0 to k - 1 in order, and the connections whose faces are in them.
    signs, cosines : (e,) float
        1 where the load of that connection's first body counts, -1 where its opposite does; and between the normals of
        the face and of the cut.
    forces, moments, points, areas, second_moments : (m, 3), (m, 3), (m, 3), (m,), (m, 2, 2) float
        Of all connections, as in `SectionCuts.sections`.
    axes : (k, 3, 3) float
        Of the cuts, as columns.

    Returns
    -------
    loads, areas_m2, second_moments_m4
        Of the k cuts.
    """
    total = _Totals(owners, len(axes))
    shares = areas[faces] * cosines
    cut_areas = total.of(shares)
    centres = total.of(shares[:, None] * points[faces]) / cut_areas[:, None]
    levers = points[faces] - centres[owners]
    pulls = signs[:, None] * forces[faces]
    turns = signs[:, None] * moments[faces] + np.cross(levers, pulls)
    across = transformed_back(axes[owners], levers)[:, 1:]
    own = second_moments[faces] * cosines[:, None, None]
    cut_moments = total.of(own + shares[:, None, None] * _moved_axes(across))
    return section_forces(axes, total.of(pulls), total.of(turns)), cut_areas, cut_moments


def worst_around(pairs: IntArray, used: FloatArray, is_shard: BoolArray) -> BoolArray:
    """Which connections (k,) between pairs (k, 2) use more than any other that shares a shard with them.

    Parameters
    ----------
    pairs : (k, 2) int
        Connected bodies.
    used : (k,) float
        Utilisations.
    is_shard : (n,) bool
        Bodies that count; connections to any other, such as the ground, do not compete over it.
    """
    most = np.full(len(is_shard), -np.inf)
    np.maximum.at(most, pairs.ravel(), np.repeat(used, 2))
    most[~is_shard] = -np.inf
    return used >= most[pairs].max(axis=1)


class _Totals:
    """Sums over the entries of each owner."""

    def __init__(self, owners: IntArray, count: int):
        self._firsts = np.searchsorted(owners, np.arange(count))

    def of(self, values: FloatArray) -> FloatArray:
        return np.add.reduceat(values, self._firsts, axis=0) if len(values) else values[:0]


def _moved_axes(across: FloatArray) -> FloatArray:
    """What a unit of area adds to second moments (e, 2, 2) by its distance (e, 2), y and z, from the axes."""
    y, z = across.T
    return np.stack((np.stack((z * z, -y * z), axis=1), np.stack((-y * z, y * y), axis=1)), axis=1)
