"""Bars in members, in layers or spread, and what of them crosses the faces that shards share."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.anchorage import anchorage_length_m, anchored_shares
from ...engineering.elasticity.bar_rupture import tensile_strength_pa
from ...engineering.elasticity.steel_bars import MODULUS_PA, Steel
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.plane_cuts import plane_cuts
from ...engineering.geometry.vectors import dot, length, transformed, transformed_back, unit
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_forces import section_axes
from ...engineering.structure.connections import Connections
from ...engineering.structure.face_sections import triangles_in_faces
from ..bridge.member import Member
from ..materials.bar_layers import BarLayer
from .member_layers import LayersOfMember, layers_of_members
from .spread_bars import spread_bars
from .t_beams import TBeam

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


def face_bars(
    layers: Sequence[BarLayer],
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    shards: Sequence[TriangleMesh],
    connections: Connections,
    joints: Sequence[Joint],
    joint_of_connection: np.ndarray,
    factor: float,
    steel: Steel,
    opening_m: float | None,
    cracked_shards: CrackedShards | None = None,
    beams: Sequence[TBeam] = (),
) -> FaceBars:
    """Return the bars of layers that cross the faces of m connections; bars end where their member does.

    `member_of_shard` (n,) and `joint_of_connection` (m,) are indices, `shards` have no gaps yet, and bars are `factor`
    times as strong as their layers say. They rupture at an opening, or without one as their steel and bond say; where
    shards crack within, this opening has in it what bars stretch along these as they yield. They yield as the section
    of their member has it, or that of the T-beam that it is a part of. Bars that run different ways pull together in
    one direction, with which they do the same work where a crack opens: as yield lines in slabs do (K. W. Johansen,
    1943, Brudlinieteorier).
    """
    count = len(connections)
    pulled_n, forces, by_position, by_opening = np.zeros(count), *np.zeros((2, count, 3)), np.zeros(count)
    by_stretch = np.zeros(count)
    of_pair = np.append(member_of_shard, -1)[connections.pairs]
    is_within = _are_within(of_pair) & (connections.areas > 0.0)
    for group in layers_of_members(layers, members):
        own = is_within & (of_pair[:, 0] == group.member)
        for joint in np.unique(joint_of_connection[own]):
            strength = joints[joint].strength
            rows = np.flatnonzero(own & (joint_of_connection == joint))
            if strength is None or not len(rows):
                continue
            layer_forces, openings = _as_whole(group, beams, float(strength.compression_pa), factor, steel)
            member = members[group.member]
            face, corners = _corners(shards, connections.only(rows))
            if group.own is None:
                corners = member.without_skew(corners)
                along = unit(member.with_skew(np.eye(3)[group.axes[0]]))
            else:
                corners = group.own.from_world(corners)
                along = group.own.directions(group.own.from_world(connections.points[rows]), group.axes[0])
            signs = np.where(dot(connections.normals[rows], along) < 0.0, -1.0, 1.0)
            strains = [0.0] * len(openings)
            if cracked_shards:
                is_pulled, young_pa = group.member in cracked_shards.pulled, joints[joint].moduli.young_pa
                strains = group.pulled_strains(layer_forces) if is_pulled else group.bent_strains(factor, young_pa)
            columns = zip(group.layers, layer_forces, openings, strains, group.levels_m, group.widths_m, strict=True)
            for layer, force, opening, strain, level, width in columns:
                pulls, positions = _pulls(face, corners, group, level, force / width, len(rows))
                if not layer.anchored and group.own is None:
                    held = _anchored(layer, member, tensile_strength_pa(strength.compression_pa), pulls, positions)
                    pulls, positions = held * pulls, held[:, None] * positions
                pulled_n[rows] += pulls
                forces[rows] += (signs * pulls)[:, None] * along
                by_position[rows] += member.with_skew(positions) if group.own is None else positions
                by_opening[rows] += (opening if opening_m is None else opening_m) * pulls
                if cracked_shards:
                    by_stretch[rows] += strain * cracked_shards.between_m(connections.pairs[rows], along) * pulls
    for spread in spread_bars(layers, members):
        own = is_within & (of_pair[:, 0] == spread.member)
        for joint in np.unique(joint_of_connection[own]):
            strength = joints[joint].strength
            rows = np.flatnonzero(own & (joint_of_connection == joint))
            if strength is None or not len(rows):
                continue
            pulls = spread.pulls_n(connections.only(rows), factor)
            opening = spread.opening_m(strength.compression_pa, steel) if opening_m is None else opening_m
            pulled_n[rows] += pulls
            forces[rows, spread.along] += np.where(connections.normals[rows, spread.along] < 0.0, -pulls, pulls)
            by_position[rows] += pulls[:, None] * connections.points[rows]
            by_opening[rows] += opening * pulls
            if cracked_shards:
                stretched_m = cracked_shards.between_m(connections.pairs[rows], np.eye(3)[spread.along])
                by_stretch[rows] += factor * spread.layer.yield_pa / MODULUS_PA * stretched_m * pulls
    has_bars = pulled_n > 0.0
    positions = np.divide(by_position, pulled_n[:, None], out=connections.points.copy(), where=has_bars[:, None])
    axes, yield_n = section_axes(connections.normals), length(forces)
    directions = np.divide(forces, yield_n[:, None], out=axes[:, :, 0].copy(), where=has_bars[:, None])
    openings_m = np.divide(by_opening, pulled_n, out=np.zeros(count), where=has_bars)
    yield_shares = None
    if cracked_shards:
        at_crack_m = steel.yield_strain / steel.rupture_strain * openings_m
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
    which they rupture."""
    beam = next((beam for beam in beams if beam.has(group)), None)
    if beam is None:
        return group.section(compressive_pa, factor).across_cracks_n(), group.openings_m(compressive_pa, steel)
    return beam.across_cracks_n(group, compressive_pa, factor), group.openings_m(compressive_pa, steel, beam.depth_m)


