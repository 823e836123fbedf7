"""Zone firings: what drilled charges do to a blast zone, as a change to the structure."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...engineering.drilled_charges.specific_charge import Effect
from ...engineering.geometry.vectors import AXES
from ...errors import ScenarioError
from ...texts import Text, joined
from ..as_built import Structure
from ..schema import key
from .bare_bars import standing_bars
from .change import Change, Event
from .departures import departure_of


@dataclass(frozen=True, slots=True, kw_only=True)
class ZoneFiring(Change):
    """What drilled charges do to a blast zone, the box of a member, when its last row fires. It follows from the zone
    and the model, and is no table of a scenario; a scene keeps it.
    """

    table: ClassVar[str] = "zone_firings"
    kind: ClassVar[str] = "blast zone"

    name: str = key("Name of the zone.")
    along: str = key("Axis that its member runs along.", choices=AXES)
    effect: str = key("What its concrete does.", choices=tuple(effect.value for effect in Effect))
    left: float = key("Part of the strength that its connections have left.", at_least=0, at_most=1)
    left_compression: float | None = key(
        "The same in compression; by default as much.", default=None, at_least=0, at_most=1
    )
    speed_m_s: float = key(
        "Mean speed of shards that are thrown; 0 where they fall as rubble at the foot.", unit="m/s", at_least=0
    )
    cage_tension_n: float = key("What its bars resist in tension.", unit="N", at_least=0)
    cage_compression_n: float = key("What its bars resist in compression.", unit="N", at_least=0)
    bars: float = key("Bars that stand bare once its concrete is gone.", default=0.0, at_least=0)
    bar_diameter_mm: float = key("Their diameter.", default=20.0, unit="mm", above=0, at_most=100)
    bar_yield_n_mm2: float = key("Their yield strength.", default=500.0, unit="N/mm²", above=0, at_most=5000)
    bar_distances_m: tuple[float, float] = key(
        "Distances of the bars from the middle of the section along its two axes, root mean squares.",
        default=(0.0, 0.0),
        unit="m",
        at_least=0,
    )

    @property
    def compression_factor(self) -> float:
        """Return by how much more strength its connections have left in compression."""
        if self.left_compression is None or not self.left:
            return 1.0
        return max(self.left_compression / self.left, 1.0)

    @property
    def takes_away(self) -> bool:
        """Return whether its shards no longer carry, not even where they touch others."""
        return self.effect == Effect.THROWN

    @property
    def step(self) -> str:
        return Text("{} of {}: {}", self.name, joined("{}, {}", self.members or ()), Text(self.effect))

    def recorded(self) -> Mapping[str, Any]:
        return {
            "zone": self.name,
            "effect": self.effect,
            "cage_tension_n": self.cage_tension_n,
            "cage_compression_n": self.cage_compression_n,
        }

    def event(self, structure: Structure) -> Event:
        of_members = self.of_members(structure)
        inside = of_members & self.in_box(structure.centres_m)
        if (inside & structure.held).any():
            raise ScenarioError(
                f"blast_zones {json.dumps(self.name, ensure_ascii=False)}: [[supports]] hold "
                f"{', '.join(self.members or ())} there, which cannot be blasted away; move the zone, or take the "
                "member out of [[supports]] and have connections.foundation hold its foot"
            )
        is_in_zone = inside & structure.is_shard
        bodies = np.flatnonzero(is_in_zone)
        self._check_concerns(bodies, "shard", structure)
        connections, departure = structure.connected_to(bodies), None
        if self.takes_away:
            beside = ~of_members & (structure.is_shard | structure.held)
            departure = departure_of(
                self, structure.centres_m[bodies], structure.boxes_m[bodies], structure.boxes_m[beside]
            )
        return Event(
            self,
            bodies if departure else bodies[:0],
            connections,
            self.left,
            departure,
            standing_bars(self, is_in_zone, structure.pairs, structure.points_m),
            self.compression_factor,
            structure.tendons_cut_with(connections, bodies) if self.left == 0.0 else (),
        )
