"""Where the supports, ribs and legs of a bridge are, and whether its parts fit together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from ...engineering.arithmetic import cosine
from ...engineering.geometry.arches import ArchAxis
from ...engineering.geometry.road_lines import RoadLine
from ...errors import ScenarioError
from ..schema import FARTHEST_M, ROUNDING, Table, check_exactly_one, given
from .alignment import Alignment
from .arch import Arch, RigidFrame
from .bridge_parts import Abutments, BridgeBearings, Girders, Piers
from .half_joints import check_half_joints, pinned_supports
from .haunches import Haunches
from .reinforcement import BridgeReinforcement

if TYPE_CHECKING:
    from .bridge import Bridge


SHORTEST_SUPPORT_M = 0.1
"""Least height of what stands on the ground."""


def axes_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the supports' axes, in the middle of the road."""
    return list(accumulate(bridge.span_lengths_m, initial=0.0))


def arch_axis(bridge: Bridge) -> ArchAxis:
    """Return the axis of the arch."""
    return given(bridge.arch).axis_between(*springing_axes_m(bridge))


def rib_axes_m(bridge: Bridge) -> list[float]:
    """Return the positions across the road of the ribs of the arch."""
    ribs = given(bridge.arch).ribs
    return [bridge.carried_width_m * ((rib + 0.5) / ribs - 0.5) for rib in range(ribs)]


def leg_axes_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the legs of the frame, where they meet the deck."""
    return axes_m(bridge)[1:-1] if bridge.abutments else axes_m(bridge)


def deck_underside(bridge: Bridge) -> float:
    """Height above the ground of what lies on piers and abutments, m: slab, girders or box girder."""
    if bridge.frame:
        return bridge.frame.clear_height_m
    if bridge.piers is None:
        return given(given(bridge.abutments).height_m)
    cap_height = bridge.pier_caps.height_m if bridge.pier_caps else 0.0
    return bridge.piers.height_m + cap_height


def slab_underside(bridge: Bridge) -> float:
    """Height of the slab's underside above the ground, m: higher than the girders' or the box's it lies on."""
    below = bridge.girders or bridge.box_girder
    return deck_underside(bridge) + (below.depth_m if below else 0.0)


def deck_top(bridge: Bridge) -> float:
    """Height of the road surface above the ground, m."""
    return slab_underside(bridge) + bridge.deck.thickness_m


def road_line(bridge: Bridge) -> RoadLine | None:
    """Return the line that the deck follows; None of one that is straight, level and of one depth."""
    if bridge.alignment is None and bridge.haunches is None:
        return None
    axes, half = axes_m(bridge), _half_support_m(bridge)
    ends = -bridge.deck.overhang_m, bridge.spans_m + bridge.deck.overhang_m
    alignment, shift = bridge.alignment or Alignment(), bridge.shift_across
    if bridge.haunches is None:
        return alignment.line(axes, [half] * len(axes), ends, shift)
    places, depths = bridge.haunches.outline(axes, half)
    line = alignment.line(axes, [half] * len(axes), ends, shift, places.tolist())
    level = slab_underside(bridge) if bridge.girders or bridge.box_girder else deck_top(bridge)
    factors = 1.0 + np.interp(line.stations_m, places, depths) / (level - deck_underside(bridge))
    return replace(line, level_m=level, factors=factors)


def lower_by_m(bridge: Bridge, along_m: float) -> float:
    """Return how much lower what carries the deck at an axis ends than it would below a deck without haunches."""
    if bridge.haunches is None:
        return 0.0
    axes = axes_m(bridge)
    return bridge.haunches.depth_over_m(_nearest(axes, along_m), len(axes))


def axis_line(bridge: Bridge, along_m: float) -> RoadLine | None:
    """Return the plane that the deck lies in over the support with its axis there, as a line with one slope."""
    if bridge.alignment is None:
        return None
    axes = axes_m(bridge)
    return bridge.alignment.axis_line(axes, _nearest(axes, along_m), bridge.shift_across)


