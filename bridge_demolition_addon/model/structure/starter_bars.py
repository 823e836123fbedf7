"""Bars from one member into the next, where members from files that have bars by a rule meet without a bearing."""

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
from ..reinforcement.concrete_members import is_concrete
from ..scenario import Scenario

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
    """Return the bars between members from files; None without a rule for these.

    Either member's bars that run across the face go on into the other: as many as those of the one with more, and
    0.2 % at least. Connections `of_bearings` have none, nor have those that leave something free.
    """
    rule = scenario.geometry_reinforcement
    if rule is None or not rule.has_bars:
        return None
    names = {table.name for table in scenario.geometry}
    meets = np.array(
        [member.name in names and member.kind != "fill" and is_concrete(scenario, member) for member in members]
    )
    of_pair = np.append(member_of_shard, -1)[connections.pairs]
    rows = np.flatnonzero(
        (of_pair[:, 0] != of_pair[:, 1])
        & (of_pair >= 0).all(axis=1)
        & np.append(meets, False)[of_pair].all(axis=1)
        & (connections.areas > 0.0)
    )
    rows = rows[~np.isin(rows, of_bearings)]
    rows = np.array([row for row in rows.tolist() if _is_tight(scenario.joints[joint_of_connection[row]])], int)
    yield_n, openings = np.zeros((2, len(connections)))
    factor, steel = scenario.connections.strength_factor, replace(scenario.steel, yield_pa=rule.grade.yield_pa)
    by_member = [_ratios(layers, member) for member in members]
    for row in rows.tolist():
        normal, point = connections.normals[row], connections.points[row]
        crossing = [_crossing(by_member[index], members[index], point, normal) for index in of_pair[row].tolist()]
        ratio = max(_LEAST_RATIO, *crossing)
        yield_n[row] = factor * ratio * steel.yield_pa * connections.areas[row]
        strength = scenario.joints[joint_of_connection[row]].strength
        own_m = scenario.connections.ductile_elongation_m
        if own_m is None and strength is not None:
            own_m = _opening_m(ratio, float(strength.compression_pa), steel)
        openings[row] = own_m or 0.0
    return StarterBars(yield_n, openings)


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
