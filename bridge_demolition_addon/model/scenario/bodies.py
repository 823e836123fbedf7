"""Surface, damping and rest of shards and ground, and supports."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from ...errors import ScenarioError
from ..schema import POSITION, SHARE, SHORTEST_LENGTH_M, Table, check_exactly_one, key
from .contacts import FRICTION, GROUND, OWN_VALUE, RESTITUTION, SHARDS, SURFACES, BodyInContact
from .site import check_outline


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


_AXES = 3

SURFACE_KINDS = ("water", "river bank", "carriageway", "railway", "other")


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundSurface(BodyInContact):
    """A second surface that never moves, such as water, a river bank or the carriageway below: level within an outline,
    or a mesh. Debris on it is counted by itself. Water is as hard as all else: nothing sinks in it."""

    table: ClassVar[str] = "ground.surfaces"
    contact: ClassVar[str] = SURFACES
    older_values: ClassVar[Mapping[str, float]] = {FRICTION: 0.8, RESTITUTION: 0.0}

    name: str = key("What it is called in reports; a name of its own for each.")
    kind: str = key("What it is.", default="other", choices=SURFACE_KINDS)
    height_m: float | None = key(
        "Height of a level surface. Give this, with `corners_m`, or `file`.", default=None, **POSITION
    )
    corners_m: tuple[tuple[float, float], ...] | None = key(
        "Corners of a level surface in plan, x and y of each, in order around it; three or more.",
        default=None,
        unit="m",
    )
    file: str | None = key(
        "Path of a mesh in place of a level surface: STL, OBJ, PLY, GLB or LandXML, with the `origin`, `bearing_deg`, "
        "`scale` and `up` of `ground`.",
        default=None,
    )
    friction: float | None = key(OWN_VALUE, default=None, at_least=0)
    restitution: float | None = key(OWN_VALUE, default=None, **SHARE)

    def _check_together(self) -> None:
        check_exactly_one(self, "height_m", "file")
        if (self.corners_m is None) != (self.height_m is None):
            raise ScenarioError(
                "ground.surfaces.corners_m and ground.surfaces.height_m: expected both, of a level surface, or neither"
            )
        if self.corners_m is not None:
            check_outline(self.corners_m, "ground.surfaces.corners_m")


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground(BodyInContact):
    """The ground: unyielding, and flat at height 0, by a profile along the road or as a file has it. Columns and
    abutments reach down to it."""

    table: ClassVar[str] = "ground"
    contact: ClassVar[str] = GROUND
    older_values: ClassVar[Mapping[str, float]] = {FRICTION: 0.8, RESTITUTION: 0.0}

    file: str | None = key(
        "Path of the terrain: a mesh (STL, OBJ, PLY, GLB), an ESRI ASCII grid (ASC), points (XYZ, CSV, TXT), a LandXML "
        "surface (XML), a GeoTIFF (TIF), a point cloud (LAS, LAZ) or a model (IFC). Without it the ground is flat.",
        default=None,
    )
    profile_m: tuple[tuple[float, float], ...] | None = key(
        "Heights along the road in place of a file: x and z of two or more points, in their order along the road, as "
        "of banks, a valley or a cutting. Between them it is straight, beyond them level, and across the road the "
        "same, turned with `bridge.skew_deg`.",
        default=None,
        **POSITION,
    )
    surface: str | None = key(
        "Name of the surface in a LandXML file that has several, or of the element in an IFC file, with `*` for any "
        "letters.",
        default=None,
    )
    origin: tuple[float, ...] | None = key(
        "Where the origin of the scenario lies in the file, in its own units: easting, northing and height; by default "
        "0, 0, 0.",
        default=None,
    )
    bearing_deg: float | None = key(
        "Direction of the x axis in the file, clockwise from its north; by default `site.bearing_deg`, or 90: x runs "
        "east.",
        default=None,
        unit="°",
        at_least=-360,
        at_most=360,
    )
    scale: float = key(
        "Metres in one unit of the file: 0.3048 for feet. Left at 1, a file that says its unit itself is in that.",
        default=1.0,
        above=0,
    )
    up: str | None = key(
        "Axis of a mesh file that points up; by default `y` for GLB, and `z` for all others.",
        default=None,
        choices=("y", "z"),
    )
    no_data: float | None = key(
        "Height that stands for no data in a grid; by default what the file says, and all that is no number.",
        default=None,
    )
    tolerance_m: float = key(
        "How far the ground may lie above or below the file's heights where it is made of fewer triangles.",
        default=0.05,
        unit="m",
        at_least=SHORTEST_LENGTH_M,
        at_most=10,
    )
    friction: float | None = key(OWN_VALUE, default=None, at_least=0)
    restitution: float | None = key(OWN_VALUE, default=None, **SHARE)
    surfaces: tuple[GroundSurface, ...] = ()

    def _check_together(self) -> None:
        if self.origin is not None and len(self.origin) != _AXES:
            raise self.unexpected("origin", "3 numbers: easting, northing and height")
        if self.profile_m is not None:
            self._check_profile(self.profile_m)

    @property
    def is_flat(self) -> bool:
        """Whether it is level at height 0 everywhere, but for surfaces on it."""
        return self.file is None and self.profile_m is None

    def _check_profile(self, points_m: tuple[tuple[float, float], ...]) -> None:
        if self.file is not None:
            raise ScenarioError("ground.file and ground.profile_m are given together: expected one of them")
        if len(points_m) < 2:
            raise self.unexpected("profile_m", "two points at least, x and z of each")
        for (before, _), (after, _) in pairwise(points_m):
            if after <= before:
                raise self.unexpected(
                    "profile_m", f"points in their order along the road; {after:g} follows {before:g}"
                )


@dataclass(frozen=True, slots=True, kw_only=True)
class ShardSettings(BodyInContact):
    """Surface, damping and rest of the shards."""

    table: ClassVar[str] = "shards"
    contact: ClassVar[str] = SHARDS
    older_values: ClassVar[Mapping[str, float]] = {FRICTION: 0.6, RESTITUTION: 0.0}

    friction: float | None = key(OWN_VALUE, default=None, at_least=0)
    restitution: float | None = key(OWN_VALUE, default=None, **SHARE)
    collision_margin_m: float = key("Distance at which shards already touch.", default=0.0, unit="m", **SHARE)
    linear_damping: float = key("Share of the velocity lost in one second.", default=0.04, **SHARE)
    angular_damping: float = key("Share of the angular velocity lost in one second.", default=0.1, **SHARE)
    use_deactivation: bool = key(
        "Whether shards at rest fall asleep until something hits them.", default=True, label="Let Resting Pieces Sleep"
    )
    start_deactivated: bool = key(
        "Whether shards sleep until something hits them; needs `use_deactivation`.",
        default=True,
        label="Asleep at the Start",
    )
    deactivation_linear_velocity_m_s: float = key(
        "Velocity below which a shard is at rest.", default=0.4, unit="m/s", at_least=0, label="At Rest Below Speed"
    )
    deactivation_angular_velocity_rad_s: float = key(
        "Angular velocity below which a shard is at rest.",
        default=0.5,
        unit="rad/s",
        at_least=0,
        label="At Rest Below Turning Speed",
    )

    def _check_together(self) -> None:
        if self.start_deactivated and not self.use_deactivation:
            raise self.unexpected("start_deactivated", "false where shards.use_deactivation is false")


@dataclass(frozen=True, slots=True, kw_only=True)
class Equipment(Table):
    """A machine that stands on the bridge, such as an excavator. `bda stages` counts its weight on the shards under it;
    a run does not have it."""

    table: ClassVar[str] = "equipment"
    may_share_names: ClassVar[bool] = True  # a machine may stand at several places, one after the other

    name: str = key("What it is called.")
    mass_kg: float = key("Mass: a crawler excavator has 20 000 to 40 000 kg.", unit="kg", above=0)
    position_m: tuple[float, float] = key("Middle of what it stands on: x, y.", unit="m")
    footprint_m: tuple[float, float] = key(
        "Length along the road and width across it of what it stands on: 4 m × 3 m of a crawler.", unit="m", above=0
    )
    from_s: float = key("Since when it stands there.", default=0.0, unit="s", at_least=0)
    until_s: float | None = key("When it leaves; by default never.", default=None, unit="s", above=0)

    def stands_at(self, time_s: float) -> bool:
        return self.from_s <= time_s and (self.until_s is None or time_s < self.until_s)

    def _check_together(self) -> None:
        if self.until_s is not None and not self.until_s > self.from_s:
            raise self.unexpected("until_s", f"more than equipment.from_s, {self.from_s:g} (s)")
