"""Tendons of a model: their lines, where they pass from shard to shard, and what bars they are across cracks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...engineering.elasticity.bar_rupture import (
    mean_strain_at_rupture,
    rupture_opening_m,
    spacing_of_ratio_m,
    tensile_strength_pa,
)
from ...engineering.elasticity.steel_bars import Steel
from ...engineering.elasticity.tendons import (
    MODULUS_PA,
    RUPTURE_STRAIN,
    TendonForces,
    TendonPassages,
    TendonSteel,
    transmission_length_m,
)
from ...engineering.geometry.mesh import TriangleMesh, volumes_and_centres
from ...engineering.geometry.paths_through_solids import Passages, passages
from ...engineering.geometry.vectors import distance, dot, points_along, transformed_back
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_forces import section_axes
from ...engineering.structure.connections import Connections
from ...errors import ScenarioError
from ..bridge.member import Member
from ..scenario import Scenario, Tendon
from ..schema import given

_PARABOLA_PIECES = 64
"""Straight pieces of a parabola: the deviation forces of one are within 0.1 % of those of the other."""

_YIELD = 0.88
"""Yield strength of prestressing steel by its tensile strength: f_p0.1k / f_pk of EN 10138 strands."""


@dataclass(frozen=True, slots=True, eq=False)
class ModelTendons:
    """All tendons of a model of n shards, or of the bodies of a scene."""

    names: tuple[str, ...]
    members: tuple[str, ...]  # that they are in
    steel: TendonSteel
    passages: TendonPassages
    paths_m: tuple[np.ndarray, ...] = field(repr=False)  # (p, 3) each

    def forces(self, positions_m: np.ndarray, rotations: np.ndarray) -> TendonForces:
        """Return the forces on n bodies at positions (3, n) in rotations (3, 3, n), as they were built."""
        return TendonForces(self.steel, self.passages, positions_m, rotations)

    def forces_of_shards(self, centres_m: np.ndarray) -> TendonForces:
        """Return the forces on shards with centres (n, 3) as they were built, and on the ground behind them."""
        positions = np.vstack((centres_m, np.zeros(3))).T
        return self.forces(positions, np.repeat(np.eye(3)[:, :, None], positions.shape[1], axis=2))

    def within_box(self, tendon: int, lowest_m: Sequence[float], highest_m: Sequence[float]) -> float | None:
        """Return the distance along a tendon of the middle of what lies in a box; None where nothing does."""
        path = self.paths_m[tendon]
        ends = np.concatenate((np.zeros(1), np.cumsum(distance(path[1:], path[:-1]))))
        inside = []
        for start, stop, begin, end in zip(path[:-1], path[1:], ends[:-1], ends[1:], strict=True):
            way = stop - start
            still = np.abs(way) < 1e-12
            if (still & ((start < lowest_m) | (start > highest_m))).any():
                continue
            safe = np.where(still, 1.0, way)
            shares = np.sort(np.stack((np.array(lowest_m) - start, np.array(highest_m) - start)) / safe, axis=0)
            low = max(0.0, float(np.where(still, 0.0, shares[0]).max()))
            high = min(1.0, float(np.where(still, 1.0, shares[1]).min()))
            if low <= high:
                inside += [begin + low * (end - begin), begin + high * (end - begin)]
        return 0.5 * (min(inside) + max(inside)) if inside else None

    def point_at(self, tendon: int, distance_m: float) -> np.ndarray:
        """Return the point (3,) at a distance along a tendon, as the bridge was built."""
        return points_along(self.paths_m[tendon], np.array([distance_m]))[0]


def placed_tendons(
    scenario: Scenario,
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    shards: Sequence[TriangleMesh],
    connections: Connections,
    joints: Sequence[Joint],
    joint_of_connection: np.ndarray,
) -> ModelTendons | None:
    """Return the tendons of a scenario in shards without gaps; None without any."""
    if not scenario.tendons:
        return None
    rows = {tuple(pair): row for row, pair in reversed(list(enumerate(np.sort(connections.pairs, axis=1).tolist())))}
    paths, lengths, transmission, parts = [], [], [], []
    for number, tendon in enumerate(scenario.tendons):
        member = _member_of(tendon, members)
        path = _path(tendon, members[member])
        own = np.flatnonzero(member_of_shard == member)
        passed = passages(path, [shards[shard] for shard in own.tolist()])
        _check_within(tendon, path, passed)
        pairs = np.stack((own[passed.first], own[passed.second]))
        at = np.array([rows.get(tuple(pair), -1) for pair in np.sort(pairs.T, axis=1).tolist()])
        tensile_pa = _tensile_pa(joints, joint_of_connection, at)
        paths.append(path)
        lengths.append(float(distance(path[1:], path[:-1]).sum()))
        transmission.append(transmission_length_m(tendon.diameter_m, tendon.prestress_pa, tensile_pa))
        openings = np.full(len(at), np.inf)
        if tendon.bonded:
            depth_m = _depth_m(members[member], path)
            openings = np.array([_opening_m(tendon, connections, row, depth_m, tensile_pa) for row in at.tolist()])
        parts.append(
            TendonPassages(
                np.full(len(at), number),
                pairs[0],
                pairs[1],
                passed.distances_m,
                passed.points_m.T,
                passed.directions.T,
                at,
                openings,
                np.zeros(len(at)),
            )
        )
    steel = TendonSteel(
        forces_n=np.array([tendon.force_n for tendon in scenario.tendons]),
        areas_m2=np.array([tendon.area_m2 for tendon in scenario.tendons]),
        lengths_m=np.array(lengths),
        transmission_m=np.array(transmission),
        bonded=np.array([tendon.bonded for tendon in scenario.tendons]),
        anchored=np.array([tendon.anchored for tendon in scenario.tendons]),
    )
    return ModelTendons(
        tuple(tendon.name for tendon in scenario.tendons),
        tuple(tendon.member for tendon in scenario.tendons),
        steel,
        _joined(parts),
        tuple(paths),
    )


def with_tendons(
    bars: FaceBars | None, tendons: ModelTendons, tables: Sequence[Tendon], connections: Connections, hardening: float
) -> tuple[FaceBars, ModelTendons]:
    """Return bars together with bonded tendons, which hold cracks with what is left of their strength by prestress.

    With the tendons, which part of the bars they are. Bars resist `hardening` times their yield force as they rupture.
    """
    bars = bars or FaceBars.none(len(connections))
    passed, steel = tendons.passages, tendons.steel
    left_n = np.array([table.rupture_n - table.force_n for table in tables]) / hardening * steel.bonded
    built = tendons.forces_of_shards(np.zeros((int(max(passed.first.max(), passed.second.max())) + 1, 3)))
    rows = np.flatnonzero((passed.connections >= 0) & steel.bonded[passed.tendons])
    at = passed.connections[rows]
    pulls = left_n[passed.tendons[rows]] * built.shares[rows]
    axes = section_axes(connections.normals[at])
    along = passed.directions[:, rows].T
    along = np.where(dot(along, connections.normals[at])[:, None] < 0.0, -1.0, 1.0) * along
    added = bars.with_pulls(
        at,
        pulls,
        transformed_back(axes[:, :, 1:], passed.points_m[:, rows].T - connections.points[at]),
        transformed_back(axes, along),
        passed.openings_m[rows],
    )
    whole = bars.yield_n.copy()
    np.add.at(whole, at, pulls)
    of_bars = np.zeros(len(passed.tendons))
    of_bars[rows] = np.divide(pulls, whole[at], out=np.zeros(len(rows)), where=whole[at] > 0.0)
    return added, replace(tendons, passages=replace(passed, of_bars=of_bars))


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
    height = volumes_and_centres([member.solid])[1][0, 2]  # of sections that are alike
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


def _tensile_pa(joints: Sequence[Joint], joint_of_connection: np.ndarray, rows: np.ndarray) -> float:
    """Strength in tension of the concrete of the first connection on the way of a tendon."""
    for row in rows[rows >= 0].tolist():
        strength = joints[joint_of_connection[row]].strength
        if strength is not None:
            return tensile_strength_pa(float(np.max(strength.compression_pa)))
    return tensile_strength_pa(30e6)


def _depth_m(member: Member, path_m: np.ndarray) -> float:
    """Depth of the section that a tendon is in: the height of a lying member, the smaller side of an upright one."""
    sizes, way = np.ptp(member.solid.vertices, axis=0), np.abs(path_m[-1] - path_m[0])
    return float(min(sizes[:2]) if way[2] > max(way[:2]) else sizes[2])


def _opening_m(tendon: Tendon, connections: Connections, row: int, depth_m: float, tensile_pa: float) -> float:
    """Opening of a crack at which a tendon ruptures, with the strain that its prestress has left."""
    strain = RUPTURE_STRAIN - tendon.prestress_pa / MODULUS_PA
    left_pa = tendon.strength_pa - tendon.prestress_pa
    steel = Steel(_YIELD * left_pa, 1.0 / _YIELD, max(strain, 2.0 * left_pa / MODULUS_PA))
    area_m2 = float(connections.areas[row]) if row >= 0 else depth_m * depth_m
    spacing_m = spacing_of_ratio_m(tendon.diameter_m, tendon.area_m2 / max(area_m2, tendon.area_m2))
    return rupture_opening_m(mean_strain_at_rupture(steel, tendon.diameter_m, spacing_m, tensile_pa), depth_m)


def _joined(parts: Sequence[TendonPassages]) -> TendonPassages:
    names = TendonPassages.__dataclass_fields__
    return TendonPassages(*(np.concatenate([getattr(part, name) for part in parts], axis=-1) for name in names))
