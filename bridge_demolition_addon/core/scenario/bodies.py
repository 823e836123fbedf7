"""Surface, damping and rest of shards and ground, and what never moves besides the ground."""

from dataclasses import dataclass
from typing import ClassVar

from ..schema import Table, key


@dataclass(frozen=True, slots=True, kw_only=True)
class Support(Table):
    """A member, or all members of a kind, that never moves: the whole of it, or its shards on one face."""

    table: ClassVar[str] = "supports"

    member: str = key("Name of a member, such as `abutment 1`, or a kind, such as `pier`; `bda check` lists the names.")
    face: str = key(
        "Which shards: all, or those with a part of the outermost face that looks down, up, backwards along the road "
        "(`start`), forwards (`end`), towards negative y (`right`) or positive y (`left`).",
        default="all",
        choices=("all", "bottom", "top", "start", "end", "right", "left"),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground(Table):
    """The ground: flat and unyielding."""

    table: ClassVar[str] = "ground"

    friction: float = key("Coefficient of friction.", default=0.8, at_least=0)
    restitution: float = key("Share of the speed kept in a bounce.", default=0.0, at_least=0, at_most=1)


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
            raise self.unexpected("start_deactivated", "false where shards.use_deactivation is false")


@dataclass(frozen=True, slots=True, kw_only=True)
class Equipment(Table):
    """A machine that stands on the bridge, such as an excavator. `bda stages` counts its weight on the shards under it;
    a run does not have it."""

    table: ClassVar[str] = "equipment"

    name: str = key("What it is called.")
    mass_kg: float = key("Mass: a crawler excavator has 20 000 to 40 000 kg.", unit="kg", above=0)
    place_m: tuple[float, float] = key("Middle of what it stands on: x, y.", unit="m")
    footprint_m: tuple[float, float] = key(
        "Length along the road and width across it of what it stands on: 4 m × 3 m of a crawler.", unit="m", above=0
    )
    from_s: float = key("Since when it stands there.", default=0.0, unit="s", at_least=0)
    until_s: float | None = key("When it leaves; by default never.", default=None, unit="s", above=0)

    def stands_at(self, time_s: float) -> bool:
        """Whether it stands there from a time on."""
        return self.from_s <= time_s and (self.until_s is None or time_s < self.until_s)

    def _check_together(self) -> None:
        if self.until_s is not None and not self.until_s > self.from_s:
            raise self.unexpected("until_s", f"more than equipment.from_s, {self.from_s:g} (s)")
