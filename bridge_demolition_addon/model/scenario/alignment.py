"""The alignment of a bridge: grade, vertical curve and crossfall of its deck, and the line that follows from them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ...engineering.arithmetic import cosine, sine
from ...engineering.geometry.road_lines import RoadLine
from ...errors import ScenarioError
from ..schema import FARTHEST_M, POSITION, ROUNDING, Table, key

_STEEPEST_PERCENT = 15
_GRADE = {"unit": "%", "at_least": -_STEEPEST_PERCENT, "at_most": _STEEPEST_PERCENT}

_SAG_M = 0.005
"""How far a vertical curve may be off the straight pieces that it is built of."""

_SAME_TOP_M = 1e-3

_PIECE_RAD = 0.04
"""Angle between the ends of a straight piece of a curve in plan: its area is off by 0.03 %, and a span twists its
supports by 1 % less."""

_SHARPEST_RAD = math.pi
"""Angle that a road turns by at most."""

_SHORTEST_M = 0.5
"""Least length of a straight piece beside a support."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Alignment(Table):
    """How the deck runs where it is not level: by a grade, by a vertical curve between two grades, or by its tops above
    the axes; and where it is not straight, by a radius. Heights of piers, abutments and what lies on them count at the
    axis of the first support; tops of all others follow the deck, down to the ground. The deck is straight over each
    support and built of straight pieces, as deep by the plumb line as it is level. There is none with an arch, a frame
    or one solid of all members."""

    table: ClassVar[str] = "bridge.alignment"

    grade_percent: float = key(
        "Slope along the road; above 0 it rises. With another `end_grade_percent` that at the first axis.",
        default=0.0,
        **_GRADE,
    )
    end_grade_percent: float | None = key(
        "Slope behind a vertical curve, a parabola; by default the same.", default=None, **_GRADE
    )
    curve_from_m: float | None = key(
        "Where the vertical curve begins along the road; by default at the first axis.", default=None, **POSITION
    )
    curve_to_m: float | None = key("Where it ends; by default at the last axis.", default=None, **POSITION)
    tops_m: tuple[float, ...] | None = key(
        "Heights of the deck's top above the axis of each support, in the middle of the road, instead of grades. The "
        "first is what piers, caps, girders and deck make together; it is straight between supports.",
        default=None,
        **POSITION,
    )
    crossfall_percent: float = key(
        "Slope across the road; above 0 the left side, towards positive y, is higher. Pier caps and tops of piers and "
        "abutments follow it.",
        default=0.0,
        unit="%",
        at_least=-10,
        at_most=10,
    )

    radius_m: float | None = key(
        "Radius of the middle of the road in plan; above 0 it turns to the left, towards positive y. It begins along x "
        "at the first axis. Spans are measured along it, and axes of supports are radial.",
        default=None,
        unit="m",
        at_least=-FARTHEST_M,
        at_most=FARTHEST_M,
    )

    @property
    def crossfall(self) -> float:
        """Return by how much the deck rises to the left for each metre."""
        return 0.01 * self.crossfall_percent

    def line(
        self,
        axes_m: Sequence[float],
        halves_m: Sequence[float],
        ends_m: tuple[float, float],
        shift_across: float,
        corners_m: Sequence[float] = (),
    ) -> RoadLine:
        """Return the line of a deck between its ends, over supports so long to both sides of their axes.

        It is plane over each support, across the road as well, and has more stations where its underside has corners.
        """
        supports = [(axis - half, axis + half) for axis, half in zip(axes_m, halves_m, strict=True)]
        corners = [corner for corner in corners_m if ends_m[0] < corner < ends_m[1]]
        bends, between = [*ends_m], [(before[1], after[0]) for before, after in pairwise(supports)]
        if self.has_corners:
            bends += [edge for edges in between for edge in edges]
        if self.radius_m is not None:
            piece = _PIECE_RAD * abs(self.radius_m)
            for begin, end in between:
                bends += np.linspace(begin, end, math.ceil((end - begin) / piece) + 1)[1:-1].tolist()
        stations = {*bends, *corners}
        for begin, end in between:
            upright = self._on_vertical_curve(begin, end, axes_m)
            stations |= {place for place in upright if _is_apart(place, [begin, end, *bends, *corners])}
        places = np.array(sorted(stations))
        heights, falls = np.transpose([self._over(place, axes_m, supports, shift_across) for place in places.tolist()])
        in_plan = None if self.radius_m is None else np.array(sorted(set(bends)))
        return RoadLine(places, heights, falls, shift_across, self.radius_m, in_plan)

    def axis_line(self, axes_m: Sequence[float], number: int, shift_across: float) -> RoadLine:
        """Return the plane that the deck lies in over a support, by its number from 0, as a line with one slope."""
        heights, slopes = self._at_axes(axes_m)
        axis, slope = axes_m[number], slopes[number]
        places = np.array([axis - 1.0, axis + 1.0])
        line = RoadLine(
            places,
            heights[number] + slope * (places - axis),
            np.full(2, self.crossfall + shift_across * slope),
            shift_across,
        )
        if self.radius_m is None:
            return line
        turn = axis / self.radius_m
        on_curve = self.radius_m * float(sine(turn)), self.radius_m * (1.0 - float(cosine(turn)))
        return replace(line, axis_m=on_curve, heading_rad=turn, begin_m=axis)

    @property
    def has_corners(self) -> bool:
        """Whether the deck is built of several straight pieces."""
        return self.is_bent or self.radius_m is not None

    @property
    def is_bent(self) -> bool:
        """Whether its slope changes."""
        return self.tops_m is not None or self.end_grade_percent not in (None, self.grade_percent)

    def check_axes(self, axes_m: Sequence[float], first_top_m: float) -> None:
        """Check that tops fit a bridge with its deck at this height at the first axis, and curves are on it.

        Raises
        ------
        ScenarioError
            They are not.
        """
        if self.radius_m is not None and axes_m[-1] > _SHARPEST_RAD * abs(self.radius_m):
            least = axes_m[-1] / _SHARPEST_RAD
            raise self.unexpected("radius_m", f"at least {least:.4g} (m), so that the road turns by 180° at most")
        if self.tops_m is not None:
            if len(self.tops_m) != len(axes_m):
                raise self.unexpected("tops_m", f"{len(axes_m)} numbers, one for each support")
            if abs(self.tops_m[0] - first_top_m) > _SAME_TOP_M:
                raise ScenarioError(
                    f"{self.table}.tops_m.1 is {self.tops_m[0]:g}: expected {first_top_m:g} (m), up to which pier or "
                    "abutment, cap, girders and deck reach there"
                )
            for number, (run, before, after) in enumerate(
                zip(np.diff(axes_m).tolist(), self.tops_m[:-1], self.tops_m[1:], strict=True), start=1
            ):
                if abs(after - before) > 0.01 * _STEEPEST_PERCENT * run:
                    slope = 100.0 * (after - before) / run
                    raise ScenarioError(
                        f"{self.table}.tops_m has a slope of {slope:.3g} % in span {number}: expected at most "
                        f"{_STEEPEST_PERCENT} %"
                    )
        elif self.is_bent:
            begin, end = self._curve_m(axes_m)
            if begin >= end * (1.0 - ROUNDING):
                raise self.unexpected(
                    "curve_from_m" if self.curve_from_m is not None else "curve_to_m",
                    f"a curve that ends behind its begin; it goes from {begin:g} to {end:g} (m)",
                )

    def _check_together(self) -> None:
        if self.tops_m is not None:
            for name in ("grade_percent", "end_grade_percent"):
                if getattr(self, name):
                    raise self.unexpected(name, f"none with {self.table}.tops_m")
        if self.end_grade_percent is None:
            for name in ("curve_from_m", "curve_to_m"):
                if getattr(self, name) is not None:
                    raise self.unexpected(name, f"none without {self.table}.end_grade_percent")

    def _curve_m(self, axes_m: Sequence[float]) -> tuple[float, float]:
        begin = axes_m[0] if self.curve_from_m is None else self.curve_from_m
        return begin, axes_m[-1] if self.curve_to_m is None else self.curve_to_m

    def _grades(self) -> tuple[float, float]:
        after = self.grade_percent if self.end_grade_percent is None else self.end_grade_percent
        return 0.01 * self.grade_percent, 0.01 * after

    def _profile(self, place_m: float, axes_m: Sequence[float]) -> tuple[float, float]:
        """Return height and slope of the road at a position along it, by its grades."""
        before, after = self._grades()
        if not self.is_bent:
            return before * place_m, before
        begin, end = self._curve_m(axes_m)
        within = min(max(place_m - begin, 0.0), end - begin)
        slope = before + (after - before) * within / (end - begin)
        on_curve = before * min(place_m, begin) + 0.5 * (before + slope) * within
        return on_curve + after * max(place_m - end, 0.0), slope

    def _at_axes(self, axes_m: Sequence[float]) -> tuple[list[float], list[float]]:
        """Return heights above the first axis, and slopes, at all axes."""
        if self.tops_m is None:
            profile = [self._profile(axis, axes_m) for axis in axes_m]
            start = profile[0][0]
            return [height - start for height, _ in profile], [slope for _, slope in profile]
        heights = [top - self.tops_m[0] for top in self.tops_m]
        spans = (np.diff(heights) / np.diff(axes_m)).tolist()
        inner = [0.5 * (before + after) for before, after in pairwise(spans)]
        return heights, [spans[0], *inner, spans[-1]]

    def _on_vertical_curve(self, begin_m: float, end_m: float, axes_m: Sequence[float]) -> list[float]:
        """Return where the deck bends upright between two supports: on a vertical curve and at its ends."""
        if self.tops_m is not None or not self.is_bent:
            return []
        before, after = self._grades()
        first, last = self._curve_m(axes_m)
        piece = math.sqrt(8.0 * _SAG_M * (last - first) / abs(after - before))
        low, high = max(begin_m, first), min(end_m, last)
        if low >= high:
            return []
        return np.linspace(low, high, max(math.ceil((high - low) / piece), 1) + 1).tolist()

    def _over(
        self,
        place_m: float,
        axes_m: Sequence[float],
        supports_m: Sequence[tuple[float, float]],
        shift_across: float,
    ) -> tuple[float, float]:
        """Return height and crossfall at a station: of one plane over a support and beyond the last ones."""
        at_axes, slopes = self._at_axes(axes_m)
        near = int(np.abs(np.array(axes_m) - place_m).argmin())
        away, slope = place_m - axes_m[near], slopes[near]
        low, high = supports_m[near]
        if low <= place_m <= high or not axes_m[0] <= place_m <= axes_m[-1]:
            if self.radius_m is None:
                return at_axes[near] + slope * away, self.crossfall + shift_across * slope
            across, along = float(cosine(away / self.radius_m)), float(sine(away / self.radius_m))
            by_crossfall = self.crossfall * self.radius_m * (1.0 - across)
            height = at_axes[near] + slope * self.radius_m * along + by_crossfall
            return height, self.crossfall * across - slope * along
        if self.tops_m is None:
            height, slope = self._profile(place_m, axes_m)
            return height - self._profile(axes_m[0], axes_m)[0], self.crossfall + shift_across * slope
        edges = [edge for support in supports_m for edge in support]
        planes = [
            rise + slope * (edge - axis)
            for rise, slope, axis, support in zip(at_axes, slopes, axes_m, supports_m, strict=True)
            for edge in support
        ]
        return float(np.interp(place_m, edges, planes)), self.crossfall + shift_across * slope


def _is_apart(place_m: float, others_m: Sequence[float]) -> bool:
    return all(abs(place_m - other) > _SHORTEST_M for other in others_m)
