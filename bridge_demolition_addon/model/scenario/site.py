"""The site around the bridge: zones, exclusion zone, neighbours, and where on earth it lies."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...engineering.geometry.plan_areas import FEWEST_CORNERS, sides_cross
from ...errors import ScenarioError
from ..schema import Table, key


def check_outline(corners_m: Sequence[tuple[float, float]], name: str) -> None:
    """Check that the corners under a key surround an area in plan, in order around it."""
    if len(corners_m) < FEWEST_CORNERS:
        raise ScenarioError(f"{name} has {len(corners_m)} positions: expected at least {FEWEST_CORNERS}")
    if sides_cross(np.array(corners_m)):
        raise ScenarioError(f"{name}: sides cross or touch each other; expected corners in order around it")


ZONE_KINDS = ("road", "railway", "power line", "pipeline", "building", "water", "other")


@dataclass(frozen=True, slots=True, kw_only=True)
class Zone(Table):
    """A zone that the report watches: what enters it, and when. It does not take part in the simulation."""

    table: ClassVar[str] = "zones"

    name: str = key("What it is called in the report.")
    kind: str = key("What lies there.", default="other", choices=ZONE_KINDS)
    corners_m: tuple[tuple[float, float], ...] = key(
        "Corners of the zone in plan, x and y of each, in order around it; three or more, and its sides do not cross.",
        unit="m",
    )
    bottom_m: float | None = key(
        "Lowest height that belongs to it; without it, all the way down.", default=None, unit="m"
    )
    top_m: float | None = key("Largest height that belongs to it; without it, all the way up.", default=None, unit="m")

    def _check_together(self) -> None:
        check_outline(self.corners_m, "zones.corners_m")
        if self.bottom_m is not None and self.top_m is not None and self.top_m <= self.bottom_m:
            raise self.unexpected("top_m", f"more than zones.bottom_m, {self.bottom_m} (m)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Exclusion(Table):
    """The exclusion zone: plan area, designed drop area, predicted debris area and a buffer around them."""

    table: ClassVar[str] = "exclusion"

    buffer_m: float = key(
        "Width of the buffer around everything else, for what the simulation cannot know, such as pieces smaller than "
        "its shards.",
        unit="m",
        at_least=0,
    )
    designed_drop_m: float = key(
        "Distance around the bridge's plan within which it is designed to drop.", default=0.0, unit="m", at_least=0
    )
    cordon_m: float | None = key(
        "Distance around the bridge's plan that is kept clear of people, such as 300 m: plans and studies state beside "
        "it how far fragments of blast zones fly.",
        default=None,
        unit="m",
        at_least=0,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Site(Table):
    """Where the origin of the scenario lies on earth, for the exclusion zone as GeoJSON."""

    table: ClassVar[str] = "site"

    latitude_deg: float = key("Latitude of the origin, WGS 84.", unit="°", at_least=-89, at_most=89)
    longitude_deg: float = key("Longitude of the origin, WGS 84.", unit="°", at_least=-180, at_most=180)
    bearing_deg: float = key(
        "Direction of the x axis, clockwise from north: 90 for a road that runs from west to east.",
        default=90.0,
        unit="°",
        at_least=-360,
        at_most=360,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Neighbour(Table):
    """A position near the bridge for which the report gives pressure, impulse and ground vibration of the charges."""

    table: ClassVar[str] = "neighbours"

    name: str = key("What it is called in the report.")
    position_m: tuple[float, float, float] = key("Where it is: x, y, z.", unit="m")
    limit_mm_s: float | None = key(
        "Limit of the ground's peak particle velocity there, for the charge plan.", default=None, unit="mm/s", above=0
    )
    limit_db: float | None = key(
        "Limit of the peak air pressure there, for the charge plan: often 115 to 133 dB.",
        default=None,
        unit="dB",
        above=0,
        at_most=200,
    )
