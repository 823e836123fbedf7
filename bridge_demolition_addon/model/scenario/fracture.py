"""How finely the bridge is cut, and how."""

from dataclasses import dataclass
from typing import ClassVar

from ...errors import ScenarioError
from ..schema import SHARE, Table, check_exactly_one, key

_LEAST_STRETCH, _MOST_STRETCH = 0.01, 100.0
"""Beyond them cells become so thin that nothing of a member is left between two cuts."""

_STRETCH = (
    "How long shards are along the road, across it and upwards, relative to each other: [3, 1, 1] where reinforcement "
    "along the road keeps cracks apart."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberFracture(Table):
    """A member, or all members of a kind, cut in a way of its own. A member's name goes before its kind."""

    table: ClassVar[str] = "fracture.members"

    member: str = key(
        "Name of a member, such as `pier 1 cap`, or a kind, such as `girder`; `bda check` lists the names."
    )
    shards: int | None = key(
        "Number of shards of each such member. Give this, `share` or `stretch` alone.",
        default=None,
        at_least=1,
        at_most=1_000_000,
    )
    share: float | None = key(
        "Part of all shards, `fracture.shards`, that such members get together.", default=None, above=0, at_most=1
    )
    stretch: tuple[float, float, float] | None = key(
        f"{_STRETCH} By default that of all members.", default=None, at_least=_LEAST_STRETCH, at_most=_MOST_STRETCH
    )

    def _check_together(self) -> None:
        if self.shards is None and self.share is None and self.stretch is None:
            raise ScenarioError(
                f'fracture.members for "{self.member}" says nothing: expected shards, share or stretch with it'
            )
        if self.shards is not None or self.share is not None:
            check_exactly_one(self, "shards", "share")


@dataclass(frozen=True, slots=True, kw_only=True)
class FracturePoint(Table):
    """A point that a shard is cut around: the part of its member nearest to it. A member that holds such points is cut
    around them alone, and has one shard for each."""

    table: ClassVar[str] = "fracture.points"

    position_m: tuple[float, float, float] = key(
        "Along the road, across it, above the ground; inside a member.", unit="m"
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Finer(Table):
    """A position around which the bridge is cut finer, such as a charge."""

    table: ClassVar[str] = "fracture.finer"

    position_m: tuple[float, float, float] = key("Along the road, across it, above the ground.", unit="m")
    radius_m: float = key("How far its effect reaches.", unit="m", above=0)
    factor: float = key(
        "How many times as many shards a volume at the position itself gets; falls evenly to 1 at the radius.",
        at_least=1,
        at_most=1000,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class FractureSettings(Table):
    """How finely the bridge is cut, and how."""

    table: ClassVar[str] = "fracture"

    shards: int = key("Number of shards of the whole bridge.", at_least=1, at_most=1_000_000)
    noise: float = key(
        "How far the points that shards are cut around are moved at random, as a part of a shard's mean size; takes "
        "the order out of points of your own.",
        default=0.0,
        label="Irregularity",
        **SHARE,
    )
    stretch: tuple[float, float, float] | None = key(
        f"{_STRETCH} By default as long in all directions, but plates with bars, such as slabs, are cut through their "
        "whole thickness, as they crack.",
        default=None,
        at_least=_LEAST_STRETCH,
        at_most=_MOST_STRETCH,
    )
    margin_m: float = key(
        "Gap between the shards of a member. Masses stay those without it.",
        default=0.0,
        unit="m",
        label="Gap Between Shards",
        **SHARE,
    )
    mass: str = key(
        "Whether a shard's mass goes by its volume, or all shards of a member have the same.",
        default="volume",
        choices=("volume", "uniform"),
    )
    recursion_share: float = key(
        "Part of the shards, chosen at random, that are cut again; there are more than `shards` then.",
        default=0.0,
        label="Share Cut Again",
        **SHARE,
    )
    recursion_shards: int = key(
        "Into how many shards each of them is cut.", default=4, at_least=2, at_most=1000, label="Cut Again Into"
    )
    recursion_smallest_m3: float = key(
        "Volume below which a shard is not cut again.",
        default=0.0,
        unit="m³",
        at_least=0,
        label="Cut Again Down To",
    )
    points_file: str | None = key(
        "Path, from the scenario file's folder, of a CSV file with more points of your own, x, y and z in m in a row; "
        "a first row of names is skipped.",
        default=None,
    )
    painted_file: str | None = key(
        "Path, from the scenario file's folder, of a CSV file that says where the bridge is cut finer: x, y, z in m "
        "and a weight from 0 to 1 in a row, such as the vertices of a painted mesh; in between it is interpolated.",
        default=None,
    )
    painted_factor: float = key(
        "How many times as many shards a volume gets where the weight is 1.", default=5.0, at_least=1, at_most=1000
    )
    members: tuple[MemberFracture, ...] = ()
    points: tuple[FracturePoint, ...] = ()
    finer: tuple[Finer, ...] = ()

    def _check_together(self) -> None:
        names = [member.member for member in self.members]
        for name in names:
            if names.count(name) > 1:
                raise ScenarioError(f'fracture.members.member is "{name}" more than once: expected it once')
