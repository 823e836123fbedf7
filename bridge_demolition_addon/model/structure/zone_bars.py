"""Bars along a member that stay in a blast zone: those that the zone says, or those that its member has."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.drilled_charges.bare_bars import (
    bar_area_m2,
    compression_n,
    straight_compression_n,
    yield_force_n,
)
from ...engineering.elasticity.steel_bars import YIELD_PA
from ...engineering.geometry.vectors import AXES
from ..blast.blast_zones import M_PER_MM, BlastZone
from ..bridge.member import Member
from ..materials import BarLayer
from ..schema import given

COVER_M = 0.05
"""From a side of the member to the outside of bars whose positions are not known."""

_ALIKE = 0.05
"""By how much bars that the zone says may differ from those that its member has."""

_WHOLE = 0.01


@dataclass(frozen=True, slots=True)
class ZoneBars:
    """Bars of one diameter, with the same forces at yield and at buckling as all that stay.

    `distances_m` of the bars are from the middle of the section, root mean squares, along its two axes in order.
    """

    count: float
    diameter_m: float
    yield_pa: float
    distances_m: tuple[float, float]
    of_member: bool = False  # whether they follow from the bars of the member

    @property
    def sizes(self) -> str:
        """Number of bars of each size."""
        count = f"{self.count:.0f}" if abs(self.count - round(self.count)) < _WHOLE else f"{self.count:.1f}"
        return f"{count} bars of {self.diameter_m / M_PER_MM:.3g} mm"

    @property
    def text(self) -> str:
        """The same, and whether they are the member's."""
        return f"{self.sizes}, as the member has," if self.of_member else self.sizes

    def resisted_n(self, bared_m: float) -> tuple[float, float]:
        """Return what they resist in tension, and may be counted on for in compression, bared over a height."""
        return (
            self.count * float(yield_force_n(self.diameter_m, self.yield_pa)),
            self.count * float(compression_n(self.diameter_m, bared_m, self.yield_pa)),
        )

    def straight_n(self, bared_m: float) -> float:
        """Return what they resist in compression without any bow, as in a run."""
        return self.count * float(straight_compression_n(self.diameter_m, bared_m, self.yield_pa))


def zone_bars(zone: BlastZone, member: Member, box_m: np.ndarray, layers: Sequence[BarLayer]) -> ZoneBars | None:
    """Return the bars that stay in a zone, of a member in a box (2, 3) with layers of bars; None without any.

    Where the zone and its member both have bars, they have to agree.
    """
    own, of_member = _of_zone(zone, box_m), _of_member(zone, member, box_m, layers)
    if own and of_member and not _are_alike(own, of_member, zone.height_m):
        raise zone.unexpected(
            "bars",
            f"it to be left out, or what [[reinforcement]] or [bridge.reinforcement] gives {member.name} there: "
            f"{of_member.sizes}",
        )
    return of_member or own


def _of_zone(zone: BlastZone, box_m: np.ndarray) -> ZoneBars | None:
    """Bars evenly along the edge of the section."""
    if not zone.bars:
        return None
    diameter_m = M_PER_MM * given(zone.bar_diameter_mm)
    halves = np.diff(box_m, axis=0)[0][_section_axes(zone)] / 2.0
    first, second = np.maximum(halves - COVER_M - diameter_m / 2.0, diameter_m / 2.0).tolist()
    along_first = first * np.sqrt((second + first / 3.0) / (first + second))
    along_second = second * np.sqrt((first + second / 3.0) / (first + second))
    return ZoneBars(float(zone.bars), diameter_m, YIELD_PA, (float(along_first), float(along_second)))


def _of_member(zone: BlastZone, member: Member, box_m: np.ndarray, layers: Sequence[BarLayer]) -> ZoneBars | None:
    """Bars of the layers that run along the whole zone."""
    own = list(_layers_along(zone, member, layers))
    if not own:
        return None
    areas = np.array([layer.area_m2 for layer in own])
    squares = np.array([layer.diameter_m * layer.diameter_m for layer in own])
    diameter_m = float(np.sqrt((areas * squares).sum() / areas.sum()))
    yield_pa = float((areas * [layer.yield_pa for layer in own]).sum() / areas.sum())
    axes = _section_axes(zone)
    by_layer = np.array([_squares_m2(layer, member, box_m)[axes] for layer in own])
    distances = np.sqrt((areas[:, None] * by_layer).sum(axis=0) / areas.sum())
    return ZoneBars(
        float(areas.sum() / bar_area_m2(diameter_m)),
        diameter_m,
        yield_pa,
        (float(distances[0]), float(distances[1])),
        True,
    )


def _layers_along(zone: BlastZone, member: Member, layers: Sequence[BarLayer]) -> Iterator[BarLayer]:
    begin_m, end_m = zone.ends_along_m
    for layer in layers:
        if layer.is_spread or layer.along != zone.along or not layer.is_in(member.name, member.kind):
            continue
        from_m, to_m = layer.ends_m
        if from_m <= begin_m and end_m <= to_m:
            yield layer


def _squares_m2(layer: BarLayer, member: Member, box_m: np.ndarray) -> np.ndarray:
    """Mean squares (3,) of the distances of a layer's bars from the middle of the section, along the axes."""
    _, across, beside = layer.axes
    lowest, highest = member.solid.bounds[:, across].tolist()
    squares = np.zeros(3)
    squares[across] = np.square(layer.level_m(lowest, highest) - box_m[:, across].mean())
    squares[beside] = np.square(np.diff(box_m[:, beside])[0]) / 12.0
    return squares


def _section_axes(zone: BlastZone) -> list[int]:
    return [axis for axis in range(3) if axis != AXES.index(zone.along)]


def _are_alike(own: ZoneBars, of_member: ZoneBars, bared_m: float) -> bool:
    pairs = zip(own.resisted_n(bared_m), of_member.resisted_n(bared_m), strict=True)
    return all(abs(first - second) <= _ALIKE * second for first, second in pairs)
