"""The wrecking ball, and the cable that it may swing on."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...engineering.arithmetic import cosine, sine
from ...engineering.geometry.vectors import length, points_along
from ...engineering.timing.timeline import Timeline
from ...engineering.units import STANDARD_GRAVITY_M_S2, mass_text
from ...errors import GeometryError, ScenarioError
from ...texts import Quantity, Text, point_text
from ..actions import Fact, HeightAt, Place, Plan, PlannedAction, PlannedStep, Point, Worksite
from ..schema import FARTHEST_M, POSITION, SHARE, SIZE, Table, expected, given, key
from .contacts import BALL, FRICTION, OWN_VALUE, RESTITUTION, BodyInContact

_USUAL_DENSITY_KG_M3 = (1000.0, 20000.0)
"""From a hollow ball to one of tungsten."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BallCable(Table):
    """A cable from the tip of a crane that the ball swings on, drawn aside and let go at `ball.release_time_s`. It
    stays taut, and neither breaks nor stretches. The ball on it collides with everything, the cable with nothing. With
    it, leave out `ball.target_m`, `ball.drop_height_m` and `ball.hits`.
    """

    table: ClassVar[str] = "ball.cable"

    crane_point_m: tuple[float, float, float] = key("The tip of the crane.", **POSITION)
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
        """Return the middle of the ball before it is let go."""
        angle, azimuth = math.radians(self.angle_degrees), math.radians(self.azimuth_degrees)
        aside = self.length_m * sine(angle)
        offset = (aside * cosine(azimuth), aside * sine(azimuth), -self.length_m * cosine(angle))
        x, y, z = (np.array(self.crane_point_m) + offset).tolist()
        return x, y, z

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
    release_time_s: float
    target_m: tuple[float, float] | None
    drop_height_m: float | None

    @property
    def fall_time_s(self) -> float:
        """Return the time from release to the deck in free fall."""
        return math.sqrt(2.0 * given(self.drop_height_m) / STANDARD_GRAVITY_M_S2)

    @property
    def impact_speed_m_s(self) -> float:
        """Return the speed at the deck after free fall, m/s."""
        return math.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * given(self.drop_height_m))

    def check_release(self, plan: Plan) -> None:
        if plan.timeline.frames_until(self.release_time_s) >= len(plan.timeline):
            time = plan.time
            wanted = f"less than time.duration_s, {time.duration_s} (s), by a frame of {time.step.frame_s:.3g} s"
            raise self.unexpected("release_time_s", wanted)


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
        return self.lift_time_s + self.lift_duration_s

    def check_lift(self, timeline: Timeline) -> None:
        """Check that the ball is still for a frame before it is let go again, so that it falls from rest."""
        earliest = timeline.frames_until(self.lift_end_s) + 1
        if timeline.frames_until(self.release_time_s) < earliest:
            earliest_s = timeline.ends_s[earliest - 1] if earliest <= len(timeline) else self.lift_end_s
            wanted = f"at least {earliest_s:.6g} (s), a frame after the ball was lifted"
            raise self.unexpected("release_time_s", wanted)


