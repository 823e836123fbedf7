"""Faces in which two members lie on each other along their length, such as girders under a slab.

Both are cut into rigid shards, and not in the same planes. Held by the middles of many faces, the two bend as one
section. Were each face to resist turning and sliding as if shards did not deform, a shard of one would hold the cut
of the other closed, as a splice does: 100 shards of a bridge with four girders swing half as fast again. So where the
interface is much longer than the members are thick, a face resists turning only by its share of that length, and
yields along it by as much as the shards behind it would stretch: as an element of a shear-flexible beam with one point
of integration, whose shear is made softer by the bending that it cannot have (R. H. MacNeal 1978, A simple
quadrilateral shell element, Computers & Structures 8, 175-183).
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray

BLOCK = 3.0
"""Length of an interface over the thickness of its two members up to which they turn as a block there."""


def shares_of_length(points_m: FloatArray, in_plane: FloatArray, sides_m: FloatArray, thickness_m: float) -> FloatArray:
    """Return what share (r, 2) of an interface each of its faces has, along its own y and z; 1 for a short interface.

    Parameters
    ----------
    points_m : (r, 3) float
        Middles of the faces of the interface.
    in_plane : (r, 3, 2) float
        Axes y and z of each.
    sides_m : (r, 2) float
        How long each is along these.
    thickness_m : float
        Of the two members together.
    """
    shares = np.ones(sides_m.shape)
    for side in range(2):
        places = (points_m[None, :, :] * in_plane[:, None, :, side]).sum(axis=2)
        half = sides_m[None, :, side] / 2.0
        whole = (places + half).max(axis=1) - (places - half).min(axis=1)
        shares[:, side] = np.minimum(1.0, np.maximum(sides_m[:, side], BLOCK * thickness_m) / whole)
    return shares


def slips_by_stretching(
    shares: FloatArray, shard_sides_m: FloatArray, young_pa: FloatArray, areas_m2: FloatArray, lengths_m: FloatArray
) -> FloatArray:
    """Return how much farther shards (r, 2) shift along y and z, m/N.

    Shards so long along y and z, stretched alike on average, differ by up to half of that stretch at their ends.
    """
    given = (1.0 - shares) * shard_sides_m * shard_sides_m
    return np.asarray(given / (young_pa * areas_m2 * lengths_m)[:, None])
