"""Bars in members, in layers or spread, and what of them crosses the faces that shards share."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...engineering.elasticity.anchorage import anchorage_length_m, anchored_shares
from ...engineering.elasticity.bar_rupture import (
    crack_spacing_m,
    mean_strain_at_rupture,
    rupture_opening_m,
    tensile_strength_pa,
)
from ...engineering.elasticity.steel_bars import MODULUS_PA, Steel
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.own_axes import OwnAxes
from ...engineering.geometry.plane_cuts import plane_cuts
from ...engineering.geometry.sides import AXES
from ...engineering.geometry.vectors import dot, length, transformed, transformed_back, unit
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_forces import section_axes
from ...engineering.structure.connections import Connections
from ...engineering.structure.face_sections import triangles_in_faces
from ...errors import ScenarioError
from ..bridge.member import Member
from ..bridge.own_axes import is_standing, own_axes
from ..materials.bar_layers import BarLayer, ReinforcedSection
from .spread_bars import spread_bars

_LEAST_STRETCH = 0.1
"""What bars stretch at least until they yield, by what they do beside one crack: faces along them have no length."""

_LEVEL_M = 1e-9
"""Cuts whose ends are no farther apart along the bars than this are square to these."""


@dataclass(frozen=True, slots=True)
class LayersOfMember:
    """Layers of bars of a member that run the same way, beside the same two sides.

    All is that of the member without skew: its layers are skewed with it. It lies between `lowest` and `highest` along
    the axis across the layers, m, and the layers at `levels_m`, where it is as wide as `widths_m`; `width_m` is its
    whole width.
    """

    member: int
    layers: tuple[BarLayer, ...]
    lowest: float
    highest: float
    width_m: float
    levels_m: tuple[float, ...]
    widths_m: tuple[float, ...]
    between_m: tuple[float, float] = (-math.inf, math.inf)  # along the bars: part of the member with these layers
    own: OwnAxes | None = None  # axes of the member that these layers count in; None for those of the bridge

    @property
    def axes(self) -> tuple[int, int, int]:
        """Return the axes along the bars, across the layers and along these."""
        return self.layers[0].axes

    def section(self, compressive_pa: float, factor: float = 1.0) -> ReinforcedSection:
        """Return the section, with depths from where it is highest, and bars so many times as strong."""
        return ReinforcedSection(
            self.highest - self.lowest,
            self.width_m,
            compressive_pa,
            [self.highest - level for level in self.levels_m],
            [layer.area_m2 for layer in self.layers],
            [factor * layer.yield_pa for layer in self.layers],
        )

    def pulled_strains(self, forces_n: Sequence[float]) -> list[float]:
        """Return strains at which layers have such forces, pulled as a whole: they stretch by E A."""
        return [force / (MODULUS_PA * layer.area_m2) for layer, force in zip(self.layers, forces_n, strict=True)]

    def bent_strains(self, factor: float, young_pa: float) -> list[float]:
        """Return by what the edge beside each layer stretches as that yields, in a section of concrete that is bent.

        It is d - x that bars stretch by their strain, with x pressed elastically: b x² / 2 = α A (d - x), of each layer
        alone. This is the fully cracked state of EN 1992-1-1:2004, 7.4.3 (3).
        """
        strains = []
        for layer, level, width in zip(self.layers, self.levels_m, self.widths_m, strict=True):
            depth = max(self.highest - level, level - self.lowest)
            by_width = MODULUS_PA / young_pa * layer.area_m2 / width
            pressed = math.sqrt(by_width * by_width + 2.0 * by_width * depth) - by_width
            height = self.highest - self.lowest
            strains.append(factor * layer.yield_pa / MODULUS_PA * height / (depth - pressed))
        return strains

    def openings_m(self, compressive_pa: float, steel: Steel) -> list[float]:
        """Return the opening of a crack at which the bars of each layer rupture."""
        depth_m, tensile_pa = self.highest - self.lowest, tensile_strength_pa(compressive_pa)
        openings = []
        for layer, level, width in zip(self.layers, self.levels_m, self.widths_m, strict=True):
            below_edge_m = min(level - self.lowest, self.highest - level)
            spacing = crack_spacing_m(layer.diameter_m, layer.area_m2, width, below_edge_m, depth_m)
            own = replace(steel, yield_pa=layer.yield_pa)
            openings.append(
                rupture_opening_m(mean_strain_at_rupture(own, layer.diameter_m, spacing, tensile_pa), depth_m)
            )
        return openings


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


def layers_of_members(layers: Sequence[BarLayer], members: Sequence[Member]) -> Iterator[LayersOfMember]:
    """Yield the layers of each member, together if they resist the same moments."""
    for layer in layers:
        for name in layer.members:
            if not any(name in (member.name, member.kind) for member in members):
                known = sorted({member.name for member in members} | {member.kind for member in members})
                raise layer.unexpected("members", f"names or kinds of members, such as {', '.join(known)}")
    for index, member in enumerate(members):
        own = [layer for layer in layers if not layer.is_spread and layer.is_in(member.name, member.kind)]
        for is_own, axes in sorted({(layer.own_axes, layer.axes) for layer in own}):
            alike = [layer for layer in own if (layer.own_axes, layer.axes) == (is_own, axes)]
            yield from _stretches(index, member, alike, axes)


def _stretches(
    index: int, member: Member, layers: Sequence[BarLayer], axes: tuple[int, int, int]
) -> Iterator[LayersOfMember]:
    """Yield the layers of each part of a member in which these are the same."""
    corners = member.without_skew(member.solid.corners)
    along = corners[..., axes[0]]
    first, last = float(along.min()), float(along.max())
    if layers[0].own_axes:
        first, last = own_axes(member).ends_m(axes[0])
    for layer in layers:
        begin, end = layer.ends_m
        if begin >= last or end <= first:
            name, limit = ("from_m", f"less than {last:g}") if begin >= last else ("to_m", f"more than {first:g}")
            raise layer.unexpected(name, f"{limit} (m), where {member.name!r} ends along {AXES[axes[0]]}")
    ends = sorted({-math.inf, math.inf, *(end for layer in layers for end in layer.ends_m if first < end < last)})
    for begin, end in pairwise(ends):
        own = tuple(layer for layer in layers if max(layer.ends_m[0], begin) < min(layer.ends_m[1], end))
        if own:
            together = _in_own_axes if own[0].own_axes else _together
            yield together(index, member, corners, own, axes, (begin, end))


def _together(
    index: int,
    member: Member,
    corners: np.ndarray,
    layers: tuple[BarLayer, ...],
    axes: tuple[int, int, int],
    between_m: tuple[float, float],
) -> LayersOfMember:
    _, across, beside = axes
    lowest, highest = (getattr(corners, which)(axis=(0, 1)) for which in ("min", "max"))
    levels = tuple(float(layer.level_m(lowest[across], highest[across])) for layer in layers)
    widths = [_width(corners, across, beside, level) for level in levels]
    _check_widths(member, layers, widths, across, float(highest[across] - lowest[across]))
    width_m = float(highest[beside] - lowest[beside])
    return LayersOfMember(
        index, layers, float(lowest[across]), float(highest[across]), width_m, levels, tuple(widths), between_m
    )


def _in_own_axes(
    index: int,
    member: Member,
    corners: np.ndarray,
    layers: tuple[BarLayer, ...],
    axes: tuple[int, int, int],
    between_m: tuple[float, float],
) -> LayersOfMember:
    """Return the same of layers that count in the axes of their member."""
    own, (_, across, beside) = own_axes(member), axes
    lowest, highest = own.ends_m(across)
    levels = tuple(float(layer.level_m(lowest, highest)) for layer in layers)
    first, last = own.ends_m(beside)
    if is_standing(member):
        placed = own.from_world(corners)
        widths = tuple(_width(placed, across, beside, level) for level in levels)
    else:
        widths = tuple(own.width_at_m(level) if beside == 1 else last - first for level in levels)
    _check_widths(member, layers, widths, across, highest - lowest)
    return LayersOfMember(index, layers, lowest, highest, last - first, levels, widths, between_m, own)


def _check_widths(
    member: Member, layers: Sequence[BarLayer], widths: Sequence[float], across: int, thickness_m: float
) -> None:
    for layer, width in zip(layers, widths, strict=True):
        if width <= 0.0:
            raise ScenarioError(
                f"reinforcement.depth_m is {layer.depth_m:g}: expected less than the size of {member.name!r} along "
                f"{AXES[across]}, {thickness_m:g} (m)"
            )


def _width(corners: np.ndarray, across: int, beside: int, level: float) -> float:
    _, points = plane_cuts(corners, across, level)
    return float(np.ptp(points[..., beside])) if len(points) else 0.0


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
) -> FaceBars:
    """Return the bars of layers that cross the faces of m connections; bars end where their member does.

    `member_of_shard` (n,) and `joint_of_connection` (m,) are indices, `shards` have no gaps yet, and bars are `factor`
    times as strong as their layers say. They rupture at an opening, or without one as their steel and bond say; where
    shards crack within, this opening has in it what bars stretch along these as they yield. Bars
    that run different ways pull together in one direction, with which they do the same work where a crack opens:
    as yield lines in slabs do (K. W. Johansen, 1943, Brudlinieteorier).
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
            layer_forces = group.section(strength.compression_pa, factor).across_cracks_n()
            openings = group.openings_m(strength.compression_pa, steel)
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
