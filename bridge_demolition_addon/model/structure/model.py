"""From a scenario to the model that is simulated: shards with their masses, and the connections between them."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Self

import numpy as np

from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...engineering.elasticity.steel_bars import Steel
from ...engineering.foundations import SoilSprings
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import cross
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.structure.connections import GROUND, Connections
from ..actions import CutOfMembers, CutPlane
from ..blast.settings import BlastSettings
from ..bridge.member import Member, mean_density
from ..bridge.preparation import ground_half_size, prepared_members
from ..materials import BarLayer
from ..scenario import Geometry, Scenario
from ..scenario.file import file_digests
from ..scenario.scenario import no_actions
from ..scenario.time import TimeSettings
from ..schema import given
from ..terrain.built import BuiltGround, built_ground
from .bearings import Pads
from .composite_decks import DeckContacts, DecksOnGirders, points_above_girders
from .connection_source import ConnectionRows, ConnectionSource, CutBridge
from .dead_loads import added_masses_kg
from .face_bars import BarRows, MemberBars, ReinforcedFaces
from .face_connections import FaceConnections
from .footings import FootingsOnSoil
from .members import FracturedMembers, fractured_members, shards_with_gaps
from .model_bearings import ModelBearings
from .steelwork import SteelConnections, SteelEnds
from .stiffness import connection_stiffness
from .supports import HeldPart, held_parts
from .t_beam_stiffness import fit_to_t_beams
from .tendons import ModelTendons, TendonsAcross

SOURCES: tuple[type[ConnectionSource], ...] = (
    MemberBars,
    Pads,
    SteelEnds,
    DecksOnGirders,
    FootingsOnSoil,
    TendonsAcross,
)
"""All that connects shards but faces, in order: sections of steel and studs stand in place of bars in layers, and
tendons are added to what is there."""

_SLENDER = 2.0
"""Height of a member over its width from which on it is a column."""


@dataclass(frozen=True, slots=True, eq=False)
class CrackBars:
    """All bars across the faces of m connections, in layers and spread evenly, and what they are made of."""

    bars: FaceBars
    steel: Steel


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
    origins : (m,) str
        What each is from: "faces", "pads", "supports" or "decks", or as a face "steel" or "soil".
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
    bar_rows : BarRows or None
        Each layer across each face; `bars` are their sums; None without layers.
    has_lattices : bool
        Whether slabs on rows of columns are cut around lattices.
    """

    members: tuple[Member, ...]
    shards: tuple[TriangleMesh, ...]
    member_of_shard: np.ndarray
    masses_kg: np.ndarray
    centres_m: np.ndarray
    connections: Connections
    joint_of_connection: np.ndarray
    origins: np.ndarray
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
    bar_rows: BarRows | None = None
    has_lattices: bool = False

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
        """Return the mean density of the members."""
        return mean_density(self.members)


def build_model(scenario: Scenario, members: Sequence[Member] | None = None) -> Model:
    """Return the model of a scenario, always the same; of members without overlap, by default all its own."""
    return model_on(ModelBasis.of(scenario), members)


def model_on(basis: ModelBasis, members: Sequence[Member] | None = None) -> Model:
    """Return the model of every scenario that has a basis; of members as in `build_model`."""
    scenario = basis.scenario
    members = prepared_members(scenario).members if members is None else tuple(members)
    solids = [(member.name, member.solid) for member in members]
    ground = built_ground(scenario, solids, ground_half_size(members, basis.clear_height_m))
    fractured = fractured_members(scenario, members, basis.planes)
    if scenario.dead_loads:
        bounds = np.array([shard.bounds for shard in fractured.shards])
        lying_kg = added_masses_kg(scenario.dead_loads, members, bounds)
        fractured = replace(fractured, masses_kg=fractured.masses_kg + lying_kg)
    held = held_parts(scenario.supports, members, fractured.shards, fractured.member_of_shard)
    cut = _cut_bridge(scenario, members, fractured, ground, held)
    others = [kind(cut) for kind in SOURCES]
    sources = (FaceConnections(cut, others), *others)
    rows = ConnectionRows.none()
    for source in sources:
        rows = source.added(rows)
    for source in sources:
        rows = source.barred(rows)
    stiffness = _stiffness(rows, cut, sources) if scenario.connections.is_elastic else None
    shards = shards_with_gaps(fractured, members, scenario.fracture.margin_m)
    for source in sources:
        shards = source.shaped(shards)
    reinforced = rows.part(ReinforcedFaces)
    return Model(
        members=members,
        shards=shards,
        member_of_shard=fractured.member_of_shard,
        masses_kg=fractured.masses_kg,
        centres_m=fractured.centres_m,
        connections=rows.connections,
        joint_of_connection=rows.joints,
        origins=rows.origins,
        second_moments_m4=rows.moments_m4,
        fixed=cut.fixed,
        held_parts=held,
        stiffness=stiffness,
        ground=ground,
        soil=rows.part(SoilSprings),
        bars=rows.bars,
        bearings=rows.bearings,
        crack_bars=_crack_bars(scenario, rows) if stiffness else None,
        steel=rows.part(SteelConnections),
        decks=rows.part(DeckContacts),
        tendons=rows.part(ModelTendons),
        layers=reinforced.layers if reinforced else (),
        bar_rows=reinforced.rows if reinforced else None,
        has_lattices=bool(fractured.in_lattices.any()),
    )


