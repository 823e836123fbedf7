"""A scenario: the bridge, how it is broken into shards and what hits it, as checked values.

x runs along the road with the axis of the first pier at 0, y across it with 0 in its middle, z up with the ground at 0.
The deck lies on the pier caps, or on the piers where there are no caps.
"""

import math
from dataclasses import dataclass, field
from typing import ClassVar

from .errors import ScenarioError
from .scenario_key import LARGEST_INTEGER, Table, key
from .strength import MATERIALS
from .time_step import TimeStep

STANDARD_GRAVITY_M_S2 = 9.80665
"""Standard acceleration of free fall, exact; 1 kgf is the weight of 1 kg under it."""

MOST_FRAMES = 1_000_000
"""Blender's timeline ends at frame 1 048 574; a run needs a few frames of it before time begins."""

SHORTEST_LENGTH_M = 0.001
"""Least size of anything solid: Bullet cannot tell contacts apart on bodies that are smaller still."""

ROUNDING = 1e-9
"""Relative slack where lengths are compared that a user would add up in decimals."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSettings(Table):
    """How long is simulated, and in which steps."""

    table: ClassVar[str] = "time"

    duration_s: float = key("Simulated time.", unit="s", above=0)
    frames_per_second: int = key("Blender's frame rate.", default=24, unit="1/s", at_least=1, at_most=32767)
    frames_per_second_base: float = key(
        "Divisor of the frame rate: 30 with a base of 1.001 is 29.97 frames per second.",
        default=1.0,
        above=0,
        at_most=1_000_000,
    )
    substeps_per_frame: int = key("Steps of the physics in one frame.", default=10, at_least=1, at_most=1000)
    solver_iterations: int = key(
        "Passes over all connections and contacts in one sub-step; more make a stiffer bridge.",
        default=10,
        at_least=1,
        at_most=1000,
    )
    time_scale: float = key(
        "Simulated seconds in one second of animation: below 1 is slow motion.", default=1.0, above=0, at_most=100
    )

    @property
    def step(self) -> TimeStep:
        """Frames and sub-steps that these settings give."""
        return TimeStep(self.frames_per_second, self.frames_per_second_base, self.substeps_per_frame, self.time_scale)

    @property
    def frames(self) -> int:
        """Whole frames that cover the duration."""
        return self.step.frames(self.duration_s)

    def _check_together(self) -> None:
        if self.duration_s / self.step.frame_s > MOST_FRAMES or not 1 <= self.frames <= MOST_FRAMES:
            raise ScenarioError(
                f"time.duration_s is {self.duration_s}: expected 1 to {MOST_FRAMES} frames, "
                f"each of {self.step.frame_s:.3g} s"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Deck(Table):
    """The deck: one slab over all spans."""

    table: ClassVar[str] = "bridge.deck"

    width_m: float = key("Width across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    thickness_m: float = key("Thickness of the slab.", unit="m", at_least=SHORTEST_LENGTH_M)
    overhang_m: float = key(
        "Length of deck beyond the axes of the first and of the last pier.", default=0.0, unit="m", at_least=0
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Piers(Table):
    """The piers: one under each end of each span, made of equal columns that stand on the ground."""

    table: ClassVar[str] = "bridge.piers"

    columns: int = key("Columns of one pier, spread evenly across the road.", default=1, at_least=1, at_most=1000)
    column_length_m: float = key("Size of a column along the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    column_width_m: float = key("Size of a column across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float = key("Height of a column above the ground.", unit="m", at_least=SHORTEST_LENGTH_M)


@dataclass(frozen=True, slots=True, kw_only=True)
class PierCaps(Table):
    """The pier caps: one beam on the columns of each pier. Without them the deck lies on the columns."""

    table: ClassVar[str] = "bridge.pier_caps"

    length_m: float = key("Size along the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    width_m: float = key("Size across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float = key("Height of the beam.", unit="m", at_least=SHORTEST_LENGTH_M)


@dataclass(frozen=True, slots=True, kw_only=True)
class Bridge(Table):
    """The bridge: spans between piers, and exactly one of density and total mass."""

    table: ClassVar[str] = "bridge"

    span_lengths_m: tuple[float, ...] = key(
        "Lengths of the spans, in their order along the road, each from pier axis to pier axis.",
        unit="m",
        at_least=SHORTEST_LENGTH_M,
    )
    density_kg_m3: float | None = key(
        "Density of the whole bridge. Give this or `mass_kg`.", default=None, unit="kg/m³", above=0
    )
    mass_kg: float | None = key(
        "Mass of the whole bridge, from which one density follows. Give this or `density_kg_m3`.",
        default=None,
        unit="kg",
        above=0,
    )
    deck: Deck
    piers: Piers
    pier_caps: PierCaps | None = None

    @property
    def spans_m(self) -> float:
        """Distance from the axis of the first pier to the axis of the last, m."""
        return math.fsum(self.span_lengths_m)

    @property
    def length_m(self) -> float:
        """Length of the deck, m."""
        return self.spans_m + 2.0 * self.deck.overhang_m

    def _check_together(self) -> None:
        _check_exactly_one(self, "density_kg_m3", "mass_kg")
        self._check_room_along()
        self._check_room_across()

    def _check_room_along(self) -> None:
        shortest = min(self.span_lengths_m)
        lengths = {"bridge.piers.column_length_m": self.piers.column_length_m}
        if self.pier_caps:
            lengths["bridge.pier_caps.length_m"] = self.pier_caps.length_m
        for name, length in lengths.items():
            if length >= shortest:
                raise ScenarioError(f"{name} is {length}: expected less than the shortest span, {shortest} (m)")

    def _check_room_across(self) -> None:
        carried = self.pier_caps or self.deck
        widest = carried.width_m / self.piers.columns
        if self.piers.column_width_m > widest * (1.0 + ROUNDING):
            raise ScenarioError(
                f"bridge.piers.column_width_m is {self.piers.column_width_m}: expected at most {widest:.6g} (m), "
                f"so that the columns fit into {carried.table}.width_m"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground(Table):
    """The ground: flat and unyielding."""

    table: ClassVar[str] = "ground"

    friction: float = key("Coefficient of friction.", default=0.8, at_least=0)
    restitution: float = key("Share of the speed kept in a bounce.", default=0.0, at_least=0, at_most=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class FractureSettings(Table):
    """How finely the bridge is cut."""

    table: ClassVar[str] = "fracture"

    shards: int = key("Number of shards of the whole bridge.", at_least=1, at_most=1_000_000)


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionSettings(Table):
    """Which shards are connected, how, and what breaks a connection."""

    table: ClassVar[str] = "connections"

    type: str = key(
        "Kind of rigid-body constraint: `FIXED` holds everything, `POINT` a point, `HINGE` all but one rotation.",
        default="HINGE",
        choices=("FIXED", "POINT", "HINGE"),
    )
    method: str = key(
        "Which shards are connected: those whose nearest vertices (`vertex`) or centres of mass (`centre`) lie within "
        "`search_radius_m`, or those that share a face (`face`).",
        default="vertex",
        choices=("vertex", "centre", "face"),
    )
    search_radius_m: float | None = key(
        "Distance up to which shards are connected. Needed for `vertex` and `centre`, not taken for `face`.",
        default=None,
        unit="m",
        above=0,
    )
    limit_per_shard: int = key(
        "Most connections of one shard; the nearest are kept.", default=50, at_least=1, at_most=LARGEST_INTEGER
    )
    breaking_force_n: float | None = key(
        "Force that breaks a connection. Give this or `breaking_force_kgf`.", default=None, unit="N", above=0
    )
    breaking_force_kgf: float | None = key(
        "Force that breaks a connection, 1 kgf = 9.80665 N. Give this or `breaking_force_n`.",
        default=None,
        unit="kgf",
        above=0,
    )
    material: str | None = key(
        "Material by whose strengths a connection breaks, under axial force, shear and bending together; with method "
        "`face`, as it takes the area of the shared face. Give this, `breaking_force_n` or `breaking_force_kgf`.",
        default=None,
        choices=tuple(MATERIALS),
    )
    ductile_share: float = key(
        "Part of a material's tensile strength that a connection keeps when it breaks, as reinforcement across the "
        "crack; 0 for none.",
        default=0.0,
        at_least=0,
        at_most=1,
    )
    ductile_elongation_m: float | None = key(
        "How far the crack opens before the reinforcement lets go. Needed with `ductile_share`, not taken without.",
        default=None,
        unit="m",
        above=0,
    )
    warm_up_s: float = key(
        "Time from the start in which no connection breaks, so that the bridge settles under its own weight.",
        default=0.0,
        unit="s",
        at_least=0,
    )
    foundation: bool = key("Whether shards that stand on the ground are connected to it.", default=True)

    @property
    def breaking_force_newton(self) -> float | None:
        """Force that breaks a connection, N, whichever unit it was given in; None for a material."""
        if self.material is not None:
            return None
        if self.breaking_force_n is not None:
            return self.breaking_force_n
        return self.breaking_force_kgf * STANDARD_GRAVITY_M_S2

    def _check_together(self) -> None:
        _check_exactly_one(self, "breaking_force_n", "breaking_force_kgf", "material")
        if self.material is not None and self.method != "face":
            raise ScenarioError(
                f'connections.material is "{self.material}": expected method "face" with it, found "{self.method}"'
            )
        if self.ductile_share > 0.0 and self.material is None:
            raise ScenarioError(
                f"connections.ductile_share is {self.ductile_share}: expected 0 where connections.material is not given"
            )
        if (self.ductile_share > 0.0) != (self.ductile_elongation_m is not None):
            raise ScenarioError(
                f"connections.ductile_elongation_m is {self.ductile_elongation_m}: expected a number above 0 (m) with "
                f"a connections.ductile_share above 0, and none with {self.ductile_share}"
            )
        if self.method == "face" and self.search_radius_m is not None:
            raise ScenarioError(
                f'connections.search_radius_m is {self.search_radius_m}: expected none with method "face"'
            )
        if self.method != "face" and self.search_radius_m is None:
            raise ScenarioError(
                f'connections.search_radius_m is missing: expected a number above 0 (m) with method "{self.method}"'
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class ShardSettings(Table):
    """Surface, damping and rest of the shards."""

    table: ClassVar[str] = "shards"

    friction: float = key("Coefficient of friction.", default=0.6, at_least=0)
    restitution: float = key("Share of the speed kept in a bounce.", default=0.0, at_least=0, at_most=1)
    collision_margin_m: float = key(
        "Distance at which shards already touch.", default=0.0, unit="m", at_least=0, at_most=1
    )
    linear_damping: float = key("Share of the velocity lost in one second.", default=0.04, at_least=0, at_most=1)
    angular_damping: float = key(
        "Share of the angular velocity lost in one second.", default=0.1, at_least=0, at_most=1
    )
    use_deactivation: bool = key("Whether shards at rest fall asleep until something hits them.", default=True)
    start_deactivated: bool = key(
        "Whether shards sleep until something hits them; needs `use_deactivation`.", default=True
    )
    deactivation_linear_velocity_m_s: float = key(
        "Velocity below which a shard is at rest.", default=0.4, unit="m/s", at_least=0
    )
    deactivation_angular_velocity_rad_s: float = key(
        "Angular velocity below which a shard is at rest.", default=0.5, unit="rad/s", at_least=0
    )

    def _check_together(self) -> None:
        if self.start_deactivated and not self.use_deactivation:
            raise ScenarioError(
                "shards.start_deactivated is true: expected false where shards.use_deactivation is false"
            )


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


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingSettings(Table):
    """What is taken down while the simulation runs."""

    table: ClassVar[str] = "recording"

    every_substep: bool = key(
        "Whether loads are read after every sub-step, which gives their means, peaks and impulses, or only after the "
        "last one of each frame, which is faster and misses most of an impact.",
        default=True,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureSettings(Table):
    """Size of the pictures."""

    table: ClassVar[str] = "pictures"

    width_px: int = key("Width.", default=1280, unit="px", at_least=16, at_most=8192)
    height_px: int = key("Height.", default=720, unit="px", at_least=16, at_most=8192)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario(Table):
    """A whole scenario: everything that a run depends on."""

    table: ClassVar[str] = "scenario"

    title: str = key("Title of the results.")
    seed: int = key(
        "Start of the random numbers: the same seed cuts the same shards.",
        default=0,
        at_least=0,
        at_most=LARGEST_INTEGER,
    )
    time: TimeSettings
    bridge: Bridge
    ground: Ground = field(default_factory=Ground)
    fracture: FractureSettings
    connections: ConnectionSettings
    shards: ShardSettings = field(default_factory=ShardSettings)
    ball: Ball | None = None
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    pictures: PictureSettings = field(default_factory=PictureSettings)

    def _check_together(self) -> None:
        if self.ball:
            self._check_release(self.ball)
            self._check_target(self.ball)

    def _check_release(self, ball: Ball) -> None:
        if self.time.step.frames(ball.release_time_s) >= self.time.frames:
            raise ScenarioError(
                f"ball.release_time_s is {ball.release_time_s}: "
                f"expected less than time.duration_s, {self.time.duration_s} (s), "
                f"by a frame of {self.time.step.frame_s:.3g} s"
            )

    def _check_target(self, ball: Ball) -> None:
        overhang = self.bridge.deck.overhang_m
        half_width = self.bridge.deck.width_m / 2.0
        deck = ((-overhang, self.bridge.spans_m + overhang), (-half_width, half_width))
        for place, (position, (lowest, highest)) in enumerate(zip(ball.target_m, deck, strict=True)):
            slack = ROUNDING * (highest - lowest)
            if not lowest - slack <= position <= highest + slack:
                raise ScenarioError(
                    f"ball.target_m[{place}] is {position}: "
                    f"expected a place on the deck, from {lowest:.6g} to {highest:.6g} (m)"
                )


def _check_exactly_one(table: Table, *names: str) -> None:
    given = [name for name in names if getattr(table, name) is not None]
    if len(given) != 1:
        state = "given together" if given else "all missing"
        listed = " and ".join(f"{table.table}.{name}" for name in given or names)
        raise ScenarioError(f"{listed} are {state}: expected exactly one of {', '.join(names)}")