@dataclass(frozen=True, slots=True, kw_only=True)
class Ball(_Drop, BodyInContact, PlannedAction):
    """A wrecking ball that is let go above the deck. Without this table there is none."""

    table: ClassVar[str] = "ball"
    contact: ClassVar[str] = BALL
    older_values: ClassVar[Mapping[str, float]] = {FRICTION: 0.5, RESTITUTION: 0.0}
    heading: ClassVar[str] = "Ball"

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
    friction: float | None = key(OWN_VALUE, default=None, at_least=0)
    restitution: float | None = key(OWN_VALUE, default=None, **SHARE)
    angular_damping: float = key(
        "Share of its angular velocity that it loses in one second. Without any, nothing stops a ball that rolls on "
        "flat ground.",
        default=0.0,
        **SHARE,
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
        return (*given(self.target_m), deck_top_m + given(self.drop_height_m) + self.diameter_m / 2.0)

    def largest_height_m(self, deck_top_m: float) -> float:
        """Return the largest height above the ground that the ball is let go from, over a deck of a height, m."""
        if self.cable:
            return self.cable.start_m[2]
        return deck_top_m + max(given(drop.drop_height_m) for drop in self.drops)

    @property
    def density_kg_m3(self) -> float:
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

    @property
    def held_by_machine(self) -> str | None:
        return self.cable.table if self.cable else None

    def begins_s(self, plan: Plan) -> float:
        """Return the time a frame before free fall brings it to the bridge, or at which it begins to swing."""
        fall_s = 0.0 if self.cable else self.fall_time_s - plan.time.step.frame_s
        return self.release_time_s + max(fall_s, 0.0)

    def ends_s(self, plan: Plan) -> float:
        return max(self.release_time_s, *(drop.release_time_s + drop.fall_time_s for drop in self.drops), 0.0)

    def scaled_in_time(self, factor: float) -> Self:
        hits = tuple(
            replace(
                hit,
                lift_time_s=hit.lift_time_s * factor,
                lift_duration_s=hit.lift_duration_s * factor,
                release_time_s=hit.release_time_s * factor,
            )
            for hit in self.hits
        )
        return replace(self, release_time_s=self.release_time_s * factor, hits=hits)

    def targets(self) -> Iterator[tuple[str, Place]]:
        return ((f"{drop.table}.target_m", given(drop.target_m)) for drop in self.drops)

    def starts_above(self) -> tuple[Place, ...]:
        return tuple(given(drop.target_m) for drop in self.drops)

    def points_of_interest(self, height_at: HeightAt) -> Iterator[Point]:
        """Yield where it is let go, and the tip of the crane."""
        for drop in self.drops:
            target = given(drop.target_m)
            yield (*target, height_at(target) + given(drop.drop_height_m) + self.diameter_m)
        if self.cable:
            yield self.cable.start_m
            yield self.cable.crane_point_m

    def planned(self, plan: Plan) -> Iterator[PlannedStep]:
        mass = mass_text(self.mass_kg, 1)
        if self.cable:
            what = Text("ball of {} is let go on its cable", mass)
            yield PlannedStep(self.release_time_s, self.release_time_s, what, "")
        for drop in self.drops:
            what = Text("ball of {} is let go, {} above the deck", mass, Quantity(given(drop.drop_height_m), "m", "g"))
            lands_s = drop.release_time_s + drop.fall_time_s
            yield PlannedStep(drop.release_time_s, lands_s, what, Text("above {}", point_text(given(drop.target_m))))

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        (ball,) = actions
        times = max(len(ball.drops), 1)
        mass = mass_text(ball.mass_kg, 1)
        return Text("ball of {}, let go once", mass) if times == 1 else Text("ball of {}, let go {} times", mass, times)

    def facts(self, site: Worksite) -> Iterator[Fact]:
        yield "mass", mass_text(self.mass_kg)
        yield "diameter", f"{self.diameter_m:.2f} m, so {self.density_kg_m3:.0f} kg/m³"
        if self.cable:
            yield from self._swing_facts(self.cable)
        else:
            yield from self._drop_facts(site.plan.time.duration_s)

    def _swing_facts(self, cable: BallCable) -> Iterator[Fact]:
        yield "cable", f"{cable.length_m:.2f} m, let go {cable.angle_degrees:g}° from the vertical"
        lowest = ", ".join(f"{value:.2f}" for value in cable.lowest_point_m)
        period_s = cable.period_s(self.diameter_m)
        at_s = self.release_time_s + period_s / 4
        yield "swing to and fro", f"{period_s:.3f} s, at its lowest ({lowest}) m at {at_s:.3f} s"
        yield "largest speed", f"{cable.largest_speed_m_s:.2f} m/s"
        yield "largest energy", f"{self.mass_kg * cable.largest_speed_m_s * cable.largest_speed_m_s / 2000.0:.1f} kJ"

    def _drop_facts(self, duration_s: float) -> Iterator[Fact]:
        impact_s = self.release_time_s + self.fall_time_s
        late = ", after the end of the run" if impact_s > duration_s else ""
        yield "clear drop height", f"{self.drop_height_m:.2f} m"
        yield "fall time", f"{self.fall_time_s:.3f} s, so it hits the deck at {impact_s:.3f} s{late}"
        yield "impact speed", f"{self.impact_speed_m_s:.2f} m/s"
        for number, hit in enumerate(self.hits, start=2):
            yield f"hit {number}", f"at {hit.release_time_s + hit.fall_time_s:.3f} s, {hit.impact_speed_m_s:.2f} m/s"
        yield "impact energy", f"{self.mass_kg * self.impact_speed_m_s * self.impact_speed_m_s / 2000.0:.1f} kJ"

    def unusual(self, site: Worksite) -> Iterator[str]:
        if not _USUAL_DENSITY_KG_M3[0] <= self.density_kg_m3 <= _USUAL_DENSITY_KG_M3[1]:
            yield Text(
                "The ball of {} and {} has {}; steel has {}",
                Quantity(self.mass_kg, "kg", ".4g"),
                Quantity(self.diameter_m, "m", ".4g"),
                Quantity(self.density_kg_m3, "kg/m³", ".3g"),
                Quantity("7850", "kg/m³", shown=False),
            )
        if self.mass_kg > site.mass_kg:
            yield Text("The ball is {} times as heavy as the bridge", f"{self.mass_kg / site.mass_kg:.3g}")

    def check_plan(self, plan: Plan) -> None:
        """Check that it is let go within the run, is up before it is let go again, and swings above flat ground."""
        for drop in (self, *self.hits):
            drop.check_release(plan)
        if self.cable and plan.has_flat_ground:
            self.check_swing(0.0)
        for hit in self.hits:
            hit.check_lift(plan.timeline)

    def check_model(self, site: Worksite) -> None:
        """Check that it begins clear of every member, as Bullet would throw them apart, and swings above the ground."""
        if self.cable:
            self.check_swing(site.ground_height(self.cable.lowest_point_m[:2]))
        heights_m = [site.surface_height(position) for position in self.starts_above()]
        centre_m = self.start_m(heights_m[0] if heights_m else 0.0)
        member = site.member_within(centre_m, self.diameter_m / 2.0)
        if member is not None:
            where = ", ".join(f"{value:g}" for value in centre_m)
            raise GeometryError(
                f"The ball begins within member {member!r}, with its middle at [{where}] (m); give it another "
                f"{'cable, or draw it aside farther' if self.cable else 'target or drop height'}."
            )

    def check_swing(self, ground_m: float) -> None:
        """Make sure that a ball on a cable swings above ground of a height, m."""
        cable = given(self.cable)
        lowest_m = cable.lowest_point_m[2] - self.diameter_m / 2.0
        if lowest_m <= ground_m:
            wanted = f"a ball that swings above the ground, its lowest point is at {lowest_m:.6g} (m)"
            raise cable.unexpected("length_m", wanted)


def lift_path(start_m: ArrayLike, end_m: ArrayLike, shares: np.ndarray) -> np.ndarray:
    """Return the positions (k, 3) of a lifted ball, m: straight up, then level to its next drop.

    It goes up by the way that it came down. Its speed rises from 0 and falls to 0 again, with 3 s² - 2 s³ of the way
    after the share s of the time (k,), and is at most 1.5 times the mean: what lies on the ball is pushed off, not
    flung.
    """
    start, end = np.asarray(start_m, float), np.asarray(end_m, float)
    path = np.array([start, [*start[:2], end[2]], end])
    time = np.asarray(shares, float)
    return points_along(path, time * time * (3.0 - 2.0 * time) * length(np.diff(path, axis=0)).sum())
