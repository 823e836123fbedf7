"""Layers of bars in members, and what of them crosses the faces that shards share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.sides import AXES
from ...engineering.geometry.vectors import transformed, transformed_back
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_forces import section_axes
from ...engineering.structure.connections import Connections
from ...engineering.structure.face_sections import triangles_in_faces
from ...errors import ScenarioError
from ..bridge.member import Member
from ..materials.bar_layers import BarLayer, ReinforcedSection


@dataclass(frozen=True, slots=True)
class LayersOfMember:
    """Layers of bars of a member that run the same way, beside the same two sides.

    The member lies between `lowest` and `highest` along the axis across the layers, m, and the layers at `levels_m`,
    where it is as wide as `widths_m`; `width_m` is its whole width.
    """

    member: int
    layers: tuple[BarLayer, ...]
    lowest: float
    highest: float
    width_m: float
    levels_m: tuple[float, ...]
    widths_m: tuple[float, ...]

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


def layers_of_members(layers: Sequence[BarLayer], members: Sequence[Member]) -> Iterator[LayersOfMember]:
    """Yield the layers of each member, together if they resist the same moments."""
    for layer in layers:
        for name in layer.members:
            if not any(name in (member.name, member.kind) for member in members):
                known = sorted({member.name for member in members} | {member.kind for member in members})
                raise layer.unexpected("members", f"names or kinds of members, such as {', '.join(known)}")
    for index, member in enumerate(members):
        own = [layer for layer in layers if {member.name, member.kind} & set(layer.members)]
        for axes in sorted({layer.axes for layer in own}):
            yield _together(index, member, tuple(layer for layer in own if layer.axes == axes), axes)


def _together(index: int, member: Member, layers: tuple[BarLayer, ...], axes: tuple[int, int, int]) -> LayersOfMember:
    _, across, beside = axes
    lowest, highest = (getattr(member.solid.vertices, which)(axis=0) for which in ("min", "max"))
    levels = tuple(float(layer.level_m(lowest[across], highest[across])) for layer in layers)
    widths = [_width(member.solid, across, beside, level) for level in levels]
    for layer, width in zip(layers, widths, strict=True):
        if width <= 0.0:
            thickness = highest[across] - lowest[across]
            raise ScenarioError(
                f"reinforcement.depth_m is {layer.depth_m:g}: expected less than the size of {member.name!r} along "
                f"{AXES[across]}, {thickness:g} (m)"
            )
    width_m = float(highest[beside] - lowest[beside])
    return LayersOfMember(index, layers, float(lowest[across]), float(highest[across]), width_m, levels, tuple(widths))


def _width(solid: TriangleMesh, across: int, beside: int, level: float) -> float:
    _, points = _crossings(solid.corners, across, level)
    return float(np.ptp(points[..., beside])) if len(points) else 0.0


def _crossings(corners: np.ndarray, across: int, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Return which triangles (t, 3, 3) a plane across an axis parts (c,), and the ends of the cuts (c, 2, 3)."""
    heights = corners[..., across] - level
    parted = np.flatnonzero((heights > 0.0).any(axis=1) & (heights <= 0.0).any(axis=1))
    corners, heights = corners[parted], heights[parted]
    # The corner that is alone on its side comes first: both edges from it are cut.
    above = heights > 0.0
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
    rows = np.arange(len(corners))
    first, height = corners[rows, alone], heights[rows, alone]
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        share = height / (height - heights[rows, other])
        ends.append(first + share[:, None] * (corners[rows, other] - first))
    return parted, np.stack(ends, axis=1) if len(ends[0]) else np.zeros((0, 2, 3))


def face_bars(
    layers: Sequence[BarLayer],
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    shards: Sequence[TriangleMesh],
    connections: Connections,
    joints: Sequence[Joint],
    joint_of_connection: np.ndarray,
    factor: float,
) -> FaceBars:
    """Return the bars of layers that cross the faces of m connections; bars end where their member does.

    `member_of_shard` (n,) and `joint_of_connection` (m,) are indices, `shards` have no gaps yet, and bars are `factor`
    times as strong as their layers say.
    """
    count = len(connections)
    yield_n, by_position = np.zeros(count), np.zeros((count, 3))
    of_pair = np.append(member_of_shard, -1)[connections.pairs]
    is_within = (of_pair[:, 0] == of_pair[:, 1]) & (of_pair[:, 0] >= 0) & (connections.areas > 0.0)
    for group in layers_of_members(layers, members):
        own = is_within & (of_pair[:, 0] == group.member)
        for joint in np.unique(joint_of_connection[own]):
            strength = joints[joint].strength
            rows = np.flatnonzero(own & (joint_of_connection == joint))
            if strength is None or not len(rows):
                continue
            forces = group.section(strength.compression_pa, factor).across_cracks_n()
            face, corners = _corners(shards, connections.only(rows))
            for force, level, width in zip(forces, group.levels_m, group.widths_m, strict=True):
                pulls, positions = _pulls(face, corners, group.axes, level, force / width, len(rows))
                yield_n[rows] += pulls
                by_position[rows] += positions
    positions = np.divide(by_position, yield_n[:, None], out=connections.points.copy(), where=yield_n[:, None] > 0.0)
    across = section_axes(connections.normals)[:, :, 1:]
    return FaceBars(yield_n, transformed_back(across, positions - connections.points))


def _corners(shards: Sequence[TriangleMesh], connections: Connections) -> tuple[np.ndarray, np.ndarray]:
    """Face (t,) and corners (t, 3, 3) of all triangles in the faces of connections, in the axes of the world."""
    own = [shards[first] for first in connections.pairs[:, 0]]
    face, corners = triangles_in_faces(own, connections.points, connections.normals)
    across = section_axes(connections.normals)[:, :, 1:]
    return face, connections.points[face][:, None] + transformed(across[face][:, None], corners)


def _pulls(
    face: np.ndarray, corners: np.ndarray, axes: tuple[int, int, int], level: float, force_n_m: float, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Force (k,) of a layer in each of k faces, and that by its position (k, 3)."""
    _, across, beside = axes
    parted, ends = _crossings(corners, across, level)
    lengths = abs(ends[:, 1, beside] - ends[:, 0, beside])
    pulls, positions = np.zeros(count), np.zeros((count, 3))
    np.add.at(pulls, face[parted], force_n_m * lengths)
    np.add.at(positions, face[parted], (force_n_m * lengths)[:, None] * ends.mean(axis=1))
    return pulls, positions
