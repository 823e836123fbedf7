"""Bars from one member into the next, where members meet without a bearing: those from files that have bars by a rule,
and those of arches and frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.elasticity.bar_rupture import mean_strain_at_rupture, spacing_of_ratio_m, tensile_strength_pa
from ...engineering.elasticity.steel_bars import Steel
from ...engineering.geometry.sides import AXES
from ...engineering.geometry.vectors import dot
from ...engineering.mechanics.joint import Joint
from ...engineering.structure.connections import Connections
from ..bridge.member import Member
from ..bridge.own_axes import own_axes
from ..materials.bar_layers import BarLayer
from ..reinforcement.concrete_members import is_concrete, names_of_bridge
from ..scenario import Scenario
from ..scenario.scenario import bars_by_rule

_LEAST_RATIO = 0.002
"""As of the upright bars of a wall: EN 1992-1-1:2004, 9.6.2 (1)."""

_DIAMETER_M = 0.016


@dataclass(frozen=True, slots=True, eq=False)
class StarterBars:
    """Forces (m,) at which starter bars across m connections yield, 0 without any, and openings (m,) of rupture."""

    yield_n: np.ndarray
    openings_m: np.ndarray


def starter_bars(
    scenario: Scenario,
    layers: Sequence[BarLayer],
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    connections: Connections,
    joint_of_connection: np.ndarray,
    of_bearings: np.ndarray,
) -> StarterBars | None:
    """Return the bars between members from files, and of an arch or a frame; None where neither has any.

    Either member's bars that run across the face go on into the other: as many as those of the one with more, and
    0.2 % at least by a rule. Connections `of_bearings` have none, nor have those that leave something free.
    """
    groups = [group for group in (_of_files(scenario, members), _of_bridge(scenario, members)) if group]
    if not groups:
        return None
    yield_n, openings = np.zeros((2, len(connections)))
    by_member = [_ratios(layers, member) for member in members]
    pairs = np.append(member_of_shard, -1)[connections.pairs].tolist()
    for group in groups:
        for row in _rows(scenario, group, member_of_shard, connections, joint_of_connection, of_bearings):
            normal, point = connections.normals[row], connections.points[row]
            crossing = [_crossing(by_member[index], members[index], point, normal) for index in pairs[row]]
            ratio = max(group.least_ratio, *crossing)
            if ratio == 0.0:
                continue
            yield_n[row] = scenario.connections.strength_factor * ratio * group.steel.yield_pa * connections.areas[row]
            openings[row] = _own_opening_m(scenario, joint_of_connection[row], ratio, group.steel)
    return StarterBars(yield_n, openings)


@dataclass(frozen=True, slots=True, eq=False)
class _Meeting:
    """Members (k,) between which bars go on, the steel of these, and their least ratio."""

    members: np.ndarray
    steel: Steel
    least_ratio: float


def _of_files(scenario: Scenario, members: Sequence[Member]) -> _Meeting | None:
    rule = scenario.geometry_reinforcement
    if rule is None or not rule.has_bars:
        return None
    names = {table.name for table in scenario.geometry}
    meets = [member.name in names and member.kind != "fill" and is_concrete(scenario, member) for member in members]
    return _Meeting(np.array(meets), replace(scenario.steel, yield_pa=rule.grade.yield_pa), _LEAST_RATIO)


def _of_bridge(scenario: Scenario, members: Sequence[Member]) -> _Meeting | None:
    """Return the members of an arch or a frame, which are of one piece; those of other bridges lie on each other."""
    if scenario.bridge is None or not (scenario.bridge.arch or scenario.bridge.frame):
        return None
    names, rule = names_of_bridge(scenario), bars_by_rule(scenario)
    meets = [member.name in names and is_concrete(scenario, member) for member in members]
    if rule is None:
        return _Meeting(np.array(meets), scenario.steel, 0.0)
    return _Meeting(np.array(meets), replace(scenario.steel, yield_pa=rule.grade.yield_pa), _LEAST_RATIO)


def _rows(
    scenario: Scenario,
    group: _Meeting,
    member_of_shard: np.ndarray,
    connections: Connections,
    joint_of_connection: np.ndarray,
    of_bearings: np.ndarray,
) -> list[int]:
    """Return the connections between two members of a group, as indices, that bars go across."""
    of_pair = np.append(member_of_shard, -1)[connections.pairs]
    rows = np.flatnonzero(
        (of_pair[:, 0] != of_pair[:, 1])
        & (of_pair >= 0).all(axis=1)
        & np.append(group.members, False)[of_pair].all(axis=1)
        & (connections.areas > 0.0)
    )
    rows = rows[~np.isin(rows, of_bearings)]
    return [row for row in rows.tolist() if _is_tight(scenario.joints[joint_of_connection[row]])]


def _own_opening_m(scenario: Scenario, joint: int, ratio: float, steel: Steel) -> float:
    strength, own_m = scenario.joints[joint].strength, scenario.connections.ductile_elongation_m
    if own_m is None and strength is not None:
        own_m = _opening_m(ratio, float(strength.compression_pa), steel)
    return own_m or 0.0


def _is_tight(joint: Joint) -> bool:
    return not joint.free and joint.strength is not None


def _ratios(layers: Sequence[BarLayer], member: Member) -> dict[tuple[bool, int], float]:
    """Return the bars of a member by the area across them, along each axis, of its own and of the bridge."""
    ratios: dict[tuple[bool, int], float] = {}
    for layer in layers:
        if not layer.is_in(member.name, member.kind):
            continue
        axis = AXES.index(layer.along)
        if layer.is_spread:
            ratio = layer.ratio
        else:
            low, high = own_axes(member).ends_m(axis) if layer.own_axes else member.solid.bounds[:, axis].tolist()
            ratio = layer.area_m2 * (high - low) / member.volume_m3
        ratios[layer.own_axes, axis] = ratios.get((layer.own_axes, axis), 0.0) + ratio
    return ratios


def _crossing(ratios: dict[tuple[bool, int], float], member: Member, point_m: np.ndarray, normal: np.ndarray) -> float:
    """Return the bars of a member across a plane, by its area."""
    total = 0.0
    for (is_own, axis), ratio in ratios.items():
        along = np.eye(3)[axis]
        if is_own:
            axes = own_axes(member)
            along = axes.directions(axes.from_world(point_m[None]), axis)[0]
        total += ratio * abs(float(dot(along, normal)))
    return total


def _opening_m(ratio: float, compressive_pa: float, steel: Steel) -> float:
    """Return the opening of one crack at which the bars rupture."""
    spacing_m = spacing_of_ratio_m(_DIAMETER_M, ratio)
    return spacing_m * mean_strain_at_rupture(steel, _DIAMETER_M, spacing_m, tensile_strength_pa(compressive_pa))
