"""The wrecking ball."""

import math
from dataclasses import dataclass
from typing import ClassVar

from ..gravity import STANDARD_GRAVITY_M_S2
from .key import SHORTEST_LENGTH_M, Table, key


@dataclass(frozen=True, slots=True, kw_only=True)
class Ball(Table):
    """A wrecking ball that is let go above the deck. Without this table there is none."""

    table: ClassVar[str] = "ball"

    mass_kg: float = key("Mass.", unit="kg", above=0)
    diameter_m: float = key("Diameter.", unit="m", at_least=SHORTEST_LENGTH_M)
    target_m: tuple[float, float] = key(
        "Where it hits the deck: along the road from the first pier's axis, and across it from its middle.", unit="m"
    )
    drop_height_m: float = key("Clear height between the ball and the deck below it.", unit="m", above=0)
    release_time_s: float = key(
        "When it is let go; before `time.duration_s` is over.", default=0.5, unit="s", at_least=0
    )
    friction: float = key("Coefficient of friction.", default=0.5, at_least=0)
    restitution: float = key("Share of the speed kept in a bounce.", default=0.0, at_least=0, at_most=1)
    contact_time_s: float | None = key(
        "How long a hit lasts, for the estimate of its largest force; by default as long as an elastic one of steel on "
        "concrete (Hertz).",
        default=None,
        unit="s",
        above=0,
    )

    @property
    def density_kg_m3(self) -> float:
        """Mass over the volume of the sphere, kg/m³."""
        return self.mass_kg / (math.pi / 6.0 * self.diameter_m**3)

    @property
    def fall_time_s(self) -> float:
        """Time from release to the deck in free fall, s."""
        return math.sqrt(2.0 * self.drop_height_m / STANDARD_GRAVITY_M_S2)

    @property
    def impact_speed_m_s(self) -> float:
        """Speed at the deck after free fall, m/s."""
        return math.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * self.drop_height_m)
