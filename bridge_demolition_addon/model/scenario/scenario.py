"""A whole scenario, made of its tables."""

from dataclasses import dataclass, field, replace
from typing import ClassVar

from ...engineering.elasticity.steel_bars import Steel
from ...engineering.ground_motion.record import GroundRecord
from ...engineering.mechanics.joint import Joint
from ...engineering.timing.timeline import Timeline
from ...errors import ScenarioError
from ..blast.charges import Charge, named_charges
from ..blast.settings import BlastSettings
from ..foundations.settings import Foundation
from ..ground_motion.settings import GroundMotion
from ..ground_motion.sources import ground_record
from ..loads.load import Load
from ..materials.bar_layers import BarLayer
from ..materials.materials import Material, check_materials
from ..schema import LARGEST_INTEGER, ROUNDING, Table, check_exactly_one, key, shown
from .ball import Ball, BallHit
from .bodies import Equipment, Ground, ShardSettings, Support
from .bridge import Bridge
from .connections import ConnectionSettings
from .fracture import FractureSettings
from .geometry import Geometry
from .jackhammer import Jackhammer
from .recording import PictureSettings, RecordingSettings
from .site import Exclusion, Neighbour, Site, Zone
from .structural_changes import Change, Removal, SawCut, Weakening, check_times
from .time import MOST_FRAMES, TimeSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario(Table):
    """A whole scenario: everything that a run depends on."""

    table: ClassVar[str] = "scenario"

    title: str = key("Title of the results.")
    seed: int = key(
        "Start of the random numbers: the same seed cuts the same shards, another seed is another draw.",
        default=0,
        at_least=0,
        at_most=LARGEST_INTEGER,
    )
    time: TimeSettings
    bridge: Bridge | None = None
    geometry: tuple[Geometry, ...] = ()
    ground: Ground = field(default_factory=Ground)
    ground_motion: GroundMotion | None = None
    fracture: FractureSettings
    materials: tuple[Material, ...] = ()
    reinforcement: tuple[BarLayer, ...] = ()
    connections: ConnectionSettings
    supports: tuple[Support, ...] = ()
    foundations: tuple[Foundation, ...] = ()
    shards: ShardSettings = field(default_factory=ShardSettings)
    ball: Ball | None = None
    blast: BlastSettings = field(default_factory=BlastSettings)
    charges: tuple[Charge, ...] = ()
    jackhammers: tuple[Jackhammer, ...] = ()
    removals: tuple[Removal, ...] = ()
    saw_cuts: tuple[SawCut, ...] = ()
    weakenings: tuple[Weakening, ...] = ()
    loads: tuple[Load, ...] = ()
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    pictures: PictureSettings = field(default_factory=PictureSettings)
    zones: tuple[Zone, ...] = ()
    exclusion: Exclusion | None = None
    site: Site | None = None
    neighbours: tuple[Neighbour, ...] = ()
    equipment: tuple[Equipment, ...] = ()

    @property
    def timeline(self) -> Timeline:
        """Return the frames of the run, shorter around detonations where that is asked for."""
        frame_s = self.time.step.frame_s
        slow_motions = self.blast.slow_motions(self.charges, frame_s)
        return Timeline.of(frame_s, self.time.duration_s, slow_motions)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Return the joint of connections that follow no rule of `connections.between`, then that of each rule."""
        return self.connections.joints(self.materials)

    @property
    def weighed_bridge(self) -> Bridge | None:
        """Return the bridge with the density of its material, where it gives neither a density nor its mass."""
        if self.bridge is None or self.bridge.density_kg_m3 is not None or self.bridge.mass_kg is not None:
            return self.bridge
        return replace(self.bridge, density_kg_m3=self._material_density_kg_m3)

    @property
    def _material_density_kg_m3(self) -> float | None:
        named = {each.name: each.density_kg_m3 for each in self.materials}
        return named.get(self.connections.material)

    @property
    def ground_record(self) -> GroundRecord | None:
        """Return how the ground moves, None where it rests.

        Raises
        ------
        ScenarioError
            As `ground_record`, of a file.
        """
        return self.ground_motion and ground_record(self.ground_motion, self.seed)

    @property
    def steel(self) -> Steel:
        """Return what the reinforcement of elastic connections is made of."""
        steel, layers = self.connections.steel, self.reinforcement
        if self.connections.ductile_yield_n_mm2 is not None or not layers:
            return steel
        yields = sum(each.area_m2 * each.yield_pa for each in layers) / sum(each.area_m2 for each in layers)
        return replace(steel, yield_pa=yields)

    @property
    def changes(self) -> tuple[Change, ...]:
        """Return all removals, saw cuts and weakenings."""
        return (*self.removals, *self.saw_cuts, *self.weakenings)

    def _check_together(self) -> None:
        self._check_charges()
        object.__setattr__(self, "connections", self.connections.with_strength(self.fracture.shards))
        check_materials(self.materials)
        self._check_reinforcement()
        _ = self.joints  # refuses materials that are unknown, or do not say how they deform
        if self.bridge and self._material_density_kg_m3 is None:
            check_exactly_one(self.bridge, "density_kg_m3", "mass_kg")
        if self.bridge is None and not self.geometry:
            raise ScenarioError("bridge is missing: expected a table, or a member of your own under [[geometry]]")
        for ball in (self.ball, *self.ball.hits) if self.ball else ():
            self._check_release(ball)
        if self.ball and self.ball.cable and self.ground.file is None:
            self.ball.check_swing(0.0)
        for drop in self.ball.drops if self.ball else ():
            self._check_on_deck(f"{drop.table}.target_m", drop.target_m)
        for hit in self.ball.hits if self.ball else ():
            self._check_lift(hit)
        for hammer in self.jackhammers:
            hammer.check_time(self.time)
            for number, point in enumerate(hammer.path_m):
                self._check_on_deck(f"jackhammers.path_m[{number}]", point)
        if self.shards.start_deactivated and (moving := [each.name for each in self.geometry if each.is_moving]):
            raise ScenarioError(
                f"geometry {shown(moving[0])} begins with a velocity or a spin: "
                "expected shards.start_deactivated = false, or it would begin at rest"
            )
        for load in self.loads:
            if load.times_s[0] >= self.time.duration_s:
                wanted = f"less than time.duration_s, {self.time.duration_s} (s)"
                raise ScenarioError(f"loads.times_s[0] is {load.times_s[0]}: expected {wanted}")
        self._check_ground_motion()
        self._check_foundations()
        check_times(self.changes, self.time.duration_s - self.time.step.frame_s, self.connections.warm_up_s)

    def _check_foundations(self) -> None:
        if not self.foundations:
            return
        if not self.connections.is_elastic:
            raise self.connections.unexpected(
                "stiffness", '"elastic" with foundations: between rigid bodies springs as stiff as soil are not solved'
            )
        if not self.connections.foundation:
            raise self.connections.unexpected("foundation", "true with foundations: they connect to the ground")

    def _check_ground_motion(self) -> None:
        motion = self.ground_motion
        if motion is None:
            return
        for name, others in (("jackhammers", self.jackhammers), ("ball.cable", self.ball and self.ball.cable)):
            if others:
                raise ScenarioError(
                    f"{name} is given together with ground_motion: expected one of them; tools that machines hold do "
                    "not move with the ground"
                )
        if motion.start_s >= self.time.duration_s:
            raise motion.unexpected("start_s", f"less than time.duration_s, {self.time.duration_s:g} (s)")

    def _check_reinforcement(self) -> None:
        connections, opening = self.connections, "ductile_elongation_m"
        is_given = getattr(connections, opening) is not None
        if not self.reinforcement:
            if is_given and connections.ductile_share == 0.0:
                wanted = "none where connections.ductile_share is 0 and there is no [[reinforcement]]"
                raise connections.unexpected(opening, wanted)
            return
        if connections.material is None:
            raise ScenarioError("connections.material is missing: expected it with [[reinforcement]]")
        if not is_given:
            wanted = "a number above 0 (m), how far a crack opens until bars rupture, with [[reinforcement]]"
            raise ScenarioError(f"connections.{opening} is missing: expected {wanted}")

    def _check_charges(self) -> None:
        charges = named_charges(self.charges)
        object.__setattr__(self, "charges", charges)
        names = [charge.name for charge in charges]
        for name in names:
            if names.count(name) > 1:
                raise ScenarioError(f"charges.name is {shown(name)} for {names.count(name)} charges: expected one each")
        for charge in charges if self.blast.explosion else ():
            detonation_s = self.blast.start_s + charge.delay_s
            if detonation_s >= self.time.duration_s:
                raise ScenarioError(
                    f"{charge.name} detonates at {detonation_s:g} s (blast.start_s and its charges.delay_ms): "
                    f"expected less than time.duration_s, {self.time.duration_s:g} (s)"
                )
        slow_s = sum(motion.duration_s for motion in self.blast.slow_motions(charges, self.time.step.frame_s))
        if slow_s and slow_s / self.blast.slow_frame_ms * 1000.0 + self.time.frames > MOST_FRAMES:
            raise ScenarioError(
                f"blast.slow_frame_ms is {self.blast.slow_frame_ms:g}: expected at most {MOST_FRAMES} frames together"
            )

    def _check_release(self, ball: Ball | BallHit) -> None:
        if self.timeline.frames_until(ball.release_time_s) >= len(self.timeline):
            wanted = (
                f"less than time.duration_s, {self.time.duration_s} (s), by a frame of {self.time.step.frame_s:.3g} s"
            )
            raise ball.unexpected("release_time_s", wanted)

    def _check_lift(self, hit: BallHit) -> None:
        timeline = self.timeline
        earliest = timeline.frames_until(hit.lift_end_s) + 1  # still for a frame, so that it falls from rest
        if timeline.frames_until(hit.release_time_s) < earliest:
            earliest_s = timeline.ends_s[earliest - 1] if earliest <= len(timeline) else hit.lift_end_s
            wanted = f"at least {earliest_s:.6g} (s), a frame after the ball was lifted"
            raise hit.unexpected("release_time_s", wanted)

    def _check_on_deck(self, name: str, point: tuple[float, float]) -> None:
        if self.geometry:
            return  # what lies there is only known once the members are read
        along, across = point
        overhang, half_width = self.bridge.deck.overhang_m, self.bridge.deck.width_m / 2.0
        skewed_by = across * self.bridge.shift_across
        deck = ((skewed_by - overhang, skewed_by + self.bridge.spans_m + overhang), (-half_width, half_width))
        for place, (position, (lowest, highest)) in enumerate(zip((along, across), deck, strict=True)):
            slack = ROUNDING * (highest - lowest)
            if not lowest - slack <= position <= highest + slack:
                raise ScenarioError(
                    f"{name}[{place}] is {position}: "
                    f"expected a place on the deck, from {lowest:.6g} to {highest:.6g} (m)"
                )