def _nearest(axes: Sequence[float], along_m: float) -> int:
    return min(range(len(axes)), key=lambda number: abs(axes[number] - along_m))


def deck_top_at(bridge: Bridge, along_m: float, across_m: float) -> float:
    """Return the height of the road surface above the ground at a position in plan, m."""
    line = road_line(bridge)
    return deck_top(bridge) + (0.0 if line is None else line.rise_m(along_m, across_m))


def upright_names(bridge: Bridge) -> list[list[str]]:
    """Return the names of the columns, walls or legs of each axis between the abutments, in their order."""
    if bridge.frame:
        count, kind, beside = len(leg_axes_m(bridge)), "leg", "."
        each = bridge.frame.legs
        numbers = [each] * count
    elif bridge.piers:
        kind, beside = "pier", " column "
        numbers = [bridge.piers_of(pier).columns for pier in range(1, pier_count(bridge) + 1)]
    else:
        return []
    return [
        [f"{kind} {axis}"] if each == 1 else [f"{kind} {axis}{beside}{number}" for number in range(1, each + 1)]
        for axis, each in enumerate(numbers, start=1)
    ]


def pier_count(bridge: Bridge) -> int:
    """Return how many axes have piers."""
    return len(axes_m(bridge)) - (2 if bridge.abutments else 0)


def kinds_of_piers(bridge: Bridge) -> list[Piers]:
    """Return all that piers are like; none of a bridge without."""
    return [bridge.piers, *(table.of(bridge.piers) for table in bridge.other_piers)] if bridge.piers else []


def axes_on_arch_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the piers that stand on the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support : arch.last_support(len(axes)) - 1]


