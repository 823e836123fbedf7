"""The wrecking ball, and the cable that it may swing on."""

import math
from dataclasses import dataclass, fields
from typing import ClassVar

import numpy as np

from ...engineering.arithmetic import cosine, sine
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..schema import FARTHEST_M, SIZE, Table, expected, key


@dataclass(frozen=True, slots=True, kw_only=True)
class BallCable(Table):
    """A cable from the tip of a crane that the ball swings on, drawn aside and let go at `ball.release_time_s`. It
    stays taut, and neither breaks nor stretches. The ball on it collides with everything, the cable with nothing. With
    it, leave out `ball.target_m`, `ball.drop_height_m` and `ball.hits`.
    """

    table: ClassVar[str] = "ball.cable"

    crane_point_m: tuple[float, float, float] = key(
        "The tip of the crane.", unit="m", at_least=-FARTHEST_M, at_most=FARTHEST_M
    )
    length_m: float = key("Length from there to the middle of the ball.", **SIZE)
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
        arm_m = self.length_m + 0.1 * diameter_m * diameter_m / self.length_m
        mean, other = 1.0, float(cosine(math.radians(self.angle_degrees) / 2.0))
        while mean - other > np.finfo(float).eps * 4.0:
            mean, other = (mean + other) / 2.0, math.sqrt(mean * other)
        return 2.0 * math.pi * math.sqrt(arm_m / STANDARD_GRAVITY_M_S2) / mean


class _Drop(Table):
    """Base of the tables of a ball that falls from a height above the deck."""

    __slots__ = ()

    @property
    def fall_time_s(self) -> float:
        """Return the time from release to the deck in free fall, s."""
        return math.sqrt(2.0 * self.drop_height_m / STANDARD_GRAVITY_M_S2)

    @property
    def impact_speed_m_s(self) -> float:
        """Return the speed at the deck after free fall, m/s."""
        return math.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * self.drop_height_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class BallHit(_Drop):
    """A further hit of the ball, in order of time. Animation lifts it from where it lies: straight up to the height of
    its next drop, and from there level to above the target, at no more than 1.5 times the mean speed. Then it stays
    there until it is let go.
    """

    table: ClassVar[str] = "ball.hits"

    lift_time_s: float = key("When lifting begins, once the ball has fallen from its hit before.", unit="s", at_least=0)
    lift_duration_s: float = key("How long lifting takes.", default=3.0, unit="s", above=0)
    release_time_s: float = key(
        "When it is let go again: a frame after it was lifted or later, and before `time.duration_s` is over.",
        unit="s",
        at_least=0,
    )
    target_m: tuple[float, float] = key(
        "Where it hits the deck: along the road from the first pier's axis, and across it from its middle.", unit="m"
    )
    drop_height_m: float = key(
        "Clear height between the ball and the deck below it.", unit="m", above=0, at_most=FARTHEST_M
    )

    @property
    def lift_end_s(self) -> float:
        """Return when the ball is up, s."""
        return self.lift_time_s + self.lift_duration_s


@dataclass(frozen=True, slots=True, kw_only=True)
class Ball(_Drop):
    """A wrecking ball that is let go above the deck. Without this table there is none."""

    table: ClassVar[str] = "ball"

    mass_kg: float = key("Mass.", unit="kg", above=0)
    diameter_m: float = key("Diameter.", **SIZE)
    target_m: tuple[float, float] | None = key(
        "Where it hits the deck: along the road from the first pier's axis, and across it from its middle. Needed "
        "without `ball.cable`.",
        default=None,
        unit="m",
    )
    drop_height_m: float | None = key(
        "Clear height between the ball and the deck below it. Needed without `ball.cable`.",
        default=None,
        unit="m",
        above=0,
        at_most=FARTHEST_M,
    )
    release_time_s: float = key(
        "When it is let go; before `time.duration_s` is over.", default=0.5, unit="s", at_least=0
    )
    friction: float = key("Coefficient of friction.", default=0.5, at_least=0)
    restitution: float = key("Share of the speed kept in a bounce.", default=0.0, at_least=0, at_most=1)
    angular_damping: float = key(
        "Share of its spin that it loses in one second. Without any, nothing stops a ball that rolls on flat ground.",
        default=0.0,
        at_least=0,
        at_most=1,
    )
    contact_time_s: float | None = key(
        "How long a hit lasts, for the estimate of its largest force; by default as long as an elastic one of steel on "
        "concrete (Hertz).",
        default=None,
        unit="s",
        above=0,
    )
    hits: tuple[BallHit, ...] = ()
    cable: BallCable | None = None

    @property
    def drops(self) -> tuple["Ball | BallHit", ...]:
        """Return the first hit, which is the ball's own, and all further ones; none of a ball that swings."""
        return () if self.cable else (self, *self.hits)

    def start_m(self, deck_top_m: float) -> tuple[float, float, float]:
        """Return the middle of the ball before it is let go, above a deck of a height, m."""
        if self.cable:
            return self.cable.start_m
        return (*self.target_m, deck_top_m + self.drop_height_m + self.diameter_m / 2.0)

    def largest_height_m(self, deck_top_m: float) -> float:
        """Return the largest height above the ground that the ball is let go from, over a deck of a height, m."""
        if self.cable:
            return self.cable.start_m[2]
        return deck_top_m + max(drop.drop_height_m for drop in self.drops)

    @property
    def density_kg_m3(self) -> float:
        """Return the mass over the volume of the sphere, kg/m³."""
        return self.mass_kg / (math.pi / 6.0 * self.diameter_m * self.diameter_m * self.diameter_m)

    def _check_together(self) -> None:
        if self.cable:
            self._check_cable(self.cable)
            return
        for item in fields(self):
            if item.name in ("target_m", "drop_height_m") and getattr(self, item.name) is None:
                raise self.unexpected(item.name, f"{expected(item)}, or a table [ball.cable]")
        for before, after in zip(self.drops, self.hits, strict=False):
            fallen_s = before.release_time_s + before.fall_time_s
            if after.lift_time_s < fallen_s:
                then = f"when the ball that is let go at {before.release_time_s:g} s reaches the deck"
                raise after.unexpected("lift_time_s", f"at least {fallen_s:.6g} (s), {then}")

    def _check_cable(self, cable: BallCable) -> None:
        for name in ("target_m", "drop_height_m", "hits"):
            if getattr(self, name):
                raise ScenarioError(f"ball.{name} is given together with ball.cable: expected one of the two")

    def check_swing(self, ground_m: float) -> None:
        """Make sure that a ball on a cable swings above ground of a height, m.

        Raises
        ------
        ScenarioError
            It would swing into it.
        """
        lowest_m = self.cable.lowest_point_m[2] - self.diameter_m / 2.0
        if lowest_m <= ground_m:
            wanted = f"a ball that swings above the ground, its lowest point is at {lowest_m:.6g} (m)"
            raise self.cable.unexpected("length_m", wanted)
