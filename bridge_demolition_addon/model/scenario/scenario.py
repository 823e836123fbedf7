"""A whole scenario, made of its tables."""

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import chain, combinations
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np

from ...engineering.blast.site_law import SiteLaw
from ...engineering.elasticity.steel_bars import Steel
from ...engineering.ground_motion import GroundRecord
from ...engineering.mechanics.strength import Joint
from ...engineering.timing.timeline import Timeline
from ...errors import Faults, ScenarioError
from ..actions import PlannedAction
from ..blast.blast_zones import BlastZone, check_zones_apart
from ..blast.charges import Charge
from ..blast.cuts import MemberCut, check_cuts
from ..blast.settings import BlastSettings
from ..blast.vibration_laws import VibrationLaw, check_laws
from ..changes.change import Change
from ..changes.removals import Removal, Weakening
from ..changes.saw_cuts import SawCut, TendonCut
from ..foundations import Foundation
from ..ground_motion.settings import GroundMotion
from ..ground_motion.sources import ground_record
from ..lifts import Lift
from ..loads.loads import Load
from ..loads.pressures import Pressure
from ..materials import BarLayer, Material, check_materials
from ..pulls import Pull
from ..schema import (
    LARGEST_INTEGER,
    ROUNDING,
    Table,
    check_exactly_one,
    given,
    key,
    named_tables,
    shown,
    subtable_class,
    subtable_fields,
)
from .ball import Ball
from .bearings import Bearing
from .bodies import Equipment, Ground, ShardSettings, Support
from .bridge import Bridge
from .bridge_checks import road_line, upright_names
from .connections import ConnectionSettings, joints_of_connections
from .contacts import BodyInContact, ContactSettings, SurfaceValues, check_not_both, with_own_values
from .dead_loads import DeadLoad
from .fall_beds import FallBed
from .fracture import FractureSettings
from .geometry import Geometry
from .girders import DECK_KIND, GirderSpan, StudRow, joints_of_deck
from .jackhammer import Jackhammer
from .joint_settings import GROUND_NAME
from .programme import Machine, Programme
from .recording import PictureSettings, RecordingSettings, ReportSettings
from .reinforcement import BarRule, BridgeReinforcement, GeometryReinforcement
from .site import Exclusion, Neighbour, Site, Zone
from .steelwork import SteelMember, SteelNode, Steelwork
from .tendons import Tendon, check_tendons
from .time import MOST_FRAMES, TimeSettings


class JointName(NamedTuple):
    """What connections with the same joint are: number 0 of `rule` follows none, others are counted as in the file."""

    kind: Literal["rule", "bearing", "steel", "deck"]
    of: Hashable
    with_bars: bool = False


