"""Saw cuts: connections that are cut along a plane, by a saw or by explosive."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...engineering.geometry.vectors import dot, unit
from ...errors import ScenarioError
from ..actions import CutThrough
from ..as_built import Structure
from ..schema import key, shown
from .change import Change, Event

_ALONG = math.sqrt(0.5)
"""Cosine of the angle between a plane and a face up to which the plane runs along the face: 45°."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SawCut(Change):
    """A saw cut through a plane: in one moment it cuts the connections between shards on its two sides, of the members
    and in the box, or everywhere. The members are cut along the plane before they are made into shards, so that each
    side weighs what the plane leaves it, and lies on its own bearings. A box chooses faces by their middles.
    """

    table: ClassVar[str] = "saw_cuts"
    kind: ClassVar[str] = "saw cut"
    noun: ClassVar[str] = "saw cut"

    point_m: tuple[float, float, float] = key("A point of the plane.", unit="m")
    normal: tuple[float, float, float] = key("Direction across the plane, of any length but 0.")
    along: str = key(
        "What the cut follows: `plane` cuts shards apart along it; `faces` goes around shards, in steps, and so do all "
        "cuts through steelwork and members with `fracture.points`.",
        default="plane",
        choices=("plane", "faces"),
    )

    def _check_together(self) -> None:
        Change._check_together(self)
        if not any(self.normal):
            raise ScenarioError(f"{self.table}.normal is {shown(self.normal)}, all 0: expected a direction")

    def cut_planes(self) -> tuple[CutThrough, ...]:
        if self.along == "faces":
            return ()
        return (CutThrough(self.members, self.point_m, self.normal, self.box),)

    def event(self, structure: Structure) -> Event:
        connections = np.flatnonzero(self._connections(structure) & self._parts(structure))
        self._check_concerns(connections, "connection", structure)
        bodies = np.zeros(0, int)
        return Event(self, bodies, connections, 0.0, tendons=structure.tendons_cut_with(connections, bodies))

    def _parts(self, structure: Structure) -> np.ndarray:
        """Return whether it parts each connection (m,), whose bodies lie on the two sides of its plane.

        Within the members it parts all of them. A bearing, or what joins the members to others, is parted only by a
        plane that runs along its face: a deck that is sawn lengthways stays on its bearings, wherever their middles
        are.
        """
        within = self.of_members(structure)[structure.pairs].all(axis=1)
        within[structure.bearings] = False
        along = np.abs(dot(structure.normals, unit(np.array(self.normal)))) > _ALONG
        return (within | along) & self._crosses(structure)

    def _crosses(self, structure: Structure) -> np.ndarray:
        """Return whether the two bodies of each connection (m,) lie on the two sides of the plane.

        The ground has no meaningful centre: the shard's, mirrored in the connection's point, stands for it.
        """
        ends = structure.centres_m[structure.pairs]
        solid = (structure.is_shard | structure.held)[structure.pairs]
        mirrored = 2.0 * structure.points_m[:, None] - ends[:, ::-1]
        ends = np.where(solid[:, :, None], ends, mirrored)
        sides = dot(ends - np.array(self.point_m), np.array(self.normal)) > 0.0
        return sides[:, 0] != sides[:, 1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Severing(SawCut):
    """A member that explosive severs along a plane. It follows from a table of `[[cuts]]`, and is no table of a
    scenario; a scene keeps it.
    """

    table: ClassVar[str] = "severings"
    kind: ClassVar[str] = "severed member"
