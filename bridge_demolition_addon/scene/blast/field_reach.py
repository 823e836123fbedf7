"""How far a force field acts, so that it pushes its own body and no other.

A field pushes along one direction, within a cylinder about it. The body has to stay inside while it moves in a frame,
and every other body outside; so the radius and both ends are a part of the way to the nearest body.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import dot, length

SHARE_OF_WAY = 0.45
"""Part of the way to a neighbour over which a field acts: less than half, as the neighbour may come nearer too."""

WIDEST_M = 5.0
LONGEST_M = 20.0
"""Limits where no neighbour is near: more than a body moves in a frame."""

_PAIRS_AT_ONCE = 2_000_000


@dataclass(frozen=True, eq=False, slots=True)
class FieldReach:
    """Cylinders about the centres of k bodies: radii (k,), lengths (k,) along the direction and against it."""

    radii_m: np.ndarray
    ahead_m: np.ndarray
    behind_m: np.ndarray

    def contain(self, moves_m: np.ndarray, directions: np.ndarray) -> np.ndarray:
        """Return whether bodies moved by (k, 3), m, are still inside their cylinders about directions (k, 3)."""
        along = dot(moves_m, directions)
        across = length(moves_m - along[:, None] * directions)
        return (across < self.radii_m) & (along < self.ahead_m) & (along > -self.behind_m)


def isolating_reaches(bodies: np.ndarray, directions: np.ndarray, centres: np.ndarray) -> FieldReach:
    """Return cylinders about k bodies of which none contains the centre of another body.

    Each of the bodies (k,) is pushed along a unit vector (k, 3); all n bodies have centres of mass (n, 3), m.
    """
    reaches = FieldReach(*(np.full(len(bodies), limit_m) for limit_m in (WIDEST_M, LONGEST_M, WIDEST_M)))
    rows = max(1, _PAIRS_AT_ONCE // max(1, len(centres)))
    for first in range(0, len(bodies), rows):
        block = slice(first, first + rows)
        between = centres[None] - centres[bodies[block], None]
        squares = dot(between, between)
        squares[np.arange(len(squares)), bodies[block]] = np.inf
        along = dot(between, directions[block, None])
        radii = np.minimum(WIDEST_M, SHARE_OF_WAY * np.sqrt(squares.min(axis=1, initial=np.inf)))
        in_line = squares - np.square(along) < np.square(2.0 * radii[:, None])
        # It may come nearer from the side as well.
        ahead = np.where(in_line & (along > 0.0), along, np.inf).min(axis=1, initial=np.inf)
        behind = np.where(in_line & (along <= 0.0), -along, np.inf).min(axis=1, initial=np.inf)
        reaches.radii_m[block] = radii
        reaches.ahead_m[block] = np.minimum(LONGEST_M, SHARE_OF_WAY * ahead)
        reaches.behind_m[block] = np.minimum(WIDEST_M, SHARE_OF_WAY * behind)
    return reaches
