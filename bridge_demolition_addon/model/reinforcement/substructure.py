"""Bars of what carries the decks: pier caps as beams, columns, also round, and walls under axial force, abutments."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.geometry.solids import across_flats_m
from ...engineering.reinforced_concrete.influence_lines import MovingLoad, extreme_effects, influence_lines
from ...engineering.reinforced_concrete.least_areas import (
    LARGEST_SHARE,
    BarChoice,
    bar_area_m2,
    bars_in_rows,
    clear_m,
    diameters_from,
    level_of_wall_m2,
    of_column_m2,
    upright_of_wall_m2,
)
from ...engineering.reinforced_concrete.materials import PERMANENT_FACTOR, VARIABLE_FACTOR
from ...engineering.reinforced_concrete.resistance import ColumnSection, PressedShape, design_moment_nm
from ..bridge.member import Member
from ..scenario.bridge_parts import PierCaps, Piers
from ..schema import given
from .design_basis import (
    COLUMN_LINK_M,
    LEAST,
    BarDesign,
    BeamEffects,
    DesignBasis,
    Tension,
    beam_effects,
    column_links,
    column_loads,
)
from .schedule import ScheduledBars, ScheduledLinks
from .superstructure import DeckLine, deck_weight_n_m, whole_traffic

_SIDES = ("start", "end", "right", "left")
_FEWEST = 8
"""Bars of a ring: four are the least by EN 1992-1-1:2004, 9.5.2 (4), and a ring of two on each side is round."""

_MOST_SPACING_M = 0.25


def round_column_bars(
    basis: BarDesign, names: Sequence[str], diameter_m: float, height_m: float, axial_n: float, buckling_m: float
) -> Iterator[ScheduledBars | ScheduledLinks]:
    """Yield the bars of equal round columns as a layer at each of four sides, and their hoops.

    The section of concrete is taken for the square of the same area, with the ring's bars at the distance from the
    middle at which two rows have its second moment of area, A r² / 2.
    """
    bar, required, reason = _ring(basis, names[0], diameter_m, axial_n, buckling_m)
    radius = _radius_m(basis, diameter_m, bar)
    fewest = max(_FEWEST, required / bar_area_m2(bar), math.tau * radius / _MOST_SPACING_M)
    number = 4 * math.ceil(0.25 * fewest - 1e-9)
    choice = BarChoice(number // 4, bar, 1, math.tau * radius / number)
    depth = 0.5 * across_flats_m(diameter_m) - _layer_distance_m(diameter_m, radius)
    found = Tension(choice, depth, 0.25 * required, reason)
    for side in _SIDES:
        yield basis.scheduled(names, "pier", side, "z", found, section_m2=_area_m2(diameter_m), length_m=height_m)
    loop_m = math.pi * (diameter_m - 2.0 * basis.rule.cover_m)
    yield column_links(names, bar, side_m=diameter_m, legs=2, width_m=diameter_m, loop_m=loop_m, length_m=height_m)


def _area_m2(diameter_m: float) -> float:
    return 0.25 * math.pi * (diameter_m * diameter_m)


def _radius_m(basis: BarDesign, diameter_m: float, bar_m: float) -> float:
    return 0.5 * diameter_m - basis.rule.cover_m - COLUMN_LINK_M - 0.5 * bar_m


def _layer_distance_m(diameter_m: float, radius_m: float) -> float:
    """Return how far from the middle four layers lie that are spread over their chords, and stiff as the ring.

    Two lie a to either side, A a² / 2, and two are spread over chords of 2 b, A b² / 6, with b² = D² / 4 - a²; together
    they have A r² / 2.
    """
    squared = 1.5 * (radius_m * radius_m) - 0.125 * (diameter_m * diameter_m)
    return math.sqrt(max(squared, 0.0))


def _ring(
    basis: BarDesign, name: str, diameter_m: float, axial_n: float, buckling_m: float
) -> tuple[float, float, str]:
    """Return the diameter of the bars of a ring, their total area, and what it follows from."""
    area = _area_m2(diameter_m)
    least, side = of_column_m2(axial_n, area, basis.design_yield_pa), math.sqrt(area)
    for bar in diameters_from(basis.bar_m):
        radius = _radius_m(basis, diameter_m, bar)
        if radius <= 0.0:
            raise basis.rule.unexpected("cover_m", f"less: the bars of {name} would lie in its middle or beyond")
        section = ColumnSection(side, side, 0.5 * side - radius / math.sqrt(2.0), basis.concrete, basis.design_yield_pa)
        moment = design_moment_nm(axial_n, section, buckling_m)
        needed = section.bars_m2(axial_n, moment)
        if not np.isfinite(needed) or needed > LARGEST_SHARE * area:
            raise basis.refused(
                f"{name} cannot carry its design load of {axial_n / _KILO:.0f} kN with {moment / _KILO:.0f} kN·m: it "
                f"would need more than {LARGEST_SHARE:.0%} of its section of {diameter_m:g} m diameter in bars; take "
                "thicker or more columns"
            )
        required, reason = (needed, column_loads(axial_n, moment)) if needed > least else (least, LEAST)
        if required <= math.tau * radius / (bar + clear_m(bar)) * bar_area_m2(bar):
            return bar, required, reason
    raise basis.refused(f"{name} needs more bars than fit around it; take thicker or more columns")


Rows = Iterator[ScheduledBars | ScheduledLinks]

_KILO = 1e3
_MM2 = 1e6
_FREE_TOP = 2.0
"""Buckling length of a pier along the road by its height, its top free: EN 1992-1-1:2004, figure 5.7 b."""

_LEGS_APART_M = 0.3
_COLUMN_SPACING_M = 0.25


@dataclass(frozen=True, slots=True)
class ColumnSize:
    """Sizes of a column along and across the road, and its height."""

    length_m: float
    width_m: float
    height_m: float


@dataclass(frozen=True, slots=True)
class SupportLoad:
    """Vertical loads of the decks on a support, without factors."""

    permanent_n: float
    traffic_n: float


def support_loads(basis: DesignBasis, lines: Sequence[DeckLine]) -> list[SupportLoad]:
    """Return the loads on all supports along the road; axles stand on either deck of a joint."""
    count = len(basis.bridge.span_lengths_m) + 1
    points: list[list[np.ndarray]] = [[] for _ in range(count)]
    reactions: list[list[np.ndarray]] = [[] for _ in range(count)]
    permanent = np.zeros(count)
    for line in lines:
        own = beam_effects(line.lines, deck_weight_n_m(basis, line), ()).permanent_reactions_n
        for row, support in enumerate(line.supports):
            permanent[support] += own[row]
            points[support].append(line.lines.points_m)
            reactions[support].append(line.lines.reactions[row])
    everywhere = [replace(load, hogging_only=False) for load in whole_traffic(basis)]
    loads = []
    for support in range(count):
        along, joined = _joined(points[support], reactions[support])
        _, largest = extreme_effects(along, joined[None, :], everywhere)
        loads.append(SupportLoad(float(permanent[support]), float(largest[0])))
    return loads


def _joined(points: Sequence[np.ndarray], reactions: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Put the lines of a reaction by two decks together: where these meet, the larger one counts."""
    along, values = np.concatenate(points), np.concatenate(reactions)
    distinct, index = np.unique(along, return_inverse=True)
    joined = np.full(len(distinct), -np.inf)
    np.maximum.at(joined, index, values)
    return distinct, joined