def _cut_bridge(
    scenario: Scenario,
    members: Sequence[Member],
    fractured: FracturedMembers,
    ground: BuiltGround,
    held: Sequence[HeldPart],
) -> CutBridge:
    fixed = np.zeros(len(fractured.shards), dtype=bool)
    for part in held:
        fixed[part.shards] = True
    return CutBridge(
        members,
        fractured.member_of_shard,
        fractured.shards,
        points_above_girders(
            scenario.steelwork, members, fractured.member_of_shard, fractured.shards, _middles(fractured)
        ),
        fixed,
        fractured.in_lattices,
        scenario,
        fractured.centres_m,
        fractured.faces,
        ground,
        {name: row for row, name in enumerate(scenario.named_joints)},
    )


def _stiffness(rows: ConnectionRows, cut: CutBridge, sources: Sequence[ConnectionSource]) -> SectionStiffness:
    """Return the stiffness of connections: as their source knows it, or else by faces of shards."""
    matrices = np.full((len(rows), 6, 6), np.nan)
    for source in sources:
        source.stiffen(rows, matrices)
    others = np.flatnonzero(np.isnan(matrices[:, 0, 0]))
    if len(others):
        of_faces = rows.connections.only(others), rows.moments_m4[others], cut.scenario.joints, rows.joints[others]
        matrices[others] = connection_stiffness(
            *of_faces, replace(cut, points_m=_points_to_bearings(rows, cut))
        ).matrices
        fit_to_t_beams(matrices, rows, cut)
    return SectionStiffness(matrices)


def _points_to_bearings(rows: ConnectionRows, cut: CutBridge) -> np.ndarray:
    """Return the points (n, 3) of shards, raised to the bearings on columns that carry some.

    A shard ends in its bearing, and what of it is above its point shortens as well.
    """
    if rows.bearings is None:
        return cut.points_m
    points, springs = cut.points_m.copy(), rows.bearings.springs
    below = rows.connections.pairs[springs.rows, 1]
    tops = springs.middles_m()[:, 2]
    extents = np.array([np.ptp(member.solid.vertices, axis=0) for member in cut.members])
    is_column = extents[:, 2] > _SLENDER * extents[:, :2].max(axis=1)
    for shard, top in zip(below.tolist(), tops.tolist(), strict=True):
        if shard != GROUND and is_column[cut.member_of_shard[shard]]:
            points[shard, 2] = top
    return points


def _crack_bars(scenario: Scenario, rows: ConnectionRows) -> CrackBars | None:
    """Return all bars, with even ones where no layers are."""
    settings, bars = scenario.connections, rows.bars
    if settings.ductile_share > 0.0:
        tension_pa = np.array([joint.strength.tension_pa if joint.strength else 0.0 for joint in scenario.joints])
        even: np.ndarray = settings.ductile_share * tension_pa[rows.joints] * rows.connections.areas
        if reinforced := rows.part(ReinforcedFaces):
            even[reinforced.have_bars] = 0.0
        if rows.bearings:
            even[rows.bearings.springs.rows] = 0.0  # no bars run through a bearing
        even[rows.bars_or_none.have_own_law] = 0.0
        bars = rows.bars_or_none.with_even(even, float(given(settings.ductile_elongation_m)))
    return CrackBars(bars, scenario.steel) if bars else None


def _middles(fractured: FracturedMembers) -> np.ndarray:
    """Return the points (n, 3) from which the stiffness of shards is measured to their faces.

    A member that was not cut has its centre of mass: its point, around which it would have been, is anywhere in it.
    """
    whole = np.bincount(fractured.member_of_shard)[fractured.member_of_shard] == 1
    return np.where(whole[:, None], fractured.centres_m, fractured.points_m)


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
        angular_velocities[shards] = table.angular_velocity_rad_s
        arms = centres - (masses * centres).sum(axis=0) / masses.sum()
        velocities[shards] = np.array(table.velocity_m_s) + cross(angular_velocities[shards], arms)
    velocities[model.fixed], angular_velocities[model.fixed] = 0.0, 0.0
    return velocities, angular_velocities


@dataclass(frozen=True, slots=True)
class ModelBasis:
    """What a model is built from: all of a scenario but what is done to its bridge, and when.

    `build_model` sees nothing else. So two scenarios with the same basis have the same model, to the last bit: a key
    that is new belongs to the basis, and what a scenario is stripped of cannot change a model.

    Attributes
    ----------
    scenario : Scenario
        As it stands: without actions, and with the blast and the time that a scenario has by default.
    planes : tuple of CutPlane or CutOfMembers
        What actions have the bridge cut along.
    clear_height_m : float
        How high a ball hangs above the bridge, for which terrain gets more room; 0 without terrain or ball.
    """

    scenario: Scenario
    planes: tuple[CutPlane | CutOfMembers, ...]
    clear_height_m: float

    @classmethod
    def of(cls, scenario: Scenario) -> Self:
        """Return what the model of a scenario is built from."""
        standing = replace(scenario, **no_actions(scenario), blast=BlastSettings(), time=TimeSettings())
        planes = tuple(chain.from_iterable(action.cut_planes() for action in scenario.actions))
        on_terrain = scenario.ball if not scenario.has_flat_ground else None
        return cls(standing, planes, on_terrain.largest_height_m(0.0) if on_terrain else 0.0)

    @property
    def digest(self) -> str:
        """SHA-256, in hexadecimal digits, of every field, down to the sign of a zero, and of files that are read."""
        text = "\n".join((repr(self), *file_digests(self.scenario)))
        return hashlib.sha256(text.encode()).hexdigest()