def springing_axes_m(bridge: Bridge) -> tuple[float, float]:
    """Return the positions along the road of the piers on the thrust blocks of the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support - 1], axes[arch.last_support(len(axes)) - 1]


def check_bridge(bridge: Bridge) -> None:
    """Check that the parts of a bridge fit together.

    Raises
    ------
    ScenarioError
        Where they do not, with the key and what is expected.
    """
    if bridge.density_kg_m3 is not None and bridge.mass_kg is not None:
        check_exactly_one(bridge, "density_kg_m3", "mass_kg")
    if bridge.spans_m > FARTHEST_M:
        raise ScenarioError(f"bridge.span_lengths_m add up to {bridge.spans_m:g}: expected at most {FARTHEST_M:g} (m)")
    _check_parts(bridge)
    if bridge.frame:
        _check_frame(bridge, bridge.frame)
    _check_superstructure(bridge)
    _check_room_along(bridge)
    _check_joints(bridge)
    if bridge.alignment or bridge.haunches:
        _check_line(bridge)
    for piers in kinds_of_piers(bridge):
        _check_room_across(bridge, piers)
    if bridge.other_piers or any(piers.batter_percent or piers.feet_apart_m for piers in kinds_of_piers(bridge)):
        _check_other_piers(bridge)
    if bridge.half_joints:
        _check_half_joints(bridge)
    if bridge.merge:
        _check_one_density(bridge)
    if bridge.arch:
        _check_arch(bridge, bridge.arch)
    if bridge.bearings:
        _check_bearings(bridge, bridge.bearings)
    if bridge.reinforcement:
        _check_reinforcement(bridge, bridge.reinforcement)


def _check_reinforcement(bridge: Bridge, reinforcement: BridgeReinforcement) -> None:
    if bridge.merge and reinforcement.has_bars:
        raise ScenarioError("bridge.reinforcement is given: expected none with bridge.merge, where no member is left")
    reinforcement.check_deck(bridge.deck.width_m)
    reinforcement.check_ratios(bridge.arch.names if bridge.arch else ())
    if bridge.frame:
        reinforcement.check_frame()


def _check_bearings(bridge: Bridge, bearings: BridgeBearings) -> None:
    if bridge.merge:
        raise ScenarioError("bridge.bearings is given: expected none with bridge.merge, where no member is left")
    supports, spans = len(bridge.span_lengths_m) + 1, len(bridge.span_lengths_m)
    if bridge.frame and bridge.abutments is None:
        raise ScenarioError("bridge.bearings is given: expected none with bridge.frame without abutments")
    if bearings.pinned_at is None:
        return
    if bridge.frame:
        raise bearings.unexpected("pinned_at", "none with bridge.frame, whose legs hold the deck along the road")
    if bridge.deck.per_span and spans > 1:
        raise bearings.unexpected("pinned_at", "none with bridge.deck.per_span: each deck is pinned at its first end")
    if bearings.pinned_at > supports:
        raise bearings.unexpected("pinned_at", f"at most {supports}, the number of supports of the bridge")


def _check_parts(bridge: Bridge) -> None:
    if bridge.girders and bridge.box_girder:
        raise ScenarioError("bridge.girders and bridge.box_girder are given together: expected at most one")
    between_abutments = bridge.abutments is not None and len(bridge.span_lengths_m) == 1
    if bridge.frame:
        between_abutments = False
    elif not between_abutments and bridge.piers is None:
        raise ScenarioError("bridge.piers is missing: expected a table")
    for name in ("piers", "pier_caps"):
        if between_abutments and getattr(bridge, name):
            raise ScenarioError(
                f"bridge.{name} is given: expected none with bridge.abutments and one span, which has no piers"
            )
    if bridge.abutments and between_abutments != (bridge.abutments.height_m is not None):
        carrying = "bridge.frame" if bridge.frame else "piers"
        wanted = "a number (m) with one span" if between_abutments else f"none with {carrying}, which give it"
        raise bridge.abutments.unexpected("height_m", wanted)


def _check_superstructure(bridge: Bridge) -> None:
    if bridge.voids:
        for name in ("girders", "box_girder", "frame"):
            if getattr(bridge, name):
                raise ScenarioError(f"bridge.voids and bridge.{name} are given together: expected at most one")
        bridge.voids.check_in(bridge.deck)
        if bridge.mass_kg is not None or bridge.merge:
            name = "mass_kg" if bridge.mass_kg is not None else "merge"
            raise ScenarioError(
                f"bridge.voids and bridge.{name} are given together: expected bridge.density_kg_m3 alone"
            )
    if bridge.box_girder and bridge.box_girder.width_m > bridge.deck.width_m * (1.0 + ROUNDING):
        raise bridge.box_girder.unexpected("width_m", f"at most bridge.deck.width_m, {bridge.deck.width_m} (m)")
    if not bridge.girders:
        return
    spacing, width = bridge.girder_spacing_m, bridge.girders.width_m
    if bridge.girders.number > 1 and width > spacing * (1.0 + ROUNDING):
        wanted = f"at most their spacing, {spacing:.6g} (m), so that girders do not overlap"
        raise bridge.girders.unexpected("width_m", wanted)
    over_all = (bridge.girders.number - 1) * spacing + width
    if over_all > bridge.deck.width_m * (1.0 + ROUNDING):
        room = f"bridge.deck.width_m, {bridge.deck.width_m} (m)"
        raise bridge.girders.unexpected(
            "number", f"girders that fit under {room}, found {over_all:.6g} over all of them"
        )


def _check_other_piers(bridge: Bridge) -> None:
    for name in ("arch", "frame", "merge"):
        if getattr(bridge, name):
            raise ScenarioError(
                f"bridge.{name} is given: expected none with bridge.other_piers, or with batter_percent or "
                "feet_apart_m of piers"
            )
    if bridge.piers is None:
        raise ScenarioError("bridge.other_piers are given: expected none without bridge.piers, from which they differ")
    numbers = [number for table in bridge.other_piers for number in table.piers]
    for table in bridge.other_piers:
        if max(table.piers) > pier_count(bridge):
            raise table.unexpected("piers", f"numbers up to {pier_count(bridge)}, that of the last pier")
        if any(numbers.count(number) > 1 for number in table.piers):
            raise table.unexpected("piers", "each pier once in all [[bridge.other_piers]]")
    for piers in kinds_of_piers(bridge):
        _check_leaning(bridge, piers)


def _check_leaning(bridge: Bridge, piers: Piers) -> None:
    shortest = min(bridge.span_lengths_m)
    if piers.foot_length_m() >= shortest:
        raise piers.unexpected(
            "batter_percent", f"less: feet {piers.foot_length_m():g} m long do not fit into a span of {shortest:g} m"
        )
    if piers.feet_apart_m is None:
        return
    tops = bridge.carried_width_m * (1.0 - 1.0 / piers.columns)
    if 0.5 * abs(piers.feet_apart_m - tops) > piers.height_m:
        room = f"within {2.0 * piers.height_m:g} m of {tops:g} (m), their distance at the top"
        raise piers.unexpected("feet_apart_m", f"{room}, so that columns lean by 45° at most")
    if bridge.reinforcement and bridge.reinforcement.is_designed and bridge.reinforcement.has_bars:
        raise bridge.reinforcement.refused(
            "expected [[bridge.reinforcement.ratios]] with feet_apart_m of piers, or [[reinforcement]]: the tie "
            "between leaning columns is not designed for"
        )


def _column_turn(bridge: Bridge, piers: Piers) -> float:
    """Return a column's length along the road over the room it takes there once it is turned."""
    return 1.0 if piers.is_wall or piers.is_round else float(cosine(math.radians(bridge.skew_deg)))