def pier_bars(basis: DesignBasis, loads: Sequence[SupportLoad]) -> Rows:
    """Yield the bars of piers and abutments with such loads on their supports."""
    bridge = basis.bridge
    on_piers = loads[1:-1] if bridge.abutments else loads
    for number, load in enumerate(on_piers, start=1):
        yield from _pier(basis, number, load)
    for abutment in basis.of_kind("abutment"):
        sizes = given(bridge.abutments)
        yield from _wall(basis, abutment, sizes.length_m, sizes.width_m, "abutment", 0.0)


def _pier(basis: DesignBasis, number: int, load: SupportLoad) -> Rows:
    piers, name = basis.bridge.piers_of(number), f"pier {number}"
    columns = [m for m in basis.of_kind("pier") if m.name == name or m.name.startswith(f"{name} column ")]
    permanent_n = load.permanent_n / len(columns)
    if caps := basis.bridge.pier_caps:
        (cap,) = (member for member in basis.of_kind("pier cap") if member.name == f"{name} cap")
        effects = _cap_effects(basis, cap, caps, piers, load)
        permanent_n = float(effects.permanent_reactions_n.max())
        yield from _cap_bars(basis, cap, caps, piers, effects)
    traffic_n = load.traffic_n * min(1.0, 2.0 / len(columns))  # it may stand off the axis of the road
    axial = [
        PERMANENT_FACTOR * (permanent_n + basis.weight_n(column)) + VARIABLE_FACTOR * traffic_n for column in columns
    ]
    if piers.is_wall:
        yield from _wall(basis, columns[0], piers.column_length_m, piers.column_width_m, "pier", axial[0])
        return
    highest = max(range(len(columns)), key=lambda index: (_height_m(columns[index]), axial[index]))
    is_frame = len(columns) > 1 and basis.bridge.pier_caps is not None
    size = ColumnSize(piers.column_length_m, piers.column_width_m, _height_m(columns[highest]))
    across = size.height_m if is_frame else _FREE_TOP * size.height_m
    names = [column.name for column in columns]
    buckling = (_FREE_TOP * size.height_m, across)
    if piers.is_round:
        yield from round_column_bars(basis, names, size.length_m, size.height_m, max(axial), max(buckling))
    else:
        yield from column_bars(basis, names, size, max(axial), buckling)