_RIGID_WITH_BARS = "bars between rigid bodies would make energy"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario(Table):
    """A whole scenario: everything that a run depends on."""

    table: ClassVar[str] = "scenario"

    title: str = key("Title of the results.")
    seed: int = key(
        "Start of the random numbers: the same seed cuts the same shards, another seed gives another run.",
        default=0,
        at_least=0,
        at_most=LARGEST_INTEGER,
    )
    time: TimeSettings
    bridge: Bridge | None = None
    geometry: tuple[Geometry, ...] = ()
    steelwork: Steelwork | None = None
    ground: Ground = field(default_factory=Ground)
    ground_motion: GroundMotion | None = None
    fracture: FractureSettings
    materials: tuple[Material, ...] = ()
    reinforcement: tuple[BarLayer, ...] = ()
    geometry_reinforcement: GeometryReinforcement | None = None
    tendons: tuple[Tendon, ...] = ()
    connections: ConnectionSettings
    bearings: tuple[Bearing, ...] = ()
    dead_loads: tuple[DeadLoad, ...] = ()
    supports: tuple[Support, ...] = ()
    foundations: tuple[Foundation, ...] = ()
    shards: ShardSettings = field(default_factory=ShardSettings)
    contacts: ContactSettings | None = field(default_factory=ContactSettings)
    ball: Ball | None = None
    blast: BlastSettings = field(default_factory=BlastSettings)
    charges: tuple[Charge, ...] = ()
    blast_zones: tuple[BlastZone, ...] = ()
    cuts: tuple[MemberCut, ...] = ()
    jackhammers: tuple[Jackhammer, ...] = ()
    removals: tuple[Removal, ...] = ()
    saw_cuts: tuple[SawCut, ...] = ()
    weakenings: tuple[Weakening, ...] = ()
    tendon_cuts: tuple[TendonCut, ...] = ()
    loads: tuple[Load, ...] = ()
    pressures: tuple[Pressure, ...] = ()
    pulls: tuple[Pull, ...] = ()
    lifts: tuple[Lift, ...] = ()
    fall_beds: tuple[FallBed, ...] = ()
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    pictures: PictureSettings = field(default_factory=PictureSettings)
    report: ReportSettings = field(default_factory=ReportSettings)
    zones: tuple[Zone, ...] = ()
    exclusion: Exclusion | None = None
    site: Site | None = None
    neighbours: tuple[Neighbour, ...] = ()
    vibration_laws: tuple[VibrationLaw, ...] = ()
    equipment: tuple[Equipment, ...] = ()
    machines: tuple[Machine, ...] = ()
    programme: Programme | None = None

    def site_law(self, of: str) -> SiteLaw | None:
        """Return how the ground carries vibration of `charges` or of the `fall`; None where no one did."""
        return next((table.law for table in self.vibration_laws if table.of == of), None)

    @property
    def timeline(self) -> Timeline:
        """Return the frames of the run, shorter around detonations where that is asked for."""
        frame_s = self.time.step.frame_s
        slow_motions = self.blast.slow_motions(self.charges, frame_s)
        return Timeline.of(frame_s, self.time.duration_s, slow_motions)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Return the joint of connections that follow no rule, then that of each rule, then that of each bearing.

        Rules are from `connections.between`. With reinforcement, the same follow for members that have bars. Joints of
        steelwork come last, and after them joints of decks with girders.
        """
        return tuple(self.named_joints.values())

    @property
    def named_joints(self) -> dict[JointName, Joint]:
        """Return all joints by what has them."""
        settings = self.connections
        factor, is_elastic = settings.strength_factor, settings.is_elastic
        plain = joints_of_connections(settings, self.materials)
        pads = [table.joint(plain[0], factor, is_elastic=is_elastic) for table in bearing_tables(self)]
        named: dict[JointName, Joint] = {}
        for with_bars in (False, True) if self.reinforcement or rules_of_bars(self) else (False,):
            own = joints_of_connections(settings, self.materials, have_bars=True) if with_bars else plain
            named |= {JointName("rule", number, with_bars): joint for number, joint in enumerate(own)}
            named |= {JointName("bearing", number, with_bars): joint for number, joint in enumerate(pads)}
        if self.steelwork:
            named |= {JointName("steel", kind): joint for kind, joint in self.steelwork.joints(factor).items()}
            for number, span in enumerate(self.steelwork.decks):
                between, over_piers = joints_of_deck(span, deck_joint(self, span), factor)
                named |= {JointName("deck", (number, False)): between, JointName("deck", (number, True)): over_piers}
        return named

    @property
    def is_reinforced(self) -> bool:
        """Return whether bars hold where connections break."""
        return bool(self.reinforcement or rules_of_bars(self)) or self.connections.ductile_share > 0.0

    @property
    def weighed_bridge(self) -> Bridge | None:
        """Return the bridge as it is built: with the density of its material, where it gives neither a density nor its
        mass, and lighter by its voids."""
        if self.bridge is None:
            return None
        bridge = self.bridge
        if bridge.density_kg_m3 is None and bridge.mass_kg is None:
            bridge = replace(bridge, density_kg_m3=self._material_density_kg_m3)
        return bridge.lightened

    @property
    def _material_density_kg_m3(self) -> float | None:
        named = {material.name: material.density_kg_m3 for material in self.materials}
        return named.get(self.connections.material) if self.connections.material else None

    @property
    def ground_record(self) -> GroundRecord | None:
        """Return how the ground moves, None where it rests."""
        return ground_record(self.ground_motion, self.seed) if self.ground_motion else None

    @property
    def steel(self) -> Steel:
        steel, layers = self.connections.steel, self.reinforcement
        if rules := rules_of_bars(self):
            return self.connections.steel_or(rules[0].grade)
        if self.connections.ductile_yield_n_mm2 is not None or not layers:
            return steel
        at_depths = [layer for layer in layers if not layer.is_spread]
        if not at_depths:
            return replace(steel, yield_pa=math.fsum(layer.yield_pa for layer in layers) / len(layers))
        areas_m2 = [layer.area_m2 for layer in at_depths]
        yields_n = math.fsum(area * layer.yield_pa for area, layer in zip(areas_m2, at_depths, strict=True))
        return replace(steel, yield_pa=yields_n / math.fsum(areas_m2))

    @property
    def warm_up_s(self) -> float:
        return self.connections.warm_up_s

    @property
    def bodies_in_contact(self) -> tuple[BodyInContact, ...]:
        """Tables of the bodies that touch others."""
        ball = () if self.ball is None else (self.ball,)
        return (self.shards, self.ground, *self.ground.surfaces, *ball, *self.jackhammers)

    def surface_of(self, body: BodyInContact) -> SurfaceValues:
        """Return friction and restitution of a body by itself, as Bullet multiplies them with another's."""
        return body.own_values if self.contacts is None else self.contacts.of_body(body.contact)

    @property
    def has_flat_ground(self) -> bool:
        return self.ground.is_flat

    def detonation_s(self, delay_s: float) -> float:
        """Return when a charge with a delay detonates, s; infinite where nothing goes off."""
        return self.blast.start_s + delay_s if self.blast.explosion else math.inf

    @property
    def blast_start_s(self) -> float:
        return self.blast.start_s

    @property
    def actions(self) -> tuple[PlannedAction, ...]:
        """Return all that is done to the bridge, in the order of the fields."""
        held = (getattr(self, name) for name in action_fields(type(self)))
        return tuple(chain.from_iterable(value if isinstance(value, tuple) else (value,) for value in held if value))

    def actions_scaled_in_time(self, factor: float) -> dict[str, Any]:
        """Return the fields of actions, for frames that last longer by a factor, as `replace` takes them."""
        held = {name: getattr(self, name) for name in action_fields(type(self))}
        return {
            name: tuple(action.scaled_in_time(factor) for action in value)
            if isinstance(value, tuple)
            else value.scaled_in_time(factor)
            for name, value in held.items()
            if value
        }

    @property
    def changes(self) -> tuple[Change, ...]:
        """Changes to the structure, without blast zones, which depend on its model."""
        return tuple(chain.from_iterable(action.changes(self) for action in self.actions))

    def resolved(self) -> dict[str, Any]:
        """Return connections with strength and stiffness, the time that these need, each zone, and how bodies touch."""
        connections = self.connections.with_strength(self.fracture.shards).with_stiffness(self.materials)
        has_bars = bool(self.is_reinforced or self.steelwork or self.tendons)
        time = self.time.completed(is_elastic=connections.is_elastic, has_bars=has_bars)
        zones = {"blast_zones": self._each_zone()} if any(zone.has_pattern for zone in self.blast_zones) else {}
        return {"connections": connections, "time": time, **zones, **self._resolved_contacts()}

    def _each_zone(self) -> tuple[BlastZone, ...]:
        """Return all blast zones, one for each of the members that the name of one stands for."""
        own = dict.fromkeys(table.name for table in self.geometry)
        axes = [*(upright_names(self.bridge) if self.bridge else ()), *([name] for name in own)]
        patterns = (zone.has_pattern and zone.member not in own for zone in self.blast_zones)
        pairs = zip(self.blast_zones, patterns, strict=True)
        return tuple(chain.from_iterable(zone.repeated(axes) if is_one else (zone,) for zone, is_one in pairs))

    def _resolved_contacts(self) -> dict[str, Any]:
        """Use pairs of surfaces, or values per body if any body sets its own."""
        bodies = self.bodies_in_contact
        of_bodies = [name for body in bodies for name in body.given_keys]
        if not of_bodies:
            contacts = self.contacts or ContactSettings()
            contacts.check_possible(dict.fromkeys(body.contact for body in bodies))
            return {"contacts": contacts}
        if self.contacts is not None:
            check_not_both(self.contacts.given_keys, of_bodies)
        surfaces = tuple(map(with_own_values, self.ground.surfaces))
        return {
            "contacts": None,
            "shards": with_own_values(self.shards),
            "ground": replace(with_own_values(self.ground), surfaces=surfaces),
            "ball": self.ball and with_own_values(self.ball),
            "jackhammers": tuple(map(with_own_values, self.jackhammers)),
        }

    def _check_together(self) -> None:
        named_tables(self)  # zones of several members have names of their own
        steelwork = self.steelwork
        own: Sequence[Geometry | SteelNode | SteelMember] = self.geometry
        if steelwork:
            own = (*own, *steelwork.nodes, *steelwork.members)
        for member in own:
            if member.name.strip() == GROUND_NAME:
                raise member.unexpected("name", "another name: this is what all stands on")
        self._check_equipment()
        check_zones_apart(self.blast_zones)
        check_cuts(self.cuts, self.blast_zones)
        self._check_slow_motion()
        check_materials(self.materials)
        self._check_reinforcement()
        check_tendons(self.tendons, self.tendon_cuts, self.connections)
        if not self.connections.is_elastic:
            for table in self.bearings:
                table.check_rigid()
        _ = self.joints  # refuses materials that are unknown, or do not say how they deform
        if self.bridge and self._material_density_kg_m3 is None:
            check_exactly_one(self.bridge, "density_kg_m3", "mass_kg")
        if self.bridge is None and not self.geometry and self.steelwork is None:
            raise ScenarioError(
                "bridge is missing: expected a table, a member of your own under [[geometry]], or [steelwork]"
            )
        if self.steelwork is not None and not self.connections.is_elastic:
            wanted = '"elastic" with [steelwork], and method "face": bars share a load by their stiffness'
            raise self.connections.unexpected("stiffness", wanted)
        faults = Faults()
        for action in self.actions:
            with faults.noted():
                action.check_plan(self)
                if self.geometry or self.steelwork:
                    continue  # what lies there is only known once the members are read
                for name, position in action.targets():
                    _check_on_deck(given(self.bridge), name, position)
        faults.check()
        if self.shards.start_deactivated and (moving := [table.name for table in self.geometry if table.is_moving]):
            raise ScenarioError(
                f"geometry {shown(moving[0])} begins with a velocity or an angular velocity: "
                "expected shards.start_deactivated = false, or it would begin at rest"
            )
        self._check_dead_loads()
        self._check_foundations()
        check_laws(self.vibration_laws)

    def _check_equipment(self) -> None:
        """Check that no machine stands twice at one time, as it would weigh twice."""
        for (first, one), (second, other) in combinations(enumerate(self.equipment, start=1), 2):
            if one.name == other.name and (one.stands_at(other.from_s) or other.stands_at(one.from_s)):
                raise ScenarioError(
                    f"[[equipment]] number {first} and [[equipment]] number {second} are both {shown(one.name)} at "
                    f"{max(one.from_s, other.from_s):g} s: expected a name of its own for each machine, or "
                    "equipment.until_s of the first before the second begins"
                )

    def _check_dead_loads(self) -> None:
        """Check that what is taken off goes before anything else is done, as a run begins without it."""
        first_s = min((action.begins_s(self) for action in self.actions), default=math.inf)
        for load in self.dead_loads:
            if load.until_s is not None and load.until_s > first_s:
                raise load.unexpected("until_s", f"at most {first_s:g} (s), when the first of the bridge is demolished")

    def _check_foundations(self) -> None:
        if not self.foundations:
            return
        if not self.connections.is_elastic:
            raise self.connections.unexpected(
                "stiffness", '"elastic" with foundations: between rigid bodies springs as stiff as soil are not solved'
            )
        if not self.connections.foundation:
            raise self.connections.unexpected("foundation", "true with foundations: they connect to the ground")

    def _check_reinforcement(self) -> None:
        connections = self.connections
        rules = rules_of_bars(self)
        if self.geometry_reinforcement and not self.geometry:
            raise ScenarioError("geometry_reinforcement is given: expected none without [[geometry]]")
        table = f"[{rules[0].table}]" if rules and not self.reinforcement else "[[reinforcement]]"
        if not self.reinforcement and not rules:
            says_none = self.geometry_reinforcement is not None or (
                self.bridge is not None and self.bridge.reinforcement is not None
            )
            if connections.ductile_elongation_m is not None and connections.ductile_share == 0.0 and not says_none:
                wanted = "none where connections.ductile_share is 0 and there is no [[reinforcement]]"
                raise connections.unexpected("ductile_elongation_m", wanted)
            if connections.ductile_share == 0.0:
                connections.check_no_steel()
            elif not connections.is_elastic:
                wanted = f'"elastic" with a connections.ductile_share above 0: {_RIGID_WITH_BARS}'
                raise connections.unexpected("stiffness", wanted)
            connections.check_no_layers()
            return
        if connections.material is None:
            raise ScenarioError(f"connections.material is missing: expected it with {table}")
        if not connections.is_elastic:
            wanted = f'"elastic" with {table}: {_RIGID_WITH_BARS}'
            raise connections.unexpected("stiffness", wanted)

    def _check_slow_motion(self) -> None:
        blast = self.blast
        slow_s = math.fsum(motion.duration_s for motion in blast.slow_motions(self.charges, self.time.step.frame_s))
        if slow_s and slow_s / given(blast.slow_frame_ms) * 1000.0 + self.time.frames > MOST_FRAMES:
            raise ScenarioError(
                f"blast.slow_frame_ms is {blast.slow_frame_ms:g}: expected at most {MOST_FRAMES} frames together"
            )


