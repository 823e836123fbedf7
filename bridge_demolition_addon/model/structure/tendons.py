"""Tendons of a model: their lines, where they pass from shard to shard, and what bars they are across cracks."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...engineering.elasticity.crack_state import FRICTION
from ...engineering.elasticity.steel_bars import (
    Steel,
    mean_strain_at_rupture,
    rupture_opening_m,
    spacing_of_ratio_m,
    tensile_strength_pa,
)
from ...engineering.elasticity.tendons import (
    MODULUS_PA,
    RUPTURE_STRAIN,
    TendonForces,
    TendonPassages,
    TendonSteel,
    transmission_length_m,
)
from ...engineering.geometry.mesh import TriangleMesh, volumes_and_centres
from ...engineering.geometry.solids import Passages, passages
from ...engineering.geometry.turned_boxes import TurnedBox
from ...engineering.geometry.vectors import distance, dot, points_along, transformed_back
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_cuts import section_axes
from ...engineering.mechanics.strength import Joint
from ...engineering.structure.connections import Connections
from ...errors import ScenarioError
from ..actions import Fact
from ..bridge.member import Member
from ..scenario import Scenario, Tendon
from ..schema import given
from .connection_source import ConnectionRows, ConnectionSource

_PARABOLA_PIECES = 64
"""Straight pieces of a parabola: the deviation forces of one are within 0.1 % of those of the other."""

_YIELD = 0.88
"""Yield strength of prestressing steel by its tensile strength: f_p0.1k / f_pk of EN 10138 strands."""

_USUAL_PA = 30e6
"""Strength in compression of concrete, where the connections of a tendon have none."""


@dataclass(frozen=True, slots=True, eq=False)
class ModelTendons:
    """All tendons of a model of n shards, or of the bodies of a scene."""

    names: tuple[str, ...]
    members: tuple[str, ...]  # that they are in
    steel: TendonSteel
    passages: TendonPassages
    paths_m: tuple[np.ndarray, ...] = field(repr=False)  # (p, 3) each

    def friction(self, members: np.ndarray) -> np.ndarray:
        """Return the friction of connections between two shards of members (m, 2), by name: of those with tendons.

        Prestress presses inclined faces, which would slide by their shear strength alone.
        """
        own = np.isin(members, self.members).all(axis=1) & (members[:, 0] == members[:, 1])
        return np.where(own, FRICTION, 0.0)

    def forces(self, positions_m: np.ndarray, rotations: np.ndarray) -> TendonForces:
        """Return the forces on n bodies at positions (3, n) in rotations (3, 3, n), as they were built."""
        return TendonForces(self.steel, self.passages, positions_m, rotations)

    def forces_of_shards(self, centres_m: np.ndarray) -> TendonForces:
        """Return the forces on shards with centres (n, 3) as they were built, and on the ground behind them."""
        positions = np.vstack((centres_m, np.zeros(3))).T
        return self.forces(positions, np.repeat(np.eye(3)[:, :, None], positions.shape[1], axis=2))

    def within_box(self, tendon: int, box: TurnedBox) -> float | None:
        """Return the distance along a tendon of the middle of what lies in a box; None where nothing does."""
        path, (lowest_m, highest_m) = box.in_own_axes(self.paths_m[tendon]), box.corners_m
        ends = np.concatenate((np.zeros(1), np.cumsum(distance(path[1:], path[:-1]))))
        inside = []
        for start, stop, begin, end in zip(path[:-1], path[1:], ends[:-1], ends[1:], strict=True):
            way = stop - start
            still = np.abs(way) < 1e-12
            if (still & ((start < lowest_m) | (start > highest_m))).any():
                continue
            safe = np.where(still, 1.0, way)
            shares = np.sort(np.stack((lowest_m - start, highest_m - start)) / safe, axis=0)
            low = max(0.0, float(np.where(still, 0.0, shares[0]).max()))
            high = min(1.0, float(np.where(still, 1.0, shares[1]).min()))
            if low <= high:
                inside += [begin + low * (end - begin), begin + high * (end - begin)]
        return 0.5 * (min(inside) + max(inside)) if inside else None

    def point_at(self, tendon: int, distance_m: float) -> np.ndarray:
        """Return the point (3,) at a distance along a tendon, as the bridge was built."""
        return points_along(self.paths_m[tendon], np.array([distance_m]))[0]


@dataclass(frozen=True, slots=True, eq=False)
class _Placed:
    """A tendon of the scenario in its member: its line, and where that passes from shard to shard, k times."""

    table: Tendon
    member: Member
    path_m: np.ndarray  # (p, 3)
    passed: Passages
    pairs: np.ndarray  # (2, k), shards
    connections: np.ndarray  # (k,), -1 for none
    compression_pa: float  # strength of the concrete

    @property
    def tensile_pa(self) -> float:
        return tensile_strength_pa(self.compression_pa)

    @property
    def is_upright(self) -> bool:
        way = np.abs(self.path_m[-1] - self.path_m[0])
        return bool(way[2] > max(way[:2]))

    @property
    def depth_m(self) -> float:
        """Depth of the section: the height of a lying member, the smaller side of an upright one."""
        sizes = np.ptp(self.member.solid.vertices, axis=0)
        return float(min(sizes[:2]) if self.is_upright else sizes[2])

    @property
    def block_m(self) -> float:
        """Depth of concrete that is crushed as it ruptures: A f_p / (b f_c) of a lying member, 0 of an upright one."""
        if self.is_upright or not self.table.bonded:
            return 0.0
        way = np.abs(self.path_m[-1] - self.path_m[0])
        width_m = float(np.ptp(self.member.solid.vertices, axis=0)[1 if way[0] >= way[1] else 0])
        return self.table.rupture_n / (width_m * self.compression_pa)

    def pulls_n(self, block_m: float) -> np.ndarray:
        """Return the forces (k,) that its prestress has left of its strength.

        A crack between shards closes at the edge of the section, and concrete is crushed over some depth a below it. So
        the strength counts for as much as has the moment A f_p (d - a / 2) about that edge.
        """
        lowest, highest = self.member.solid.bounds[:, 2]
        heights = self.passed.points_m[:, 2]
        depths = np.full(len(heights), np.inf) if self.is_upright else np.maximum(highest - heights, heights - lowest)
        shares = np.maximum(1.0 - 0.5 * block_m / depths, 0.0)
        pulls: np.ndarray = np.maximum(shares * self.table.rupture_n - self.table.force_n, 0.0) * self.table.bonded
        return pulls


class TendonsAcross(ConnectionSource):
    """Tendons of a scenario, in shards without gaps: bonded ones hold cracks as bars do."""

    def barred(self, rows: ConnectionRows) -> ConnectionRows:
        """Return bars across connections together with tendons, by what prestress has left of the strength of these."""
        cut, scenario = self.cut, self.cut.scenario
        if not scenario.tendons:
            return rows
        pairs_of_rows = np.sort(rows.connections.pairs, axis=1).tolist()
        row_of = {tuple(pair): row for row, pair in reversed(list(enumerate(pairs_of_rows)))}
        placed, joints = [], scenario.joints
        for table in scenario.tendons:
            member = _member_of(table, cut.members)
            own = np.flatnonzero(cut.member_of_shard == member)
            path_m = _path(table, cut.members[member])
            passed = passages(path_m, [cut.shards[shard] for shard in own.tolist()])
            _check_within(table, path_m, passed)
            pairs = np.stack((own[passed.first], own[passed.second]))
            crossed = np.array([row_of.get(tuple(pair), -1) for pair in np.sort(pairs.T, axis=1).tolist()])
            compression_pa = _compression_pa(joints, rows.joints[crossed[crossed >= 0]])
            placed.append(_Placed(table, cut.members[member], path_m, passed, pairs, crossed, compression_pa))
        tendons = ModelTendons(
            names=tuple(one.table.name for one in placed),
            members=tuple(one.table.member for one in placed),
            steel=_steel(placed),
            passages=_passages(placed, rows.connections),
            paths_m=tuple(one.path_m for one in placed),
        )
        blocks = [math.fsum(other.block_m for other in placed if other.member is one.member) for one in placed]
        pulls_n = np.concatenate([one.pulls_n(block_m) for one, block_m in zip(placed, blocks, strict=True)])
        tendons, bars = _with_bars(tendons, pulls_n / scenario.steel.hardening, rows.bars_or_none, rows.connections)
        return replace(rows, bars=bars).with_part(tendons)


def _steel(placed: Sequence[_Placed]) -> TendonSteel:
    return TendonSteel(
        forces_n=np.array([one.table.force_n for one in placed]),
        areas_m2=np.array([one.table.area_m2 for one in placed]),
        lengths_m=np.array([float(distance(one.path_m[1:], one.path_m[:-1]).sum()) for one in placed]),
        transmission_m=np.array(
            [transmission_length_m(one.table.diameter_m, one.table.prestress_pa, one.tensile_pa) for one in placed]
        ),
        bonded=np.array([one.table.bonded for one in placed]),
        anchored=np.array([one.table.anchored for one in placed]),
    )


def _passages(placed: Sequence[_Placed], connections: Connections) -> TendonPassages:
    counts = [len(one.connections) for one in placed]
    openings = [
        _opening_m(one, connections, row) if one.table.bonded else np.inf
        for one in placed
        for row in one.connections.tolist()
    ]
    return TendonPassages(
        tendons=np.repeat(np.arange(len(placed)), counts),
        first=np.concatenate([one.pairs[0] for one in placed]),
        second=np.concatenate([one.pairs[1] for one in placed]),
        distances_m=np.concatenate([one.passed.distances_m for one in placed]),
        points_m=np.concatenate([one.passed.points_m for one in placed]).T,
        directions=np.concatenate([one.passed.directions for one in placed]).T,
        connections=np.concatenate([one.connections for one in placed]),
        openings_m=np.array(openings),
        of_bars=np.zeros(sum(counts)),
    )


def _with_bars(
    tendons: ModelTendons, pulls_n: np.ndarray, bars: FaceBars, connections: Connections
) -> tuple[ModelTendons, FaceBars]:
    """Return tendons that know their places among the bars, and these bars: they yield at `pulls_n` (k,)."""
    passed, steel = tendons.passages, tendons.steel
    rows = np.flatnonzero((passed.connections >= 0) & steel.bonded[passed.tendons])
    at = passed.connections[rows]
    pulls = (pulls_n * steel.shares_at(passed))[rows]
    axes = section_axes(connections.normals[at])
    along = passed.directions[:, rows].T
    along = np.where(dot(along, connections.normals[at])[:, None] < 0.0, -1.0, 1.0) * along
    together = bars.with_pulls(
        at,
        pulls,
        transformed_back(axes[:, :, 1:], passed.points_m[:, rows].T - connections.points[at]),
        transformed_back(axes, along),
        passed.openings_m[rows],
    )
    whole, of_bars = bars.yield_n.copy(), np.zeros(len(passed.tendons))
    np.add.at(whole, at, pulls)
    of_bars[rows] = np.divide(pulls, whole[at], out=np.zeros(len(rows)), where=whole[at] > 0.0)
    return replace(tendons, passages=replace(passed, of_bars=of_bars)), together


def _member_of(tendon: Tendon, members: Sequence[Member]) -> int:
    for index, member in enumerate(members):
        if member.name == tendon.member:
            return index
    names = ", ".join(member.name for member in members)
    raise tendon.unexpected("member", f"the name of a member, one of {names}")


def _path(tendon: Tendon, member: Member) -> np.ndarray:
    if tendon.points_m is not None:
        return np.array(tendon.points_m)
    first, middle, last = given(tendon.eccentricities_m)
    corners = member.without_skew(member.solid.corners).reshape(-1, 3)
    (begin, right, _), (end, left, _) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    share = np.linspace(0.0, 1.0, _PARABOLA_PIECES + 1)
    below = first + share * (4.0 * middle - 3.0 * first - last) + share * share * (2.0 * (first + last) - 4.0 * middle)
    straight = TriangleMesh(member.without_skew(member.solid.vertices), member.solid.triangles)
    height = volumes_and_centres([straight if member.line else member.solid])[1][0, 2]  # of sections that are alike
    beside = 0.5 * (right + left) + tendon.beside_m
    points = np.column_stack((begin + share * (end - begin), np.full(len(share), beside), height - below))
    return member.with_skew(points)


def _check_within(tendon: Tendon, path_m: np.ndarray, passed: Passages) -> None:
    if passed.gap_m is not None:
        x, y, z = points_along(path_m, np.array([passed.gap_m]))[0].tolist()
        raise ScenarioError(
            f"tendons {tendon.name!r} leaves {tendon.member} at ({x:.3f}, {y:.3f}, {z:.3f}) m: expected all of "
            "its line within the member"
        )
    if not len(passed.first):
        raise ScenarioError(
            f"tendons {tendon.name!r} lies in one shard of {tendon.member}: expected a member in more shards, by "
            "fracture.shards"
        )


def _compression_pa(joints: Sequence[Joint], used: np.ndarray) -> float:
    """Strength in compression of the first of some joints (j,) that has one."""
    for joint in used.tolist():
        if (strength := joints[joint].strength) is not None:
            return float(np.max(strength.compression_pa))
    return _USUAL_PA


def _opening_m(placed: _Placed, connections: Connections, row: int) -> float:
    """Opening of a crack at which a tendon ruptures, with the strain that its prestress has left."""
    table, depth_m = placed.table, placed.depth_m
    strain = RUPTURE_STRAIN - table.prestress_pa / MODULUS_PA
    left_pa = table.strength_pa - table.prestress_pa
    steel = Steel(_YIELD * left_pa, 1.0 / _YIELD, max(strain, 2.0 * left_pa / MODULUS_PA))
    area_m2 = float(connections.areas[row]) if row >= 0 else depth_m * depth_m
    spacing_m = spacing_of_ratio_m(table.diameter_m, table.area_m2 / max(area_m2, table.area_m2))
    return rupture_opening_m(mean_strain_at_rupture(steel, table.diameter_m, spacing_m, placed.tensile_pa), depth_m)


def tendon_facts(scenario: Scenario, tendons: ModelTendons) -> Iterator[Fact]:
    """Yield force, length and energy of each tendon, and what a cut takes of it."""
    count = 1 + int(max(tendons.passages.first.max(), tendons.passages.second.max()))
    unturned = np.repeat(np.eye(3)[:, :, None], count, axis=2)
    stored_j = tendons.forces(np.zeros((3, count)), unturned).stored_j()
    steel = tendons.steel
    for number, table in enumerate(scenario.tendons):
        share = table.prestress_n_mm2 / table.strength_n_mm2
        yield (
            table.name,
            f"{table.member}: {steel.forces_n[number] / 1000.0:.0f} kN, {share:.0%} of its strength, "
            f"{steel.lengths_m[number]:.2f} m, {stored_j[number] / 1000.0:.1f} kJ",
        )
        if table.bonded:
            ends = "" if table.anchored else ", and so do its ends, without anchorages"
            yield "", f"bonded: a cut takes its force over {steel.transmission_m[number]:.2f} m to both sides{ends}"
        else:
            yield "", "not bonded: any cut takes all of its force"
    yield "", "energy of tendons hurts people: keep everybody off their lines and anchorages while they are cut"
