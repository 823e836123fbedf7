"""How much of the resistance of members with bars is used: in bending and by axial force, section by section.

The force and the moment in a section are those that connections carry between the shards on its two sides. Resistance
is that of the rectangle with its layers of bars (EN 1992-1-1:2004, 6.1), without factors of safety. Shear and torsion
are left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import cross, dot, unit
from ...engineering.mechanics.section_cuts import ConnectionLoads
from ..scenario import Scenario
from .face_bars import LayersOfMember, layers_of_members
from .model import Model

_SAME_M = 1e-6
"""Middles of shards that are no farther apart than this lie on the same side of each section."""


@dataclass(frozen=True, slots=True, eq=False)
class SectionUse:
    """The section that is used most."""

    member: int
    at_m: np.ndarray  # (3,), its middle
    used: float


class SectionsWithBars:
    """Sections of the members of a model that have layers of bars."""

    def __init__(self, scenario: Scenario, model: Model):
        self._model, self._factor = model, scenario.connections.strength_factor
        strength = scenario.joints[0].strength
        self._groups: Sequence[LayersOfMember] = ()
        if strength is not None and model.crack_bars is not None:
            self._compression_pa = float(strength.compression_pa)
            self._groups = tuple(layers_of_members(model.layers, model.members))
        first, second = np.append(model.member_of_shard, -1)[model.connections.pairs].T
        self._within = np.where(first == second, first, -1)

    @property
    def judged(self) -> np.ndarray:
        """Return the connections (m,) within members that have sections with bars."""
        return np.isin(self._within, [group.member for group in self._groups])

    def most_used(self, loads: ConnectionLoads, used: np.ndarray) -> SectionUse | None:
        """Return the section of which most is used, by the loads of all connections; None without bars.

        Faces use parts (m,) of the strength of their concrete, nan where they have cracked or are gone. A section that
        has not cracked uses no more of its resistance than they do, and one that has, and stands, no more than all.
        """
        uses = [use for group in self._groups for use in self._of_group(group, loads, used)]
        return max(uses, key=lambda use: use.used, default=None)

    def _of_group(self, group: LayersOfMember, loads: ConnectionLoads, used: np.ndarray) -> Iterator[SectionUse]:
        model, member = self._model, self._model.members[group.member]
        rows = np.flatnonzero(self._within == group.member)
        pairs = model.connections.pairs[rows]
        placed = member.without_skew(model.centres_m) if group.own is None else group.own.from_world(model.centres_m)
        axis, across, _ = group.axes
        along = placed[:, axis]
        own = np.sort(along[model.member_of_shard == group.member])
        steps = np.flatnonzero(np.diff(own) > _SAME_M)
        planes = 0.5 * (own[steps] + own[steps + 1])
        planes = planes[(planes >= group.between_m[0]) & (planes <= group.between_m[1])]
        if not len(planes):
            return
        middles = np.tile(placed[model.member_of_shard == group.member].mean(axis=0), (len(planes), 1))
        middles[:, axis], middles[:, across] = planes, 0.5 * (group.lowest + group.highest)
        if group.own is None:
            points, directions = member.with_skew(middles), np.eye(3)
            runs, up = (np.tile(directions[row], (len(planes), 1)) for row in (axis, across))
            runs = unit(member.with_skew(runs))
        else:
            points = group.own.to_world(middles)
            runs, up = group.own.directions(middles, axis), group.own.directions(middles, across)
        forces, moments = np.zeros((2, len(planes), 3))
        limits = np.zeros(len(planes))
        for number, (plane, point) in enumerate(zip(planes.tolist(), points, strict=True)):
            beyond = along[pairs] > plane
            crosses = beyond[:, 0] != beyond[:, 1]
            through = rows[crosses]
            signs = np.where(beyond[crosses, 0], 1.0, -1.0)[:, None]
            on_beyond = signs * loads.forces_n[through]
            levers = loads.points_m[through] - point
            forces[number] = on_beyond.sum(axis=0)
            moments[number] = (signs * loads.moments_nm[through] + cross(levers, on_beyond)).sum(axis=0)
            limits[number] = used[through].max(initial=0.0)  # nan where one has cracked
        axial = -dot(forces, runs)
        # What lies beyond is pulled back over the section: pulled where it is high, the last edge is pressed.
        pressing = -dot(moments, unit(cross(runs, up)))
        of_bars = group.section(self._compression_pa, self._factor).utilisations(axial, pressing)
        worst = np.minimum(of_bars, np.where(np.isnan(limits), 1.0, limits))
        most = int(np.lexsort((of_bars, worst))[-1])
        yield SectionUse(group.member, points[most], float(worst[most]))