def _check_on_deck(bridge: Bridge, name: str, point: tuple[float, float]) -> None:
    along, across = point
    overhang, half_width = bridge.deck.overhang_m, bridge.deck.width_m / 2.0
    skewed_by = across * bridge.shift_across
    if bridge.alignment and bridge.alignment.radius_m is not None and (line := road_line(bridge)):
        along, across, _ = line.from_world(np.array([along, across, 0.0])).tolist()
    deck = ((skewed_by - overhang, skewed_by + bridge.spans_m + overhang), (-half_width, half_width))
    for number, (position, (lowest, highest)) in enumerate(zip((along, across), deck, strict=True), start=1):
        slack = ROUNDING * (highest - lowest)
        if not lowest - slack <= position <= highest + slack:
            raise ScenarioError(
                f"{name}.{number} is {position}: "
                f"expected a position on the deck, from {lowest:.6g} to {highest:.6g} (m)"
            )


def action_fields(scenario_class: type[Table]) -> tuple[str, ...]:
    """Return the names of the fields of a scenario that hold planned actions."""
    return tuple(
        item.name
        for item in subtable_fields(scenario_class)
        if issubclass(subtable_class(item) or Table, PlannedAction)
    )


@cache
def run_tables() -> dict[str, tuple[type[PlannedAction], ...]]:
    """Return the kinds of tables by which runs do what is planned, by the name that a scene keeps them under."""
    found: dict[str, tuple[type[PlannedAction], ...]] = {}
    for item in subtable_fields(Scenario):
        kind = subtable_class(item) or Table
        for table in kind.run_tables() if issubclass(kind, PlannedAction) else ():
            found[table.kept_in] = (*found.get(table.kept_in, ()), table)
    return found