def _longest_support_m(bridge: Bridge) -> float:
    """Return the length along the road of the longest of what carries the deck."""
    lengths = [bridge.abutments.length_m] if bridge.abutments else []
    lengths += [piers.column_length_m / _column_turn(bridge, piers) for piers in kinds_of_piers(bridge)]
    if bridge.pier_caps:
        lengths.append(bridge.pier_caps.length_m)
    return max(lengths)


def _half_support_m(bridge: Bridge) -> float:
    """Return how far from its axis the longest support extends, along the middle of the road: on a curve more than by
    its length, as the inner edge of the road is shorter."""
    half, radius = 0.5 * _longest_support_m(bridge), bridge.alignment.radius_m if bridge.alignment else None
    return half if radius is None else half * abs(radius) / (abs(radius) - 0.5 * _widest_m(bridge))


def _widest_m(bridge: Bridge) -> float:
    widths = [part.width_m for part in (bridge.deck, bridge.pier_caps, bridge.abutments) if part]
    return max([*widths, *(piers.column_width_m for piers in kinds_of_piers(bridge))])


def _check_curve(bridge: Bridge, alignment: Alignment, radius_m: float) -> None:
    widest = _widest_m(bridge)
    if abs(radius_m) <= widest:
        raise alignment.unexpected(
            "radius_m", f"more than {widest:g} (m) or less than {-widest:g}, the width of what is on the curve"
        )
    if bridge.skew_deg != 0.0:
        raise ScenarioError(f"bridge.skew_deg is {bridge.skew_deg:g}: expected 0 with bridge.alignment.radius_m")
    shortest, half = min(bridge.span_lengths_m), _half_support_m(bridge)
    if 2.0 * half >= shortest:
        raise alignment.unexpected(
            "radius_m",
            f"more, so that supports {2.0 * half:.4g} m long in its middle fit into a span of {shortest:g} m",
        )


def _check_line(bridge: Bridge) -> None:
    own = "alignment" if bridge.alignment else "haunches"
    for name in ("arch", "frame", "merge"):
        if getattr(bridge, name):
            raise ScenarioError(f"bridge.{own} and bridge.{name} are given together: expected at most one")
    if bridge.alignment and bridge.alignment.radius_m is not None:
        _check_curve(bridge, bridge.alignment, bridge.alignment.radius_m)
    if bridge.haunches:
        _check_haunches(bridge, bridge.haunches)
    if bridge.alignment:
        bridge.alignment.check_axes(axes_m(bridge), deck_top(bridge))


