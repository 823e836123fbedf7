"""From a scenario to the model that is simulated: shards with their masses, and the connections between them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...engineering.foundations.footings import SoilSprings
from ...engineering.fracture.shared_faces import SharedFaces
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import cross
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.structure import connections as connecting
from ...engineering.structure.connections import Connections
from ...engineering.structure.face_sections import second_moments
from ..bridge.extent import ground_half_size
from ..bridge.member import Member, mean_density
from ..bridge.preparation import prepared_members
from ..materials.bar_layers import BarLayer
from ..reinforcement.design import all_layers
from ..scenario import ConnectionSettings, Geometry, Scenario
from ..scenario.scenario import bearing_tables, joints_of_faces
from ..schema import given
from ..terrain.built import BuiltGround, built_ground
from .bearings import ModelBearings, bearing_connections, have_bearing, placed_bearings, raised_shards
from .composite_decks import (
    DeckContacts,
    are_of_decks,
    contact_moments,
    contact_rows,
    contact_stiffness,
    deck_connections,
    faces_across_decks,
    loose_deck_springs,
    points_above_girders,
    with_studs,
)
from .connection_rules import rules_of_pairs
from .crack_bars import CrackBars, even_bars_n
from .face_bars import CrackedShards, face_bars, within_reinforced
from .footings import on_footings, second_moments_of, soil_springs, with_soil
from .members import FracturedMembers, fractured_members, shards_with_gaps
from .model_basis import ModelBasis
from .starter_bars import starter_bars
from .steelwork import (
    SteelConnections,
    joint_rows,
    node_supports,
    on_supports,
    pins_of_supports,
    resisting_moments,
    steel_connections,
    steel_stiffness,
    with_steel_hinges,
)
from .stiffness import CutMembers, connection_stiffness
from .supports import HeldPart, held_parts
from .t_beams import t_beams
from .tendons import ModelTendons, model_tendons


@dataclass(frozen=True, slots=True)
class Model:
    """A bridge cut into n shards, and its m connections.

    Attributes
    ----------
    members : tuple of Member
        Members before they were cut.
    shards : tuple of TriangleMesh
        Closed meshes, in the bridge's coordinates.
    member_of_shard, masses_kg, centres_m : (n,) int, (n,) float, (n, 3) float
        Index of the member that each shard was cut from, its mass and centre of mass.
    joint_of_connection : (m,) int
        Index of one of the scenario's joints, which says what a connection has in common with others.
    second_moments_m4 : (m, 2, 2) float
        Second moments of area of the connections' faces; 0 for one without a face.
    fixed : (n,) bool
        Whether each shard never moves, as supports hold it; no connection lies between two of these.
    held_parts : tuple of HeldPart
        What supports hold, each shard of `fixed` in one of them.
    stiffness, soil, bars, bearings
        None where connections are rigid, where the ground does not settle, without layers of reinforcement, and without
        `[[bearings]]`.
    crack_bars : CrackBars or None
        All bars that hold where elastic connections crack, in layers and by `ductile_share`; None without any.
    steel : SteelConnections or None
        Which connections are joints of steel bars; None without steelwork.
    decks : DeckContacts or None
        Which connections are contacts of decks with girders; None without any.
    tendons : ModelTendons or None
        None without `[[tendons]]`.
    layers : tuple of BarLayer
        All layers of bars that the members have, by hand and by rule.
    """

    members: tuple[Member, ...]
    shards: tuple[TriangleMesh, ...]
    member_of_shard: np.ndarray
    masses_kg: np.ndarray
    centres_m: np.ndarray
    connections: Connections
    joint_of_connection: np.ndarray
    second_moments_m4: np.ndarray
    fixed: np.ndarray
    held_parts: tuple[HeldPart, ...] = ()
    stiffness: SectionStiffness | None = None
    ground: BuiltGround = field(default_factory=BuiltGround)
    soil: SoilSprings | None = None
    bars: FaceBars | None = None
    bearings: ModelBearings | None = None
    crack_bars: CrackBars | None = None
    steel: SteelConnections | None = None
    decks: DeckContacts | None = None
    tendons: ModelTendons | None = None
    layers: tuple[BarLayer, ...] = ()

    def thicknesses_m(self) -> np.ndarray:
        """Return the thickness (m,) of the thinner of the members that each connection is between."""
        of_members = np.array([member.thickness_m for member in self.members])
        of_shards = np.append(of_members[self.member_of_shard], np.inf)  # the ground, at index -1
        return of_shards[self.connections.pairs].min(axis=1)

    def between(self, connection: int) -> tuple[str, ...]:
        """Return the names of the members, or the ground, on both sides of a connection, which may be one."""
        shards = self.connections.pairs[connection].tolist()
        names = ["ground" if shard < 0 else self.members[self.member_of_shard[shard]].name for shard in shards]
        return tuple(dict.fromkeys(names))

    @property
    def breakable(self) -> np.ndarray:
        """Return which connections (m,) can break by stress: not footings on soil, nor pads that deform."""
        can = np.ones(len(self.connections), bool)
        if self.bearings and self.stiffness is not None:
            can[self.bearings.springs.rows] = False
        if self.soil:
            can[self.soil.rows] = False
        return can

    @property
    def density_kg_m3(self) -> float:
        """Return the mean density of all members."""
        return mean_density(self.members)


def build_model(scenario: Scenario, members: Sequence[Member] | None = None) -> Model:
    """Return the model of a scenario, always the same; of members without overlap, by default all its own."""
    return model_on(ModelBasis.of(scenario), members)


def model_on(basis: ModelBasis, members: Sequence[Member] | None = None) -> Model:
    """Return the model of all scenarios that have a basis; of members as in `build_model`."""
    scenario = basis.scenario
    members = prepared_members(scenario).members if members is None else tuple(members)
    solids = [(member.name, member.solid) for member in members]
    ground = built_ground(scenario, solids, ground_half_size(members, basis.clear_height_m))
    fractured = fractured_members(scenario, members, basis.planes)
    shards, centres, faces = fractured.shards, fractured.centres_m, fractured.faces
    rules = scenario.connections.between
    rules_of = partial(rules_of_pairs, rules, members, fractured.member_of_shard)
    excluded = np.array([False, *(rule.none for rule in rules)])
    heights_at = None if ground.terrain is None else ground.terrain.heights_at
    placed = placed_bearings(bearing_tables(scenario), members)

    def allowed(pairs: np.ndarray) -> np.ndarray:
        of_decks = are_of_decks(scenario.steelwork, members, fractured.member_of_shard, pairs)
        is_joined = ~excluded[rules_of(pairs)] & ~have_bearing(placed, fractured.member_of_shard, pairs) & ~of_decks
        return is_joined & ~on_supports(scenario.steelwork, members, fractured.member_of_shard, pairs)

    is_steel = np.array([member.steel is not None for member in members])[fractured.member_of_shard]
    connections = _connections(scenario.connections, shards, centres, faces, allowed, heights_at, ~is_steel)
    joint_of_connection = rules_of(connections.pairs)
    bearings = None
    if placed:
        of_pads, bearings, tables = bearing_connections(
            placed,
            bearing_tables(scenario),
            members,
            fractured.member_of_shard,
            shards,
            len(connections),
            scenario.connections.strength_factor,
        )
        connections = connecting.joined([connections, of_pads])
        joint_of_connection = np.concatenate((joint_of_connection, 1 + len(rules) + tables))
    steel = None
    if scenario.steelwork:
        supports, nodes = node_supports(scenario.steelwork, members, fractured.member_of_shard, shards)
        first_support = len(connections)
        connections = connecting.joined([connections, supports])
        steel = steel_connections(fractured.bar_joints, connections, first_support, nodes)
        joint_of_connection = np.concatenate((joint_of_connection, np.zeros(len(nodes), int)))
        joint_of_connection[steel.rows] = joint_rows(steel, scenario, members)
        pins, names = pins_of_supports(
            scenario.steelwork, members, nodes, first_support, len(bearings.names) if bearings else 0
        )
        if names:
            bearings = bearings.followed_by(pins, names) if bearings else ModelBearings(names, pins)
    points = points_above_girders(scenario.steelwork, members, fractured.member_of_shard, shards, _middles(fractured))
    decks = None
    if scenario.steelwork and scenario.steelwork.decks:
        on_girders, decks = deck_connections(
            scenario.steelwork, members, fractured.member_of_shard, shards, points, faces, len(connections)
        )
        connections = connecting.joined([connections, on_girders])
        joint_of_connection = np.concatenate((joint_of_connection, contact_rows(decks, scenario)))
        loose = loose_deck_springs(decks, scenario, connections, len(bearings.names) if bearings else 0)
        if loose:
            bearings = bearings.followed_by(*loose) if bearings else ModelBearings(loose[1], loose[0])
    held = held_parts(scenario.supports, members, shards, fractured.member_of_shard)
    fixed = np.zeros(len(shards), dtype=bool)
    for part in held:
        fixed[part.shards] = True
    # The ground, at index -1, is fixed as well.
    moves = ~np.append(fixed, True)[connections.pairs].all(axis=1)
    connections, joint_of_connection = connections.only(moves), joint_of_connection[moves]
    bearings = replace(bearings, springs=bearings.springs.among(moves)) if bearings else None
    steel = steel.among(moves) if steel else None
    decks = decks.among(moves) if decks else None
    moments = second_moments(
        shards, connections.pairs[:, 0], connections.areas, connections.points, connections.normals
    )
    if steel:
        moments[steel.rows] = resisting_moments(steel, connections, given(scenario.steelwork), members)
    if decks:
        moments[decks.rows] = contact_moments(decks)
        across, of_rectangles = faces_across_decks(
            scenario.steelwork, members, fractured.member_of_shard, shards, connections
        )
        moments[across] = of_rectangles
    soil = soil_springs(scenario.foundations, members, fractured.member_of_shard, shards, connections)
    bars = within = None
    layers = all_layers(scenario, members)
    if layers:
        within = within_reinforced(layers, members, fractured.member_of_shard, connections)
        others = [part.rows for part in (bearings.springs if bearings else None, soil) if part]
        without = np.concatenate([np.zeros(0, int), *others])
        starters = starter_bars(
            scenario, layers, members, fractured.member_of_shard, connections, joint_of_connection, without
        )
        if starters:
            # A foot on the ground cracks at the strength of its face, as where it has no bars, and they hold it then.
            within |= (starters.yield_n > 0.0) & (connections.pairs >= 0).all(axis=1)
        joint_of_connection = joint_of_connection + np.where(within, len(joints_of_faces(scenario)) // 2, 0)
        bars = face_bars(
            layers,
            members,
            fractured.member_of_shard,
            shards,
            connections,
            scenario.joints,
            joint_of_connection,
            scenario.connections.strength_factor,
            scenario.steel,
            scenario.connections.ductile_elongation_m,
            _cracked_shards(scenario, fractured, connections, decks),
            tuple(t_beams(scenario, layers, members)),
        )
        if starters:
            bars = bars.with_even(starters.yield_n, starters.openings_m)
    if steel:
        bars = with_steel_hinges(bars, steel, scenario, members, len(connections))
    if decks:
        bars = with_studs(bars, decks, scenario, len(connections))
    tendons, bars = model_tendons(
        scenario, members, fractured.member_of_shard, shards, connections, joint_of_connection, bars
    )
    stiffness = None
    if scenario.connections.is_elastic:
        cut = CutMembers(members, fractured.member_of_shard, shards, points, fixed)
        stiffness = _stiffness(connections, moments, scenario, joint_of_connection, cut, steel, decks)
    if soil and stiffness:
        connections, stiffness = on_footings(connections, soil), with_soil(stiffness, soil)
        moments[soil.rows] = second_moments_of(soil)
    return Model(
        members=members,
        shards=raised_shards(
            shards_with_gaps(fractured, members, scenario.fracture.margin_m),
            placed,
            bearing_tables(scenario),
            fractured.member_of_shard,
        ),
        member_of_shard=fractured.member_of_shard,
        masses_kg=fractured.masses_kg,
        centres_m=centres,
        connections=connections,
        joint_of_connection=joint_of_connection,
        second_moments_m4=moments,
        fixed=fixed,
        held_parts=held,
        stiffness=stiffness,
        ground=ground,
        soil=soil,
        bars=bars,
        bearings=bearings,
        crack_bars=_crack_bars(scenario, bars, within, connections, joint_of_connection, bearings)
        if stiffness
        else None,
        steel=steel,
        decks=decks,
        tendons=tendons,
        layers=layers,
    )


def _cracked_shards(
    scenario: Scenario, fractured: FracturedMembers, connections: Connections, decks: DeckContacts | None
) -> CrackedShards | None:
    """Return how far bars stretch where shards crack within, as the scenario says; None where they do not."""
    if not scenario.connections.cracks_within_shards:
        return None
    on_girders = connections.pairs[decks.rows, 0] if decks else np.zeros(0, int)
    return CrackedShards(fractured.centres_m, frozenset(fractured.member_of_shard[on_girders].tolist()))


def _stiffness(
    connections: Connections,
    moments: np.ndarray,
    scenario: Scenario,
    joint_of_connection: np.ndarray,
    cut: CutMembers,
    steel: SteelConnections | None,
    decks: DeckContacts | None,
) -> SectionStiffness:
    """Return the stiffness of all connections: by faces of shards, sections of steel bars, and studs of decks."""
    if steel is None:
        return connection_stiffness(connections, moments, scenario.joints, joint_of_connection, cut)
    matrices = np.zeros((len(connections), 6, 6))
    others = np.setdiff1d(np.arange(len(connections)), steel.rows)
    if decks:
        others = np.setdiff1d(others, decks.rows)
        matrices[decks.rows] = contact_stiffness(decks, scenario).matrices
    if len(others):
        of_faces = connections.only(others), moments[others], scenario.joints, joint_of_connection[others]
        matrices[others] = connection_stiffness(*of_faces, cut).matrices
    matrices[steel.rows] = steel_stiffness(steel, connections, cut.members).matrices
    return SectionStiffness(matrices)


def _crack_bars(
    scenario: Scenario,
    bars: FaceBars | None,
    within: np.ndarray | None,
    connections: Connections,
    joint_of_connection: np.ndarray,
    bearings: ModelBearings | None,
) -> CrackBars | None:
    """Return all bars; even ones are not where connections lie `within` (m,) members that have layers."""
    settings = scenario.connections
    if settings.ductile_share > 0.0:
        even = even_bars_n(settings, scenario.joints, joint_of_connection, connections.areas)
        if within is not None:
            even[within] = 0.0
        if bearings:
            even[bearings.springs.rows] = 0.0  # no bars run through a bearing
        bars = bars or FaceBars.none(len(connections))
        even[bars.have_own_law] = 0.0
        bars = bars.with_even(even, float(given(settings.ductile_elongation_m)))
    return CrackBars(bars, scenario.steel) if bars else None


def _middles(fractured: FracturedMembers) -> np.ndarray:
    """Return the points (n, 3) from which the stiffness of shards is measured to their faces.

    A member that was not cut has its centre of mass: its point, around which it would have been, is anywhere in it.
    """
    whole = np.bincount(fractured.member_of_shard)[fractured.member_of_shard] == 1
    return np.where(whole[:, None], fractured.centres_m, fractured.points_m)


def _connections(
    settings: ConnectionSettings,
    shards: tuple[TriangleMesh, ...],
    centres: np.ndarray,
    faces: SharedFaces,
    allowed: Callable[[np.ndarray], np.ndarray],
    heights_at: Callable[[np.ndarray], np.ndarray] | None,
    may_stand: np.ndarray,
) -> Connections:
    """Return the connections of allowed pairs (k, 2), and to the ground, flat or with such heights.

    On the ground stand those shards (n,) that may.
    """
    match settings.method:
        case "face":
            pairs, distances = connecting.neighbours_by_face(faces)
        case "centre":
            pairs, distances = connecting.neighbours_by_centre(centres, given(settings.search_radius_m))
        case "vertex":
            pairs, distances = connecting.neighbours_by_vertex(shards, given(settings.search_radius_m))
        case "nearest":
            pairs, distances = connecting.neighbours_by_count(centres, given(settings.neighbours))
    kept = allowed(pairs)
    between = connecting.connect(centres, faces, pairs[kept], distances[kept], settings.limit_per_shard)
    if not settings.foundation:
        return between
    standing = connecting.foundations(shards, heights_at)
    stands = allowed(standing.pairs) & may_stand[standing.pairs[:, 0]]
    return connecting.joined([between, standing.only(stands)])


def start_motions(tables: Sequence[Geometry], model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Return velocities (n, 3), m/s, and angular velocities (n, 3), rad/s, of the shards of a model as it begins.

    Of members in several files, the first says how they move, as one body. Shards that are held do not.
    """
    velocities, angular_velocities = np.zeros((2, len(model.shards), 3))
    names = np.array([member.name for member in model.members])[model.member_of_shard]
    first_of_each = {table.name: table for table in reversed(tables)}
    for table in (first for first in first_of_each.values() if first.is_moving):
        shards = np.flatnonzero(names == table.name)
        masses, centres = model.masses_kg[shards, None], model.centres_m[shards]
        angular_velocities[shards] = table.spin_rad_s
        arms = centres - (masses * centres).sum(axis=0) / masses.sum()
        velocities[shards] = np.array(table.velocity_m_s) + cross(angular_velocities[shards], arms)
    velocities[model.fixed], angular_velocities[model.fixed] = 0.0, 0.0
    return velocities, angular_velocities
