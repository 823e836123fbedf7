"""Dead loads as masses of shards: each part of what lies on a member belongs to the highest shard under it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.units import mass_text
from ...errors import ScenarioError
from ..actions import Fact
from ..bridge.member import Member, members_named
from ..scenario.dead_loads import DeadLoad

_STEP_M = 0.5
"""Side of a part, at most."""

_AT_THE_TOP = 0.05
"""Of the depth of the bridge there, m: shards whose top is that close to the highest one carry what stands on it."""

_ROUNDING_M = 1e-6
_POINTS_AT_ONCE = 256


@dataclass(frozen=True, slots=True, eq=False)
class LyingLoad:
    """Middles (k, 2) of the parts of a dead load on plan, and the mass of each (k,), kg."""

    points_m: np.ndarray
    masses_kg: np.ndarray

    @property
    def mass_kg(self) -> float:
        return math.fsum(self.masses_kg.tolist())


def lying_load(load: DeadLoad, members: Sequence[Member]) -> LyingLoad:
    """Return the parts of a dead load on its members.

    Raises
    ------
    ScenarioError
        No member has its name or kind, or the load lies off it.
    """
    parts = [_on_member(load, members[row]) for row in members_named(load.member, members, "dead_loads.member")]
    points, masses = zip(*parts, strict=True)
    return LyingLoad(np.concatenate(points), np.concatenate(masses))


def _on_member(load: DeadLoad, member: Member) -> tuple[np.ndarray, np.ndarray]:
    corners = member.without_skew(member.solid.vertices)[:, :2]
    own = np.array([corners.min(axis=0), corners.max(axis=0)])
    ends = own.copy()
    for axis, (name, given) in enumerate((("along_m", load.along_m), ("across_m", load.across_m))):
        if given is None:
            continue
        if given[0] < own[0, axis] - _ROUNDING_M or given[1] > own[1, axis] + _ROUNDING_M:
            room = f"{own[0, axis]:g} to {own[1, axis]:g} (m)"
            raise load.unexpected(name, f"positions on {member.name}, which reaches from {room}")
        ends[:, axis] = given
    size = ends[1] - ends[0]
    counts = np.maximum(np.ceil(size / _STEP_M - 1e-9).astype(int), 1)
    x, y = (ends[0, axis] + size[axis] * (np.arange(counts[axis]) + 0.5) / counts[axis] for axis in (0, 1))
    points = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    mass_kg = load.mass_kg_m2 * size[0] * size[1] if load.mass_kg_m2 is not None else (load.mass_kg_m or 0.0) * size[0]
    upright = np.column_stack((points, np.zeros(len(points))))
    return member.with_skew(upright)[:, :2], np.full(len(points), mass_kg / len(points))


def highest_under(points: np.ndarray, boxes: np.ndarray, removed: np.ndarray) -> np.ndarray:
    """Return the shards (k,) whose boxes (n, 2, 3) are under points (k, 2) and highest, -1 where there is none.

    Of several that are as high it is the nearest on plan.
    """
    middles = boxes[:, :, :2].mean(axis=1)
    found = np.full(len(points), -1)
    for first in range(0, len(points), _POINTS_AT_ONCE):
        part = points[first : first + _POINTS_AT_ONCE, None]
        over = ((boxes[:, 0, :2] <= part) & (part <= boxes[:, 1, :2])).all(axis=2) & ~removed
        tops = np.where(over, boxes[:, 1, 2], -np.inf)
        at_the_top = over & (tops >= tops.max(axis=1, keepdims=True) - _AT_THE_TOP)
        apart = np.where(at_the_top, np.square(middles - part).sum(axis=2), np.inf)
        found[first : first + _POINTS_AT_ONCE] = np.where(over.any(axis=1), apart.argmin(axis=1), -1)
    return found


def added_masses_kg(loads: Sequence[DeadLoad], members: Sequence[Member], bounds_m: np.ndarray) -> np.ndarray:
    """Return the masses (n,) of what stays on shards, which have bounds (n, 2, 3)."""
    masses, none = np.zeros(len(bounds_m)), np.zeros(len(bounds_m), bool)
    for load in loads:
        if load.until_s is not None:
            continue
        lying = lying_load(load, members)
        shards = highest_under(lying.points_m, bounds_m, none)
        if (shards < 0).any():
            where = lying.points_m[shards < 0][0].round(2).tolist()
            raise ScenarioError(f'dead_loads "{load.name}": nothing of the bridge is under {where} m')
        np.add.at(masses, shards, lying.masses_kg)
    return masses


def dead_load_facts(loads: Sequence[DeadLoad], members: Sequence[Member]) -> Iterator[Fact]:
    """Yield what lies on the bridge, and what of it is taken off first."""
    for load in loads:
        later = "" if load.until_s is None else ", taken off first: a run begins without it"
        yield load.name, f"{mass_text(lying_load(load, members).mass_kg, width=10)} on {load.member}{later}"
