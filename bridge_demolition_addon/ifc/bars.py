"""Reinforcing bars of a file as layers of the members that they lie in, and bars by rule where it has none in them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..engineering.geometry.solids import contains
from ..engineering.geometry.vectors import AXES, SIDES, length, transformed
from ..errors import GeometryError
from ..model.bridge.member import Member
from ..model.materials import BarLayer
from ..model.reinforcement.concrete_members import is_concrete
from ..model.reinforcement.design import bar_schedule
from ..model.scenario import GeometryReinforcement, Scenario
from ..model.scenario.reinforcement import LOAD_MODEL_1
from .alignments import points_of
from .elements import Element
from .library import library
from .missing_references import CONTRADICTIONS, items_of
from .placement import Placement
from .source import IfcSource

_ALONG = math.cos(math.radians(20.0))
"""Cosine of the angle up to which a bar runs along an axis of the bridge."""

_ONE_LAYER_M = 0.03
"""Difference of depths up to which bars are one layer."""

_SQUARE_MILLIMETRES = 1e6
_SMALLEST_SHARE = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class _Bar:
    """A straight bar: its ends (2, 3) in the scenario, m, and the area of its steel, m²."""

    ends_m: np.ndarray
    area_m2: float

    @property
    def middle_m(self) -> np.ndarray:
        """Middle (3,) of the bar."""
        middle: np.ndarray = self.ends_m.mean(axis=0)
        return middle

    @property
    def length_m(self) -> float:
        """Length of the bar."""
        return float(length(self.ends_m[1] - self.ends_m[0]))

    @property
    def axis(self) -> int | None:
        """Axis of the bridge that it runs along; None where it is inclined."""
        way = np.abs(self.ends_m[1] - self.ends_m[0]) / max(self.length_m, 1e-12)
        return int(way.argmax()) if way.max() >= _ALONG else None


def bar_layers(
    source: IfcSource, elements: Sequence[Element], members: Mapping[int, Member], placement: Placement
) -> tuple[list[BarLayer], list[str]]:
    """Return layers of the bars of a file in members, which are given by the numbers of their elements, and notes.

    A bar lies in the member that it is part of in the file, or else in the one around its middle. The area of a layer
    is the volume of its bars over the length of the member along them: laps count as often as they are.
    """
    found: dict[str, list[_Bar]] = {}
    by_name = {member.name: member for member in members.values()}
    lost = 0
    for element in elements:
        if "IfcReinforcingBar" not in element.facts.classes:
            continue
        try:
            bars = list(_bars(source, element.entity, placement))
        except (GeometryError, *CONTRADICTIONS):  # a shape that is not swept
            bars = []
        lost += not bars
        for bar in bars:
            member = _member_of(element, bar, members)
            if member is None or bar.axis is None:
                lost += 1
            else:
                found.setdefault(member.name, []).append(bar)
    layers = [layer for name, bars in found.items() for layer in _layers(by_name[name], bars)]
    notes = []
    if layers:
        count = sum(len(bars) for bars in found.values())
        notes.append(f"{count} reinforcing bars are {len(layers)} layers of reinforcement of {', '.join(found)}")
    if lost:
        notes.append(f"{lost} reinforcing bars are bent, inclined or in no member, and do not count")
    return layers, notes


def _bars(source: IfcSource, entity: Any, placement: Placement) -> Iterator[_Bar]:
    diameter = getattr(entity, "NominalDiameter", None)
    placing = np.array(library("util.placement").get_local_placement(entity.ObjectPlacement), dtype=float)
    for item in items_of(entity, "IfcSweptDiskSolid"):
        points = points_of(item.Directrix)
        if len(points) != 2:
            continue
        across = (diameter or 2.0 * item.Radius) * source.unit_m
        ends = (transformed(placing[:3, :3], points) + placing[:3, 3]) * source.unit_m - placement.origin_m
        ends[:, :2] = transformed(placement.turn, ends[:, :2])
        yield _Bar(ends, math.pi / 4.0 * across**2)


def _member_of(element: Element, bar: _Bar, members: Mapping[int, Member]) -> Member | None:
    whole = next((members[number] for number in element.wholes if number in members), None)
    if whole is not None:
        return whole
    middle = bar.middle_m
    for member in members.values():
        low, high = member.solid.bounds
        if (middle >= low).all() and (middle <= high).all() and contains(member.solid, middle[None])[0]:
            return member
    return None


def _layers(member: Member, bars: Sequence[_Bar]) -> Iterator[BarLayer]:
    """Yield the layers of bars in a member: along each axis, from the side that they are nearest to."""
    low, high = member.solid.bounds
    for along in range(len(AXES)):
        depths: dict[str, list[tuple[float, float]]] = {}
        extent = float(high[along] - low[along])
        for bar in bars:
            if bar.axis != along:
                continue
            side, depth = _side(bar.middle_m, low, high, along)
            depths.setdefault(side, []).append((depth, bar.area_m2 * bar.length_m / extent))
        for side, rows in depths.items():
            yield from _grouped(member, along, side, sorted(rows))


def _side(middle: np.ndarray, low: np.ndarray, high: np.ndarray, along: int) -> tuple[str, float]:
    """Return the side of a member that a bar is nearest to, and how deep below it; above and below come first."""
    away = {
        side: float(middle[axis] - low[axis] if way < 0 else high[axis] - middle[axis])
        for side, (axis, way) in SIDES.items()
        if axis != along
    }
    level = {side: depth for side, depth in away.items() if SIDES[side][0] == len(AXES) - 1}
    return min((level or away).items(), key=lambda item: item[1])


def _grouped(member: Member, along: int, side: str, rows: Sequence[tuple[float, float]]) -> Iterator[BarLayer]:
    total = math.fsum(area for _, area in rows)
    first = 0
    for row in range(1, len(rows) + 1):
        if row < len(rows) and rows[row][0] - rows[first][0] <= _ONE_LAYER_M:
            continue
        group = rows[first:row]
        area = math.fsum(share for _, share in group)
        depth = math.fsum(depth * share for depth, share in group) / area
        first = row
        if area >= _SMALLEST_SHARE * total and depth > 0.0:
            yield BarLayer(
                members=(member.name,),
                along=AXES[along],
                side=side,
                depth_m=round(depth, 4),
                area_mm2=round(area * _SQUARE_MILLIMETRES, 1),
            )


OTHER_SHARE = 1.0
"""Strength that members of other materials keep where they break, as steel does: `connections.ductile_share`."""

OTHER_ELONGATION_M = 0.05
"""How far these deform until they rupture, which no file is known to say."""

_NOT_BUILT = ("fill",)
_HELD = ("footing", "approach slab")


def with_bars_by_rule(scenario: Scenario) -> Scenario:
    """Return a scenario whose members of concrete have bars by rule; members of other materials yield."""
    built = [table for table in scenario.geometry if table.kind not in _NOT_BUILT]
    concrete = [table for table in built if is_concrete(scenario, table)]
    if len(concrete) < len(built):
        connections = replace(scenario.connections, ductile_share=OTHER_SHARE, ductile_elongation_m=OTHER_ELONGATION_M)
        scenario = replace(scenario, connections=connections)
    if not concrete:
        return scenario
    return replace(scenario, geometry_reinforcement=GeometryReinforcement(designed_for=LOAD_MODEL_1))


def notes_on_bars(scenario: Scenario, members: Sequence[Member], added: Sequence[str]) -> Iterator[str]:
    """Yield notes on bars by rule: which members have them, how much steel that is, and what the design says.

    Supports that are `added` are no part of the file.
    """
    rule = scenario.geometry_reinforcement
    if rule is None:
        return
    schedule = bar_schedule(scenario, members)
    by_rule = {name for row in schedule.rows for name in row.members}
    found = [member for member in members if member.name in by_rule and member.name not in added]
    moving = [member for member in found if member.kind not in _HELD]
    if not found:
        return
    steel_kg = math.fsum(schedule.mass_of_kg(kind) for kind in {member.kind for member in moving})
    volume_m3 = math.fsum(member.volume_m3 for member in moving)
    kinds = ", ".join(dict.fromkeys(member.kind for member in found))
    amount = f", {steel_kg / volume_m3:.0f} kg/m³ beside footings and approach slabs" if volume_m3 else ""
    yield (
        f"the file has no bars in {len(found)} members of concrete ({kinds}): by rule they have bars for "
        f"{rule.described}{amount}; bda check lists them, and [[reinforcement]] says it better"
    )
    yield from schedule.notes
