"""Cuts in one moment: connections along a plane, by a saw or by explosive, and tendons without their concrete."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...engineering.elasticity.tendons import CutTendon
from ...engineering.geometry.vectors import dot, unit
from ...errors import ScenarioError
from ...texts import Text, joined
from ..actions import CutThrough, Fact, Worksite
from ..as_built import Structure, TendonLines
from ..schema import given, key, shown
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


@dataclass(frozen=True, slots=True, kw_only=True)
class TendonCut(Change):
    """A cut of tendons in one moment, without the concrete around them: of those named, of those in some members, or
    of all, where they run through the box. Without a box an unbonded tendon lets go at its anchorages. Saw cuts,
    removals, severed members and zones that are blasted away cut the tendons that cross them as well.
    """

    table: ClassVar[str] = "tendon_cuts"
    kind: ClassVar[str] = "tendon cut"
    noun: ClassVar[str] = "tendon cut"

    tendons: tuple[str, ...] | None = key("Names of the tendons; by default all.", default=None)

    def facts(self, site: Worksite) -> Iterator[Fact]:
        cuts, tendons = self.event(site.structure).tendons, given(site.structure.tendons)
        yield f"{self.time_s:.3f} s", f"{self.kind}, {_cut_text(cuts, tendons)}"

    def check_model(self, site: Worksite) -> None:
        self.event(site.structure)

    def described(self) -> tuple[str, str]:
        tendons = joined("{}, {}", self.tendons or (Text("all"),))
        return Text("{}: {}", Text(self.kind), tendons), self.where or Text("at their anchorages")

    def event(self, structure: Structure) -> Event:
        cuts = tuple(self._cuts(structure.tendons)) if structure.tendons else ()
        if not cuts:
            raise ScenarioError(
                f"{self.table} at {self.time_s:g} s: no tendon is there; "
                "expected names, members or a box that meet some"
            )
        none = np.zeros(0, int)
        return Event(self, none, none, 1.0, tendons=cuts)

    def _cuts(self, tendons: TendonLines) -> Iterator[CutTendon]:
        for number, (name, member) in enumerate(zip(tendons.names, tendons.members, strict=True)):
            if self.tendons is not None and name not in self.tendons:
                continue
            if self.members is not None and member not in self.members:
                continue
            if self.box is None:
                if tendons.steel.bonded[number]:
                    quoted = json.dumps(name, ensure_ascii=False)
                    wanted = f"both corners of a box, as {quoted} is bonded and lets go only near the cut"
                    raise self.unexpected("lowest_corner_m", wanted)
                yield CutTendon(number, 0.0)
                continue
            at_m = tendons.within_box(number, self.box)
            if at_m is not None:
                yield CutTendon(number, at_m)


def _cut_text(cuts: tuple[CutTendon, ...], tendons: TendonLines) -> str:
    """Return which tendons are cut, where, and which energy they let go, of tendons that were whole."""
    released_j = tendons.forces(*_anywhere(tendons)).cut(cuts)
    parts = []
    for number in sorted({cut.tendon for cut in cuts}):
        at = next(cut.distance_m for cut in cuts if cut.tendon == number)
        x, y, z = tendons.point_at(number, at).tolist()
        parts.append(
            f"{tendons.names[number]} in {tendons.members[number]} at ({x:.2f}, {y:.2f}, {z:.2f}) m, "
            f"{released_j[number] / 1000.0:.1f} kJ let go"
        )
    return "; ".join(parts)


def _anywhere(tendons: TendonLines) -> tuple[np.ndarray, np.ndarray]:
    """Positions (3, n) and rotations (3, 3, n) of as many bodies as tendons pass."""
    count = int(max(tendons.passages.first.max(), tendons.passages.second.max())) + 1
    return np.zeros((3, count)), np.repeat(np.eye(3)[:, :, None], count, axis=2)