def _check_haunches(bridge: Bridge, haunches: Haunches) -> None:
    if bridge.voids:
        raise ScenarioError("bridge.haunches and bridge.voids are given together: expected at most one")
    axes = axes_m(bridge)
    haunches.check_along(axes, _half_support_m(bridge))
    for axis in axes:
        if not lower_by_m(bridge, axis):
            continue
        if bridge.abutments and axis in (axes[0], axes[-1]):
            haunches.check_depth(deck_underside(bridge) - SHORTEST_SUPPORT_M, "the height of abutments")
        elif bridge.piers:
            haunches.check_depth(bridge.piers.height_m - SHORTEST_SUPPORT_M, "bridge.piers.height_m")


def _check_room_along(bridge: Bridge) -> None:
    shortest = min(bridge.span_lengths_m)
    supports: list[tuple[Table, str, float]] = []
    supports += [(piers, "column_length_m", _column_turn(bridge, piers)) for piers in kinds_of_piers(bridge)]
    if bridge.pier_caps:
        supports.append((bridge.pier_caps, "length_m", 1.0))
    for part, name, turn in supports:
        if getattr(part, name) >= shortest * turn:
            limit = f"the shortest span, {shortest} (m)" if turn == 1.0 else f"{shortest * turn:.6g} (m), turned"
            raise part.unexpected(name, f"less than {limit}")
    if bridge.abutments:
        lengths = [getattr(part, name) / turn for part, name, turn in supports]
        _check_room_beside_abutments(bridge, bridge.abutments, max(lengths, default=bridge.abutments.length_m))


def _check_room_beside_abutments(bridge: Bridge, abutments: Abutments, next_length: float) -> None:
    shortest = min(bridge.span_lengths_m[0], bridge.span_lengths_m[-1])
    if (abutments.length_m + next_length) / 2.0 >= shortest:
        wanted = f"less, so that the abutments do not overlap the next support in a span of {shortest} (m)"
        raise abutments.unexpected("length_m", wanted)


def _check_joints(bridge: Bridge) -> None:
    """Check that both decks at a joint lie on the pier under it."""
    if bridge.deck.joint_gap_m <= 0.0 or len(bridge.span_lengths_m) == 1:
        return
    lengths = [piers.column_length_m for piers in kinds_of_piers(bridge)]
    support = bridge.pier_caps.length_m if bridge.pier_caps else min(lengths)
    if bridge.deck.joint_gap_m >= support:
        wanted = f"less than {support} (m), the length of the pier or pier cap that carries both decks"
        raise bridge.deck.unexpected("joint_gap_m", wanted)


def _check_room_across(bridge: Bridge, piers: Piers) -> None:
    carried = bridge.pier_caps or bridge.box_girder or bridge.deck
    widest = bridge.carried_width_m / piers.columns
    if not piers.is_wall and piers.column_width_m > widest * (1.0 + ROUNDING):
        wanted = f"at most {widest:.6g} (m), so that the columns fit into {carried.table}.width_m"
        raise piers.unexpected("column_width_m", wanted)
    caps = bridge.pier_caps
    if (
        caps
        and caps.end_height_m is not None
        and bridge.columns_half_width_m(piers) >= 0.5 * caps.width_m * (1.0 - ROUNDING)
    ):
        raise caps.unexpected("end_height_m", "none where the columns reach to the ends of bridge.pier_caps.width_m")
    if bridge.girders and not bridge.pier_caps:
        _check_columns_under_girders(bridge, piers, bridge.girders, widest)


def _check_columns_under_girders(bridge: Bridge, piers: Piers, girders: Girders, column_spacing: float) -> None:
    """Check that no column, without pier caps, stands between two girders and carries nothing."""
    columns, number = piers.columns, girders.number
    reach = (piers.column_width_m + girders.width_m) / 2.0
    for column in range(columns):
        position = (column - (columns - 1) / 2.0) * column_spacing
        apart = [abs(position - (girder - (number - 1) / 2.0) * bridge.girder_spacing_m) for girder in range(number)]
        if min(apart) >= reach * (1.0 - ROUNDING):
            wanted = f"as many as bridge.girders.number, {number}, or bridge.pier_caps"
            raise piers.unexpected("columns", f"{wanted}, as a column stands between two girders and carries nothing")