def _height_m(member: Member) -> float:
    return float(np.ptp(member.solid.vertices[:, 2]))


def _column_axes(basis: DesignBasis, piers: Piers) -> list[float]:
    return [basis.bridge.carried_width_m * ((number + 0.5) / piers.columns - 0.5) for number in range(piers.columns)]


def _cap_effects(basis: DesignBasis, cap: Member, caps: PierCaps, piers: Piers, load: SupportLoad) -> BeamEffects:
    """Return the effects on a pier cap: loads of the decks are spread evenly over it, traffic where it is worst."""
    half = 0.5 * caps.width_m
    lines = influence_lines(_column_axes(basis, piers), -half, half)
    permanent = (load.permanent_n + basis.weight_n(cap)) / caps.width_m
    return beam_effects(lines, permanent, (MovingLoad(uniform_n_m=load.traffic_n / caps.width_m),))


def _cap_bars(basis: DesignBasis, cap: Member, caps: PierCaps, piers: Piers, effects: BeamEffects) -> Rows:
    shape = PressedShape.rectangle(caps.height_m, caps.length_m)
    advice = "take a larger bridge.pier_caps.height_m"
    axes, face = _column_axes(basis, piers), 0.5 * piers.column_width_m
    moments = {"bottom": effects.sagging_nm, "top": effects.hogging_beyond_nm(axes, face)}
    main = {
        side: basis.tension(
            cap.name,
            moment,
            shape,
            bars_width_m=caps.length_m,
            outside_m=basis.rule.cover_m + basis.link_m,
            advice=advice,
        )
        for side, moment in moments.items()
    }
    section = caps.length_m * caps.height_m
    for side, found in main.items():
        yield basis.scheduled([cap.name], "pier cap", side, "y", found, section_m2=section, length_m=caps.width_m)
    depth = caps.height_m - main["top"].depth_m
    row = basis.links_for(
        [cap.name],
        "pier cap",
        effects.shear_beyond_n(axes, face + depth),
        width_m=caps.length_m,
        webs=1,
        height_m=caps.height_m,
        depth_m=depth,
        bars_m2=main["top"].choice.area_m2,
        length_m=caps.width_m,
        advice=advice,
    )
    if row:
        yield row


def column_bars(
    basis: BarDesign, names: Sequence[str], size: ColumnSize, axial_n: float, buckling_m: tuple[float, float]
) -> Rows:
    """Yield the bars of equal columns at all four sides, and their links.

    `buckling_m` are the buckling lengths along and across the road.
    """
    length, width, height_m = size.length_m, size.width_m, size.height_m
    outside = basis.rule.cover_m + COLUMN_LINK_M
    diameter, pairs = _bars_of_column(basis, names[0], size, axial_n, buckling_m)
    axis = outside + 0.5 * diameter
    for sides, (required, reason), room in (
        (("start", "end"), pairs[0], width - 2.0 * outside),
        (("right", "left"), pairs[1], length - 2.0 * outside - 2.0 * (diameter + clear_m(diameter))),
    ):
        if room < diameter:
            continue
        choice = bars_in_rows(0.5 * required, room, diameter, 1, least_spacing_m=0.0, most_spacing_m=_COLUMN_SPACING_M)
        found = Tension(given(choice), axis, 0.5 * required, reason)
        for side in sides:
            yield basis.scheduled(names, "pier", side, "z", found, section_m2=length * width, length_m=height_m)
    yield _column_links(basis, names, size, diameter)