def _anchored(
    layer: BarLayer, member: Member, tensile_pa: float, pulls: np.ndarray, positions: np.ndarray
) -> np.ndarray:
    """Return the parts (k,) of their forces (k,) that straight bars resist by bond, from there to the member's ends.

    `positions` (k, 3) are those of the bars by their forces, without the skew of the member. Where a layer says itself
    where it begins or ends, it has its whole strength.
    """
    axis = layer.axes[0]
    along = np.divide(positions[:, axis], pulls, out=np.zeros(len(pulls)), where=pulls > 0.0)
    of_member = member.without_skew(member.solid.vertices)[:, axis]
    begin = of_member.min() if layer.from_m is None else -np.inf
    end = of_member.max() if layer.to_m is None else np.inf
    length_m = anchorage_length_m(layer.diameter_m, layer.yield_pa, tensile_pa)
    return anchored_shares(np.minimum(along - begin, end - along), length_m)


def within_reinforced(
    layers: Sequence[BarLayer], members: Sequence[Member], member_of_shard: np.ndarray, connections: Connections
) -> np.ndarray:
    """Return whether each connection (m,) is between two shards of one member that has bars."""
    of_pair = np.append(member_of_shard, -1)[connections.pairs]
    names = [(member.name, member.kind) for member in members]
    reinforced = [index for index, name in enumerate(names) if any(layer.is_in(*name) for layer in layers)]
    return _are_within(of_pair) & np.isin(of_pair[:, 0], reinforced)


def _are_within(of_pair: np.ndarray) -> np.ndarray:
    """Whether connections between members (m, 2), -1 for the ground, are within one."""
    within: np.ndarray = (of_pair[:, 0] == of_pair[:, 1]) & (of_pair[:, 0] >= 0)
    return within


def _corners(shards: Sequence[TriangleMesh], connections: Connections) -> tuple[np.ndarray, np.ndarray]:
    """Face (t,) and corners (t, 3, 3) of all triangles in the faces of connections, in the axes of the world."""
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
