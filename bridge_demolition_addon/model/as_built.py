"""Bodies and connections as they were built, among which planned actions select theirs, wherever these are by then."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..engineering.elasticity.tendons import CutTendon, TendonForces, TendonPassages, TendonSteel
from ..engineering.geometry.turned_boxes import TurnedBox


class TendonLines(Protocol):
    """Tendons: what they are, and where they run."""

    @property
    def names(self) -> tuple[str, ...]: ...
    @property
    def members(self) -> tuple[str, ...]: ...
    @property
    def steel(self) -> TendonSteel: ...
    @property
    def passages(self) -> TendonPassages: ...

    def within_box(self, tendon: int, box: TurnedBox) -> float | None:
        """Return the distance along a tendon of the middle of what lies in a box; None where nothing does."""

    def point_at(self, tendon: int, distance_m: float) -> np.ndarray:
        """Return the point (3,) at a distance along a tendon."""

    def forces(self, positions_m: np.ndarray, rotations: np.ndarray) -> TendonForces:
        """Return the forces on n bodies at positions (3, n) in rotations (3, 3, n)."""


@dataclass(frozen=True, eq=False, slots=True)
class Structure:
    """Bodies and connections as they were built."""

    centres_m: np.ndarray  # (n, 3), centres of mass
    masses_kg: np.ndarray  # (n,), 0 for what cannot move
    member_names: np.ndarray  # (n,), of the members that bodies were cut from; empty for one that was not
    member_kinds: np.ndarray  # (n,), as above
    is_shard: np.ndarray  # (n,), shards that can move
    held: np.ndarray  # (n,), shards that never move, as supports hold them
    pairs: np.ndarray  # (m, 2), bodies of the connections
    points_m: np.ndarray  # (m, 3), positions of the connections
    normals: np.ndarray  # (m, 3), unit vectors across their faces
    bearings: np.ndarray  # (b,), connections that are bearings
    boxes_m: np.ndarray  # (n, 2, 3), lowest and highest corners of the bodies
    tendons: TendonLines | None = None

    def connected_to(self, bodies: np.ndarray) -> np.ndarray:
        """Return the connections (c,) of bodies (b,)."""
        return np.flatnonzero(np.isin(self.pairs, bodies).any(axis=1))

    def tendons_cut_with(self, connections: np.ndarray, bodies: np.ndarray) -> tuple[CutTendon, ...]:
        """Return where tendons are cut: in connections (c,) that they pass, or next to bodies (b,) that they are in."""
        return tuple(self.tendons.passages.crossing(connections, bodies)) if self.tendons else ()
