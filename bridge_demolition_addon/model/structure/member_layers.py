"""Bars of members: layers that run the same way, along the same two sides, and their sections; and spread bars."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...engineering.elasticity.steel_bars import (
    MODULUS_PA,
    Steel,
    crack_spacing_m,
    mean_strain_at_rupture,
    rupture_opening_m,
    spacing_of_ratio_m,
    tensile_strength_pa,
)
from ...engineering.geometry.mesh import plane_cuts
from ...engineering.geometry.own_axes import OwnAxes
from ...engineering.geometry.road_lines import RoadLine
from ...engineering.geometry.vectors import AXES
from ...engineering.structure.connections import Connections
from ...errors import ScenarioError
from ..bridge.member import Member, is_standing, own_axes
from ..materials import BarLayer, ReinforcedSection


@dataclass(frozen=True, slots=True)
class LayersOfMember:
    """Layers of bars of a member that run the same way, along the same two sides.

    Everything is without the member's skew: its layers are skewed with it. It lies between `lowest` and `highest` along
    the axis across the layers, m, and the layers at `levels_m`, where it is as wide as `widths_m`; `width_m` is its
    whole width.
    """

    member: int
    layers: tuple[BarLayer, ...]
    lowest: float
    highest: float
    width_m: float
    levels_m: tuple[float, ...]
    widths_m: tuple[float, ...]
    between_m: tuple[float, float] = (-math.inf, math.inf)  # along the bars: part of the member with these layers
    own: OwnAxes | RoadLine | None = None  # axes of the member that layers count in; None for the bridge's

    @property
    def axes(self) -> tuple[int, int, int]:
        """Return the axes along the bars, across the layers and along these."""
        return self.layers[0].axes

    def section(self, compressive_pa: float, factor: float = 1.0) -> ReinforcedSection:
        """Return the section, with depths from where it is highest, and bars stronger by a factor."""
        return ReinforcedSection(
            self.highest - self.lowest,
            self.width_m,
            compressive_pa,
            [self.highest - level for level in self.levels_m],
            [layer.area_m2 for layer in self.layers],
            [factor * layer.yield_pa for layer in self.layers],
        )

    def pulled_strains(self, forces_n: Sequence[float]) -> list[float]:
        """Return strains at which layers have such forces, pulled as a whole: they stretch by E A."""
        return [force / (MODULUS_PA * layer.area_m2) for layer, force in zip(self.layers, forces_n, strict=True)]

    def bent_strains(self, factor: float, young_pa: float) -> list[float]:
        """Return by what the edge next to each layer stretches as that yields, in a section of concrete that is bent.

        It is d - x that bars stretch by their strain, with x pressed elastically: b x² / 2 = α A (d - x), of each layer
        alone. This is the fully cracked state of EN 1992-1-1:2004, 7.4.3 (3).
        """
        strains = []
        for layer, level, width in zip(self.layers, self.levels_m, self.widths_m, strict=True):
            depth = max(self.highest - level, level - self.lowest)
            by_width = MODULUS_PA / young_pa * layer.area_m2 / width
            pressed = math.sqrt(by_width * by_width + 2.0 * by_width * depth) - by_width
            height = self.highest - self.lowest
            strains.append(factor * layer.yield_pa / MODULUS_PA * height / (depth - pressed))
        return strains

    def openings_m(self, compressive_pa: float, steel: Steel, whole_m: float | None = None) -> list[float]:
        """Return the opening of a crack at which the bars of each layer rupture.

        The section that yields is so deep as a whole, or else as the member. A hinge holds one crack at least, whose
        bars stretch up to half-way to the next ones.
        """
        depth_m, tensile_pa = self.highest - self.lowest, tensile_strength_pa(compressive_pa)
        openings = []
        for layer, level, width in zip(self.layers, self.levels_m, self.widths_m, strict=True):
            below_edge_m = min(level - self.lowest, self.highest - level)
            spacing = crack_spacing_m(layer.diameter_m, layer.area_m2, width, below_edge_m, depth_m)
            own = replace(steel, yield_pa=layer.yield_pa)
            strain = mean_strain_at_rupture(own, layer.diameter_m, spacing, tensile_pa)
            openings.append(max(rupture_opening_m(strain, whole_m or depth_m), strain * spacing))
        return openings


def layers_of_members(layers: Sequence[BarLayer], members: Sequence[Member]) -> Iterator[LayersOfMember]:
    """Yield the layers of each member, together if they resist the same moments."""
    for layer in layers:
        for name in layer.members:
            if not any(name in (member.name, member.kind) for member in members):
                known = sorted({member.name for member in members} | {member.kind for member in members})
                raise layer.unexpected("members", f"names or kinds of members, such as {', '.join(known)}")
    for index, member in enumerate(members):
        own = [layer for layer in layers if not layer.is_spread and layer.is_in(member.name, member.kind)]
        for is_own, axes in sorted({(layer.own_axes, layer.axes) for layer in own}):
            alike = [layer for layer in own if (layer.own_axes, layer.axes) == (is_own, axes)]
            yield from _stretches(index, member, alike, axes)


def _stretches(
    index: int, member: Member, layers: Sequence[BarLayer], axes: tuple[int, int, int]
) -> Iterator[LayersOfMember]:
    """Yield the layers of each part of a member in which these are the same."""
    corners = member.without_skew(member.solid.corners)
    along = corners[..., axes[0]]
    first, last = float(along.min()), float(along.max())
    if layers[0].own_axes:
        first, last = own_axes(member).ends_m(axes[0])
    for layer in layers:
        begin, end = layer.ends_m
        if begin >= last or end <= first:
            name, limit = ("from_m", f"less than {last:g}") if begin >= last else ("to_m", f"more than {first:g}")
            raise layer.unexpected(name, f"{limit} (m), where {member.name!r} ends along {AXES[axes[0]]}")
    ends = sorted({-math.inf, math.inf, *(end for layer in layers for end in layer.ends_m if first < end < last)})
    for begin, end in pairwise(ends):
        own = tuple(layer for layer in layers if max(layer.ends_m[0], begin) < min(layer.ends_m[1], end))
        if own:
            together = _in_own_axes if own[0].own_axes else _together
            yield together(index, member, corners, own, axes, (begin, end))


def _together(
    index: int,
    member: Member,
    corners: np.ndarray,
    layers: tuple[BarLayer, ...],
    axes: tuple[int, int, int],
    between_m: tuple[float, float],
) -> LayersOfMember:
    _, across, beside = axes
    lowest, highest = (getattr(corners, which)(axis=(0, 1)) for which in ("min", "max"))
    levels = tuple(float(layer.level_m(lowest[across], highest[across])) for layer in layers)
    widths = [_width(corners, across, beside, level) for level in levels]
    _check_widths(member, layers, widths, across, float(highest[across] - lowest[across]))
    width_m = float(highest[beside] - lowest[beside])
    ends = float(lowest[across]), float(highest[across])
    return LayersOfMember(index, layers, *ends, width_m, levels, tuple(widths), between_m, member.line)


def _in_own_axes(
    index: int,
    member: Member,
    corners: np.ndarray,
    layers: tuple[BarLayer, ...],
    axes: tuple[int, int, int],
    between_m: tuple[float, float],
) -> LayersOfMember:
    """Return the same of layers that count in the axes of their member."""
    own, (_, across, beside) = own_axes(member), axes
    lowest, highest = own.ends_m(across)
    levels = tuple(float(layer.level_m(lowest, highest)) for layer in layers)
    first, last = own.ends_m(beside)
    if is_standing(member):
        placed = own.from_world(corners)
        widths = tuple(_width(placed, across, beside, level) for level in levels)
    else:
        widths = tuple(own.width_at_m(level) if beside == 1 else last - first for level in levels)
    _check_widths(member, layers, widths, across, highest - lowest)
    return LayersOfMember(index, layers, lowest, highest, last - first, levels, widths, between_m, own)


def _check_widths(
    member: Member, layers: Sequence[BarLayer], widths: Sequence[float], across: int, thickness_m: float
) -> None:
    for layer, width in zip(layers, widths, strict=True):
        if width <= 0.0:
            raise ScenarioError(
                f"reinforcement.depth_m is {layer.depth_m:g}: expected less than the size of {member.name!r} along "
                f"{AXES[across]}, {thickness_m:g} (m)"
            )


def _width(corners: np.ndarray, across: int, beside: int, level: float) -> float:
    _, points = plane_cuts(corners, across, level)
    return float(np.ptp(points[..., beside])) if len(points) else 0.0


@dataclass(frozen=True, slots=True)
class SpreadBars:
    """Spread bars of a member, such as links, which is `length_m` long along them.

    A crack with the normal n and the area A is crossed by ρ |n · e| A of bars along e, with ρ of steel in each area
    across them. So a plane crack at an angle θ in a beam has links for V = A_sw / s · z f_y cot θ: EN 1992-1-1:2004,
    equation 6.8.
    """

    member: int
    layer: BarLayer
    length_m: float

    @property
    def along(self) -> int:
        """Return the axis that the bars run along."""
        return AXES.index(self.layer.along)

    def pulls_n(self, connections: Connections, factor: float) -> np.ndarray:
        """Return the yield forces (m,) of the bars across connections, N; `factor` scales their strength."""
        crossed_m2 = abs(connections.normals[:, self.along]) * connections.areas
        return factor * self.layer.ratio * self.layer.yield_pa * crossed_m2

    def opening_m(self, compressive_pa: float, steel: Steel) -> float:
        """Return the opening of one crack at which they rupture: of the length between cracks, or its whole."""
        layer, tensile_pa = self.layer, tensile_strength_pa(compressive_pa)
        spacing_m = min(spacing_of_ratio_m(layer.diameter_m, layer.ratio), self.length_m)
        own = replace(steel, yield_pa=layer.yield_pa)
        return spacing_m * mean_strain_at_rupture(own, layer.diameter_m, spacing_m, tensile_pa)


def spread_bars(layers: Sequence[BarLayer], members: Sequence[Member]) -> Iterator[SpreadBars]:
    """Yield the spread bars of each member."""
    for layer in layers:
        if not layer.is_spread:
            continue
        for index, member in enumerate(members):
            if layer.is_in(member.name, member.kind):
                lengths = np.ptp(member.solid.vertices, axis=0)
                yield SpreadBars(index, layer, float(lengths[AXES.index(layer.along)]))
