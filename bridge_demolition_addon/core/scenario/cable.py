"""The cable that a wrecking ball swings on."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arithmetic import cosine, sine
from ..schema import SHORTEST_LENGTH_M, Table, key
from ..units import STANDARD_GRAVITY_M_S2


@dataclass(frozen=True, slots=True, kw_only=True)
class BallCable(Table):
    """A cable from the tip of a crane that the ball swings on, drawn aside and let go at `ball.release_time_s`. It
    stays taut, and neither breaks nor stretches. The ball on it collides with everything, the cable with nothing. With
    it, leave out `ball.target_m`, `ball.drop_height_m` and `ball.hits`.
    """

    table: ClassVar[str] = "ball.cable"

    crane_point_m: tuple[float, float, float] = key("The tip of the crane.", unit="m")
    length_m: float = key("Length from there to the middle of the ball.", unit="m", at_least=SHORTEST_LENGTH_M)
    angle_degrees: float = key("Angle from the vertical at which it is let go.", above=0, at_most=90)
    azimuth_degrees: float = key(
        "To which side it is drawn: 0 along the road, 90 across it, towards positive y. It swings to the other side.",
        default=0.0,
        at_least=-360,
        at_most=360,
    )

    @property
    def start_m(self) -> tuple[float, float, float]:
        """Return the middle of the ball before it is let go, m."""
        angle, azimuth = math.radians(self.angle_degrees), math.radians(self.azimuth_degrees)
        aside = self.length_m * sine(angle)
        offset = (aside * cosine(azimuth), aside * sine(azimuth), -self.length_m * cosine(angle))
        return tuple((np.array(self.crane_point_m) + offset).tolist())

    @property
    def lowest_point_m(self) -> tuple[float, float, float]:
        """Return the middle of the ball at its lowest, m."""
        x, y, z = self.crane_point_m
        return x, y, z - self.length_m

    @property
    def largest_speed_m_s(self) -> float:
        """Return the speed at the lowest point, m/s."""
        height_m = self.start_m[2] - self.lowest_point_m[2]
        return math.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * height_m)

    def period_s(self, diameter_m: float) -> float:
        """Return the time of one swing to and fro of a ball of a diameter, s.

        The ball turns with the cable, as one solid with the moment of inertia m L² + 2/5 m r². For amplitude, the
        complete elliptic integral by the arithmetic-geometric mean.

        References
        ----------
        C. G. Carvalhaes, P. Suppes (2008), American Journal of Physics 76, 1150-1154: T = T₀ / agm(1, cos θ/2).
        """
        arm_m = self.length_m + 0.1 * diameter_m**2 / self.length_m
        mean, other = 1.0, float(cosine(math.radians(self.angle_degrees) / 2.0))
        while mean - other > np.finfo(float).eps * 4.0:
            mean, other = (mean + other) / 2.0, math.sqrt(mean * other)
        return 2.0 * math.pi * math.sqrt(arm_m / STANDARD_GRAVITY_M_S2) / mean
