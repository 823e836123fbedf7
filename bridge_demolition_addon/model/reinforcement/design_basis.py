"""What the design of every member has in common: bridge, materials, cover and traffic, and bars that it chooses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.reinforced_concrete.influence_lines import (
    InfluenceLines,
    MovingLoad,
    extreme_effects,
    permanent_effects,
)
from ...engineering.reinforced_concrete.least_areas import (
    DIAMETERS_M,
    LARGEST_SHARE,
    MOST_ROWS,
    BarChoice,
    bar_area_m2,
    bars_in_rows,
    column_link_bar_m,
    column_link_spacing_m,
    diameters_from,
    of_beam_m2,
    of_links_m2_m,
    row_depth_m,
)
from ...engineering.reinforced_concrete.materials import PERMANENT_FACTOR, VARIABLE_FACTOR, Concrete, design_yield_pa
from ...engineering.reinforced_concrete.resistance import (
    Links,
    PressedShape,
    links,
    links_along_m2_m,
    struts_n,
    tension_steel,
    without_links_n,
)
from ...engineering.reinforced_concrete.traffic import Traffic
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ...texts import Quantity, Text
from ..bridge.member import Member
from ..materials import BarLayer
from ..scenario import Bridge
from ..scenario.reinforcement import BarRule, BridgeReinforcement
from .schedule import ScheduledBars, ScheduledLinks

_MM2 = 1e6
_KILO = 1e3
_LEAST_SPACING_M = 0.075
"""Least distance of bars where there is room: what is narrower than `_NARROW_M` has them closer."""

_NARROW_M = 1.0
_MOST_SPACING_M = 0.25
"""Largest distance of bars; EN 1992-1-1:2004, 9.3.1.1 (3), allows up to 0.4 m in slabs."""

LEAST = "least area"
"""Reason of bars that no load asks for."""

COLUMN_LINK_M = 0.010
"""Usual links of columns."""

_LINK_DIAMETERS_M = (0.010, 0.012, 0.014, 0.016, 0.020)
_LEAST_LINK_SPACING_M = 0.08
_MOST_LEGS_APART_M = 0.6
"""Largest distance of legs across a beam: EN 1992-1-1:2004, 9.2.2 (8)."""


@dataclass(frozen=True, slots=True)
class Tension:
    """Bars in tension that a moment needs: their depth below their side, and why the number."""

    choice: BarChoice
    depth_m: float
    required_m2: float
    reason: str


@dataclass(frozen=True, slots=True)
class BarDesign:
    """Rule and materials that bars are designed by, and the bars that they choose."""

    rule: BarRule
    concrete: Concrete

    @property
    def yield_pa(self) -> float:
        """Characteristic strength of the bars."""
        return self.rule.grade.yield_pa

    @property
    def design_yield_pa(self) -> float:
        return design_yield_pa(self.rule.grade)

    @property
    def bar_m(self) -> float:
        return self.rule.bar_diameter_mm / _KILO

    @property
    def secondary_m(self) -> float:
        """Diameter of bars across main ones: the usual one next above 0.6 of theirs."""
        return next((usual for usual in DIAMETERS_M if usual >= 0.6 * self.bar_m * (1.0 - 1e-9)), self.bar_m)

    @property
    def link_m(self) -> float:
        return _LINK_DIAMETERS_M[0]

    def weight_n(self, member: Member) -> float:
        return member.mass_kg * STANDARD_GRAVITY_M_S2

    def refused(self, why: str) -> ScenarioError:
        return self.rule.refused(why)

    def tension(
        self,
        name: str,
        moment_nm: float,
        shape: PressedShape,
        *,
        bars_width_m: float,
        outside_m: float,
        least_m2: Callable[[float], float] | None = None,
        is_slab: bool = False,
        preferred_m: float | None = None,
        advice: str,
    ) -> Tension:
        """Return bars for a moment, in as few rows as they fit in.

        `outside_m` is the distance of their outer edge from their side, `bars_width_m` the width of the concrete in
        which they lie, and `least_m2` their least area by their depth below the pressed edge.
        """
        least_spacing = 0.0 if bars_width_m < _NARROW_M else _LEAST_SPACING_M
        room = bars_width_m - 2.0 * (self.rule.cover_m if is_slab else self.rule.cover_m + self.link_m)
        for rows in range(1, 2 if is_slab else MOST_ROWS + 1):
            for diameter in diameters_from(preferred_m or self.bar_m):
                depth = outside_m + row_depth_m(diameter, rows)
                self._check_depth(name, depth, shape.height_m, room - diameter)
                required, reason = self._required(name, moment_nm, shape, depth, bars_width_m, least_m2, advice)
                choice = bars_in_rows(
                    required, room, diameter, rows, least_spacing_m=least_spacing, most_spacing_m=_MOST_SPACING_M
                )
                if choice:
                    return Tension(choice, depth, required, reason)
        raise self.refused(
            f"{name} needs {_MM2 * required:.0f} mm² of bars under {moment_nm / _KILO:.0f} kN·m, which do not fit into "
            f"{room:.2f} m: {advice}"
        )

    def _check_depth(self, name: str, depth_m: float, height_m: float, room_m: float) -> None:
        if depth_m >= 0.5 * height_m or room_m < 0.0:
            raise self.rule.unexpected(
                "cover_m", f"less: the bars of {name}, {height_m:g} m thick, would be {depth_m:.3f} m below its side"
            )

    def _required(
        self,
        name: str,
        moment_nm: float,
        shape: PressedShape,
        depth_m: float,
        width_m: float,
        least_m2: Callable[[float], float] | None,
        advice: str,
    ) -> tuple[float, str]:
        effective = shape.height_m - depth_m
        for_moment = tension_steel(max(moment_nm, 0.0), shape, effective, self.concrete, self.design_yield_pa)
        if for_moment.neutral_axis > self.concrete.deepest_neutral_axis:
            found = (
                "no depth of the neutral axis carries it"
                if np.isinf(for_moment.neutral_axis)
                else f"x/d is {for_moment.neutral_axis:.2f}"
            )
            raise self.refused(
                f"{name} cannot carry its design moment of {moment_nm / _KILO:.0f} kN·m without bars in compression: "
                f"with {shape.height_m:g} m of height and d = {effective:.3f} m {found}, where EN 1992-1-1 has at most "
                f"{self.concrete.deepest_neutral_axis:g}; {advice}"
            )
        least = self.of_beam_m2(width_m, effective) if least_m2 is None else least_m2(effective)
        reason: str
        required, reason = for_moment.area_m2, Text("{} = {}", "M_Ed", Quantity(moment_nm / _KILO, "kN·m", ".0f"))
        if least > required:
            required, reason = least, LEAST
        if required > LARGEST_SHARE * width_m * shape.height_m:
            raise self.refused(
                f"{name} needs {_MM2 * required:.0f} mm² of bars, {required / width_m / shape.height_m:.1%} of its "
                f"section, where EN 1992-1-1 has at most {LARGEST_SHARE:.0%}; {advice}"
            )
        return required, reason

    def of_beam_m2(self, width_m: float, depth_m: float) -> float:
        return of_beam_m2(width_m, depth_m, self.concrete, self.yield_pa)

    def least_bars(
        self, name: str, height_m: float, width_m: float, area_m2: float, outside_m: float, reason: str
    ) -> Tension:
        """Return bars of an area that no moment asks for, such as those across the main ones of a slab."""
        shape = PressedShape.rectangle(height_m, width_m)
        found = self.tension(
            name,
            0.0,
            shape,
            bars_width_m=width_m,
            outside_m=outside_m,
            least_m2=lambda _: area_m2,
            is_slab=True,
            preferred_m=self.secondary_m,
            advice="take thicker members",
        )
        return Tension(found.choice, found.depth_m, found.required_m2, reason)

    def scheduled(
        self,
        names: Sequence[str],
        kind: str,
        side: str,
        along: str,
        found: Tension,
        *,
        section_m2: float,
        length_m: float,
        depth_m: float | None = None,
        between_m: tuple[float, float] | None = None,
    ) -> ScheduledBars:
        """Return a layer of the schedule; `depth_m` below its side where that is not the one of its section.

        `between_m` are positions along the bars where these do not run along the whole member.
        """
        layer = BarLayer(
            members=tuple(names),
            along=along,
            side=side,
            depth_m=found.depth_m if depth_m is None else depth_m,
            area_mm2=found.choice.area_m2 * _MM2,
            yield_n_mm2=self.yield_pa / _MM2,
            diameter_mm=_KILO * found.choice.diameter_m,
            from_m=None if between_m is None else between_m[0],
            to_m=None if between_m is None else between_m[1],
        )
        return ScheduledBars(layer, kind, found.choice, section_m2, found.required_m2, found.reason, length_m)

    def links_for(
        self,
        names: Sequence[str],
        kind: str,
        shear_n: float,
        *,
        width_m: float,
        webs: int,
        height_m: float,
        depth_m: float,
        bars_m2: float,
        length_m: float,
        advice: str,
        is_slab: bool = False,
        has_slab: bool = False,
    ) -> ScheduledLinks | None:
        """Return the links for a shear force; None for a slab that needs none.

        `width_m` is the sum of the webs' widths, `bars_m2` the bars in tension with them. Where a girder `has_slab`
        above it, its links hold this.
        """
        concrete_n = without_links_n(width_m, depth_m, bars_m2, self.concrete)
        least = of_links_m2_m(width_m, self.concrete, self.yield_pa)
        if shear_n <= concrete_n:
            if is_slab:
                return None
            needed, reason = Links(least, 2.5), LEAST
        else:
            found = links(shear_n, width_m, depth_m, self.concrete, self.design_yield_pa)
            if found is None:
                raise self.refused(
                    f"{names[0]} cannot carry its design shear of {shear_n / _KILO:.0f} kN with any links: its struts "
                    f"carry V_Rd,max = {struts_n(width_m, depth_m, self.concrete, 1.0) / _KILO:.0f} kN at 45°; {advice}"
                )
            needed, reason = found, Text("{} = {}", "V_Ed", Quantity(shear_n / _KILO, "kN", ".0f"))
            if least > found.area_m2_m:
                needed, reason = Links(least, found.cot_strut), LEAST
        along = links_along_m2_m(shear_n, depth_m, self.design_yield_pa) if has_slab else 0.0
        if along > needed.area_m2_m:
            needed, reason = (
                Links(along, needed.cot_strut),
                Text("V_Ed = {} along the slab", Quantity(shear_n / _KILO, "kN", ".0f")),
            )
        most = min(0.75 * depth_m, 0.6 if is_slab else 0.3)  # 9.2.2 (6)
        apart = 1.5 * depth_m if is_slab else min(0.75 * depth_m, _MOST_LEGS_APART_M)  # 9.3.2 (5) and 9.2.2 (8)
        legs = max(2 * webs, webs * (1 + int(np.ceil((width_m / webs - 2.0 * self.rule.cover_m) / apart - 1e-9))))
        diameter, spacing = self._link_bars(needed.area_m2_m, legs, most)
        area = legs * np.pi * diameter**2 / 4.0 / spacing
        upright = legs * (height_m - 2.0 * self.rule.cover_m)
        level = 0.0 if is_slab else 2.0 * (width_m - 2.0 * webs * self.rule.cover_m)
        return ScheduledLinks(
            members=tuple(names),
            kind=kind,
            link_area_mm2_per_m=float(area) * _MM2,
            required_mm2_per_m=needed.area_m2_m * _MM2,
            reason=reason,
            legs=legs,
            diameter_m=diameter,
            spacing_m=spacing,
            width_m=width_m,
            loop_m=upright + level,
            length_m=length_m,
            shear_n=shear_n,
            concrete_n=concrete_n,
            cot_strut=needed.cot_strut,
        )

    @staticmethod
    def _link_bars(area_m2_m: float, legs: int, most_m: float) -> tuple[float, float]:
        """Return diameter and distance of links, m, the distance in steps of 10 mm, of no less area than is needed."""
        for diameter in _LINK_DIAMETERS_M:
            spacing = min(legs * np.pi * diameter**2 / 4.0 / area_m2_m, most_m)
            if spacing >= _LEAST_LINK_SPACING_M or diameter == _LINK_DIAMETERS_M[-1]:
                break
        stepped = np.floor(spacing * 100.0 + 1e-9) / 100.0
        return diameter, float(stepped if stepped > 0.0 else spacing)


@dataclass(frozen=True, slots=True)
class DesignBasis(BarDesign):
    """A parametric bridge, its members, and what its bars are designed by."""

    rule: BridgeReinforcement
    bridge: Bridge
    members: tuple[Member, ...]
    traffic: Traffic | None

    def of_kind(self, kind: str) -> list[Member]:
        return [member for member in self.members if member.kind == kind]


def column_loads(axial_n: float, moment_nm: float) -> Text:
    """Return the design loads of a column or wall as text: the reason of its bars."""
    axial, moment = Quantity(axial_n / _KILO, "kN", ".0f"), Quantity(moment_nm / _KILO, "kN·m", ".0f")
    return Text("{} = {}, {} = {}", "N_Ed", axial, "M_Ed", moment)


def column_links(
    names: Sequence[str], bar_m: float, *, side_m: float, legs: int, width_m: float, loop_m: float, length_m: float
) -> ScheduledLinks:
    """Return the links of equal columns with bars of a diameter; `side_m` is their smallest side or their diameter."""
    diameter = max(COLUMN_LINK_M, column_link_bar_m(bar_m))
    spacing = np.floor(100.0 * column_link_spacing_m(bar_m, side_m) + 1e-9) / 100.0
    area = float(legs * bar_area_m2(diameter) / spacing) * _MM2
    return ScheduledLinks(
        members=tuple(names),
        kind="pier",
        link_area_mm2_per_m=area,
        required_mm2_per_m=area,
        reason=LEAST,
        legs=legs,
        diameter_m=diameter,
        spacing_m=float(spacing),
        width_m=width_m,
        loop_m=loop_m,
        length_m=length_m,
    )


@dataclass(frozen=True, slots=True, eq=False)
class BeamEffects:
    """Design effects along a beam with n points: permanent loads count 1.35 times, or once where they relieve."""

    lines: InfluenceLines
    largest_nm: np.ndarray  # (n,), moments
    least_nm: np.ndarray  # (n,)
    shears_n: np.ndarray  # (n - 1,), larger of both directions, between the points
    permanent_reactions_n: np.ndarray  # (r,), without factors

    @property
    def sagging_nm(self) -> float:
        return float(max(self.largest_nm.max(), 0.0))

    @property
    def hogging_nm(self) -> float:
        return float(max(-self.least_nm.min(), 0.0))

    def shear_beyond_n(self, supports_m: Sequence[float], distance_m: float) -> float:
        """Return the largest shear force farther from all supports than a distance; 0 where nothing is.

        Between two points a shear comes from axles at or beyond the next one: so the part before the distance counts.
        """
        apart = np.abs(self.lines.between_m[:, None] - np.array(supports_m)).min(axis=1)
        before = 1.5 * np.diff(self.lines.points_m)
        is_beyond = (apart >= distance_m - before) & (apart.max() >= distance_m)
        return float(self.shears_n[is_beyond].max(initial=0.0))

    def hogging_beyond_nm(self, supports_m: Sequence[float], distance_m: float) -> float:
        """Return the largest hogging moment at the faces of supports or farther from these."""
        apart = np.abs(self.lines.points_m[:, None] - np.array(supports_m)).min(axis=1)
        return float(max(-self.least_nm[apart >= distance_m].min(initial=0.0), 0.0))


def beam_effects(lines: InfluenceLines, permanent_n_m: float, moving: Sequence[MovingLoad]) -> BeamEffects:
    """Return the design effects of a permanent load by length and of moving loads, one of them at a time."""
    points = lines.points_m
    moments = permanent_effects(points, lines.moments, permanent_n_m)
    shears = permanent_effects(points, lines.shears, permanent_n_m)
    least, largest = extreme_effects(points, lines.moments, moving)
    downwards, upwards = extreme_effects(points, lines.shears, [_everywhere(load) for load in moving])
    raised, lowered = np.maximum(PERMANENT_FACTOR * shears, shears), np.minimum(PERMANENT_FACTOR * shears, shears)
    return BeamEffects(
        lines,
        np.maximum(PERMANENT_FACTOR * moments, moments) + VARIABLE_FACTOR * largest,
        np.minimum(PERMANENT_FACTOR * moments, moments) + VARIABLE_FACTOR * least,
        np.maximum(raised + VARIABLE_FACTOR * upwards, -(lowered + VARIABLE_FACTOR * downwards)),
        permanent_effects(points, lines.reactions, permanent_n_m),
    )


def _everywhere(load: MovingLoad) -> MovingLoad:
    """Return a load that counts for all effects."""
    return replace(load, hogging_only=False)