def no_actions(scenario: Scenario) -> dict[str, Any]:
    """Return the fields of actions where nothing is done to the bridge, as `replace` takes them."""
    held = {name: getattr(scenario, name) for name in action_fields(Scenario)}
    return {name: () if isinstance(value, tuple) else None for name, value in held.items()}


def deck_joint(scenario: Scenario, span: GirderSpan) -> Joint:
    """Return the joint of connections within the deck on girders."""
    connections = scenario.connections
    own, *others = joints_of_connections(connections, scenario.materials)
    for rule, joint in zip(connections.between, others, strict=True):
        if not rule.none and all(name in (span.deck_name, DECK_KIND) for name in rule.members):
            return joint
    return own


def studs_of(span: GirderSpan, scenario: Scenario) -> StudRow | None:
    """Return the studs below a deck, before any factor on strengths; None where it lies on friction alone."""
    concrete = deck_joint(scenario, span)
    unweakened_pa = float(given(concrete.strength).compression_pa) / scenario.connections.strength_factor
    return span.studs(unweakened_pa, given(concrete.moduli))


def bearing_tables(scenario: Scenario) -> tuple[Bearing, ...]:
    """Return all bearings, first the ones that count before others: the scenario's own, then its bridge's."""
    return (*scenario.bearings, *(scenario.bridge.bearing_tables if scenario.bridge else ()))


def rules_of_bars(scenario: Scenario) -> tuple[BarRule, ...]:
    """Return the rules that members have bars by: of the bridge, and of members from files."""
    of_files = scenario.geometry_reinforcement
    rules: tuple[BarRule | None, ...] = bars_by_rule(scenario), of_files
    return tuple(rule for rule in rules if rule and rule.has_bars)


def bars_by_rule(scenario: Scenario) -> BridgeReinforcement | None:
    """Return the rule that a bridge has bars by; None where it has none."""
    rule = scenario.bridge.reinforcement if scenario.bridge else None
    return rule if rule and rule.has_bars else None