def _check_half_joints(bridge: Bridge) -> None:
    for name in ("arch", "frame", "merge", "box_girder"):
        if getattr(bridge, name):
            raise ScenarioError(f"bridge.half_joints and bridge.{name} are given together: expected at most one")
    if bridge.deck.per_span:
        raise bridge.deck.unexpected("per_span", "false with bridge.half_joints, which divide one deck")
    if bridge.bearings is None:
        raise ScenarioError("bridge.bearings is missing: expected a table with bridge.half_joints")
    if bridge.reinforcement and bridge.reinforcement.is_designed:
        raise ScenarioError(
            "bridge.reinforcement is designed for loads: expected [[bridge.reinforcement.ratios]] with "
            "bridge.half_joints, or [[reinforcement]]: a deck with hinges is not designed"
        )
    check_half_joints(bridge.half_joints, axes_m(bridge), _half_support_m(bridge))
    pinned_supports(bridge.half_joints, axes_m(bridge), (bridge.bearings.pinned_at or 1) - 1)


def _check_one_density(bridge: Bridge) -> None:
    for part in (bridge.deck, bridge.girders, bridge.piers, bridge.pier_caps, bridge.abutments):
        if part and part.density_kg_m3 is not None:
            raise part.unexpected("density_kg_m3", "none where bridge.merge is true, as one solid has one density")


def _check_arch(bridge: Bridge, arch: Arch) -> None:
    if bridge.merge:
        raise ScenarioError("bridge.arch is given: expected none with bridge.merge, where no member is left")
    if bridge.skew_deg != 0.0:
        raise ScenarioError(f"bridge.skew_deg is {bridge.skew_deg:g}: expected 0 with bridge.arch")
    if len(axes_m(bridge)) < 3:
        raise ScenarioError("bridge.span_lengths_m has one span: expected two spans at least with bridge.arch")
    arch.check_supports(len(axes_m(bridge)), given(bridge.piers).columns)
    piers, axis = given(bridge.piers), arch_axis(bridge)
    arch.check_room(axis, axes_on_arch_m(bridge), piers.column_length_m, piers.height_m)
    arch.check_width(bridge.carried_width_m / piers.columns, piers.columns, piers.column_width_m)
    lengths = [piers.column_length_m]
    if bridge.abutments and set(springing_axes_m(bridge)) & {axes_m(bridge)[0], axes_m(bridge)[-1]}:
        lengths.append(bridge.abutments.length_m)
    arch.check_blocks(axis, springing_axes_m(bridge)[0], max(lengths))


def _check_frame(bridge: Bridge, frame: RigidFrame) -> None:
    for name in ("piers", "pier_caps", "girders", "box_girder", "arch"):
        if getattr(bridge, name):
            raise ScenarioError(f"bridge.{name} is given: expected none with bridge.frame, of a slab on legs")
    if bridge.deck.per_span:
        raise bridge.deck.unexpected("per_span", "false with bridge.frame, whose deck is of one piece with all legs")
    if bridge.merge:
        raise ScenarioError("bridge.frame is given: expected none with bridge.merge, where no member is left")
    if bridge.skew_deg != 0.0:
        raise ScenarioError(f"bridge.skew_deg is {bridge.skew_deg:g}: expected 0 with bridge.frame")
    if not leg_axes_m(bridge):
        raise ScenarioError(
            "bridge.abutments are given: expected none with bridge.frame and one span, or no leg is left"
        )
    ends = -bridge.deck.overhang_m, bridge.spans_m + bridge.deck.overhang_m
    frame.check_room(leg_axes_m(bridge), ends, ends_on_legs=bridge.abutments is None)
    frame.check_width(bridge.deck.width_m)
