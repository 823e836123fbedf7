"""Tendon cuts: tendons that are cut without the concrete around them."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...engineering.elasticity.tendons import CutTendon
from ...errors import ScenarioError
from ...texts import Text, joined
from ..actions import Fact, Worksite
from ..as_built import Structure, TendonLines
from ..schema import given, key
from .change import Change, Event


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
