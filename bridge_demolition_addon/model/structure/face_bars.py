"""Bars in members, in layers or spread, and what of them crosses the faces that shards share."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from ...engineering.elasticity.steel_bars import (
    MODULUS_PA,
    Steel,
    anchorage_length_m,
    anchored_shares,
    tensile_strength_pa,
)
from ...engineering.geometry.mesh import TriangleMesh, plane_cuts
from ...engineering.geometry.vectors import dot, length, transformed, transformed_back, unit
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_cuts import section_axes
from ...engineering.mechanics.strength import Joint
from ...engineering.structure.connections import Connections, triangles_in_faces
from ..bridge.member import Member
from ..materials import BarLayer
from ..reinforcement.design import all_layers
from ..schema import given
from .box_webs import web_links
from .composite_decks import DeckContacts
from .connection_source import ConnectionRows, ConnectionSource, CutBridge
from .member_layers import LayersOfMember, layers_of_members, spread_bars
from .starter_bars import starter_bars
from .t_beams import TBeam, t_beams

_LEAST_STRETCH = 0.1
"""What bars stretch at least until they yield, by what they do beside one crack: faces along them have no length."""

_LEVEL_M = 1e-9
"""Cuts whose ends are no farther apart along the bars than this are square to these."""


@dataclass(frozen=True, slots=True, eq=False)
class CrackedShards:
    """Shards (n,) that crack within as they do between each other, so that bars stretch from middle to middle."""

    middles_m: np.ndarray  # (n, 3)
    pulled: frozenset[int] = frozenset()  # members that are pulled as a whole, as decks over supports of girders are

    def between_m(self, pairs: np.ndarray, along: np.ndarray) -> np.ndarray:
        """Return the lengths (k,) between the middles of pairs (k, 2) of shards, along directions (3,) or (k, 3)."""
        first, second = self.middles_m[pairs].swapaxes(0, 1)
        lengths: np.ndarray = abs(dot(second - first, np.broadcast_to(along, first.shape)))
        return lengths


def _between(ends: np.ndarray, along: int, between_m: tuple[float, float]) -> np.ndarray:
    """Return the parts of cuts, by their ends (c, 2, 3), between two positions along an axis; others have no length."""
    if between_m == (-math.inf, math.inf):
        return ends
    first, second = ends[:, 0], ends[:, 1]
    length = second[:, along] - first[:, along]
    is_across = abs(length) < _LEVEL_M
    safe = np.where(is_across, 1.0, length)
    shares = np.sort(np.clip((np.array(between_m)[:, None] - first[:, along]) / safe, 0.0, 1.0), axis=0)
    inside = (first[:, along] >= between_m[0]) & (first[:, along] < between_m[1])
    shares[:, is_across] = np.where(inside[is_across], np.array([[0.0], [1.0]]), 0.0)
    return first[:, None] + shares.T[:, :, None] * (second - first)[:, None]


@dataclass(frozen=True, slots=True, eq=False)
class BarRows:
    """b rows of bars, each of one layer of one member across the face of one connection.

    Attributes
    ----------
    connections, members, layers : (b,) int
        Their connection, and the member and the layer, by their numbers in the model, that they are from.
    pulls_n, directions : (b,), (b, 3) float
        Force at which they yield, and its direction, to the side of the second shard.
    moments_nm : (b, 3) float
        Forces times their positions.
    openings_m : (b,) float
        Openings of a crack at which they rupture.
    stretches_m : (b,) float
        What they stretch along cracked shards as they yield; 0 where shards do not crack within.
    """

    connections: np.ndarray
    members: np.ndarray
    layers: np.ndarray
    pulls_n: np.ndarray
    directions: np.ndarray
    moments_nm: np.ndarray
    openings_m: np.ndarray
    stretches_m: np.ndarray

    @classmethod
    def none(cls) -> BarRows:
        """Return no bars."""
        no_rows, no_values, no_vectors = np.zeros(0, int), np.zeros(0), np.zeros((0, 3))
        return cls(no_rows, no_rows, no_rows, no_values, no_vectors, no_vectors, no_values, no_values)

    def summed(self, by_row: np.ndarray, count: int) -> np.ndarray:
        """Return sums (count, ...) of values (b, ...) over the bars across each connection."""
        sums = np.zeros((count, *by_row.shape[1:]))
        np.add.at(sums, self.connections, by_row)
        return sums


@dataclass(frozen=True, slots=True, eq=False)
class ReinforcedFaces:
    """Layers of bars of a model, the rows of them across its m connections, and which of these (m,) have such bars."""

    layers: tuple[BarLayer, ...]
    rows: BarRows
    have_bars: np.ndarray


class MemberBars(ConnectionSource):
    """Bars of members across faces: bars end where their member does, but for those between members of one piece."""

    def barred(self, rows: ConnectionRows) -> ConnectionRows:
        """Return connections with bars; their joints are of concrete without steel."""
        cut = self.cut
        layers = all_layers(cut.scenario, cut.members)
        if not layers:
            return rows
        have_bars = _within_reinforced(layers, cut, rows)
        starters = starter_bars(cut, layers, rows)
        if starters:
            # A foot on the ground cracks at the strength of its face, as where it has no bars, and they hold it then.
            have_bars |= (starters.yield_n > 0.0) & (rows.connections.pairs >= 0).all(axis=1)
        with_bars = [cut.joint_rows.get(name._replace(with_bars=True), row) for name, row in cut.joint_rows.items()]
        rows = replace(rows, joints=np.where(have_bars, np.array(with_bars)[rows.joints], rows.joints))
        cracked = _cracked_shards(cut, rows)
        of_layers = _LayersAcross(layers, cut, rows, cracked).rows()
        bars = _put_together(of_layers, rows.connections, cut.scenario.steel, is_cracked=cracked is not None)
        if starters:
            bars = bars.with_even(starters.yield_n, starters.openings_m)
        if links := web_links(cut, layers, rows):
            bars = bars.with_even(links.yield_n, links.openings_m)
        return replace(rows, bars=bars).with_part(ReinforcedFaces(layers, of_layers, have_bars))


def _cracked_shards(cut: CutBridge, rows: ConnectionRows) -> CrackedShards | None:
    """Return how far bars stretch where shards crack within, as the scenario says; None where they do not."""
    if not cut.scenario.connections.cracks_within_shards:
        return None
    decks = rows.part(DeckContacts)
    on_girders = rows.connections.pairs[decks.rows, 0] if decks else np.zeros(0, int)
    return CrackedShards(cut.centres_m, frozenset(cut.member_of_shard[on_girders].tolist()))


class _LayersAcross:
    """Layers of bars across the faces of a model within its members."""

    def __init__(
        self, layers: Sequence[BarLayer], cut: CutBridge, rows: ConnectionRows, cracked_shards: CrackedShards | None
    ):
        scenario = cut.scenario
        self._layers, self._cut, self._rows, self._cracked_shards = layers, cut, rows, cracked_shards
        self._factor, self._steel = scenario.connections.strength_factor, scenario.steel
        self._opening_m, self._joints = scenario.connections.ductile_elongation_m, scenario.joints
        self._numbers = {id(layer): number for number, layer in enumerate(layers)}
        of_pair = cut.members_of(rows.connections.pairs)
        is_within = _are_within(of_pair) & (rows.connections.areas > 0.0)
        self._member = np.where(is_within, of_pair[:, 0], -1)

    def rows(self) -> BarRows:
        """Return all that cross a face."""
        parts = [BarRows.none(), *self._at_levels(), *self._spread()]
        columns = [np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(BarRows)]
        return BarRows(*columns)

    def _at_levels(self) -> Iterator[BarRows]:
        """Yield the bars of layers, which yield as the section of their member has it, or of the T-beam with that."""
        members, connections, factor = self._cut.members, self._rows.connections, self._factor
        beams = tuple(t_beams(self._cut.scenario, self._layers, members))
        for group in layers_of_members(self._layers, members):
            member = members[group.member]
            for rows, joint, compression_pa in self._by_strength(group.member):
                layer_forces, openings = _as_whole(group, beams, compression_pa, factor, self._steel)
                face, corners = _corners(self._cut.shards, connections.only(rows))
                if group.own is None:
                    corners = member.without_skew(corners)
                    along = unit(member.with_skew(np.eye(3)[group.axes[0]]))
                else:
                    corners = group.own.from_world(corners)
                    along = group.own.directions(group.own.from_world(connections.points[rows]), group.axes[0])
                strains = [0.0] * len(openings)
                if self._cracked_shards:
                    is_pulled, young_pa = group.member in self._cracked_shards.pulled, given(joint.moduli).young_pa
                    strains = group.pulled_strains(layer_forces) if is_pulled else group.bent_strains(factor, young_pa)
                columns = zip(
                    group.layers, layer_forces, openings, strains, group.levels_m, group.widths_m, strict=True
                )
                for layer, force, opening, strain, level, width in columns:
                    pulls, positions = _pulls(face, corners, group, level, force / width, len(rows))
                    if not layer.anchored and not layer.own_axes:
                        held = _anchored(layer, member, tensile_strength_pa(compression_pa), pulls, positions)
                        pulls, positions = held * pulls, held[:, None] * positions
                    moments = member.with_skew(positions) if group.own is None else positions
                    yield self._crossing(rows, layer, pulls, along, moments, opening, strain)

    def _spread(self) -> Iterator[BarRows]:
        connections = self._rows.connections
        for spread in spread_bars(self._layers, self._cut.members):
            strain = self._factor * spread.layer.yield_pa / MODULUS_PA
            for rows, _, compression_pa in self._by_strength(spread.member):
                pulls = spread.pulls_n(connections.only(rows), self._factor)
                moments, along = pulls[:, None] * connections.points[rows], np.eye(3)[spread.along]
                opening = spread.opening_m(compression_pa, self._steel)
                yield self._crossing(rows, spread.layer, pulls, along, moments, opening, strain)

    def _by_strength(self, member: int) -> Iterator[tuple[np.ndarray, Joint, float]]:
        """Yield the faces within a member whose concrete is the same, their joint, and its strength in compression."""
        own = self._member == member
        for joint in np.unique(self._rows.joints[own]):
            if (strength := self._joints[joint].strength) is not None:
                rows = np.flatnonzero(own & (self._rows.joints == joint))
                yield rows, self._joints[joint], float(strength.compression_pa)

    def _crossing(
        self,
        rows: np.ndarray,
        layer: BarLayer,
        pulls_n: np.ndarray,
        along: np.ndarray,
        moments_nm: np.ndarray,
        opening_m: float,
        strain: float,
    ) -> BarRows:
        """Return bars of a layer across faces (k,): `along` (3,) or (k, 3) they run, and yield at a strain."""
        signs = np.where(dot(self._rows.connections.normals[rows], along) < 0.0, -1.0, 1.0)
        stretches_m = np.zeros(len(rows))
        if self._cracked_shards:
            stretches_m = strain * self._cracked_shards.between_m(self._rows.connections.pairs[rows], along)
        columns = (
            rows,
            self._member[rows],
            np.full(len(rows), self._numbers[id(layer)]),
            pulls_n,
            signs[:, None] * along,
            moments_nm,
            np.full(len(rows), opening_m if self._opening_m is None else self._opening_m),
            stretches_m,
        )
        return BarRows(*(column[pulls_n > 0.0] for column in columns))


def _put_together(bars: BarRows, connections: Connections, steel: Steel, *, is_cracked: bool) -> FaceBars:
    """Return the bars across each of m faces as one.

    Where shards crack within, the opening has in it what bars stretch along these as they yield. Bars that run
    different ways pull together in one direction, with which they do the same work where a crack opens: as yield lines
    in slabs do (K. W. Johansen, 1943, Brudlinieteorier).
    """
    count = len(connections)
    pulled_n = bars.summed(bars.pulls_n, count)
    forces = bars.summed(bars.pulls_n[:, None] * bars.directions, count)
    has_bars = pulled_n > 0.0
    moments, where = bars.summed(bars.moments_nm, count), has_bars[:, None]
    positions = np.divide(moments, pulled_n[:, None], out=connections.points.copy(), where=where)
    axes, yield_n = section_axes(connections.normals), length(forces)
    directions = np.divide(forces, yield_n[:, None], out=axes[:, :, 0].copy(), where=where)
    by_opening = bars.summed(bars.openings_m * bars.pulls_n, count)
    openings_m = np.divide(by_opening, pulled_n, out=np.zeros(count), where=has_bars)
    yield_shares = None
    if is_cracked:
        at_crack_m = steel.yield_strain / steel.rupture_strain * openings_m
        by_stretch = bars.summed(bars.stretches_m * bars.pulls_n, count)
        yields_m = np.divide(by_stretch, pulled_n, out=np.zeros(count), where=has_bars)
        yields_m = np.maximum(yields_m, _LEAST_STRETCH * at_crack_m)
        openings_m += yields_m - at_crack_m
        yield_shares = np.divide(yields_m, openings_m, out=np.full(count, np.nan), where=has_bars)
    return FaceBars(
        yield_n,
        transformed_back(axes[:, :, 1:], positions - connections.points),
        transformed_back(axes, directions),
        openings_m,
        yield_shares=yield_shares,
    )


def _as_whole(
    group: LayersOfMember, beams: Sequence[TBeam], compressive_pa: float, factor: float, steel: Steel
) -> tuple[list[float], list[float]]:
    """Return the forces at which layers yield across a crack of the whole section that they are in, and the openings at
    which they rupture, by the bond of concrete that is as weak."""
    beam = next((beam for beam in beams if beam.has(group)), None)
    if beam is None:
        return group.section(compressive_pa, factor).across_cracks_n(), group.openings_m(compressive_pa, steel)
    return beam.across_cracks_n(group, compressive_pa, factor), group.openings_m(compressive_pa, steel, beam.depth_m)


def _anchored(
    layer: BarLayer, member: Member, tensile_pa: float, pulls: np.ndarray, positions: np.ndarray
) -> np.ndarray:
    """Return the parts (k,) of their forces (k,) that straight bars resist by bond, from there to the member's ends.

    `positions` (k, 3) of the bars are weighted by their forces, without the skew of the member, but of one on a line of
    its own. Where a layer says itself where it begins or ends, it has its whole strength.
    """
    axis = layer.axes[0]
    places = np.divide(positions, pulls[:, None], out=np.zeros_like(positions), where=pulls[:, None] > 0.0)
    along = (places if member.line is None else member.line.from_world(places))[:, axis]
    of_member = member.without_skew(member.solid.vertices)[:, axis]
    begin = of_member.min() if layer.from_m is None else -np.inf
    end = of_member.max() if layer.to_m is None else np.inf
    length_m = anchorage_length_m(layer.diameter_m, layer.yield_pa, tensile_pa)
    return anchored_shares(np.minimum(along - begin, end - along), length_m)


def _within_reinforced(layers: Sequence[BarLayer], cut: CutBridge, rows: ConnectionRows) -> np.ndarray:
    """Return whether each connection (m,) is between two shards of one member that has bars."""
    of_pair = cut.members_of(rows.connections.pairs)
    names = [(member.name, member.kind) for member in cut.members]
    reinforced = [index for index, name in enumerate(names) if any(layer.is_in(*name) for layer in layers)]
    return _are_within(of_pair) & np.isin(of_pair[:, 0], reinforced)


def _are_within(of_pair: np.ndarray) -> np.ndarray:
    """Whether connections between members (m, 2), -1 for the ground, are within one."""
    within: np.ndarray = (of_pair[:, 0] == of_pair[:, 1]) & (of_pair[:, 0] >= 0)
    return within


def _corners(shards: Sequence[TriangleMesh], connections: Connections) -> tuple[np.ndarray, np.ndarray]:
    """Face (t,) and corners (t, 3, 3) of the triangles in the faces of connections, in the axes of the world."""
    own = [shards[first] for first in connections.pairs[:, 0]]
    face, corners = triangles_in_faces(own, connections.points, connections.normals)
    across = section_axes(connections.normals)[:, :, 1:]
    return face, connections.points[face][:, None] + transformed(across[face][:, None], corners)


def _pulls(
    face: np.ndarray, corners: np.ndarray, group: LayersOfMember, level: float, force_n_m: float, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Force (k,) of a layer in each of k faces, and that by its position (k, 3), of the world in own axes."""
    along, across, beside = group.axes
    parted, ends = plane_cuts(corners, across, level)
    ends = _between(ends, along, group.between_m)
    lengths = abs(ends[:, 1, beside] - ends[:, 0, beside])
    pulls, positions = np.zeros(count), np.zeros((count, 3))
    np.add.at(pulls, face[parted], force_n_m * lengths)
    middles = ends.mean(axis=1)
    if group.own is not None:
        middles = group.own.to_world(middles)
    np.add.at(positions, face[parted], (force_n_m * lengths)[:, None] * middles)
    return pulls, positions
