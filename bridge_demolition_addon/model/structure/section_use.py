"""How much of the resistance of members with bars is used: in bending and by axial force, section by section.

The force and the moment in a section are those that connections carry between the shards on its two sides. Resistance
of the rectangle with its layers of bars (EN 1992-1-1:2004, 6.1), without factors of safety. Girders cast with their
slab are T-beams with it, as far as links hold both together. Shear and torsion are left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations

import numpy as np

from ...engineering.geometry.vectors import cross, dot, unit
from ...engineering.mechanics.section_cuts import ConnectionLoads
from ...engineering.reinforced_concrete.resistance import FRICTION_ALONG_CRACK
from ..scenario import Scenario
from .member_layers import LayersOfMember, layers_of_members
from .model import Model
from .t_beams import TBeam, t_beams

_SAME_M = 1e-6
"""Middles of shards that are no farther apart than this lie on the same side of each section."""

_LEAST_SLIP = 0.25
"""Least length by the shortest span over which shear along a slab evens out, half of that between a moment of 0 and the
largest one: EN 1992-1-1:2004, 6.2.4 (3)."""


@dataclass(frozen=True, slots=True, eq=False)
class SectionUse:
    """The section that is used most."""

    member: int
    at_m: np.ndarray  # (3,), its middle
    used: float
    along_slab: bool = False  # whether of what links carry along the slab, instead of bending and axial force


@dataclass(frozen=True, slots=True, eq=False)
class _Cuts:
    """Forces and moments (k, 3) on what lies beyond planes, and parts (k,) that the faces use; nan where cracked."""

    forces_n: np.ndarray
    moments_nm: np.ndarray
    limits: np.ndarray


class SectionsWithBars:
    """Sections of the members of a model that have layers of bars."""

    def __init__(self, scenario: Scenario, model: Model):
        self._model, self._factor = model, scenario.connections.strength_factor
        strength = scenario.joints[0].strength
        self._groups: Sequence[LayersOfMember] = ()
        self._beams: Sequence[TBeam] = ()
        if strength is not None and model.crack_bars is not None:
            self._compression_pa = float(strength.compression_pa)
            self._groups = tuple(layers_of_members(model.layers, model.members))
            self._beams = tuple(t_beams(scenario, model.layers, model.members))
        self._of_pair = np.append(model.member_of_shard, -1)[model.connections.pairs]
        first, second = self._of_pair.T
        self._within = np.where(first == second, first, -1)

    @property
    def judged(self) -> np.ndarray:
        """Return the connections (m,) within members that have sections with bars, and of girders with their slabs."""
        judged = np.isin(self._within, [group.member for group in self._groups])
        for beam in self._beams:
            judged[self._rows(beam.girder.member, beam.deck.member)] = True
        return judged

    def most_used(self, loads: ConnectionLoads, used: np.ndarray) -> SectionUse | None:
        """Return the most used section, by the connections' loads; None without bars.

        Faces use parts (m,) of the strength of their concrete, nan where they have cracked or are gone. A section that
        has not cracked uses no more of its resistance than they do, and one that has, and stands, no more than all.
        """
        uses = [use for beam in self._beams for use in self._of_beam(beam, loads, used)]
        for beam in {beam.girder.member: beam for beam in self._beams}.values():
            uses += self._along_slab(beam, loads, used)
        for group in self._groups:
            if not any(beam.has(group) for beam in self._beams):
                uses += self._of_group(group, loads, used)
        return max(uses, key=lambda use: use.used, default=None)

    def _of_group(self, group: LayersOfMember, loads: ConnectionLoads, used: np.ndarray) -> Iterator[SectionUse]:
        model, member = self._model, self._model.members[group.member]
        placed = member.without_skew(model.centres_m) if group.own is None else group.own.from_world(model.centres_m)
        axis, across, _ = group.axes
        planes = self._planes(group.member, placed[:, axis], group.between_m)
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
        rows = np.flatnonzero(self._within == group.member)
        cuts = self._cuts(rows, placed[:, axis], planes, points, loads, used)
        axial = -dot(cuts.forces_n, runs)
        # What lies beyond is pulled back over the section: pulled where it is high, the last edge is pressed.
        pressing = -dot(cuts.moments_nm, unit(cross(runs, up)))
        of_bars = group.section(self._compression_pa, self._factor).utilisations(axial, pressing)
        yield _most(group.member, points, of_bars, cuts.limits)

    def _of_beam(self, beam: TBeam, loads: ConnectionLoads, used: np.ndarray) -> Iterator[SectionUse]:
        """Yield the section of a T-beam that is used most.

        The girder's faces say its moment about the middle of the slab, which is pressed or pulled as much as the girder
        is pulled or pressed; moments in the slab and the total axial force are shared out evenly.
        """
        cut = partial(self._across, beam, beam.deck.between_m, loads=loads, used=used)
        planes, points, runs, own = cut(beam.girder.member)
        if not len(planes):
            return
        slab = cut(beam.deck.member)[-1]
        girders = {other.girder.member for other in self._beams if other.deck.member == beam.deck.member}
        whole_n = np.add.reduce([slab.forces_n, *(cut(number)[-1].forces_n for number in sorted(girders))])
        axial = -dot(whole_n, runs) / len(girders)
        turns = unit(cross(runs, np.eye(3)[2]))
        pressing = -dot(own.moments_nm + slab.moments_nm / len(girders), turns)
        pressing -= axial * (beam.slab_m - beam.middle_m)
        of_bars = [
            beam.section(at_m, self._compression_pa, self._factor).utilisations(axial[[row]], pressing[[row]])[0]
            for row, at_m in enumerate(planes.tolist())
        ]
        yield _most(beam.girder.member, points, np.array(of_bars), np.maximum(own.limits, slab.limits))

    def _along_slab(self, beam: TBeam, loads: ConnectionLoads, used: np.ndarray) -> Iterator[SectionUse]:
        """Yield the part of a girder in which links that hold it along its slab are used most.

        What its pull changes by between two sections, all links there carry together. What has not cracked uses no more
        of that than its faces do of their strength.
        """
        model, member = self._model, self._model.members[beam.girder.member]
        planes, points, runs, own = self._across(beam, (-np.inf, np.inf), beam.girder.member, loads=loads, used=used)
        rows = self._rows(beam.girder.member, beam.deck.member)
        if not len(planes) or model.bars is None:
            return
        ends = member.without_skew(member.solid.vertices)[:, 0]
        sections = np.concatenate(([ends.min()], planes, [ends.max()]))
        pulls = np.concatenate(([0.0], dot(own.forces_n, runs), [0.0]))
        along = member.without_skew(model.connections.points[rows])[:, 0]
        resisted = FRICTION_ALONG_CRACK * model.bars.yield_n[rows]
        least_m, most = _LEAST_SLIP * min(np.diff(beam.supports_m).tolist()), None
        for first, second in combinations(range(len(sections)), 2):
            between = (along >= sections[first]) & (along < sections[second])
            if sections[second] - sections[first] < least_m or not resisted[between].any():
                continue
            of_links = abs(pulls[second] - pulls[first]) / resisted[between].sum()
            limit = used[rows[between]].max()
            part = min(of_links, 1.0 if np.isnan(limit) else limit)
            if most is None or part > most.used:
                at_m = points[min(first, len(points) - 1)]
                most = SectionUse(beam.girder.member, at_m, float(part), along_slab=True)
        if most:
            yield most

    def _rows(self, one: int, other: int) -> np.ndarray:
        """Return the connections (r,) between two members."""
        return np.flatnonzero((np.sort(self._of_pair, axis=1) == sorted((one, other))).all(axis=1))

    def _across(
        self,
        beam: TBeam,
        between_m: tuple[float, float],
        of_member: int,
        *,
        loads: ConnectionLoads,
        used: np.ndarray,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, _Cuts]:
        """Return planes (k,) across a T-beam, their points (k, 3) in its slab, its direction there, and cuts of one of
        its members."""
        model, number = self._model, beam.girder.member
        member = model.members[number]
        placed = member.without_skew(model.centres_m)
        planes = self._planes(number, placed[:, 0], between_m)
        middles = np.tile(placed[model.member_of_shard == number].mean(axis=0), (len(planes), 1))
        middles[:, 0], middles[:, 2] = planes, beam.slab_m
        points = member.with_skew(middles)
        if member.line:
            runs = member.line.directions(middles, 0)
        else:
            runs = unit(member.with_skew(np.tile(np.eye(3)[0], (len(planes), 1))))
        rows = np.flatnonzero(self._within == of_member)
        return planes, points, runs, self._cuts(rows, placed[:, 0], planes, points, loads, used)

    def _planes(self, member: int, along_m: np.ndarray, between_m: tuple[float, float]) -> np.ndarray:
        """Return the planes (k,) between the middles of a member's shards, from positions (n,) along an axis."""
        own = np.sort(along_m[self._model.member_of_shard == member])
        steps = np.flatnonzero(np.diff(own) > _SAME_M)
        planes = 0.5 * (own[steps] + own[steps + 1])
        within: np.ndarray = planes[(planes >= between_m[0]) & (planes <= between_m[1])]
        return within

    def _cuts(
        self,
        rows: np.ndarray,
        along_m: np.ndarray,
        planes: np.ndarray,
        points: np.ndarray,
        loads: ConnectionLoads,
        used: np.ndarray,
    ) -> _Cuts:
        """Return what connections (r,) carry through planes (k,), about points (k, 3) in these."""
        beyond = along_m[self._model.connections.pairs[rows]] > planes[:, None, None]
        forces, moments = np.zeros((2, len(planes), 3))
        limits = np.zeros(len(planes))
        for number, point in enumerate(points):
            crosses = beyond[number, :, 0] != beyond[number, :, 1]
            through = rows[crosses]
            signs = np.where(beyond[number, crosses, 0], 1.0, -1.0)[:, None]
            on_beyond = signs * loads.forces_n[through]
            levers = loads.points_m[through] - point
            forces[number] = on_beyond.sum(axis=0)
            moments[number] = (signs * loads.moments_nm[through] + cross(levers, on_beyond)).sum(axis=0)
            limits[number] = used[through].max(initial=0.0)  # nan where one has cracked
        return _Cuts(forces, moments, limits)


def _most(member: int, points: np.ndarray, of_bars: np.ndarray, limits: np.ndarray) -> SectionUse:
    """Return the most used section at points (k, 3)."""
    worst = np.minimum(of_bars, np.where(np.isnan(limits), 1.0, limits))
    most = int(np.lexsort((of_bars, worst))[-1])
    return SectionUse(member, points[most], float(worst[most]))