def _bars_of_column(
    basis: BarDesign, name: str, size: ColumnSize, axial_n: float, buckling_m: tuple[float, float]
) -> tuple[float, tuple[tuple[float, str], tuple[float, str]]]:
    """Return the diameter of a column's bars, and their areas at both faces along the road and at both across it."""
    length, width = size.length_m, size.width_m
    outside, section_m2 = basis.rule.cover_m + COLUMN_LINK_M, length * width
    least = of_column_m2(axial_n, section_m2, basis.design_yield_pa)
    shares = width / (length + width), length / (length + width)
    for diameter in diameters_from(basis.bar_m):
        axis = outside + 0.5 * diameter
        if axis >= 0.5 * min(length, width):
            raise basis.rule.unexpected("cover_m", f"less: the bars of {name} would lie in its middle or beyond")
        pairs, fits = [], True
        for (high, wide), buckling, share, room in (
            ((length, width), buckling_m[0], shares[0], width - 2.0 * outside),
            (
                (width, length),
                buckling_m[1],
                shares[1],
                length - 2.0 * outside - 2.0 * (diameter + clear_m(diameter)),
            ),
        ):
            section = ColumnSection(high, wide, axis, basis.concrete, basis.design_yield_pa)
            moment = design_moment_nm(axial_n, section, buckling)
            needed = section.bars_m2(axial_n, moment)
            if not np.isfinite(needed) or needed > LARGEST_SHARE * section_m2:
                raise basis.refused(
                    f"{name} cannot carry its design load of {axial_n / _KILO:.0f} kN with {moment / _KILO:.0f} kN·m: "
                    f"it would need more than {LARGEST_SHARE:.0%} of its section of {length:g} × {width:g} m in bars; "
                    "take thicker or more columns"
                )
            text = column_loads(axial_n, moment)
            pairs.append((needed, text) if needed > least * share else (least * share, "least area"))
            per_side = 0.5 * pairs[-1][0]
            most = (1 + int(max(room - diameter, 0.0) / (diameter + clear_m(diameter)))) * bar_area_m2(diameter)
            fits = fits and (room < diameter or per_side <= most)
        if fits:
            return diameter, (pairs[0], pairs[1])
    raise basis.refused(f"{name} needs more bars than fit along its sides; take thicker or more columns")


def _column_links(basis: BarDesign, names: Sequence[str], size: ColumnSize, bar_m: float) -> ScheduledLinks:
    length, width, cover = size.length_m, size.width_m, basis.rule.cover_m
    legs = 2 + max(int(np.ceil((width - 2.0 * cover) / _LEGS_APART_M)) - 1, 0)
    loop_m = legs * (length - 2.0 * cover) + 2.0 * (width - 2.0 * cover)
    return column_links(
        names, bar_m, side_m=min(length, width), legs=legs, width_m=width, loop_m=loop_m, length_m=size.height_m
    )


def _wall(basis: DesignBasis, member: Member, length_m: float, width_m: float, kind: str, axial_n: float) -> Rows:
    """Yield the bars of a wall across the road, upright and level at both faces."""
    height, section = _height_m(member), length_m * width_m
    outside = basis.rule.cover_m
    upright, reason = upright_of_wall_m2(section), "least area"
    if axial_n:
        shape = ColumnSection(
            length_m, width_m, outside + basis.secondary_m + 0.5 * basis.bar_m, basis.concrete, basis.design_yield_pa
        )
        moment = design_moment_nm(axial_n, shape, _FREE_TOP * height)
        needed = shape.bars_m2(axial_n, moment)
        if not np.isfinite(needed):
            raise basis.refused(
                f"{member.name} cannot carry its design load of {axial_n / _KILO:.0f} kN with "
                f"{moment / _KILO:.0f} kN·m: it would need more than {LARGEST_SHARE:.0%} of its section in bars; take "
                "a larger bridge.piers.column_length_m"
            )
        if needed > upright:
            upright, reason = needed, column_loads(axial_n, moment)
    level = level_of_wall_m2(upright / width_m, length_m) * height
    inside = outside + basis.secondary_m
    of_upright = basis.least_bars(member.name, length_m, width_m, 0.5 * upright, inside, reason)
    of_level = basis.least_bars(member.name, length_m, height, 0.5 * level, outside, "least area")
    for side in ("start", "end"):
        yield basis.scheduled([member.name], kind, side, "z", of_upright, section_m2=section, length_m=height)
        yield basis.scheduled([member.name], kind, side, "y", of_level, section_m2=length_m * height, length_m=width_m)
